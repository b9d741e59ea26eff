// Moves the sides of plates inwards by the thickness of their walls.
#include "core/export/facade_walls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/mathematics.h"

namespace bl::exporting {

namespace {

using geometry::PlateRing;
using geometry::Ring;

constexpr double kChordAngle = 0.1;     // [rad] that one chord of an arc may span
constexpr double kSharpest = -0.5;      // cosine between normals: at sharper corners walls end square
constexpr double kShortestSide = 1e-4;  // [m] a shorter side is none

// A side of a plate from corner to corner, arcs as chords.
struct WallSide {
  Ring points;
  double length = 0;
  std::int32_t beyond = PlateRing::kFree;
};

WallSide side_of(const PlateRing& ring, std::size_t k, const Point3& centre) {
  const PlateRing::Corner& corner = ring.corners[k];
  const Point3 &from = corner.at, &to = ring.corners[(k + 1) % ring.corners.size()].at;
  WallSide side{{from}, distance(from, to), corner.beyond};
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

void add_walls(const PlateRing& ring, const Point3& centre, double inwards, std::vector<FacadeWall>& walls) {
  std::vector<WallSide> sides;
  for (std::size_t k = 0; k < ring.corners.size(); ++k)
    if (WallSide side = side_of(ring, k, centre); side.length > kShortestSide) sides.push_back(std::move(side));
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Ring& points = sides[k].points;
    const Ring &previous = sides[(k + sides.size() - 1) % sides.size()].points, &next = sides[(k + 1) % sides.size()].points;
    const Vector3 before = normal_of(previous[previous.size() - 2], previous.back()), after = normal_of(next[0], next[1]);
    Ring inner = inner_of(points, before, after, inwards, true);
    if (!is_sound(points, inner)) inner = inner_of(points, before, after, inwards, false);
    if (!is_sound(points, inner)) continue;
    FacadeWall wall{points, sides[k].length, FacadeWall::Side::courtyard};
    wall.outline.insert(wall.outline.end(), inner.rbegin(), inner.rend());
    if (inwards < 0) std::reverse(wall.outline.begin(), wall.outline.end());
    else
      wall.side = sides[k].beyond >= 0                  ? FacadeWall::Side::neighbour
                  : sides[k].beyond == PlateRing::kPlot ? FacadeWall::Side::plot
                                                        : FacadeWall::Side::free;
    walls.push_back(std::move(wall));
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
