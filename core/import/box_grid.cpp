// As many cells as boxes; a box of many cells is kept beside the grid, so that large ones do not fill it.
#include "core/import/box_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bl::importing {

namespace {

constexpr std::size_t kManyCells = 64, kMostSide = 512;

std::size_t cell_at(double place, double from, double to, std::size_t side) {
  const double share = to > from ? (place - from) / (to - from) * static_cast<double>(side) : 0;
  return share > 0 ? std::min(static_cast<std::size_t>(std::min(share, 1e9)), side - 1) : 0;
}

}  // namespace

PlanBox plan_box(std::span<const Point3> ring) {
  if (ring.empty()) return {};
  PlanBox box{ring[0].x, ring[0].x, ring[0].y, ring[0].y};
  for (const Point3& p : ring) {
    box.west = std::min(box.west, p.x), box.east = std::max(box.east, p.x);
    box.south = std::min(box.south, p.y), box.north = std::max(box.north, p.y);
  }
  return box;
}

BoxGrid::BoxGrid(const PlanBox& extent, std::size_t expected)
    : extent_(extent),
      side_(std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(expected))), 1, kMostSide)),
      cells_(side_ * side_) {}

BoxGrid::Cells BoxGrid::cells_of(const PlanBox& box) const {
  return {cell_at(box.west, extent_.west, extent_.east, side_), cell_at(box.east, extent_.west, extent_.east, side_),
          cell_at(box.south, extent_.south, extent_.north, side_), cell_at(box.north, extent_.south, extent_.north, side_)};
}

void BoxGrid::add(const PlanBox& box) {
  const std::size_t number = boxes_.size();
  boxes_.push_back(box);
  const Cells cells = cells_of(box);
  if (cells.count() > kManyCells) return large_.push_back(number);
  for (std::size_t row = cells.low; row <= cells.high; ++row)
    for (std::size_t column = cells.left; column <= cells.right; ++column) cells_[row * side_ + column].push_back(number);
}

std::vector<std::size_t> BoxGrid::meeting(const PlanBox& box) const {
  std::vector<std::size_t> found;
  const Cells cells = cells_of(box);
  if (cells.count() > kManyCells) {
    found.resize(boxes_.size());
    std::iota(found.begin(), found.end(), std::size_t{0});
  } else {
    found = large_;
    for (std::size_t row = cells.low; row <= cells.high; ++row)
      for (std::size_t column = cells.left; column <= cells.right; ++column)
        found.insert(found.end(), cells_[row * side_ + column].begin(), cells_[row * side_ + column].end());
  }
  std::erase_if(found, [&](std::size_t number) { return !boxes_[number].meets(box); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace bl::importing
