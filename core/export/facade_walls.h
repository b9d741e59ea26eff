// The walls of a standing storey as simple bodies: one for each straight side and each curve of its outline and its courtyards.
#pragma once

#include <vector>

#include "core/export/proposal_model.h"

namespace bl::exporting {

struct FacadeWall {
  enum class Side { free, plot, neighbour, courtyard };
  geometry::Ring outline;  ///< in plan, counter-clockwise; its outer side is that of the plate [m]
  double length = 0;       ///< of its outer side [m]
  Side side = Side::free;  ///< what is on the other side of it
};

/// Walls stand within the plate and meet in mitres where corners are not too sharp for that. Nothing for rounded volumes, which
/// have no façades. A side that is too short for walls of this thickness [m] has none. Short sides that follow each other in
/// nearly one direction are the chords of a curve, such as a plate has at a distance from a corner, and have one wall together;
/// its length is the sum of theirs.
std::vector<FacadeWall> facade_walls(const Storey& storey, const Point3& arc_centre, double thickness);

}  // namespace bl::exporting
