// Ball ∩ polyhedron, edge by edge. All signs are kept, so the formulas hold for a centre outside the polyhedron too.
#include "core/geometry/shape_measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bl {

namespace {

constexpr double kPi = std::numbers::pi;
// Candidates for the highest and lowest point may miss the polyhedron by this share of the radius: a point that lies exactly
// on an edge must not be lost, and the height it may be wrong by is of the same size.
constexpr double kTouchShare = 1e-12;

// The plane of a facet, seen from the ball's centre.
struct Disc {
  double height = 0;          // |h|, distance of the plane
  double squared_radius = 0;  // ρ² = r² - h²; not positive: the ball does not reach the plane
  double radius = 0;          // ρ
  double share = 1;           // κ = |h| / r where there is a disc, else 1
};

Disc disc_of(double offset, double squared_radius) {
  Disc disc;
  disc.height = std::abs(offset);
  disc.squared_radius = squared_radius - offset * offset;
  if (disc.squared_radius > 0) {
    disc.radius = std::sqrt(disc.squared_radius);
    disc.share = disc.height / std::sqrt(squared_radius);
  }
  return disc;
}

// The part [low, high] of an edge [t0, t1] at signed distance δ from the foot point that lies in the disc; low >= high: none.
struct Span {
  double low, high;
};

Span span_in_disc(double t0, double t1, double delta, double squared_disc_radius) {
  const double rest = squared_disc_radius - delta * delta;
  if (!(rest > 0)) return {t1, t0};
  const double reach = std::sqrt(rest);
  return {std::max(t0, -reach), std::min(t1, reach)};
}

// Angle that an edge piece subtends at the foot point, positive counter-clockwise.
double swept_angle(double t0, double t1, double delta) { return std::atan2(delta * (t1 - t0), delta * delta + t0 * t1); }

// Solid angle, seen from the centre, of what lies between the disc's rim and an edge piece outside the disc.
// κ θ - sgn(δ) [g(t1) - g(t0)] with g(t) = atan2(|h| t, |δ| sqrt(h² + δ² + t²)), the difference taken as one angle.
double outer_solid_angle(double t0, double t1, double delta, double angle, const Disc& disc) {
  const double h = disc.height, d = std::abs(delta);
  const double x0 = d * std::sqrt(h * h + d * d + t0 * t0), x1 = d * std::sqrt(h * h + d * d + t1 * t1);
  const double y0 = h * t0, y1 = h * t1;
  const double difference = std::atan2(y1 * x0 - y0 * x1, x0 * x1 + y0 * y1);
  return disc.share * angle - (delta > 0 ? difference : -difference);
}

struct FacetIntegral {
  double area = 0, solid_angle = 0, winding = 0;
  Vector3 moment;  // first moment in the plane, about the foot point
  bool meets_edge = false;
};

// One edge a→b of a facet with unit normal n: adds its part to area, solid angle and moment.
void add_edge(const Point3& a, const Point3& b, const Vector3& n, double offset, const Disc& disc, FacetIntegral& sum) {
  const Vector3 along = b - a;
  const double length = norm(along);
  if (!(length > 0)) return;
  const Vector3 e = along / length;
  const double t_a = dot(a, e), t_b = t_a + length;
  const double delta = dot(n, cross(a, e));
  const Vector3 foot = n * offset;
  const Vector3 at_a = a - foot;
  const auto at = [&](double t) { return at_a + (t - t_a) * e; };
  const Span inside = span_in_disc(t_a, t_b, delta, disc.squared_radius);
  const auto outside = [&](double t0, double t1) {
    if (!(t1 > t0) || delta == 0) return;
    const double angle = swept_angle(t0, t1, delta);
    sum.winding += angle;
    sum.solid_angle += outer_solid_angle(t0, t1, delta, angle, disc);
    if (disc.radius == 0) return;
    sum.area += 0.5 * disc.squared_radius * angle;
    const Vector3 p0 = at(t0), p1 = at(t1);
    const double n0 = norm(p0), n1 = norm(p1);
    if (n0 > 0 && n1 > 0) sum.moment += (disc.squared_radius * disc.radius / 3) * cross(p1 / n1 - p0 / n0, n);
  };
  if (!(inside.high > inside.low)) return outside(t_a, t_b);
  sum.meets_edge = true;
  outside(t_a, inside.low);
  outside(inside.high, t_b);
  const double area = 0.5 * delta * (inside.high - inside.low);
  sum.area += area;
  sum.moment += (area / 3) * (at(inside.low) + at(inside.high));
}

FacetIntegral integrate_facet(const Clipper& cell, const ClippedFace& face, double squared_radius) {
  const Disc disc = disc_of(face.offset, squared_radius);
  FacetIntegral sum;
  Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const Point3 b = cell.vertices[cell.loops[face.first + i]];
    add_edge(a, b, face.normal, face.offset, disc, sum);
    a = b;
  }
  if (!sum.meets_edge) {
    // The rim meets no edge: the facet holds the whole disc or nothing of it, and the angles say which.
    sum.area = disc.radius > 0 && sum.winding > kPi ? kPi * disc.squared_radius : 0;
    sum.moment = {};
  }
  sum.area = std::max(0.0, sum.area);
  return sum;
}

double polygon_area_vector(const Clipper& cell, const ClippedFace& face, Vector3& centroid) {
  const Point3 origin = cell.vertices[cell.loops[face.first]];
  double doubled = 0;
  Vector3 moment;
  for (std::uint32_t i = 1; i + 1 < face.count; ++i) {
    const Vector3 b = cell.vertices[cell.loops[face.first + i]] - origin;
    const Vector3 c = cell.vertices[cell.loops[face.first + i + 1]] - origin;
    const double part = dot(face.normal, cross(b, c));
    doubled += part;
    moment += part * (b + c);
  }
  centroid = doubled > 0 ? origin + moment / (3 * doubled) : origin;
  return std::max(0.0, 0.5 * doubled);
}

// Shapes below this share of their cell are a touch, not a volume.
constexpr double kTouchingShare = 1e-14;

// The ball holds the whole polyhedron.
void measure_unwrapped(const Clipper& cell, double cell_volume, const Point3& cell_centroid, ShapeMeasure& out) {
  out.volume = cell_volume;
  out.centroid = cell_centroid;
  out.is_empty = !(cell_volume > 0);
  for (const ClippedFace& face : cell.faces) {
    Vector3 middle;
    out.areas.push_back(polygon_area_vector(cell, face, middle));
  }
  out.point_inside = cell_centroid;
}

}  // namespace

void measure_shape(const Clipper& cell, double squared_radius, double cell_volume, const Point3& cell_centroid,
                   ShapeMeasure& out) {
  out.areas.clear();
  out.volume = out.spherical_area = 0;
  out.is_empty = true;
  out.centroid = out.point_inside = {};
  if (cell.is_empty()) return;
  if (cell.reach_squared() <= squared_radius) return measure_unwrapped(cell, cell_volume, cell_centroid, out);
  const double radius = std::sqrt(squared_radius);
  double cones = 0, solid_angle = 0, facets = 0;
  Vector3 moment, area_vector, mean;
  for (const ClippedFace& face : cell.faces) {
    const FacetIntegral sum = integrate_facet(cell, face, squared_radius);
    out.areas.push_back(sum.area);
    if (face.offset != 0) solid_angle += face.offset > 0 ? sum.solid_angle : -sum.solid_angle;
    if (!(sum.area > 0)) continue;
    cones += face.offset * sum.area;
    facets += sum.area;
    const Vector3 facet_moment = (face.offset * sum.area) * face.normal + sum.moment;
    mean += facet_moment;
    area_vector += sum.area * face.normal;
    moment += (face.offset / 4) * facet_moment;
  }
  double sphere = squared_radius * std::clamp(solid_angle, 0.0, 4 * kPi);
  if (facets == 0) sphere = solid_angle > 2 * kPi ? 4 * kPi * squared_radius : 0;  // a whole ball, or nothing
  out.spherical_area = sphere;
  out.is_empty = facets == 0 && sphere == 0;
  if (out.is_empty) return;
  out.volume = std::clamp((cones + radius * sphere) / 3, 0.0, cell_volume);
  // A ball that touches its cell from outside: what is left is rounding, and has no inside that a mesh could be wrapped around.
  if (out.volume <= kTouchingShare * cell_volume) {
    out.volume = out.spherical_area = 0;
    out.is_empty = true;
    return;
  }
  // The spherical part's first moment follows from the area vectors: those of a closed surface add up to nothing.
  moment -= (squared_radius / 4) * area_vector;
  out.point_inside = facets > 0 ? mean / facets : Point3{};
  out.centroid = out.volume > 0 ? moment / out.volume : out.point_inside;
}

namespace {

// Is `point`, which lies in the face's plane, in the face or within `tolerance` of it?
bool is_in_face(const Clipper& cell, const ClippedFace& face, const Point3& point, double tolerance) {
  Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const Point3 b = cell.vertices[cell.loops[face.first + i]];
    const Vector3 along = b - a;
    if (dot(face.normal, cross(along, point - a)) < -tolerance * norm(along)) return false;
    a = b;
  }
  return true;
}

// Highest point of the shape in direction `up` (+1 or -1), as up * z. The point is the pole of the ball, the top of a facet's
// circle, a pierced edge, or a vertex; the largest of those that belong to the shape.
double highest_point(const Clipper& cell, double squared_radius, const ShapeMeasure& shape, double up) {
  const double radius = std::sqrt(squared_radius), tolerance = kTouchShare * radius;
  bool pole_inside = true;
  for (const ClippedFace& face : cell.faces) pole_inside = pole_inside && up * face.normal.z * radius <= face.offset + tolerance;
  if (pole_inside) return radius;
  double best = up * shape.point_inside.z;
  for (const Point3& v : cell.vertices) {
    if (squared_norm(v) <= squared_radius) best = std::max(best, up * v.z);
  }
  for (const ClippedFace& face : cell.faces) {
    Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const Point3 b = cell.vertices[cell.loops[face.first + i]];
      if (std::max(up * a.z, up * b.z) > best) {
        const Vector3 along = b - a;
        const double length = norm(along);
        const Vector3 e = length > 0 ? along / length : Vector3{};
        const double t = dot(a, e);
        const Vector3 nearest = a - t * e;
        const double rest = squared_radius - squared_norm(nearest);
        if (length > 0 && rest > 0) {
          const double reach = std::sqrt(rest);
          const double low = std::max(t, -reach), high = std::min(t + length, reach);
          if (low <= high) best = std::max({best, up * (nearest.z + low * e.z), up * (nearest.z + high * e.z)});
        }
      }
      a = b;
    }
  }
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const ClippedFace& face = cell.faces[k];
    const double rho2 = squared_radius - face.offset * face.offset;
    if (!(shape.areas[k] > 0) || !(rho2 > 0)) continue;
    const Vector3 foot = face.offset * face.normal;
    const Vector3 rise = Vector3{0, 0, up} - (up * face.normal.z) * face.normal;
    const double steepness = norm(rise);
    const Point3 top = steepness > 0 ? foot + (std::sqrt(rho2) / steepness) * rise : foot;
    if (up * top.z > best && (steepness == 0 || is_in_face(cell, face, top, tolerance))) best = up * top.z;
  }
  return best;
}

}  // namespace

void measure_extent(const Clipper& cell, double squared_radius, ShapeMeasure& shape) {
  if (cell.reach_squared() <= squared_radius) {
    shape.lowest = shape.highest = cell.vertices.front().z;
    for (const Point3& v : cell.vertices) {
      shape.lowest = std::min(shape.lowest, v.z);
      shape.highest = std::max(shape.highest, v.z);
    }
    return;
  }
  shape.highest = highest_point(cell, squared_radius, shape, 1);
  shape.lowest = std::min(shape.highest, -highest_point(cell, squared_radius, shape, -1));
}

double section_area(const Clipper& cell, double squared_radius, double z) {
  Disc disc;
  disc.squared_radius = squared_radius - z * z;
  if (!(disc.squared_radius > 0)) return 0;
  disc.radius = std::sqrt(disc.squared_radius);
  FacetIntegral sum;
  const Vector3 up{0, 0, 1};
  for (const ClippedFace& face : cell.faces) {
    // The outline of the section runs, counter-clockwise from above, from where a face's loop goes down to where it goes up.
    // Both are taken from the lower to the upper vertex, so that neighbouring faces get the same bits.
    Point3 down, rise;
    bool has_down = false, has_rise = false;
    std::uint32_t from = cell.loops[face.first + face.count - 1];
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const std::uint32_t to = cell.loops[face.first + i];
      const bool from_above = cell.vertices[from].z > z, to_above = cell.vertices[to].z > z;
      if (from_above != to_above) {
        const Point3& low = cell.vertices[from_above ? to : from];
        const Point3& high = cell.vertices[from_above ? from : to];
        Point3 crossing = low + ((z - low.z) / (high.z - low.z)) * (high - low);
        crossing.z = 0;
        (from_above ? down : rise) = crossing;
        (from_above ? has_down : has_rise) = true;
      }
      from = to;
    }
    if (has_down && has_rise) add_edge(down, rise, up, 0, disc, sum);
  }
  if (!sum.meets_edge) return sum.winding > kPi ? kPi * disc.squared_radius : 0;
  return std::max(0.0, sum.area);
}

double floor_area(const Clipper& cell, double squared_radius, const ShapeMeasure& shape, double storey_height) {
  const double height = shape.highest - shape.lowest;
  if (height < storey_height) return section_area(cell, squared_radius, shape.lowest + 0.5 * height);
  double sum = 0;
  for (int storey = 0; storey < static_cast<int>(kMostStoreys) + 1; ++storey) {
    const double above = (storey + 0.5) * storey_height;
    if (!(above < height)) break;
    sum += section_area(cell, squared_radius, shape.lowest + above);
  }
  return sum;
}

double footprint_area(const Clipper& cell, double squared_radius, const ShapeMeasure& shape) {
  double sum = section_area(cell, squared_radius, 0);
  std::vector<Point3> part;
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const ClippedFace& face = cell.faces[k];
    const double nz = face.normal.z;
    if (!(shape.areas[k] > 0) || nz == 0) continue;
    // Wanted is the part below the centre of upward facets, above it of downward ones.
    const double sign = nz > 0 ? -1 : 1;
    std::uint32_t wanted = 0;
    for (std::uint32_t i = 0; i < face.count; ++i) wanted += sign * cell.vertices[cell.loops[face.first + i]].z > 0 ? 1u : 0u;
    if (wanted == 0) continue;
    if (wanted == face.count) {
      sum += std::abs(nz) * shape.areas[k];
      continue;
    }
    part.clear();
    Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
    for (std::uint32_t i = 0; i < face.count; ++i) {
      const Point3 b = cell.vertices[cell.loops[face.first + i]];
      if ((sign * a.z > 0) != (sign * b.z > 0)) part.push_back(a + (a.z / (a.z - b.z)) * (b - a));
      if (sign * b.z > 0) part.push_back(b);
      a = b;
    }
    const Disc disc = disc_of(face.offset, squared_radius);
    FacetIntegral area;
    for (std::size_t i = 0; i < part.size(); ++i) {
      add_edge(part[i], part[(i + 1) % part.size()], face.normal, face.offset, disc, area);
    }
    if (!area.meets_edge) area.area = disc.radius > 0 && area.winding > kPi ? kPi * disc.squared_radius : 0;
    sum += std::abs(nz) * std::max(0.0, area.area);
  }
  return sum;
}

}  // namespace bl
