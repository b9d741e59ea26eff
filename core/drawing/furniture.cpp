// Labels are placed greedily: at their anchor, then on rings around it with a leader, then in short form.
#include "core/drawing/furniture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/text.h"
#include "core/drawing/palette.h"

namespace bl::drawing {

namespace {

constexpr double kNameSize = 11.5, kFigureSize = 10, kShortSize = 9.5;
// Up is tried before down, and the sides between.
constexpr std::array kAngles = {90, 60, 120, 30, 150, 0, 180, -30, 210, -60, 240, 270};

Pixel toward(Pixel from, Pixel to, double distance) {
  const double x = to.x - from.x, y = to.y - from.y, length = std::max(std::hypot(x, y), 1e-9);
  return {from.x + x / length * distance, from.y + y / length * distance};
}

}  // namespace

double text_width(const std::string& text, double size) {
  std::size_t letters = 0;
  for (const char c : text) letters += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u ? 1 : 0;
  return static_cast<double>(letters) * size * 0.56;
}

bool LabelPlacer::take(const Box& box) {
  if (!frame_.contains(box)) return false;
  if (std::any_of(taken_.begin(), taken_.end(), [&](const Box& other) { return other.overlaps(box); })) return false;
  taken_.push_back(box);
  return true;
}

bool LabelPlacer::place_long(Markup& svg, const Label& label) {
  const double wide = std::max(text_width(label.first, kNameSize), text_width(label.second, kFigureSize)) + 6, tall = 27;
  const auto try_at = [&](Pixel centre, bool has_leader) {
    const Box box{centre.x - wide / 2, centre.y - tall / 2, centre.x + wide / 2, centre.y + tall / 2};
    if (!take(box)) return false;
    if (has_leader) {
      const Pixel end = toward({std::clamp(label.anchor.x, box.left, box.right), std::clamp(label.anchor.y, box.top, box.bottom)},
                               label.anchor, 1);
      PathText leader;
      leader.polyline({end, label.anchor}, false);
      svg.path(leader, {{"class", "leader"}});
      svg.leaf("circle", {{"cx", pixels(label.anchor.x)}, {"cy", pixels(label.anchor.y)}, {"r", "1.8"}, {"class", "dot"}});
    }
    svg.element("text", label.first, {{"x", pixels(centre.x)}, {"y", pixels(centre.y - 2)}, {"class", "name"}});
    svg.element("text", label.second, {{"x", pixels(centre.x)}, {"y", pixels(centre.y + 10)}, {"class", "figure"}});
    return true;
  };
  if (try_at(label.anchor, false)) return true;
  for (const double reach : {30.0, 50.0, 75.0, 105.0})
    for (const int angle : kAngles) {
      const double radians = angle * std::numbers::pi / 180, across = reach + wide / 2 - tall / 2;
      if (try_at({label.anchor.x + across * std::cos(radians), label.anchor.y - reach * std::sin(radians)}, true)) return true;
    }
  return false;
}

bool LabelPlacer::place_short(Markup& svg, const Label& label) {
  const double wide = text_width(label.short_form, kShortSize) + 3, tall = 11;
  for (const double reach : {0.0, 7.0, 12.0})
    for (const int angle : kAngles) {
      if (reach == 0 && angle != kAngles[0]) break;
      const double radians = angle * std::numbers::pi / 180;
      const Pixel at{label.anchor.x + reach * std::cos(radians), label.anchor.y - reach * std::sin(radians)};
      if (!take({at.x - wide / 2, at.y - tall / 2, at.x + wide / 2, at.y + tall / 2})) continue;
      svg.element("text", label.short_form, {{"x", pixels(at.x)}, {"y", pixels(at.y + 3.4)}, {"class", "short"}});
      return true;
    }
  return false;
}

std::size_t LabelPlacer::write(Markup& svg, const std::vector<Label>& labels, std::size_t most_long) {
  std::size_t without = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (!(i < most_long && place_long(svg, labels[i])) && !place_short(svg, labels[i])) ++without;
  return without;
}

void draw_north(Markup& svg, const View& view, double degrees, Pixel centre, double radius) {
  const auto at = [&](double angle, double share) {
    const double a = (degrees + angle) * std::numbers::pi / 180;
    const Vector3 ground = Vector3{std::sin(a), std::cos(a), 0} * (radius * share);
    return Pixel{centre.x + dot(ground, view.right), centre.y - dot(ground, view.up)};
  };
  PathText circle, dark, light;
  std::vector<Pixel> ring;
  for (int i = 0; i < 48; ++i) ring.push_back(at(7.5 * i, 0.8));
  circle.polyline(ring, true);
  dark.polyline({at(0, 1), at(150, 0.62), at(180, 0.3)}, true);
  light.polyline({at(0, 1), at(210, 0.62), at(180, 0.3)}, true);
  svg.open("g", {{"role", "img"}}).element("title", "North");
  svg.path(circle, {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", ".7"}, {"stroke-opacity", ".55"}});
  svg.path(light, {{"fill", hex(kPaper)}, {"stroke", hex(kInk)}, {"stroke-width", ".7"}, {"stroke-linejoin", "round"}});
  svg.path(dark, {{"fill", hex(kInk)}, {"stroke", hex(kInk)}, {"stroke-width", ".7"}, {"stroke-linejoin", "round"}});
  const Pixel letter = at(0, 1);
  const Pixel place = toward(letter, centre, -9);
  svg.element("text", "N", {{"x", pixels(place.x)}, {"y", pixels(place.y + 4)}, {"class", "name"}});
  svg.close();
}

double round_length(double most) {
  if (!(most > 0) || !std::isfinite(most)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= most) return factor * power;
  return power;
}

void draw_scale_bar(Markup& svg, double pixels_per_metre, Pixel at, double most_width) {
  const double metres = round_length(most_width / pixels_per_metre), width = metres * pixels_per_metre;
  svg.open("g", {{"role", "img"}}).element("title", "Scale bar of " + shortest(metres) + " m");
  for (int part = 0; part < 4; ++part) {
    const bool is_dark = part % 2 == 0;
    svg.leaf("rect", {{"x", pixels(at.x + width * part / 4)},
                      {"y", pixels(at.y)},
                      {"width", pixels(width / 4)},
                      {"height", "4"},
                      {"fill", hex(is_dark ? kInk : kPaper)},
                      {"stroke", hex(kInk)},
                      {"stroke-width", ".7"}});
  }
  for (const double share : {0.0, 0.5, 1.0}) {
    const std::string figure = shortest(metres * share) + (share == 1 ? "\xC2\xA0m" : "");
    svg.element("text", figure, {{"x", pixels(at.x + width * share)}, {"y", pixels(at.y - 5)}, {"class", "figure"}});
  }
  svg.close();
}

}  // namespace bl::drawing
