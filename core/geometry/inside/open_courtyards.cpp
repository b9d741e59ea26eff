// Takes courtyards that reach an outer wall away from plates, by the Clipper library.
#include "core/geometry/inside/open_courtyards.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <clipper.hpp>

namespace bl::geometry {

namespace {

constexpr double kOpenGrid = 1e8;        // steps of the Clipper library's integers in a metre
constexpr double kOpenTolerance = 1e-4;  // of chords in plates that are opened [m]
constexpr double kOnWall = 1e-5;         // how far from a wall a place on it may lie [m]
constexpr double kThroughWall = 1e-4;    // how far a courtyard is drawn out through a wall that it reaches [m]

struct OuterWall {
  Point3 from, to;
  std::int32_t beyond = PlateRing::kFree;

  bool has(const Point3& at) const {
    const Vector3 along = to - from;
    const double length = norm(along), s = dot(at - from, along);
    if (!(length > 0) || s < -kOnWall * length || s > (length + kOnWall) * length) return false;
    return std::abs(cross(along, at - from).z) < kOnWall * length;
  }
};

ClipperLib::Path open_path(const Ring& ring, const Point3& centre) {
  ClipperLib::Path path;
  for (const Point3& p : ring)
    path.emplace_back(static_cast<ClipperLib::cInt>(std::llround((p.x - centre.x) * kOpenGrid)),
                      static_cast<ClipperLib::cInt>(std::llround((p.y - centre.y) * kOpenGrid)));
  return path;
}

// What lies this little on both sides of a stretch.
Ring strip_about(const Point3& from, const Point3& to) {
  const Vector3 along = to - from;
  const Vector3 out = (kThroughWall / norm(along)) * Vector3{along.y, -along.x, 0};
  return {from + out, to + out, to - out, from - out};
}

std::int32_t beyond_at(const std::vector<OuterWall>& walls, const Point3& at) {
  for (const OuterWall& wall : walls)
    if (wall.has(at)) return wall.beyond;
  return PlateRing::kFree;
}

}  // namespace

void open_courtyards(PlateStack& stack, const Point3& centre) {
  std::vector<OuterWall> walls;
  for (const PlateRing& ring : stack.outlines)
    for (std::size_t k = 0; k < ring.corners.size(); ++k)
      if (!ring.corners[k].is_arc)
        walls.push_back({ring.corners[k].at, ring.corners[(k + 1) % ring.corners.size()].at, ring.corners[k].beyond});
  ClipperLib::Clipper clipper;
  bool is_open = false;
  for (const PlateRing& ring : stack.courtyards) {
    clipper.AddPath(open_path(chords_of(ring, centre, kOpenTolerance), centre), ClipperLib::ptClip, true);
    for (std::size_t k = 0; k < ring.corners.size(); ++k) {
      const Point3 &a = ring.corners[k].at, &b = ring.corners[(k + 1) % ring.corners.size()].at;
      if (ring.corners[k].is_arc || !(distance(a, b) > kOnWall)) continue;
      for (const OuterWall& wall : walls) {
        if (!wall.has(a) || !wall.has(b)) continue;
        ClipperLib::Path strip = open_path(strip_about(a, b), centre);
        if (!ClipperLib::Orientation(strip)) ClipperLib::ReversePath(strip);
        clipper.AddPath(strip, ClipperLib::ptClip, true);
        is_open = true;
        break;
      }
    }
  }
  if (!is_open) return;
  for (const PlateRing& ring : stack.outlines)
    clipper.AddPath(open_path(chords_of(ring, centre, kOpenTolerance), centre), ClipperLib::ptSubject, true);
  ClipperLib::Paths left;
  clipper.Execute(ClipperLib::ctDifference, left, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  std::vector<PlateRing> rings;
  for (const ClipperLib::Path& path : left) {
    if (path.size() < 3) continue;
    PlateRing& ring = rings.emplace_back();
    for (const ClipperLib::IntPoint& p : path)
      ring.corners.push_back(
          {{centre.x + static_cast<double>(p.X) / kOpenGrid, centre.y + static_cast<double>(p.Y) / kOpenGrid, 0},
           PlateRing::kFree,
           false});
    for (std::size_t k = 0; k < ring.corners.size(); ++k)
      ring.corners[k].beyond = beyond_at(walls, 0.5 * (ring.corners[k].at + ring.corners[(k + 1) % ring.corners.size()].at));
  }
  stack.outlines = std::move(rings);
  stack.courtyards.clear();
}

}  // namespace bl::geometry
