// Balls in buckets by size and place in plan, so that those near a vertical line are found without looking at all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

class PlanBuckets {
 public:
  /// Balls of no radius are left out. `low` and `high` span the plan in which most of the centres lie.
  PlanBuckets(const Point3& low, const Point3& high, std::span<const Point3> centres, std::span<const double> radii);

  /// A ball has another place or size.
  void change(std::size_t ball, const Point3& centre, double radius);

  /// Calls `see` for every ball whose centre is, in plan, no farther from `point` than `share` times the sum of `radius` and its
  /// own, and for some more beside them; each once.
  template <class See>
  void near(const Point3& point, double radius, double share, See&& see) const {
    for (const Size& size : sizes_) {
      const double reach = share * (radius + size.largest);
      const Place low = place_of(size, point.x - reach, point.y - reach), high = place_of(size, point.x + reach, point.y + reach);
      for (std::size_t y = low.row; y <= high.row; ++y)
        for (std::size_t x = low.column; x <= high.column; ++x)
          for (const std::uint32_t ball : size.buckets[y * most_ + x]) see(std::size_t{ball});
    }
  }

 private:
  // Balls of radii in [largest / 2, largest), by squares of the plan.
  struct Size {
    int exponent = 0;
    double largest = 0, width = 0;
    std::vector<std::vector<std::uint32_t>> buckets;  // row by row
  };
  struct Place {
    std::size_t column, row;
  };

  Place place_of(const Size& size, double x, double y) const;
  Size& size_for(double radius);
  // Where the ball is kept.
  std::vector<std::uint32_t>& bucket_of(const Point3& centre, double radius);

  Point3 low_;
  double extent_ = 0;
  std::size_t most_ = 1;  // columns and rows of a size
  std::vector<Size> sizes_;
  std::vector<Point3> centres_;
  std::vector<double> radii_;
};

}  // namespace bl::geometry
