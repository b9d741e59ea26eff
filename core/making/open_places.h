// Lays the open space of a programme into the plan of a new scene: rectangles that nobody builds on.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/plan_ring.h"
#include "core/import/programme_csv.h"

namespace bl::making {

/// A rectangle within the plan, clear of its holes and of all others.
struct OpenPlace {
  std::string name;     ///< unique among them
  std::size_t row = 0;  ///< of the programme
  geometry::Ring ring;  ///< counter-clockwise
  double area = 0;      ///< [m²]
  double asked = 0;     ///< that it should have [m²]
};

/// The direction of the longest side of a plan, of length 1; of equal sides that of the first.
Vector3 main_direction(const geometry::Ring& plan);

/// One place for each item of rows that are open space, along the main direction of the plan: as square as there is room for, the
/// first near the middle, later ones away from earlier ones. What does not fit becomes smaller; what fits nowhere is left out.
/// Both, and where places lie, is told in `notes`.
std::vector<OpenPlace> lay_open_places(const geometry::Ring& plan, const std::vector<geometry::Ring>& holes,
                                       const std::vector<importing::ProgrammeRow>& rows, std::vector<std::string>& notes);

}  // namespace bl::making
