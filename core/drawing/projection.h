// Orthographic views: from metres in space to pixels on a sheet, with depth.
#pragma once

#include <span>

#include "core/base/vector.h"
#include "core/drawing/markup.h"

namespace bl::drawing {

/// Three unit vectors at right angles; `toward` points from the drawing to the eye.
struct View {
  Vector3 right, up, toward;
};

/// From the direction `azimuth` (degrees clockwise from the y axis) and `elevation` degrees above the ground.
View axonometric_view(double azimuth, double elevation);
/// From above, y upwards.
View plan_view();

/// A rectangle of pixels.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool contains(const Box& other) const {
    return left <= other.left && top <= other.top && right >= other.right && bottom >= other.bottom;
  }
};

/// A view laid onto a sheet so that given points fill a frame.
class Sheet {
 public:
  /// `most_height` bounds the frame; the sheet's own height follows from what is drawn.
  Sheet(const View& view, std::span<const Point3> content, double width, double most_height, const Box& margins);
  Pixel at(const Point3& point) const;
  double depth(const Point3& point) const { return dot(point, view_.toward); }
  const View& view() const { return view_; }
  double scale() const { return scale_; }  ///< [px/m] of lengths that lie across the view
  double width() const { return width_; }
  double height() const { return height_; }

 private:
  View view_;
  double width_ = 0, height_ = 0, scale_ = 1, left_ = 0, top_ = 0;
};

}  // namespace bl::drawing
