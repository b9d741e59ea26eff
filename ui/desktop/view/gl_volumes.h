// The coarse cells on the graphics processor: what has changed since the last picture is sent, the rest stays there.
#pragma once

#include <array>
#include <vector>

#include "ui/desktop/view/gl_tools.h"
#include "ui/desktop/view/view_scene.h"

namespace bl::desktop {

class GlVolumes {
 public:
  static constexpr int kDeepest = 4;
  GlVolumes();
  ~GlVolumes();
  GlVolumes(const GlVolumes&) = delete;
  GlVolumes& operator=(const GlVolumes&) = delete;

  /// Makes the buffers follow the volumes. `depth`: how finely pictures divide them, to reckon what that has spared.
  void update(const ViewScene& scene, int depth, Traffic& traffic);
  /// Draws all volumes, each coarse triangle split `depth` times; the program in use reads `corners` and `records`.
  void draw(const GlProgram& program, int depth) const;
  /// Triangles that are not divided yet, with those that only keep room.
  std::size_t coarse_triangles() const { return triangle_room_; }

 private:
  struct Slot {
    MeshPointer cell;
    std::uint32_t first_corner = 0, corner_room = 0, first_triangle = 0, triangle_room = 0;
    std::array<float, 12> record{};
    std::array<float, 36> facade{};
    bool has_record = false, has_facade = false;
  };
  struct Grid {
    GLsizei indices = 0;
    std::size_t offset = 0;
    GLint base = 0;
  };
  void make_grids();
  void lay_out(const ViewVolumes& volumes, std::size_t count);
  bool has_room_for(const ViewVolume& volume, std::size_t k) const;
  void send_cell(std::size_t k, const ViewVolume& volume, bool is_laid_out, int depth, Traffic& traffic);
  void send_facade(std::size_t k, const ViewFacade& facade, Traffic& traffic);
  void send_record(std::size_t k, const ViewVolume& volume, const Point3& origin, Traffic& traffic);

  std::vector<Slot> slots_;
  ViewVolumes sent_;  ///< what the slots hold, relative to `origin_`
  Point3 origin_;
  std::size_t corner_room_ = 0, triangle_room_ = 0;
  GlTexels corners_{GL_RGBA32F}, records_{GL_RGBA32F}, facades_{GL_RGBA32F};
  GlBuffer instances_;
  GLuint array_ = 0, grid_vertices_ = 0, grid_indices_ = 0;
  std::array<Grid, kDeepest + 1> grids_;
};

}  // namespace bl::desktop
