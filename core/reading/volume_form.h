// The forms in which volumes are drawn, measured and exported, and the storeys, the body and the figures of a volume in each.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/mesh.h"
#include "core/geometry/plates.h"

namespace bl::reading {

enum class VolumeForm : std::uint8_t { as_is, balls, cells, slabs, standing };

struct VolumeFormChoice {
  VolumeForm form = VolumeForm::as_is;
  const char *id, *label, *doc;
  const char* measured;  ///< what a figure of it is: "as they are", "as balls"
};
inline constexpr std::size_t kVolumeForms = 5;
/// All forms, in the order of menus.
std::span<const VolumeFormChoice> volume_forms();
const VolumeFormChoice& choice_of(VolumeForm form);

struct FormedStorey {
  double bottom = 0, top = 0;  ///< height above the origin [m]
  double area = 0;             ///< of its floor [m²]
  std::vector<geometry::PlateFace> faces;
};

/// A volume as its solver made it: what other forms of it follow from.
struct FormSource {
  bool is_standing = false;
  Point3 position;                                   ///< [m]
  double volume = 0, floor_area = 0;                 ///< [m³], [m²]
  double bottom = 0, height = 0, storey_height = 3;  ///< [m]
  MeshPointer shape;                                 ///< of a rounded one, with its coarse mesh; only cells want it
  std::vector<FormedStorey> storeys;                 ///< balls and cells do without
};

/// Where solvers measure the floor area of a rounded body: in the middle of each whole storey from its bottom up, and of what is
/// left above the last one, which counts by its share of a storey. A body without a whole storey has one floor.
struct FloorCut {
  double bottom = 0, top = 0, at = 0;  ///< [m]
  double share = 1;                    ///< by which its section counts
  bool is_drawn = true;                ///< as a storey; what is left and no more than half a storey belongs to the one below
};
std::vector<FloorCut> floor_cuts(double bottom, double height, double storey);

struct FormedVolume {
  double volume = 0, floor_area = 0;  ///< [m³], [m²]
  double bottom = 0, top = 0;         ///< height above the origin [m]
  std::vector<FormedStorey> storeys;
  std::shared_ptr<const Mesh> mesh;  ///< closed, its volume that of the figure but for rounding
};

/// For every form but `as_is`: null mesh where the volume has none. A volume that stands is, in every form but balls, what it is.
/// - balls: one ball of the same volume, around the place of a rounded volume or the middle of one that stands; its floors are
/// cut
///   in the middle of each storey, as solvers measure rounded volumes.
/// - cells: what neighbours and boundary leave between the volume's own bottom and top, with flat facets, measured in the same
/// way.
/// - slabs: each storey as a plate of its floor; the floor area is that of the scene, the volume that of the plates.
/// - standing: whole storeys on the largest floor, as many as the volume fills, at least one; such bodies may meet each other.
/// Without its body, storeys have no faces and there is no mesh, except of cells: figures alone take less time.
FormedVolume in_form(const FormSource& source, VolumeForm form, bool with_body = true);

/// The radius of a ball of that volume [m].
double ball_radius(double volume);
/// Where its middle lies [m].
Point3 ball_middle(const FormSource& source);
/// The cell with flat facets, as a coarse mesh; null where it cannot be made.
MeshPointer flat_cell(const FormSource& source);

}  // namespace bl::reading
