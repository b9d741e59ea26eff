// Points and boxes of the canvas's plane: x to the right, y down, in points at full size.
#pragma once

#include <algorithm>
#include <cmath>

#include <imgui.h>

namespace bl::desktop::canvas {

inline ImVec2 operator+(ImVec2 a, ImVec2 b) { return {a.x + b.x, a.y + b.y}; }
inline ImVec2 operator-(ImVec2 a, ImVec2 b) { return {a.x - b.x, a.y - b.y}; }
inline ImVec2 operator*(ImVec2 a, float k) { return {a.x * k, a.y * k}; }
inline float dot(ImVec2 a, ImVec2 b) { return a.x * b.x + a.y * b.y; }
inline float cross(ImVec2 a, ImVec2 b) { return a.x * b.y - a.y * b.x; }
inline float length(ImVec2 a) { return std::sqrt(dot(a, a)); }
inline ImVec2 unit_vector(ImVec2 a) { return length(a) > 1e-6f ? a * (1 / length(a)) : ImVec2(1, 0); }

struct Box {
  ImVec2 at, size;

  ImVec2 low() const { return at; }
  ImVec2 high() const { return at + size; }
  ImVec2 centre() const { return at + size * 0.5f; }
  bool holds(ImVec2 p) const { return p.x >= at.x && p.y >= at.y && p.x <= at.x + size.x && p.y <= at.y + size.y; }
  bool encloses(const Box& b) const { return holds(b.low()) && holds(b.high()); }
  bool touches(const Box& b) const {
    return at.x <= b.at.x + b.size.x && b.at.x <= at.x + size.x && at.y <= b.at.y + b.size.y && b.at.y <= at.y + size.y;
  }
  Box grown(float margin) const { return {at - ImVec2(margin, margin), size + ImVec2(2 * margin, 2 * margin)}; }
  /// The smallest box around both.
  Box with(const Box& b) const {
    const ImVec2 low{std::min(at.x, b.at.x), std::min(at.y, b.at.y)};
    const ImVec2 up{std::max(high().x, b.high().x), std::max(high().y, b.high().y)};
    return {low, up - low};
  }
};

/// The box between two opposite corners, whichever they are.
inline Box box_between(ImVec2 a, ImVec2 b) { return Box{a, {0, 0}}.with({b, {0, 0}}); }

/// Distance of a point from a stretch of line.
inline float distance(ImVec2 p, ImVec2 a, ImVec2 b) {
  const ImVec2 along = b - a;
  const float square = dot(along, along);
  const float t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0f, 1.0f) : 0.0f;
  return length(p - (a + along * t));
}

/// Do two stretches of line cross?
inline bool do_cross(ImVec2 a, ImVec2 b, ImVec2 c, ImVec2 d) {
  const float side_c = cross(b - a, c - a), side_d = cross(b - a, d - a);
  const float side_a = cross(d - c, a - c), side_b = cross(d - c, b - c);
  return side_c * side_d < 0 && side_a * side_b < 0;
}

}  // namespace bl::desktop::canvas
