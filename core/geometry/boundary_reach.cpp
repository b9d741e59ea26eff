// Compares plates with the sections of a boundary at their height.
#include "core/geometry/boundary_reach.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/inside/plan_plot.h"

namespace bl::geometry {

namespace {

constexpr double kReachChords = 0.01;   // between arcs of plates and their chords [m]
constexpr double kLeastOutside = 0.01;  // of a plate that counts as outside [m²]
constexpr double kBelowTop = 1e-6;      // under the top of a storey its plate is compared [m]

// The area of a ring inside a convex polygon, negative where the ring is clockwise. Cutting by half-planes one after the other is
// right for areas of rings that are not convex too: what it joins encloses nothing.
double area_within(const Ring& ring, const PlanPolygon& section) {
  PlanPolygon rest, spare;
  for (const Point3& p : ring) rest.corners.push_back({{p.x, p.y}});
  const std::size_t count = section.corners.size();
  for (std::size_t k = 0; k < count && !rest.is_empty(); ++k) {
    const PlanPoint &a = section.corners[k].at, &b = section.corners[(k + 1) % count].at;
    const double x = b.y - a.y, y = a.x - b.x, length = std::sqrt(x * x + y * y);
    if (length > 0) clip(rest, {x / length, y / length, (x * a.x + y * a.y) / length}, PlanSide::kPlot, spare);
  }
  return area_of(rest);
}

struct PlateBox {
  PlanPoint low{1e300, 1e300}, high{-1e300, -1e300};
};
PlateBox plate_box(const std::vector<PlateFace>& faces) {
  PlateBox box;
  for (const PlateFace& face : faces)
    for (const Point3& p : face.outer) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
    }
  return box;
}

}  // namespace

bool is_upright(const Domain& domain) {
  const double hair = 1e-9 * domain.size();
  return std::ranges::all_of(domain.pieces, [&](const Domain::Piece& piece) {
    if (std::abs(piece.shape.minimum.z - domain.minimum.z) > hair || std::abs(piece.shape.maximum.z - domain.maximum.z) > hair)
      return false;
    return std::ranges::all_of(piece.shape.planes, [](const Plane& plane) {
      const double flat = std::sqrt(plane.normal.x * plane.normal.x + plane.normal.y * plane.normal.y);
      return std::abs(plane.normal.z) <= 1e-12 || flat <= 1e-12;
    });
  });
}

BoundaryReach reach_out_of(const Domain& domain, const StandingBody& body) {
  BoundaryReach reach;
  int storey = 0;
  for (const PlateStack& stack : body.stacks) {
    const std::vector<PlateFace> faces = faces_of(stack, body.centre, kReachChords);
    const PlateBox box = plate_box(faces);
    for (int k = 1; k <= stack.storeys; ++k) {
      ++storey;
      const double top = stack.bottom + k * stack.storey_height;
      if (top > domain.maximum.z + kBelowTop) return reach;
      const std::vector<PlanPolygon> sections = sections_at(domain, top - kBelowTop, box.low, box.high);
      double outside = 0;
      for (const PlateFace& face : faces) {
        const auto add = [&](const Ring& ring) {
          outside += signed_area(ring);
          for (const PlanPolygon& section : sections) outside -= area_within(ring, section);
        };
        add(face.outer);
        for (const Ring& hole : face.holes) add(hole);
      }
      if (!(outside > kLeastOutside)) continue;
      if (reach.storey == 0) reach.storey = storey, reach.height = top;
      reach.area = std::max(reach.area, outside);
    }
  }
  return reach;
}

}  // namespace bl::geometry
