// Maps between plane and screen; doubles keep the point under the cursor where it is over many steps of zoom.
#include "ui/desktop/panels/canvas/camera.h"

namespace bl::desktop::canvas {

namespace {

constexpr double kGlideSeconds = 0.22;
constexpr float kFitMargin = 26;
// Of the zoom without anything over the corner: what makes room for that is not worth more.
constexpr double kLeastViewShare = 0.75;

}  // namespace

void Camera::set_pane(Box pane, float scale, double now) {
  // The middle stays the middle when a splitter moves.
  const Pose kept = pose();
  const bool is_changed = pane.size.x != pane_.size.x || pane.size.y != pane_.size.y || scale_ != static_cast<double>(scale);
  pane_ = pane;
  scale_ = static_cast<double>(scale);
  now_ = now;
  if (is_changed) set(kept);
  if (glide_end_ < 0) return;
  const double t = std::clamp((now - glide_begin_) / kGlideSeconds, 0.0, 1.0);
  const double eased = t * t * (3 - 2 * t);
  const double zoom = begin_.zoom * std::pow(goal_.zoom / begin_.zoom, eased);
  // The middle follows the zoom, so that nothing rushes past on the way.
  const double share =
      std::abs(goal_.zoom - begin_.zoom) < 1e-9 ? eased : (1 / begin_.zoom - 1 / zoom) / (1 / begin_.zoom - 1 / goal_.zoom);
  set({begin_.x + (goal_.x - begin_.x) * share, begin_.y + (goal_.y - begin_.y) * share, zoom});
  if (t >= 1) set(goal_), glide_end_ = -1;
}

ImVec2 Camera::to_screen(ImVec2 p) const {
  const double k = zoom_ * scale_;
  return {static_cast<float>(pane_.at.x + (static_cast<double>(p.x) - x_) * k),
          static_cast<float>(pane_.at.y + (static_cast<double>(p.y) - y_) * k)};
}

ImVec2 Camera::to_plane(ImVec2 p) const {
  const double k = zoom_ * scale_;
  return {static_cast<float>(x_ + static_cast<double>(p.x - pane_.at.x) / k),
          static_cast<float>(y_ + static_cast<double>(p.y - pane_.at.y) / k)};
}

Camera::Pose Camera::pose() const {
  const double k = zoom_ * scale_;
  return {x_ + static_cast<double>(pane_.size.x) / 2 / k, y_ + static_cast<double>(pane_.size.y) / 2 / k, zoom_};
}

void Camera::set(const Pose& pose) {
  zoom_ = std::clamp(pose.zoom, kLeastZoom, kMostZoom);
  const double k = zoom_ * scale_;
  x_ = pose.x - static_cast<double>(pane_.size.x) / 2 / k;
  y_ = pose.y - static_cast<double>(pane_.size.y) / 2 / k;
}

void Camera::pan(ImVec2 pixels) {
  glide_end_ = -1;
  const double k = zoom_ * scale_;
  x_ -= static_cast<double>(pixels.x) / k;
  y_ -= static_cast<double>(pixels.y) / k;
}

void Camera::zoom_at(ImVec2 at, double factor) {
  glide_end_ = -1;
  const double before = zoom_ * scale_;
  zoom_ = std::clamp(zoom_ * factor, kLeastZoom, kMostZoom);
  const double after = zoom_ * scale_;
  x_ += static_cast<double>(at.x - pane_.at.x) * (1 / before - 1 / after);
  y_ += static_cast<double>(at.y - pane_.at.y) * (1 / before - 1 / after);
}

void Camera::centre_on(ImVec2 p) {
  glide_end_ = -1;
  set({static_cast<double>(p.x), static_cast<double>(p.y), zoom_});
}

void Camera::glide(const Pose& goal) {
  begin_ = pose();
  goal_ = goal;
  goal_.zoom = std::clamp(goal_.zoom, kLeastZoom, kMostZoom);
  glide_begin_ = now_;
  glide_end_ = now_ + kGlideSeconds;
}

// The box in the middle of what is left of the pane beside the head, and a strip at the left and at the foot.
Camera::Pose Camera::pose_beside(const Box& box, double left, double foot) const {
  const double margin = 2 * static_cast<double>(kFitMargin) * scale_;
  const double across = (static_cast<double>(pane_.size.x) - margin - left) / std::max(1.0, static_cast<double>(box.size.x));
  const double down =
      (static_cast<double>(pane_.size.y) - margin - head_ - foot) / std::max(1.0, static_cast<double>(box.size.y));
  const double zoom = std::clamp(std::min(across, down) / scale_, kLeastZoom, 1.0), k = zoom * scale_;
  return {static_cast<double>(box.centre().x) - left / 2 / k, static_cast<double>(box.centre().y) - (head_ - foot) / 2 / k, zoom};
}

bool Camera::is_clear(const Pose& pose, const std::vector<Box>& bodies) const {
  const float k = static_cast<float>(pose.zoom * scale_);
  const ImVec2 middle{static_cast<float>(pose.x), static_cast<float>(pose.y)};
  const Box corner{{0, pane_.size.y - corner_.y}, corner_};
  return std::none_of(bodies.begin(), bodies.end(), [&](const Box& body) {
    return corner.touches({(body.at - middle) * k + pane_.size * 0.5f, body.size * k});
  });
}

void Camera::fit(const Box& box, bool is_soft, const std::vector<Box>& bodies) {
  const Pose whole = pose_beside(box, 0, 0);
  Pose best = whole;
  const std::vector<Box> all = bodies.empty() ? std::vector<Box>{box} : bodies;
  if (corner_.x > 0 && !is_clear(whole, all)) {
    // Beside the corner or above it, whichever leaves the box larger; as it was where both make it too small.
    const Pose beside = pose_beside(box, static_cast<double>(corner_.x), 0);
    const Pose above = pose_beside(box, 0, static_cast<double>(corner_.y));
    const Pose& larger = beside.zoom >= above.zoom ? beside : above;
    if (larger.zoom >= kLeastViewShare * whole.zoom) best = larger;
  }
  go_to(best, is_soft);
}

void Camera::go_to(const Pose& goal, bool is_soft) {
  if (is_soft) return glide(goal);
  glide_end_ = -1;
  set(goal);
}

void Camera::glide_to_zoom(double zoom) {
  const Pose from = aim();
  glide({from.x, from.y, zoom});
}

}  // namespace bl::desktop::canvas
