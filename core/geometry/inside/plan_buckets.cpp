// One grid for each doubling of the radius: with a single grid one large ball would make all columns wide.
#include "core/geometry/inside/plan_buckets.h"

#include <algorithm>
#include <cmath>

namespace bl::geometry {

namespace {

bool is_ball(double radius) { return radius > 0 && std::isfinite(radius); }

// What lies beyond the plan counts to its first or last column, where it stays in order.
std::size_t column_of(double distance, double width, std::size_t most) {
  return static_cast<std::size_t>(std::clamp(distance / width, 0.0, static_cast<double>(most - 1)));
}

}  // namespace

PlanBuckets::PlanBuckets(const Point3& low, const Point3& high, std::span<const Point3> centres, std::span<const double> radii)
    : low_(low),
      extent_(std::max(high.x - low.x, high.y - low.y)),
      most_(static_cast<std::size_t>(std::sqrt(static_cast<double>(centres.size()))) + 1),
      centres_(centres.begin(), centres.end()),
      radii_(radii.begin(), radii.end()) {
  for (std::size_t i = 0; i < centres_.size(); ++i)
    if (is_ball(radii_[i])) bucket_of(centres_[i], radii_[i]).push_back(static_cast<std::uint32_t>(i));
}

void PlanBuckets::change(std::size_t ball, const Point3& centre, double radius) {
  const auto number = static_cast<std::uint32_t>(ball);
  if (is_ball(radii_[ball])) {
    auto& before = bucket_of(centres_[ball], radii_[ball]);
    before.erase(std::find(before.begin(), before.end(), number));
  }
  centres_[ball] = centre;
  radii_[ball] = radius;
  if (is_ball(radius)) bucket_of(centre, radius).push_back(number);
}

PlanBuckets::Place PlanBuckets::place_of(const Size& size, double x, double y) const {
  return {column_of(x - low_.x, size.width, most_), column_of(y - low_.y, size.width, most_)};
}

PlanBuckets::Size& PlanBuckets::size_for(double radius) {
  const int exponent = std::ilogb(radius) + 1;
  const auto found = std::find_if(sizes_.begin(), sizes_.end(), [&](const Size& size) { return size.exponent == exponent; });
  if (found != sizes_.end()) return *found;
  const double largest = std::ldexp(1.0, exponent);
  sizes_.push_back({exponent, largest, std::max(largest, extent_ / static_cast<double>(most_)),
                    std::vector<std::vector<std::uint32_t>>(most_ * most_)});
  return sizes_.back();
}

std::vector<std::uint32_t>& PlanBuckets::bucket_of(const Point3& centre, double radius) {
  Size& size = size_for(radius);
  const Place place = place_of(size, centre.x, centre.y);
  return size.buckets[place.row * most_ + place.column];
}

}  // namespace bl::geometry
