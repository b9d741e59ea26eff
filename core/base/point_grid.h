// Finds the points near a place among many, also while they move.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vector.h"

namespace bl {

/// Points in cells of space of one size. Cells are found by a hash of where they lie, so it does not matter how far the points
/// are spread. What a search finds does not depend on the order in which the points were moved.
class PointGrid {
 public:
  PointGrid() = default;
  /// `side` of a cell [m]: searches are quick up to about this distance. In plan, heights do not count.
  PointGrid(std::vector<Point3> points, double side, bool in_plan);

  std::size_t size() const { return points_.size(); }
  const Point3& operator[](std::uint32_t point) const { return points_[point]; }
  void move(std::uint32_t point, const Point3& to);

  /// From a to b, as distances are measured here.
  Vector3 way(const Point3& a, const Point3& b) const { return {b.x - a.x, b.y - a.y, in_plan_ ? 0 : b.z - a.z}; }
  /// No point is farther away than this, but for rounding.
  double farthest(const Point3& from) const;

  /// Calls visit(point) for every point within a distance [m], also for some beyond it, and for some more than once.
  template <class Visit>
  void visit_near(const Point3& centre, double distance, const Visit& visit) const {
    const Vector3 room{distance, distance, distance};
    const Cell low = cell_of(centre - room), high = cell_of(centre + room);
    if (points_.size() < count_of(low, high)) {
      for (std::uint32_t point = 0; point < points_.size(); ++point) visit(point);
      return;
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
          for (std::uint32_t point = first_[bucket_of({x, y, z})]; point != kNone; point = next_[point]) visit(point);
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  // Never descends where the point ascends, whatever is rounded: what lies between two points lies between their cells.
  Cell cell_of(const Point3& point) const;
  std::size_t bucket_of(const Cell& cell) const;
  // How many cells there are from one to another; more than any list of points holds where the product is too large.
  static std::size_t count_of(const Cell& low, const Cell& high);
  void insert(std::uint32_t point);

  std::vector<Point3> points_;
  double side_ = 1;
  bool in_plan_ = false;
  std::vector<std::uint32_t> first_, next_;  // first point of a bucket; next point of the same bucket
  Point3 low_, high_;                        // all points lie between these
};

}  // namespace bl
