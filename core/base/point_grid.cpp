// Cells of points: how they are made and kept.
#include "core/base/point_grid.h"

#include <bit>
#include <cmath>

namespace bl {

PointGrid::PointGrid(std::vector<Point3> points, double side, bool in_plan)
    : points_(std::move(points)), side_(std::clamp(side, 1e-3, 1e12)), in_plan_(in_plan) {
  first_.assign(std::bit_ceil(points_.size() + 1), kNone);
  next_.assign(points_.size(), kNone);
  if (!points_.empty()) low_ = high_ = points_.front();
  for (std::uint32_t point = 0; point < points_.size(); ++point) insert(point);
}

void PointGrid::move(std::uint32_t point, const Point3& to) {
  std::uint32_t* at = &first_[bucket_of(cell_of(points_[point]))];
  while (*at != point) at = &next_[*at];
  *at = next_[point];
  points_[point] = to;
  insert(point);
}

double PointGrid::farthest(const Point3& from) const {
  const auto reach = [](double low, double high, double at) { return std::max(std::abs(low - at), std::abs(high - at)); };
  const double z = in_plan_ ? 0 : reach(low_.z, high_.z, from.z);
  return norm({reach(low_.x, high_.x, from.x), reach(low_.y, high_.y, from.y), z});
}

PointGrid::Cell PointGrid::cell_of(const Point3& point) const {
  const auto step = [&](double x) { return static_cast<std::int64_t>(std::clamp(std::floor(x / side_), -1e15, 1e15)); };
  return {step(point.x), step(point.y), in_plan_ ? 0 : step(point.z)};
}

std::size_t PointGrid::bucket_of(const Cell& cell) const {
  std::uint64_t mixed = 0;
  for (const std::int64_t step : cell) {
    mixed = (mixed ^ static_cast<std::uint64_t>(step)) * 0x9e3779b97f4a7c15u;
    mixed ^= mixed >> 32;
  }
  return mixed & (first_.size() - 1);
}

std::size_t PointGrid::count_of(const Cell& low, const Cell& high) {
  double count = 1;
  for (int axis = 0; axis < 3; ++axis) count *= static_cast<double>(high[axis] - low[axis] + 1);
  return static_cast<std::size_t>(std::min(count, 1e15));
}

void PointGrid::insert(std::uint32_t point) {
  const Point3& at = points_[point];
  low_ = {std::min(low_.x, at.x), std::min(low_.y, at.y), std::min(low_.z, at.z)};
  high_ = {std::max(high_.x, at.x), std::max(high_.y, at.y), std::max(high_.z, at.z)};
  std::uint32_t& first = first_[bucket_of(cell_of(at))];
  next_[point] = first;
  first = point;
}

}  // namespace bl
