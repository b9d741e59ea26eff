// Boxes in plan on a grid: which of many shapes can a place or a shape meet at all?
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/plan_ring.h"

namespace bl::importing {

/// An upright box in plan [m].
struct PlanBox {
  double west = 0, east = 0, south = 0, north = 0;
  bool meets(const PlanBox& other) const {
    return west <= other.east && east >= other.west && south <= other.north && north >= other.south;
  }
};
PlanBox plan_box(std::span<const Point3> ring);

/// Boxes are numbered in the order in which they were added.
class BoxGrid {
 public:
  /// `extent`: where most boxes lie; `expected`: about how many they are.
  BoxGrid(const PlanBox& extent, std::size_t expected);
  /// Of the outer rings of a list of shapes.
  template <class Shapes, class Outer>
  static BoxGrid of(const Shapes& shapes, const Outer& outer);

  void add(const PlanBox& box);
  /// The numbers of the boxes that meet this one, ascending.
  std::vector<std::size_t> meeting(const PlanBox& box) const;

 private:
  struct Cells {
    std::size_t left, right, low, high;
    std::size_t count() const { return (right - left + 1) * (high - low + 1); }
  };
  Cells cells_of(const PlanBox& box) const;

  PlanBox extent_;
  std::size_t side_;
  std::vector<PlanBox> boxes_;
  std::vector<std::vector<std::size_t>> cells_;
  std::vector<std::size_t> large_;  // boxes that lie in many cells
};

template <class Shapes, class Outer>
BoxGrid BoxGrid::of(const Shapes& shapes, const Outer& outer) {
  std::vector<PlanBox> boxes;
  for (const auto& shape : shapes) boxes.push_back(plan_box(outer(shape)));
  PlanBox extent = boxes.empty() ? PlanBox{} : boxes.front();
  for (const PlanBox& box : boxes) {
    extent.west = extent.west < box.west ? extent.west : box.west, extent.east = extent.east > box.east ? extent.east : box.east;
    extent.south = extent.south < box.south ? extent.south : box.south;
    extent.north = extent.north > box.north ? extent.north : box.north;
  }
  BoxGrid grid(extent, boxes.size());
  for (const PlanBox& box : boxes) grid.add(box);
  return grid;
}

}  // namespace bl::importing
