// Joins the convex parts of plates to outlines, with arcs as arcs.
#include "core/geometry/plates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/mathematics.h"
#include "core/geometry/inside/footprint_workshop.h"
#include "core/geometry/inside/open_courtyards.h"
#include "core/geometry/polygon_triangles.h"

namespace bl::geometry {

namespace {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kSame = 1e-7;  // ends of curves nearer than this are one place [m]

// A piece of an outline, relative to the site.
struct Curve {
  PlanPoint from, to;
  std::int32_t beyond = 0;
  bool is_arc = false;
};

bool is_same(const PlanPoint& a, const PlanPoint& b) { return std::abs(a.x - b.x) <= kSame && std::abs(a.y - b.y) <= kSame; }

// The sides of a part inside a disc, and the arcs that join them, in order; sides towards other parts of the plot are left out.
void add_curves(const PlanPolygon& part, double radius, std::vector<Curve>& curves) {
  std::vector<Curve> sides;
  const std::size_t count = part.corners.size();
  double turned = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const PlanPoint& p = part.corners[k].at;
    const PlanPoint& q = part.corners[(k + 1) % count].at;
    const double dx = q.x - p.x, dy = q.y - p.y, length = std::sqrt(dx * dx + dy * dy);
    if (!(length > 0)) continue;
    const PlanPoint e{dx / length, dy / length};
    const double height = e.y * p.x - e.x * p.y, a = e.x * p.x + e.y * p.y, b = a + length;
    turned += mathematics::arc_tangent(height * (b - a), height * height + a * b);
    double low = a, high = b;
    if (std::isfinite(radius)) {
      const double rest = (radius - height) * (radius + height);
      if (!(rest > 0)) continue;
      const double half = std::sqrt(rest);
      low = std::clamp(-half, a, b);
      high = std::clamp(half, a, b);
    }
    if (!(low < high)) continue;
    const auto at = [&](double t) { return PlanPoint{t * e.x + height * e.y, t * e.y - height * e.x}; };
    sides.push_back({low == a ? p : at(low), high == b ? q : at(high), part.corners[k].beyond, false});
  }
  if (sides.empty()) {
    // Either the whole disc lies inside the part, or none of it.
    if (std::isfinite(radius) && radius > 0 && turned > 1) curves.push_back({{radius, 0}, {radius, 0}, PlateRing::kFree, true});
    return;
  }
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const Curve& side = sides[k];
    const Curve& next = sides[(k + 1) % sides.size()];
    if (side.beyond != PlanSide::kInner) curves.push_back(side);
    if (side.beyond == PlanSide::kStreet || side.beyond == PlanSide::kLeftOut) curves.back().beyond = PlanSide::kPlot;
    if (!is_same(side.to, next.from)) curves.push_back({side.to, next.from, PlateRing::kFree, true});
  }
}

PlateRing::Corner corner_of(const Curve& curve, const Point3& centre) {
  const std::int32_t beyond = curve.beyond >= 0 || curve.beyond == PlanSide::kPlot ? curve.beyond : PlateRing::kFree;
  return {{centre.x + curve.from.x, centre.y + curve.from.y, 0}, beyond, curve.is_arc};
}

// Does the side go on in the direction of the one before it, with the same beyond?
bool goes_on(const Curve& before, const Curve& after) {
  if (before.is_arc || after.is_arc) return before.is_arc && after.is_arc;
  const double ax = before.to.x - before.from.x, ay = before.to.y - before.from.y;
  const double bx = after.to.x - after.from.x, by = after.to.y - after.from.y;
  return before.beyond == after.beyond && ax * bx + ay * by > 0 &&
         std::abs(ax * by - ay * bx) <= kSame * std::sqrt(std::max(ax * ax + ay * ay, bx * bx + by * by));
}

// Rings of curves that follow one another.
std::vector<PlateRing> joined(std::vector<Curve> curves, const Point3& centre, double radius) {
  std::vector<PlateRing> rings;
  std::vector<std::uint8_t> is_used(curves.size(), 0);
  for (std::size_t first = 0; first < curves.size(); ++first) {
    if (is_used[first] != 0) continue;
    std::vector<Curve> chain{curves[first]};
    is_used[first] = 1;
    while (!is_same(chain.back().to, chain.front().from)) {
      std::size_t next = curves.size();
      double nearest = 1e-4 * 1e-4;  // wider than what is one place: pieces meet by their own rounding
      for (std::size_t k = 0; k < curves.size(); ++k) {
        const double x = curves[k].from.x - chain.back().to.x, y = curves[k].from.y - chain.back().to.y;
        if (is_used[k] != 0 || x * x + y * y > nearest) continue;
        nearest = x * x + y * y;
        next = k;
      }
      if (next == curves.size()) break;
      is_used[next] = 1;
      if (goes_on(chain.back(), curves[next])) chain.back().to = curves[next].to;
      else chain.push_back(curves[next]);
    }
    if (chain.size() > 1 && goes_on(chain.back(), chain.front())) {
      chain.front().from = chain.back().from;
      chain.pop_back();
    }
    if (chain.size() < 2 && !chain.front().is_arc) continue;
    PlateRing ring;
    ring.radius = std::isfinite(radius) ? radius : 0;
    for (const Curve& curve : chain) ring.corners.push_back(corner_of(curve, centre));
    rings.push_back(std::move(ring));
  }
  return rings;
}

// The angle of an arc of a ring; a whole circle where it comes back to where it begins.
double angle_of(const Point3& from, const Point3& to, const Point3& centre) {
  const double ax = from.x - centre.x, ay = from.y - centre.y, bx = to.x - centre.x, by = to.y - centre.y;
  double angle = mathematics::arc_tangent(ax * by - ay * bx, ax * bx + ay * by);
  if (angle <= 0) angle += kTwoPi;
  return angle;
}

// Can a courtyard have sides on those of the plate?
bool may_meet(const PlateOffset& outer, const PlateOffset& court) {
  return court.neighbour - outer.neighbour < kSame || court.plot.border - outer.plot.border < kSame ||
         court.plot.street - outer.plot.street < kSame;
}

// A place a millimetre inside of a line that has what it encloses, or the rest around a hole, on its left.
Point3 inside_of(const Ring& line, const Point3& at) {
  constexpr double kInside = 1e-3;  // [m]
  Vector3 inwards;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const Point3 &from = line[k], &to = line[(k + 1) % line.size()];
    const Vector3 along{to.x - from.x, to.y - from.y, 0}, way{at.x - from.x, at.y - from.y, 0};
    const double length = norm(along), s = dot(along, way);
    // At a corner both sides count.
    if (!(length > 0) || s < -kSame * length || s > (length + kSame) * length || std::abs(cross(along, way).z) > kSame * length)
      continue;
    inwards = inwards + Vector3{-along.y / length, along.x / length, 0};
  }
  const double length = norm(inwards);
  return length > kSame ? at + inwards * (kInside / length) : at;
}

}  // namespace

StandingBody body_of(const FootprintDiagram& diagram, std::uint32_t site) {
  const FootprintDiagram::Workshop& w = diagram.workshop();
  const StandingSite& own = w.sites[site];
  const FootprintMeasure& measure = w.measures[site];
  StandingBody body;
  body.centre = {own.site.position.x, own.site.position.y, 0};
  FootprintMaker maker(w.plot, w.grid, w.sites);
  const double root = std::sqrt(std::max(0.0, own.site.weight));
  const auto rings = [&](const PlateOffset& offset) {
    const double radius = own.form == FootprintForm::round ? root - offset.own : StandingSite::kAnyDepth;
    std::vector<Curve> curves;
    if (radius > 0)
      for (const PlanPolygon& part : maker.parts(site, offset)) add_curves(part, radius, curves);
    return joined(std::move(curves), body.centre, radius);
  };
  double bottom = own.site.position.z;
  for (std::size_t r = 0; r < own.runs.size(); ++r) {
    const StoreyRun& run = own.runs[r];
    PlateStack stack{run.storeys, bottom, own.storey_height, measure.plates[r], {}, {}};
    bottom = stack.top();
    if (!(stack.area > 0)) continue;
    const PlateOffset outer = outer_offset(own, run), court = courtyard_offset(own, run);
    stack.outlines = rings(outer);
    if (std::isfinite(own.depth)) stack.courtyards = rings(court);
    if (!stack.courtyards.empty() && may_meet(outer, court)) open_courtyards(stack, body.centre);
    body.stacks.push_back(std::move(stack));
  }
  return body;
}

Ring chords_of(const PlateRing& ring, const Point3& centre, double tolerance) {
  Ring line;
  const std::size_t count = ring.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Point3 &from = ring.corners[k].at, &to = ring.corners[(k + 1) % count].at;
    // A side that is shorter than what is one place has no chord of its own.
    if (line.empty() || !is_same({line.back().x, line.back().y}, {from.x, from.y})) line.push_back(from);
    if (!ring.corners[k].is_arc) continue;
    const double angle = angle_of(from, to, centre);
    const double step = 2 * mathematics::arc_cosine(std::clamp(1 - tolerance / ring.radius, 0.0, 1.0));
    const int parts = std::clamp(static_cast<int>(std::ceil(angle / std::max(step, 1e-3))), 1, 4096);
    const double start = mathematics::arc_tangent(from.y - centre.y, from.x - centre.x);
    for (int p = 1; p < parts; ++p) {
      const double at = start + angle * p / parts;
      line.push_back({centre.x + ring.radius * mathematics::cosine(at), centre.y + ring.radius * mathematics::sine(at), 0});
    }
  }
  while (line.size() > 1 && is_same({line.back().x, line.back().y}, {line.front().x, line.front().y})) line.pop_back();
  return line;
}

double length_of(const PlateRing& ring, const Point3& centre, std::int32_t beyond) {
  double sum = 0;
  const std::size_t count = ring.corners.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (ring.corners[k].beyond != beyond) continue;
    const Point3 &from = ring.corners[k].at, &to = ring.corners[(k + 1) % count].at;
    sum += ring.corners[k].is_arc ? ring.radius * angle_of(from, to, centre) : distance(from, to);
  }
  return sum;
}

double area_of(std::span<const PlateFace> faces) {
  double area = 0;
  for (const PlateFace& face : faces) {
    area += std::abs(signed_area(face.outer));
    for (const Ring& hole : face.holes) area -= std::abs(signed_area(hole));
  }
  return area;
}

std::vector<PlateFace> faces_of(const PlateStack& stack, const Point3& centre, double tolerance) {
  std::vector<PlateFace> faces;
  std::vector<Ring> holes;
  const auto take = [&](const PlateRing& ring, bool is_courtyard) {
    Ring line = chords_of(ring, centre, tolerance);
    const double area = signed_area(line);
    if (line.size() < 3 || area == 0) return;
    // The edge of a courtyard has the building on its other side.
    if (is_courtyard) std::reverse(line.begin(), line.end());
    if ((area > 0) != is_courtyard) faces.push_back({std::move(line), {}});
    else holes.push_back(std::move(line));
  };
  for (const PlateRing& ring : stack.outlines) take(ring, false);
  for (const PlateRing& ring : stack.courtyards) take(ring, true);
  for (Ring& hole : holes) {
    PlateFace* around = nullptr;
    for (PlateFace& face : faces)
      if (ring_contains(face.outer, hole.front()) && (around == nullptr || signed_area(face.outer) < signed_area(around->outer)))
        around = &face;
    if (around != nullptr) around->holes.push_back(std::move(hole));
  }
  return faces;
}

Point3 middle_of(std::span<const PlateFace> faces) {
  const auto largest = std::max_element(faces.begin(), faces.end(), [](const auto& a, const auto& b) {
    return std::abs(signed_area(a.outer)) < std::abs(signed_area(b.outer));
  });
  if (largest == faces.end() || largest->outer.empty()) return {};
  const Ring& ring = largest->outer;
  const Point3 first = ring.front();
  Vector3 sum;
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const double part = turn(first, ring[k], ring[k + 1]);
    sum = sum + part * ((ring[k] - first) + (ring[k + 1] - first));
    twice += part;
  }
  return twice == 0 ? first : first + sum / (3 * twice);
}

double clearance_of(const StandingBody& body, std::span<const Point3> border, double tolerance) {
  double least = std::numeric_limits<double>::infinity();
  if (body.stacks.empty()) return least;
  // From each corner to the nearest place on the other line; what is on the wrong side of it counts below 0.
  const auto take = [&least](const Point3& corner, std::span<const Point3> line, bool is_inside) {
    const Point3 flat{corner.x, corner.y, 0}, nearest = nearest_on_ring(line, flat);
    const double away = distance({nearest.x, nearest.y, 0}, flat);
    least = std::min(least, ring_contains(line, flat) == is_inside ? away : -away);
  };
  for (const PlateRing& outline : body.stacks.front().outlines) {
    const Ring line = chords_of(outline, body.centre, tolerance);
    if (line.size() < 3) continue;
    for (const Point3& corner : line) take(corner, border, true);
    if (signed_area(line) > 0)
      for (const Point3& corner : border) take(corner, line, false);
  }
  return least;
}

Point3 nearest_place(const StandingBody& body, const Point3& position, double tolerance) {
  if (body.stacks.empty()) return position;
  const PlateStack& lowest = body.stacks.front();
  const Point3 flat{position.x, position.y, 0};
  int around = 0;  // outer lines less holes
  double least = std::numeric_limits<double>::infinity();
  Point3 nearest = flat;
  for (const PlateRing& outline : lowest.enclosed.empty() ? lowest.outlines : lowest.enclosed) {
    const Ring line = chords_of(outline, body.centre, tolerance);
    if (line.size() < 3) continue;
    if (ring_contains(line, flat)) around += signed_area(line) > 0 ? 1 : -1;
    const Point3 side = nearest_on_ring(line, flat);
    const double away = distance({side.x, side.y, 0}, flat);
    if (away >= least) continue;
    least = away;
    nearest = inside_of(line, side);
  }
  if (around > 0) nearest = flat;
  return {nearest.x, nearest.y, lowest.bottom};
}

Mesh mesh_of(const StandingBody& body, double tolerance) {
  Mesh mesh;
  for (const PlateStack& stack : body.stacks)
    for (const PlateFace& face : faces_of(stack, body.centre, tolerance)) {
      const Mesh prism = prism_mesh(face.outer, face.holes, stack.bottom, stack.top());
      const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.insert(mesh.vertices.end(), prism.vertices.begin(), prism.vertices.end());
      for (const auto& [a, b, c] : prism.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
    }
  return mesh;
}

}  // namespace bl::geometry
