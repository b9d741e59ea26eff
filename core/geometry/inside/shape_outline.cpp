// Where a shape's surface turns from facing up to facing down: edges, rims of facets, and the ball's equator.
#include "core/geometry/inside/shape_outline.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"

namespace bl::geometry {

namespace {

// A plane whose normal leans less than this out of the x axis has a circle that is no wider than rounding in x.
constexpr double kLeastLean = 1e-12;
// A line across a circle's plane that is this nearly parallel to it has no crossing that could be told from none.
constexpr double kParallelShare = 1e-14;

// A place on a circle, as cosine and sine; angles count from the direction of the largest x.
struct Turn {
  double cosine = 0, sine = 0;

  bool is_upper() const { return sine > 0 || (sine == 0 && cosine > 0); }
  bool operator<(const Turn& other) const {
    if (is_upper() != other.is_upper()) return is_upper();
    return cosine * other.sine - sine * other.cosine > 0;
  }
};

// What keeps the places normal·p <= offset.
struct Bound {
  Vector3 normal;
  double offset = 0;
};

// How far a wall reaches in x, and where: all of it is one line in plan.
struct WallSpan {
  Point3 first, last;
  bool is_empty = true;

  void add(const Point3& p) {
    if (is_empty || p.x < first.x) first = p;
    if (is_empty || p.x > last.x) last = p;
    is_empty = false;
  }
};

// The circle in which a plane meets the ball, with axes that make x = middle + width * cosine.
struct PlanCircle {
  Vector3 normal, along, aside;
  double offset = 0, radius = 0, lean = 0;  // lean² = 1 - normal.x²

  PlanCircle(const Vector3& n, double d, double squared_radius) : normal(n), offset(d) {
    const double squared = n.y * n.y + n.z * n.z, rest = squared_radius - d * d;
    lean = std::sqrt(squared);
    if (!(rest > 0) || !(lean > kLeastLean)) return;
    radius = std::sqrt(rest);
    along = Vector3{squared, -n.x * n.y, -n.x * n.z} / lean;
    aside = Vector3{0, n.z, -n.y} / lean;
  }
  bool exists() const { return radius > 0; }
  Point3 at(const Turn& t) const { return offset * normal + radius * (t.cosine * along + t.sine * aside); }
};

class OutlineMaker {
 public:
  OutlineMaker(const Polyhedron& cell, double squared_radius, double tolerance, std::vector<PlanArc>& out)
      : cell_(cell), squared_radius_(squared_radius), tolerance_(tolerance), out_(out) {}

  void run() {
    const bool is_wrapped = cell_.reach_squared > squared_radius_;
    edges_.clear();
    for (const PolyhedronFace& face : cell_.faces) {
      if (face.normal.z == 0) add_wall(face, is_wrapped);
      else if (is_wrapped) add_rim(face);
    }
    add_edges();
    if (is_wrapped) add_equator();
  }

 private:
  // Half of an edge: the faces on its two sides run along it in opposite directions.
  struct HalfEdge {
    std::uint32_t low, high;
    bool is_upward;
    bool operator<(const HalfEdge& other) const {
      return low != other.low ? low < other.low : high != other.high ? high < other.high : is_upward < other.is_upward;
    }
  };

  // What lies in the ball of the straight line between two points; false where nothing does.
  bool clip(Point3& a, Point3& b) const {
    const bool has_a = squared_norm(a) <= squared_radius_, has_b = squared_norm(b) <= squared_radius_;
    if (has_a && has_b) return true;
    const Vector3 way = b - a;
    const double length = norm(way);
    if (!(length > 0)) return false;
    const Vector3 unit = way / length;
    const double t = dot(a, unit);
    const Point3 nearest = a - t * unit;
    const double rest = squared_radius_ - squared_norm(nearest);
    if (!(rest > 0)) return false;
    const double reach = std::sqrt(rest), low = std::max(t, -reach), high = std::min(t + length, reach);
    if (!(low < high)) return false;
    if (!has_a) a = nearest + low * unit;
    if (!has_b) b = nearest + high * unit;
    return true;
  }

  void add_line(Point3 a, Point3 b) {
    if (a.x > b.x) std::swap(a, b);
    if (!(b.x - a.x > tolerance_)) return;
    PlanArc arc;
    arc.from = arc.middle = a.x;
    arc.to = b.x;
    arc.level = a.y;
    arc.slope = (b.y - a.y) / (b.x - a.x);
    out_.push_back(arc);
  }

  // Edges between a face that looks up and one that looks down.
  void add_edges() {
    for (const PolyhedronFace& face : cell_.faces) {
      if (face.normal.z == 0 || face.count < 2) continue;
      const auto loop = cell_.loop(face);
      std::uint32_t from = loop[face.count - 1];
      for (const std::uint32_t to : loop) {
        edges_.push_back({std::min(from, to), std::max(from, to), face.normal.z > 0});
        from = to;
      }
    }
    std::sort(edges_.begin(), edges_.end());
    for (std::size_t k = 0; k + 1 < edges_.size(); ++k) {
      const HalfEdge &one = edges_[k], &other = edges_[k + 1];
      if (one.low != other.low || one.high != other.high || one.is_upward == other.is_upward) continue;
      Point3 a = cell_.vertices[one.low], b = cell_.vertices[one.high];
      if (clip(a, b)) add_line(a, b);
    }
  }

  void bound_by_edges(const PolyhedronFace& face) {
    bounds_.clear();
    const auto loop = cell_.loop(face);
    Point3 a = cell_.vertices[loop[face.count - 1]];
    for (const std::uint32_t corner : loop) {
      const Point3& b = cell_.vertices[corner];
      const Vector3 outward = cross(b - a, face.normal);
      const double length = norm(outward);
      // Corners may lie at one place; which way such an edge runs is rounding.
      if (length > tolerance_) bounds_.push_back({outward / length, dot(outward / length, a)});
      a = b;
    }
  }

  bool reaches_out(const PolyhedronFace& face) const {
    const auto loop = cell_.loop(face);
    return std::any_of(loop.begin(), loop.end(),
                       [&](std::uint32_t corner) { return squared_norm(cell_.vertices[corner]) > squared_radius_; });
  }

  void add_wall(const PolyhedronFace& face, bool is_wrapped) {
    WallSpan wall;
    const auto loop = cell_.loop(face);
    for (std::uint32_t i = 0; i < face.count; ++i) {
      Point3 a = cell_.vertices[loop[i]], b = cell_.vertices[loop[i + 1 == face.count ? 0 : i + 1]];
      if (!clip(a, b)) continue;
      wall.add(a);
      wall.add(b);
    }
    const PlanCircle circle(face.normal, face.offset, squared_radius_);
    if (is_wrapped && face.count > 2 && circle.exists() && reaches_out(face)) {
      bound_by_edges(face);
      visit_arcs(circle, [&](const Turn& from, const Turn& to, const Turn&) {
        wall.add(circle.at(from));
        wall.add(circle.at(to));
      });
    }
    if (!wall.is_empty) add_line(wall.first, wall.last);
  }

  // The rim of a face that looks up is outline below the centre, where the ball's surface looks down, and the other way round.
  void add_rim(const PolyhedronFace& face) {
    const PlanCircle circle(face.normal, face.offset, squared_radius_);
    if (face.count < 3 || !circle.exists() || !reaches_out(face)) return;
    bound_by_edges(face);
    visit_arcs(circle, [&](const Turn& from, const Turn& to, const Turn& between) {
      if (face.normal.z * circle.at(between).z <= 0) add_arc(circle, from, to, between.sine);
    });
  }

  void add_equator() {
    const PlanCircle circle({0, 0, 1}, 0, squared_radius_);
    bounds_.clear();
    for (const PolyhedronFace& face : cell_.faces) bounds_.push_back({face.normal, face.offset});
    visit_arcs(circle, [&](const Turn& from, const Turn& to, const Turn& between) { add_arc(circle, from, to, between.sine); });
  }

  void add_arc(const PlanCircle& circle, const Turn& from, const Turn& to, double side) {
    PlanArc arc;
    arc.normal = circle.normal;
    arc.offset = circle.offset;
    const double width = circle.lean * circle.radius, squared = circle.lean * circle.lean;
    arc.middle = circle.offset * circle.normal.x;
    arc.from = arc.middle + width * std::min(from.cosine, to.cosine);
    arc.to = arc.middle + width * std::max(from.cosine, to.cosine);
    arc.level = circle.normal.y * circle.offset;
    arc.slope = -circle.normal.x * circle.normal.y / squared;
    arc.bulge = (side > 0 ? circle.normal.z : -circle.normal.z) / squared;
    arc.squared_width = width * width;
    if (arc.to - arc.from > tolerance_) out_.push_back(arc);
  }

  // Where the line alpha * cosine + beta * sine = gamma crosses the circle.
  void split_at(double alpha, double beta, double gamma, double scale) {
    const double size = alpha * alpha + beta * beta;
    if (!(size > kParallelShare * kParallelShare * scale * scale)) return;
    const double rest = 1 - gamma * gamma / size;
    if (!(rest > 0)) return;
    const double reach = std::sqrt(rest / size), a = gamma / size;
    turns_.push_back({a * alpha - reach * beta, a * beta + reach * alpha});
    turns_.push_back({a * alpha + reach * beta, a * beta - reach * alpha});
  }

  // Calls visit(from, to, between) for the arcs of a circle within all bounds; none of them goes round an extreme of x, through
  // the plane z = 0 or further than a quarter.
  template <class Visit>
  void visit_arcs(const PlanCircle& circle, Visit&& visit) {
    turns_.assign({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
    const Point3 centre = circle.offset * circle.normal;
    const auto split = [&](const Vector3& normal, double offset) {
      split_at(circle.radius * dot(normal, circle.along), circle.radius * dot(normal, circle.aside), offset - dot(normal, centre),
               circle.radius);
    };
    for (const Bound& bound : bounds_) split(bound.normal, bound.offset);
    split({0, 0, 1}, 0);
    std::sort(turns_.begin(), turns_.end());
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      const Turn &from = turns_[k], &to = turns_[k + 1 == turns_.size() ? 0 : k + 1];
      Turn between{from.cosine + to.cosine, from.sine + to.sine};
      const double length = std::sqrt(between.cosine * between.cosine + between.sine * between.sine);
      if (!(length > 0)) continue;
      between = {between.cosine / length, between.sine / length};
      const Point3 place = circle.at(between);
      const bool is_kept = std::all_of(bounds_.begin(), bounds_.end(),
                                       [&](const Bound& bound) { return dot(bound.normal, place) <= bound.offset; });
      if (is_kept) visit(from, to, between);
    }
  }

  const Polyhedron& cell_;
  double squared_radius_, tolerance_;
  std::vector<PlanArc>& out_;
  std::vector<HalfEdge> edges_;
  std::vector<Bound> bounds_;
  std::vector<Turn> turns_;
};

}  // namespace

double PlanArc::at(double x) const {
  const double t = x - middle;
  const double y = level + slope * t;
  return bulge == 0 ? y : y + bulge * std::sqrt(std::max(0.0, squared_width - t * t));
}

double PlanArc::area_below(double low, double high) const {
  const double t0 = low - middle, t1 = high - middle;
  double area = (level + 0.5 * slope * (t0 + t1)) * (high - low);
  if (bulge != 0) {
    // 2 ∫ sqrt(w² - t²) dt = t sqrt(w² - t²) + w² asin(t/w); the difference of the two angles at once.
    const double u0 = std::sqrt(std::max(0.0, squared_width - t0 * t0)), u1 = std::sqrt(std::max(0.0, squared_width - t1 * t1));
    const double angle = mathematics::arc_tangent(t1 * u0 - t0 * u1, t0 * t1 + u0 * u1);
    area += 0.5 * bulge * (t1 * u1 - t0 * u0 + squared_width * angle);
  }
  return area;
}

void outline_in_plan(const Polyhedron& cell, double squared_radius, double tolerance, std::vector<PlanArc>& out) {
  OutlineMaker(cell, squared_radius, tolerance, out).run();
}

}  // namespace bl::geometry
