// Rectangles of falling size and growing slimness are tried at the places of a grid until one fits.
#include "core/making/open_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/plural.h"
#include "core/base/text.h"

namespace bl::making {

namespace {

constexpr std::array kOpenAspects = {1.0, 1.5, 1 / 1.5, 2.0, 0.5, 3.0, 1 / 3.0, 5.0, 0.2};  // first side / second side
constexpr int kOpenGrid = 41;                                                               // places along each direction
constexpr double kOpenShrink = 0.95;                                                        // of the area, from try to try
constexpr int kOpenTries = 90;                                                              // down to a hundredth of the area
constexpr int kMostPieces = 64;                                                             // of one row

double to_micrometres(double x) { return std::round(x * 1e6) / 1e6 + 0.0; }

// The plan in a frame along its main direction.
class Laying {
 public:
  Laying(const geometry::Ring& plan, const std::vector<geometry::Ring>& holes)
      : plan_(plan), taken_(holes), along_(main_direction(plan)), across_{-along_.y, along_.x, 0} {
    for (const Point3& p : plan) {
      low_ = {std::min(low_.x, dot(p, along_)), std::min(low_.y, dot(p, across_)), 0};
      high_ = {std::max(high_.x, dot(p, along_)), std::max(high_.y, dot(p, across_)), 0};
    }
    middle_ = (low_ + high_) / 2;
  }

  /// Nothing where not even a hundredth of the area fits.
  std::optional<geometry::Ring> lay(double area) {
    for (int k = 0; k < kOpenTries; ++k, area *= kOpenShrink)
      for (const double aspect : kOpenAspects)
        if (auto ring = best(std::sqrt(area * aspect), std::sqrt(area / aspect))) {
          taken_.push_back(*ring);
          return ring;
        }
    return std::nullopt;
  }

 private:
  geometry::Ring rectangle(double u, double v, double width, double depth) const {
    geometry::Ring ring;
    for (const auto& [a, b] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
      const Point3 p = along_ * (u + a * width) + across_ * (v + b * depth);
      ring.push_back({to_micrometres(p.x), to_micrometres(p.y), 0});
    }
    return ring;
  }

  bool fits(const geometry::Ring& ring) const {
    const auto is_inside = [&](const Point3& corner) { return geometry::ring_contains(plan_, corner); };
    if (!std::all_of(ring.begin(), ring.end(), is_inside) || geometry::find_crossing(ring, plan_)) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const geometry::Ring& other) {
      const auto within_other = [&](const Point3& corner) { return geometry::ring_contains(other, corner); };
      return geometry::ring_contains(ring, other.front()) || std::any_of(ring.begin(), ring.end(), within_other) ||
             geometry::find_crossing(ring, other);
    });
  }

  // How good a middle is: near the middle of the plan, or far from the open places that are laid already.
  double score(double u, double v) const {
    if (places_.empty()) return -(u - middle_.x) * (u - middle_.x) - (v - middle_.y) * (v - middle_.y);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point3& p : places_) nearest = std::min(nearest, (u - p.x) * (u - p.x) + (v - p.y) * (v - p.y));
    return nearest;
  }

  std::optional<geometry::Ring> best(double width, double depth) {
    const double room_u = high_.x - low_.x - width, room_v = high_.y - low_.y - depth;
    if (!(room_u > 0) || !(room_v > 0)) return std::nullopt;
    std::vector<std::pair<double, Point3>> places;
    for (int i = 0; i < kOpenGrid; ++i)
      for (int k = 0; k < kOpenGrid; ++k) {
        const double u = low_.x + width / 2 + room_u * (i + 0.5) / kOpenGrid,
                     v = low_.y + depth / 2 + room_v * (k + 0.5) / kOpenGrid;
        places.emplace_back(score(u, v), Point3{u, v, 0});
      }
    std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [worth, at] : places)
      if (geometry::Ring ring = rectangle(at.x, at.y, width, depth); fits(ring)) {
        places_.push_back(at);
        return ring;
      }
    return std::nullopt;
  }

  const geometry::Ring& plan_;
  std::vector<geometry::Ring> taken_;
  std::vector<Point3> places_;  // middles of what is laid, in the frame
  Vector3 along_, across_;
  Point3 low_{INFINITY, INFINITY, 0}, high_{-INFINITY, -INFINITY, 0}, middle_;
};

// What came of one row, as a sentence.
std::string told_of_row(const importing::ProgrammeRow& row, const std::vector<OpenPlace>& places, std::size_t first) {
  double got = 0;
  for (std::size_t k = first; k < places.size(); ++k) got += places[k].area;
  const double asked = row.floor_area * row.count;
  const std::size_t count = places.size() - first;
  if (count == 0)
    return "`" + row.use + "` is open space, and no place for it was found in the plan: make room, and add it by hand.";
  std::string text = "`" + row.use + "` is open space: " + how_many(count, "rectangle", "rectangles") + " of " + fixed(got, 1) +
                     " m² " + by_number(count, "is", "are") + " kept open, as exclusions of the boundary `site`; move " +
                     by_number(count, "it", "them") + " to where " + by_number(count, "it belongs", "they belong") + ".";
  if (got < asked * (1 - 1e-6))
    text += " No more of the " + fixed(asked, 1) + " m² that are asked for fits in " +
            std::string(count == 1 ? "one piece." : "such pieces.");
  return text;
}

}  // namespace

Vector3 main_direction(const geometry::Ring& plan) {
  double longest = 0;
  Vector3 direction{1, 0, 0};
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Vector3 side = plan[(i + 1) % plan.size()] - plan[i];
    const double length = norm(Vector3{side.x, side.y, 0});
    // Of equal sides the first, whatever their last digits are.
    if (length < longest * (1 + 1e-6) + 1e-9) continue;
    longest = length;
    direction = Vector3{side.x, side.y, 0} / length;
  }
  return direction;
}

std::vector<OpenPlace> lay_open_places(const geometry::Ring& plan, const std::vector<geometry::Ring>& holes,
                                       const std::vector<importing::ProgrammeRow>& rows, std::vector<std::string>& notes) {
  std::vector<OpenPlace> places;
  Laying laying(plan, holes);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const importing::ProgrammeRow& row = rows[r];
    if (!row.is_open) continue;
    const int pieces = std::min(row.count, kMostPieces);
    const double asked = row.floor_area * row.count / pieces;
    const std::size_t first = places.size();
    for (int k = 1; k <= pieces; ++k) {
      auto ring = laying.lay(asked);
      if (!ring) break;  // the next one would not fit either
      const double area = std::abs(geometry::signed_area(*ring));
      places.push_back({row.use + (pieces > 1 ? " " + std::to_string(k) : ""), r, std::move(*ring), area, asked});
    }
    notes.push_back(told_of_row(row, places, first));
  }
  return places;
}

}  // namespace bl::making
