// The axes of a view from two angles, and the fit of a drawing into its frame.
#include "core/drawing/projection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bl::drawing {

View axonometric_view(double azimuth, double elevation) {
  const double a = azimuth * std::numbers::pi / 180, e = elevation * std::numbers::pi / 180;
  const Vector3 toward{std::cos(e) * std::sin(a), std::cos(e) * std::cos(a), std::sin(e)};
  const Vector3 right{-std::cos(a), std::sin(a), 0};
  return {right, cross(toward, right), toward};
}

View plan_view() { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}; }

Sheet::Sheet(const View& view, std::span<const Point3> content, double width, double most_height, const Box& margins)
    : view_(view), width_(width) {
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;
  bool is_first = true;
  for (const Point3& point : content) {
    const double x = dot(point, view.right), y = dot(point, view.up);
    low_x = is_first ? x : std::min(low_x, x);
    high_x = is_first ? x : std::max(high_x, x);
    low_y = is_first ? y : std::min(low_y, y);
    high_y = is_first ? y : std::max(high_y, y);
    is_first = false;
  }
  const double wide = std::max(high_x - low_x, 1e-3), tall = std::max(high_y - low_y, 1e-3);
  const double room = width - margins.left - margins.right, most = most_height - margins.top - margins.bottom;
  scale_ = std::min(room / wide, most / tall);
  height_ = tall * scale_ + margins.top + margins.bottom;
  left_ = margins.left + 0.5 * (room - wide * scale_) - low_x * scale_;
  top_ = margins.top + high_y * scale_;
}

Pixel Sheet::at(const Point3& point) const {
  return {left_ + dot(point, view_.right) * scale_, top_ - dot(point, view_.up) * scale_};
}

}  // namespace bl::drawing
