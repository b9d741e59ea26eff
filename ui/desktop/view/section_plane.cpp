// The section's plane in numbers, as a rectangle and as text.
#include "ui/desktop/view/section_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "core/base/text.h"

namespace bl::desktop {

namespace {

constexpr double kDegree = std::numbers::pi / 180;
// How far the frame stands out of the model, as a share of its size.
constexpr double kOverhang = 0.05;

double whole_turns(double degrees) { return degrees - 360 * std::floor(degrees / 360); }

// Whole quarter turns have no rounding: planes along the axes stay exactly there.
Vector3 way_of(double bearing) {
  const double turns = whole_turns(bearing);
  if (turns == 0) return {0, 1, 0};
  if (turns == 90) return {1, 0, 0};
  if (turns == 180) return {0, -1, 0};
  if (turns == 270) return {-1, 0, 0};
  return {std::sin(turns * kDegree), std::cos(turns * kDegree), 0};
}

// To the micrometre, without a minus before nothing.
std::string metres_text(double metres) { return shortest(std::round(metres * 1e6) / 1e6 + 0.0); }

std::array<Point3, 4> plan_corners(const ModelBox& box, double z) {
  return {{{box.low.x, box.low.y, z}, {box.high.x, box.low.y, z}, {box.high.x, box.high.y, z}, {box.low.x, box.high.y, z}}};
}

}  // namespace

ViewSection level_section(double height) { return {true, {0, 0, 1}, height}; }

ViewSection upright_section(double bearing, double distance) {
  const Vector3 way = way_of(bearing);
  // 0 - x keeps a zero from becoming -0.
  return {true, {0 - way.x, 0 - way.y, 0}, 0 - distance};
}

double bearing_of(const ViewSection& section) {
  if (is_level(section)) return 0;
  const double degrees = std::atan2(-section.normal.x, -section.normal.y) / kDegree;
  return whole_turns(std::round(degrees * 1e6) / 1e6) + 0.0;
}

double position_of(const ViewSection& section) {
  return (is_level(section) && section.normal.z > 0 ? section.offset : -section.offset) + 0.0;
}

ViewSection flipped(const ViewSection& section) {
  const Vector3& n = section.normal;
  return {section.is_on, {0 - n.x, 0 - n.y, 0 - n.z}, 0 - section.offset};
}

ModelBox model_box(const SceneFacts& facts) {
  ModelBox box{{1e300, 1e300, facts.ground}, {-1e300, -1e300, facts.ground}};
  const auto take = [&](double x, double y, double reach) {
    box.low.x = std::min(box.low.x, x - reach), box.high.x = std::max(box.high.x, x + reach);
    box.low.y = std::min(box.low.y, y - reach), box.high.y = std::max(box.high.y, y + reach);
  };
  for (std::size_t k = 0; k < facts.volumes.size(); ++k) {
    const Point3& at = facts.columns.position[k];
    take(at.x, at.y, std::max(0.0, facts.columns.radius[k]));
    const VolumeFacts& volume = facts.volumes[k];
    if (!(volume.figures.height > 0)) continue;
    box.low.z = std::min(box.low.z, volume.figures.bottom);
    box.high.z = std::max(box.high.z, volume.figures.bottom + volume.figures.height);
  }
  for (const CellarFacts& cellar : facts.cellars)
    if (cellar.cell) box.low.z = std::min(box.low.z, cellar.bottom);
  for (const BoundaryFacts& boundary : facts.boundaries)
    for (const auto& [a, b] : boundary.edges) take(a.x, a.y, 0), take(b.x, b.y, 0);
  if (box.low.x > box.high.x) take(facts.centre.x, facts.centre.y, facts.radius);
  if (!(box.high.z > box.low.z)) box.high.z = box.low.z + std::max(1.0, 2 * (facts.centre.z - facts.ground));
  return box;
}

std::array<Point3, 4> section_corners(const ViewSection& section, const ModelBox& box) {
  const double reach = kOverhang * distance(box.low, box.high);
  if (is_level(section)) {
    const ModelBox wide{box.low - Vector3{reach, reach, 0}, box.high + Vector3{reach, reach, 0}};
    return plan_corners(wide, position_of(section));
  }
  // Along the plane from left to right as one looks, who sees the hidden half before them.
  const Vector3 along{-section.normal.y, section.normal.x, 0};
  double left = 1e300, right = -1e300;
  for (const Point3& corner : plan_corners(box, 0)) {
    const double at = dot(corner - Point3{}, along);
    left = std::min(left, at - reach), right = std::max(right, at + reach);
  }
  const Point3 foot = Point3{} + section.offset * section.normal;
  const auto at = [&](double way, double z) {
    const Point3 p = foot + way * along;
    return Point3{p.x, p.y, z};
  };
  return {{at(left, box.low.z), at(right, box.low.z), at(right, box.high.z + reach), at(left, box.high.z + reach)}};
}

std::string section_option(const ViewSection& section, const ModelBox& box) {
  if (is_level(section)) return metres_text(position_of(section));
  const auto corners = section_corners(section, box);
  std::string text;
  for (const Point3& end : {corners[0], corners[1]})
    text += (text.empty() ? "" : ",") + metres_text(end.x) + "," + metres_text(end.y);
  return text;
}

std::string section_text(const ViewSection& section) {
  if (!is_level(section)) return "upright " + shortest(bearing_of(section)) + " " + metres_text(position_of(section));
  return "level " + metres_text(position_of(section)) + (section.normal.z < 0 ? " below" : "");
}

std::optional<ViewSection> section_from_text(const std::string& text) {
  std::istringstream words(text);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  std::vector<double> numbers;
  for (std::size_t k = 1; k < all.size() && k < 3; ++k)
    if (const auto number = parse_number(all[k]); number && std::abs(*number) < 1e9) numbers.push_back(*number);
  if (all.size() == 3 && all[0] == "upright" && numbers.size() == 2) return upright_section(numbers[0], numbers[1]);
  const bool is_below = all.size() == 3 && all[2] == "below";
  if (all.empty() || all[0] != "level" || numbers.size() != 1 || (all.size() != 2 && !is_below)) return {};
  return is_below ? flipped(level_section(numbers[0])) : level_section(numbers[0]);
}

}  // namespace bl::desktop
