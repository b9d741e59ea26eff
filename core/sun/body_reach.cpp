// Every stack of storeys is a prism: only the edge of its roof can reach through a plane that rises.
#include "core/sun/body_reach.h"

#include <algorithm>

namespace bl::sun {

namespace {

constexpr double kChordTolerance = 1e-3;  // [m]
constexpr double kLevel = 1e-12;          // of normals that have no level part, or no upright one

// The corners of the plates of a stack.
geometry::Ring corners_of(const geometry::PlateStack& stack, const Point3& centre) {
  geometry::Ring corners;
  for (const geometry::PlateRing& ring : stack.outlines) {
    const geometry::Ring chords = geometry::chords_of(ring, centre, kChordTolerance);
    corners.insert(corners.end(), chords.begin(), chords.end());
  }
  return corners;
}

}  // namespace

BodyReach reach_of(const geometry::StandingBody& body, std::span<const SunPlane> planes) {
  BodyReach reach;
  for (std::size_t s = 0; s < body.stacks.size(); ++s) {
    const geometry::PlateStack& stack = body.stacks[s];
    const geometry::Ring corners = corners_of(stack, body.centre);
    const double bottom = body.stacks.front().bottom;
    const bool is_top = s + 1 == body.stacks.size();
    for (const SunPlane& plane : planes) {
      const Vector3 level{plane.normal.x, plane.normal.y, 0};
      double farthest = -std::numeric_limits<double>::infinity();
      for (const Point3& corner : corners) farthest = std::max(farthest, dot(level, corner));
      if (corners.empty() || !(plane.normal.z > kLevel)) continue;
      const double height = (plane.offset - farthest) / plane.normal.z;
      // A storey below which the plane runs goes as a whole; what carries it has a plane of its own to keep.
      if (is_top || height < stack.top()) reach.allowed = std::min(reach.allowed, std::max(height, stack.bottom) - bottom);
      const double flat = norm(level);
      if (!(flat > kLevel)) continue;
      const double excess = (farthest + plane.normal.z * stack.top() - plane.offset) / flat;
      if (excess <= reach.excess) continue;
      reach.excess = excess;
      reach.back = level / -flat;
    }
  }
  return reach;
}

}  // namespace bl::sun
