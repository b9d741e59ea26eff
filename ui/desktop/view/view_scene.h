// Everything that a renderer needs for one picture of the scene, as plain data: no OpenGL, no state of the simulation.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/shared_list.h"
#include "ui/desktop/view/camera.h"

namespace bl::desktop {

/// Packed as ImGui packs them: red in the lowest byte, alpha in the highest.
using Colour = std::uint32_t;

/// The windows of a façade, for each of the eight orientations clockwise from north.
struct ViewFacade {
  struct Side {
    float width = 0, module = 1;  ///< of a window as a share of its module; of the module [m]
    float sill = 0, head = 0;     ///< above each floor [m]
    bool operator==(const Side&) const = default;
  };
  std::array<Side, 8> sides;
  float north = 0;  ///< clockwise from the y axis [degree]
  bool operator==(const ViewFacade&) const = default;
};

/// A volume: its coarse cell, which the renderer divides and wraps onto the ball that the cell's wrap names.
struct ViewVolume {
  /// plain: no edges and storeys of its own; hatched: its height is assumed.
  enum Flag : std::uint32_t { hovered = 1, chosen = 2, dimmed = 4, dressed = 16, hatched = 32, plain = 64 };
  std::uint32_t node = 0;  ///< index in the state, for picking
  MeshPointer cell;        ///< never empty, always with a wrap
  Colour colour = 0;
  float bottom = 0, storey = 0;  ///< [m], of the storey lines; 0: none
  std::uint32_t flags = 0;
  ViewFacade facade = {};  ///< where the flag `dressed` is set
  bool operator==(const ViewVolume&) const = default;
};

/// In ascending node. Pictures that follow each other share the volumes that look the same; each leaf knows how many coarse
/// triangles it has.
using ViewVolumes = SharedList<ViewVolume, std::size_t>;
ViewVolumes published(ViewVolumes::Draft&& draft);
inline ViewVolumes listed(std::vector<ViewVolume> volumes) { return published(ViewVolumes::Draft(std::move(volumes))); }
/// What is shared is not looked at.
bool operator==(const ViewVolumes& a, const ViewVolumes& b);
bool have_same_cells(const ViewVolumes& a, const ViewVolumes& b);
std::size_t coarse_triangles(const ViewVolumes& volumes);

/// A line of a width in pixels; what lies behind volumes is hidden, or faint where `hidden_share` is above 0.
struct ViewLine {
  Point3 from, to;
  Colour colour = 0;
  float width = 1;
  float hidden_share = 0;
  /// From the point before it, and to the one after it, where its corners meet those of its neighbours; 0: it begins, it ends.
  Vector3 came = {}, goes = {};
  bool operator==(const ViewLine&) const = default;
};

/// A translucent surface, such as the boundary.
struct ViewSurface {
  MeshPointer mesh;
  Colour colour = 0;
  bool operator==(const ViewSurface&) const = default;
};

/// A picture of a file on a plane.
struct ViewPicture {
  std::string path;
  Point3 corner;       ///< lower left, as people see it [m]
  Vector3 across, up;  ///< along its lower and its left side [m]
  float opacity = 1;
  int orientation = 1;     ///< of EXIF, 1 to 8
  bool is_veiled = false;  ///< it may not be shown
  bool operator==(const ViewPicture&) const = default;
  Point3 middle() const { return corner + 0.5 * (across + up); }
};

/// The half-space that is shown: normal · x <= offset.
struct ViewSection {
  bool is_on = false;
  Vector3 normal{0, 0, 1};
  double offset = 0;  ///< [m]
  bool operator==(const ViewSection&) const = default;
};

struct ViewColours {
  Colour sky = 0, ground = 0, grid = 0, edge = 0, chosen = 0, hovered = 0, cut = 0;
  bool is_dark = true;
  bool operator==(const ViewColours&) const = default;
};

/// Parts of the picture that can be left out.
struct ViewLayers {
  bool shadows = true, edges = true, storeys = true, ground = true;  // façades: the flag of each volume
  bool operator==(const ViewLayers&) const = default;
};

struct ViewScene {
  Camera camera;
  Point3 origin;                   ///< what coordinates on the graphics processor are relative to [m]
  Point3 centre;                   ///< of everything that is drawn [m]
  double radius = 100;             ///< of the ball around it [m]
  double ground = 0;               ///< height of the ground [m]
  bool is_ground_cut = false;      ///< the section takes the ground away too: there is something below it
  double grid = 10;                ///< distance of its lines [m]
  Vector3 sun{-0.45, -0.6, 0.66};  ///< towards the light, a unit vector
  float scale = 1;                 ///< pixels per point
  int most_triangles = 0;          ///< of one picture; 0: as the renderer sees fit
  bool is_hurried = false;         ///< pictures follow each other: a slow renderer may divide volumes less finely
  ViewColours colours;
  ViewLayers layers;
  ViewSection section;
  ViewVolumes volumes;
  std::vector<ViewSurface> surfaces;
  std::vector<ViewSurface> bodies;  ///< translucent, and seen as one: of those that lie behind each other only the nearest side
  std::vector<ViewLine> lines;
  std::vector<ViewPicture> pictures;
  bool operator==(const ViewScene&) const = default;

  double near_plane() const;  ///< [m] from the eye
  double far_plane() const;
};

/// Splits of each coarse triangle (0 to 4) so that a picture has no more than so many triangles in all.
int depth_within(std::size_t coarse_triangles, int most_triangles, int deepest);

}  // namespace bl::desktop
