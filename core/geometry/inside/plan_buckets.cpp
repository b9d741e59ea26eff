// One grid for each doubling of the radius: with a single grid one large ball would make all columns wide.
#include "core/geometry/inside/plan_buckets.h"

#include <algorithm>
#include <cmath>

namespace bl::geometry {

namespace {

// Far coordinates over small widths end at the last column, where they stay in order.
std::int64_t column_of(double coordinate, double width) {
  constexpr double kLast = 1e15;
  return static_cast<std::int64_t>(std::clamp(std::floor(coordinate / width), -kLast, kLast));
}

}  // namespace

PlanBuckets::PlanBuckets(std::span<const Point3> centres, std::span<const double> radii) {
  std::map<int, Size> by_exponent;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (!(radii[i] > 0) || !std::isfinite(radii[i])) continue;
    const int exponent = std::ilogb(radii[i]) + 1;
    Size& size = by_exponent[exponent];
    size.largest = std::ldexp(1.0, exponent);
    size.columns[column_of(centres[i].x, size.largest)][column_of(centres[i].y, size.largest)].push_back(i);
  }
  for (auto& [exponent, size] : by_exponent) sizes_.push_back(std::move(size));
}

void PlanBuckets::near(const Point3& point, double radius, double share, const std::function<void(std::size_t)>& see) const {
  for (const Size& size : sizes_) {
    const double reach = share * (radius + size.largest);
    const auto last = size.columns.upper_bound(column_of(point.x + reach, size.largest));
    for (auto column = size.columns.lower_bound(column_of(point.x - reach, size.largest)); column != last; ++column) {
      const auto end = column->second.upper_bound(column_of(point.y + reach, size.largest));
      for (auto at = column->second.lower_bound(column_of(point.y - reach, size.largest)); at != end; ++at)
        for (const std::size_t i : at->second) see(i);
    }
  }
}

}  // namespace bl::geometry
