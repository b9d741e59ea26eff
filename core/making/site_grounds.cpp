// Lines become strips of their width; words of maps become kinds of ground.
#include "core/making/site_grounds.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/geometry/domain_makers.h"
#include "core/making/use_rates.h"

namespace bl::making {

namespace {

// A lane of a street in a town, and the path beside it, where no width is known.
constexpr double kLane = 3.25, kPath = 1.75, kFootway = 2.5;  // [m]
// The clearance of a track: 2.5 m on each side of its axis (EBO, annex 1: standard clearance); of a tram 2.65 m for the vehicle
// (BOStrab) with 0.4 m on each side.
constexpr double kTrack = 5, kTramTrack = 3.5;  // [m]
// No corner reaches farther than so many half widths: pointed bends are cut into pieces instead.
constexpr double kMostMiter = 3;

constexpr std::array kStreets{"road", "street"};
constexpr std::array kRails{"railway", "rail"};
constexpr std::array kWater{"water", "riverbank", "dock", "reservoir", "basin", "wetland", "bay"};
constexpr std::array kGreen{
    "grass",     "forest",    "meadow",     "recreation_ground", "village_green", "allotments",  "orchard",
    "cemetery",  "park",      "garden",     "nature_reserve",    "pitch",         "wood",        "scrub",
    "grassland", "heath",     "grave_yard", "playground",        "green",         "green_space", "vineyard",
    "flowerbed", "greenfield"};

Vector3 along(const Point3& a, const Point3& b) {
  const Vector3 way{b.x - a.x, b.y - a.y, 0};
  return way / norm(way);
}

Vector3 left_of(const Vector3& way) { return {-way.y, way.x, 0}; }

// The points of the line in plan, without repetitions.
std::vector<Point3> flat(const std::vector<Point3>& line) {
  std::vector<Point3> points;
  for (const Point3& p : line)
    if (points.empty() || distance(points.back(), {p.x, p.y, 0}) > 1e-3) points.push_back({p.x, p.y, 0});
  return points;
}

geometry::Ring strip(const std::vector<Point3>& line, double half, bool& is_sound) {
  std::vector<Point3> left, right;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector3 before = i > 0 ? along(line[i - 1], line[i]) : along(line[i], line[i + 1]);
    const Vector3 after = i + 1 < line.size() ? along(line[i], line[i + 1]) : before;
    const Vector3 sum = left_of(before) + left_of(after);
    // The corner of two strips lies on the line between their normals, farther out the sharper the bend is.
    const double length = dot(sum, sum) / 2;
    if (!(length > 2 / (kMostMiter * kMostMiter))) {
      is_sound = false;
      return {};
    }
    const Vector3 aside = sum * (half / length);
    left.push_back(line[i] + aside);
    right.push_back(line[i] - aside);
  }
  right.insert(right.end(), left.rbegin(), left.rend());
  is_sound = !geometry::find_self_crossing(right);
  return right;
}

// One ring where the bends of a line allow it, else one for each straight piece.
std::vector<geometry::Ring> line_ground(const std::vector<Point3>& points, double width) {
  const std::vector<Point3> line = flat(points);
  if (line.size() < 2) return {};
  const double half = width / 2;
  bool is_sound = false;
  if (geometry::Ring whole = strip(line, half, is_sound); is_sound) return {std::move(whole)};
  std::vector<geometry::Ring> pieces;
  for (std::size_t i = 1; i < line.size(); ++i) {
    geometry::Ring piece = strip({line[i - 1], line[i]}, half, is_sound);
    if (is_sound) pieces.push_back(std::move(piece));
  }
  return pieces;
}

}  // namespace

std::string_view ground_kind(std::string_view use) {
  const std::string word = lower_case(std::string(use.substr(use.find('=') == std::string_view::npos ? 0 : use.find('=') + 1)));
  const auto is_one = [&word](const auto& words) { return std::find(words.begin(), words.end(), word) != words.end(); };
  // Types of CityJSON come first: what a road is for says nothing of what it is.
  if (use.starts_with("Road") || use.starts_with("TransportSquare")) return "streets";
  if (use.starts_with("Railway")) return "rails";
  return is_one(kWater) || use.starts_with("water") || use.starts_with("WaterBody") || use.starts_with("Waterway") ? "water"
         : is_one(kGreen) || use.starts_with("PlantCover")                                                         ? "green"
         : is_one(kStreets)                                                                                        ? "streets"
         : is_one(kRails)                                                                                          ? "rails"
                                                                                                                   : "";
}

std::string open_use_of(std::string_view use) {
  const std::string word = lower_case(std::string(use.substr(use.find('=') == std::string_view::npos ? 0 : use.find('=') + 1)));
  const UseRates* rates = use_rates(word);
  return rates != nullptr && rates->is_open ? word : "";
}

double street_width(const importing::ContextStreet& street) {
  if (street.width > 0) return street.width;
  return street.for_cars ? street.lanes * kLane + 2 * kPath : kFootway;
}

std::vector<geometry::Ring> street_ground(const importing::ContextStreet& street) {
  return line_ground(street.line, street_width(street));
}

std::vector<geometry::Ring> rail_ground(const importing::ContextRail& rail) {
  return line_ground(rail.line, rail.rail_class == "tram" ? kTramTrack : kTrack);
}

std::vector<geometry::Ring> area_ground(const importing::ContextArea& area) {
  const std::string_view kind = ground_kind(area.use);
  if (area.holes.empty() || (kind != "streets" && kind != "rails")) return {area.outer};
  const auto body = geometry::extrude_plan(area.outer, area.holes, 0, 1);
  if (!body) return {};  // the outer ring alone would take the ground of its holes too
  std::vector<geometry::Ring> pieces;
  for (const geometry::Domain::Piece& piece : body->pieces)
    for (std::size_t k = 0; k < piece.shape.planes.size(); ++k) {
      if (!(piece.shape.planes[k].normal.z > 0.5)) continue;  // its top
      geometry::Ring& ring = pieces.emplace_back();
      for (const std::uint32_t corner : piece.shape.faces[k])
        ring.push_back({piece.shape.vertices[corner].x, piece.shape.vertices[corner].y, 0});
    }
  return pieces;
}

}  // namespace bl::making
