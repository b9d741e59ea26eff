// The 3D view drawn with OpenGL 3.3: daylight with soft shadows, outlines, and cells that are wrapped where they are drawn.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ui/desktop/view/gl_pictures.h"
#include "ui/desktop/view/gl_volumes.h"
#include "ui/desktop/view/renderer.h"

namespace bl::desktop {

class GlRenderer final : public Renderer {
 public:
  /// An OpenGL context has to be current, now and whenever it is used. Nothing where the driver refuses; `failure` says why.
  static std::unique_ptr<GlRenderer> make(std::string& failure);
  ~GlRenderer() override;

  std::uintptr_t draw(const ViewScene& scene, int width, int height) override;
  std::uint64_t take_bytes_sent() override;
  std::uint64_t take_bytes_spared() override;
  std::string description() const override { return description_; }
  bool is_waiting() const override { return pictures_.is_waiting(); }
  std::string why_missing(const std::string& path) override { return pictures_.why_missing(path); }

  /// The corners of all triangles as the shaders make them, relative to the balls' centres: three floats each. For tests.
  std::vector<float> divided(const ViewScene& scene, int depth);
  /// The picture's pixels, RGBA, from the lower left corner. For tests and stills.
  std::vector<std::uint8_t> pixels() const;
  int width() const { return final_.width(); }
  int height() const { return final_.height(); }
  /// Until all files of pictures have come in that the last draw asked for. For tests and stills.
  void wait_for_pictures() { pictures_.wait(); }
  /// Splits of each triangle in the last picture.
  int depth() const { return depth_; }

 private:
  GlRenderer();
  bool build(std::string& failure);
  int affordable(const ViewScene& scene, int least_depth_off) const;
  void draw_maps(const ViewScene& scene);
  void draw_volumes(const ViewScene& scene);
  void draw_ground(const ViewScene& scene);
  void draw_surfaces(const ViewScene& scene);
  void draw_lines(const ViewScene& scene);
  void draw_bodies(const ViewScene& scene);
  void draw_pictures(const ViewScene& scene);
  void send_lines(const ViewScene& scene);
  void finish(const ViewScene& scene);
  void set_light(const GlProgram& program, const ViewScene& scene) const;
  static std::array<float, 4> section_of(const ViewScene& scene);
  bool has_new_shapes(const ViewScene& scene) const;

  /// Translucent meshes one after another, sent when they are others than before.
  struct Batch {
    GLuint array = 0;
    GlBuffer buffer;
    std::vector<ViewSurface> sent;
    Point3 origin;
  };
  void send(Batch& batch, const std::vector<ViewSurface>& surfaces, const Point3& origin);
  /// As flat paint that lies on what is drawn already, or as bodies with sides.
  const GlProgram& begin_surfaces(const ViewScene& scene, bool is_body) const;
  static void draw_batch(const GlProgram& program, const Batch& batch);
  void draw_line_quads(const ViewScene& scene, bool is_behind) const;

  struct Programs {
    GlProgram volumes, cut_volumes, shadow, heights, capture, ground, surfaces, lines, pictures, blur, finish;
  };
  std::unique_ptr<Programs> programs_;
  std::string description_;
  bool is_software_ = false;
  int oversampling_ = 1, depth_ = 0;
  float pixel_ = 1;
  Traffic traffic_;
  GlVolumes volumes_;
  GlPictures pictures_;
  GlTarget picture_, final_, shadow_, heights_, blurred_;
  GLuint empty_ = 0, line_array_ = 0;
  Batch surfaces_, bodies_;
  GlBuffer line_buffer_;
  Point3 line_origin_;
  std::vector<ViewLine> sent_lines_;
  Matrix matrix_{}, sun_matrix_{}, map_matrix_{};
  ViewScene last_;
  bool has_last_ = false;
};

}  // namespace bl::desktop
