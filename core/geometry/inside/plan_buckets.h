// Balls in buckets by size and place in plan, so that those near a vertical line are found without looking at all of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

class PlanBuckets {
 public:
  /// Balls of no radius are left out.
  PlanBuckets(std::span<const Point3> centres, std::span<const double> radii);

  /// Calls `see` for every ball whose centre is, in plan, no farther from `point` than `share` times the sum of `radius` and its
  /// own, and for some more beside them; each once.
  void near(const Point3& point, double radius, double share, const std::function<void(std::size_t)>& see) const;

 private:
  // Balls of radii in [largest / 2, largest), by columns of the plan as wide as `largest`.
  struct Size {
    double largest = 0;
    std::map<std::int64_t, std::map<std::int64_t, std::vector<std::size_t>>> columns;
  };
  std::vector<Size> sizes_;
};

}  // namespace bl::geometry
