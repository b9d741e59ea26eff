// The value at a place from scattered points with values: of the nearest one, weighted by distance, or the mean nearby.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

namespace bl::geometry {

enum class Sampling {
  nearest,           ///< the value of the nearest point
  inverse_distance,  ///< all points weighted with 1/d² (Shepard 1968)
  mean,              ///< the plain mean
};

/// Takes points one by one and keeps no list of them; their order affects only the last bits of the result.
class PointSampler {
 public:
  /// Only points within `radius` [m] in plan count.
  PointSampler(Sampling method, double x, double y, double radius) : method_(method), x_(x), y_(y), radius_(radius) {}

  void add(double x, double y, double value) {
    const double squared = (x - x_) * (x - x_) + (y - y_) * (y - y_);
    if (!(squared <= radius_ * radius_)) return;
    ++used_;
    if (squared < nearest_) {
      nearest_ = squared;
      nearest_value_ = value;
    }
    const double weight = method_ == Sampling::mean ? 1 : 1 / std::max(squared, 1e-12);
    sum_ += weight * value;
    weight_ += weight;
  }

  /// How many points were near enough.
  std::size_t used() const { return used_; }
  std::optional<double> value() const {
    if (used_ == 0) return std::nullopt;
    // At a point itself its value holds: its weight would be endless.
    if (method_ == Sampling::nearest || (method_ == Sampling::inverse_distance && nearest_ < 1e-12)) return nearest_value_;
    return sum_ / weight_;
  }

 private:
  Sampling method_;
  double x_, y_, radius_;
  double nearest_ = std::numeric_limits<double>::infinity(), nearest_value_ = 0, sum_ = 0, weight_ = 0;
  std::size_t used_ = 0;
};

}  // namespace bl::geometry
