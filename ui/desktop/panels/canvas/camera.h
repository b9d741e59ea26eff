// Where the canvas is looked at: a place and a zoom, with soft flights between them.
#pragma once

#include "ui/desktop/panels/canvas/plane.h"

namespace bl::desktop::canvas {

class Camera {
 public:
  static constexpr double kLeastZoom = 0.02, kMostZoom = 4;

  /// The pane on the screen, in pixels, and pixels per point; said once for each frame.
  void set_pane(Box pane, float scale, double now);
  /// Pixels at the pane's upper edge that something lies over; what is fitted stays below.
  void set_head(float pixels) { head_ = static_cast<double>(pixels); }
  const Box& pane() const { return pane_; }
  double zoom() const { return zoom_; }
  /// Pixels for one unit of the plane.
  float factor() const { return static_cast<float>(zoom_ * scale_); }

  ImVec2 to_screen(ImVec2 p) const;
  ImVec2 to_plane(ImVec2 p) const;
  Box to_screen(const Box& box) const { return {to_screen(box.at), box.size * factor()}; }
  /// What is in sight.
  Box sight() const { return {to_plane(pane_.low()), pane_.size * (1 / factor())}; }

  void pan(ImVec2 pixels);
  /// What lies under `at` on the screen stays there.
  void zoom_at(ImVec2 at, double factor);
  void centre_on(ImVec2 p);
  /// Shows all of `box`, no larger than at full size.
  void fit(const Box& box, bool is_soft);
  /// Flies to a zoom around the middle of the pane.
  void glide_to_zoom(double zoom);
  bool is_gliding() const { return glide_end_ > now_; }

  struct Pose {
    double x = 0, y = 0, zoom = 1;  ///< the middle of the pane, in the plane
  };
  /// Where it is, or where it is flying to.
  Pose aim() const { return is_gliding() ? goal_ : pose(); }
  void go_to(const Pose& pose, bool is_soft);

 private:
  Pose pose() const;
  void set(const Pose& pose);
  void glide(const Pose& goal);

  Box pane_{{0, 0}, {1, 1}};
  double scale_ = 1, zoom_ = 1;
  double head_ = 0;
  double x_ = 0, y_ = 0;  // of the plane, at the pane's upper left corner
  Pose begin_, goal_;
  double now_ = 0, glide_begin_ = 0, glide_end_ = -1;
};

}  // namespace bl::desktop::canvas
