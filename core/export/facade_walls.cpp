// Moves the sides of plates inwards by the thickness of their walls.
#include "core/export/facade_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/mathematics.h"

namespace bl::exporting {

namespace {

using geometry::PlateRing;
using geometry::Ring;

constexpr double kChordAngle = 0.1;     // [rad] that one chord of an arc may span
constexpr double kSharpest = -0.5;      // cosine between normals: at sharper corners walls end square
constexpr double kShortestSide = 1e-4;  // [m] a shorter side is none
// Chords of a curve: at a distance of 100 m from a corner they are 0.3 m long, and they turn by less than this; the outlines of
// maps are finer in few places. A wall goes round no more than about half a circle, so that it does not touch itself.
constexpr double kLongestChord = 0.5, kLargestTurn = 0.35, kMostTurn = 3;  // [m], [rad], [rad]

// A side of a plate from corner to corner, arcs as chords.
struct WallSide {
  Ring points;
  double length = 0;
  std::int32_t beyond = PlateRing::kFree;
  bool is_arc = false;
};
using WallRun = std::vector<WallSide>;  // one side, or the chords of a curve

WallSide side_of(const PlateRing& ring, std::size_t k, const Point3& centre) {
  const PlateRing::Corner& corner = ring.corners[k];
  const Point3 &from = corner.at, &to = ring.corners[(k + 1) % ring.corners.size()].at;
  WallSide side{{from}, distance(from, to), corner.beyond, corner.is_arc};
  if (corner.is_arc) {
    const Vector3 u = from - centre, v = to - centre;
    double angle = mathematics::arc_tangent(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
    if (angle <= 0) angle += 2 * std::numbers::pi;
    side.length = angle * ring.radius;
    const double start = mathematics::arc_tangent(u.y, u.x);
    const int parts = std::max(1, static_cast<int>(std::ceil(angle / kChordAngle)));
    for (int p = 1; p < parts; ++p) {
      const double at = start + angle * p / parts;
      side.points.push_back(
          {centre.x + ring.radius * mathematics::cosine(at), centre.y + ring.radius * mathematics::sine(at), 0});
    }
  }
  side.points.push_back(to);
  return side;
}

Vector3 normal_of(const Point3& from, const Point3& to) {
  const Vector3 way = to - from;
  const double length = std::sqrt(way.x * way.x + way.y * way.y);
  return {-way.y / length, way.x / length, 0};
}

Point3 mitred(const Point3& corner, const Vector3& before, const Vector3& after, double inwards) {
  return corner + (inwards / (1 + dot(before, after))) * (before + after);
}

// The inner side of a wall; at its ends in mitres with its neighbours where `is_mitred`.
Ring inner_of(const Ring& points, const Vector3& before, const Vector3& after, double inwards, bool is_mitred) {
  Ring inner;
  const std::size_t last = points.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const Vector3 in = k > 0 ? normal_of(points[k - 1], points[k]) : before,
                  out = k < last ? normal_of(points[k], points[k + 1]) : after;
    const bool is_end = k == 0 || k == last;
    if (is_end && (!is_mitred || dot(in, out) < kSharpest)) inner.push_back(points[k] + inwards * (k == 0 ? out : in));
    else inner.push_back(mitred(points[k], in, out, inwards));
  }
  return inner;
}

// Does the inner side run the way of the outer one throughout?
bool is_sound(const Ring& points, const Ring& inner) {
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    if (!(dot(points[k + 1] - points[k], inner[k + 1] - inner[k]) > 0)) return false;
  return true;
}

// By how much a chord turns from the one before it [rad], to the left; nothing where both are not those of one curve.
std::optional<double> turn_between(const WallSide& side, const WallSide& next) {
  if (side.is_arc || next.is_arc || side.beyond != next.beyond || std::max(side.length, next.length) > kLongestChord)
    return std::nullopt;
  const Vector3 a = normal_of(side.points.front(), side.points.back()), b = normal_of(next.points.front(), next.points.back());
  const double turn = mathematics::arc_tangent(a.x * b.y - a.y * b.x, dot(a, b));
  return std::abs(turn) <= kLargestTurn ? std::optional(turn) : std::nullopt;
}

std::vector<WallRun> runs_of(const std::vector<WallSide>& sides) {
  const std::size_t count = sides.size();
  std::size_t first = 0;  // a side that goes on from none, where there is one
  while (first < count && turn_between(sides[(first + count - 1) % count], sides[first])) ++first;
  std::vector<WallRun> runs;
  double turned = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const WallSide& side = sides[(first + k) % count];
    const std::optional<double> turn = runs.empty() ? std::nullopt : turn_between(runs.back().back(), side);
    const bool goes_on = turn && *turn * turned >= 0 && std::abs(turned + *turn) <= kMostTurn;
    turned = goes_on ? turned + *turn : 0;
    if (!goes_on) runs.emplace_back();
    runs.back().push_back(side);
  }
  return runs;
}

Ring points_of(const WallRun& run) {
  Ring points = run.front().points;
  for (std::size_t k = 1; k < run.size(); ++k) points.insert(points.end(), run[k].points.begin() + 1, run[k].points.end());
  return points;
}

// The wall along a line between its neighbours; nothing where it has no room for this thickness.
std::optional<FacadeWall> wall_along(const Ring& points, const Vector3& before, const Vector3& after, double inwards) {
  Ring inner = inner_of(points, before, after, inwards, true);
  if (!is_sound(points, inner)) inner = inner_of(points, before, after, inwards, false);
  if (!is_sound(points, inner)) return std::nullopt;
  FacadeWall wall{points, 0, FacadeWall::Side::courtyard};
  wall.outline.insert(wall.outline.end(), inner.rbegin(), inner.rend());
  if (inwards < 0) std::reverse(wall.outline.begin(), wall.outline.end());
  return wall;
}

Vector3 normal_at_end(const WallSide& side) { return normal_of(side.points[side.points.size() - 2], side.points.back()); }
Vector3 normal_at_start(const WallSide& side) { return normal_of(side.points[0], side.points[1]); }

// The wall of run k. Is there one?
bool add_wall(const std::vector<WallRun>& runs, std::size_t k, double inwards, std::vector<FacadeWall>& walls) {
  const WallRun &run = runs[k], &previous = runs[(k + runs.size() - 1) % runs.size()], &next = runs[(k + 1) % runs.size()];
  auto wall = wall_along(points_of(run), normal_at_end(previous.back()), normal_at_start(next.front()), inwards);
  if (!wall) return false;
  for (const WallSide& side : run) wall->length += side.length;
  const std::int32_t beyond = run.front().beyond;
  if (inwards > 0)
    wall->side = beyond >= 0                  ? FacadeWall::Side::neighbour
                 : beyond == PlateRing::kPlot ? FacadeWall::Side::plot
                                              : FacadeWall::Side::free;
  walls.push_back(std::move(*wall));
  return true;
}

void add_walls(const PlateRing& ring, const Point3& centre, double inwards, std::vector<FacadeWall>& walls) {
  std::vector<WallSide> sides;
  for (std::size_t k = 0; k < ring.corners.size(); ++k)
    if (WallSide side = side_of(ring, k, centre); side.length > kShortestSide) sides.push_back(std::move(side));
  std::vector<WallRun> runs = runs_of(sides);
  for (std::size_t k = 0; k < runs.size();) {
    if (add_wall(runs, k, inwards, walls) || runs[k].size() == 1) {
      ++k;
      continue;
    }
    // A curve that is too narrow for one wall: each of its chords has its own, or none.
    std::vector<WallRun> chords;
    for (const WallSide& side : runs[k]) chords.push_back({side});
    runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(k));
    runs.insert(runs.begin() + static_cast<std::ptrdiff_t>(k), chords.begin(), chords.end());
  }
}

}  // namespace

std::vector<FacadeWall> facade_walls(const Storey& storey, const Point3& arc_centre, double thickness) {
  const Point3 centre{arc_centre.x, arc_centre.y, 0};
  std::vector<FacadeWall> walls;
  const auto add = [&](const PlateRing& ring, double inwards) {
    if (ring.corners.size() != 1) return add_walls(ring, centre, inwards, walls);
    // A whole circle would have one wall that touches itself: it gets two.
    PlateRing halves = ring;
    halves.corners.push_back(halves.corners.front());
    halves.corners.back().at = centre + (centre - ring.corners.front().at);
    add_walls(halves, centre, inwards, walls);
  };
  for (const PlateRing& ring : storey.rings) add(ring, thickness);
  for (const PlateRing& ring : storey.courtyards) add(ring, -thickness);
  return walls;
}

}  // namespace bl::exporting
