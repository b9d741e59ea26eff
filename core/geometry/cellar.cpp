// Areas of rings with arcs, and the plates of cellars.
#include "core/geometry/cellar.h"

#include <cstddef>
#include <numbers>

#include "core/base/mathematics.h"

namespace bl::geometry {

double area_of(const PlateRing& ring, const Point3& centre) {
  const std::size_t count = ring.corners.size();
  double twice = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vector3 a = ring.corners[k].at - centre, b = ring.corners[(k + 1) % count].at - centre;
    const double turn = a.x * b.y - a.y * b.x;
    if (!ring.corners[k].is_arc) {
      twice += turn;
      continue;
    }
    // Counter-clockwise about the centre; a ring of one arc is the whole circle.
    double angle = mathematics::arc_tangent(turn, a.x * b.x + a.y * b.y);
    if (angle <= 0) angle += 2 * std::numbers::pi;
    twice += ring.radius * ring.radius * angle;
  }
  return 0.5 * twice;
}

PlateStack cellar_of(const StandingBody& body, int storeys, double height) {
  PlateStack cellar;
  cellar.storeys = 0;
  cellar.storey_height = height;
  if (body.stacks.empty() || storeys <= 0) return cellar;
  cellar.storeys = storeys;
  const PlateStack& lowest = body.stacks.front();
  cellar.bottom = lowest.bottom - storeys * height;
  cellar.outlines = lowest.enclosed.empty() ? lowest.outlines : lowest.enclosed;
  // Of a plate without a courtyard the area is known to the bit.
  if (lowest.courtyards.empty() && lowest.enclosed.empty()) cellar.area = lowest.area;
  else
    for (const PlateRing& ring : cellar.outlines) cellar.area += area_of(ring, body.centre);
  return cellar;
}

}  // namespace bl::geometry
