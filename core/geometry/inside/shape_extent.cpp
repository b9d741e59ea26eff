// Vertical extent, sections, floor area and footprint of (convex polyhedron ∩ ball).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/inside/facet_sum.h"
#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

namespace {

// Candidates for the highest and lowest point may miss the polyhedron by this share of the radius: a point that lies exactly
// on an edge must not be lost, and the height it may be wrong by is of the same size.
constexpr double kTouchOfExtent = 1e-12;

// Is `point`, which lies in the face's plane, in the face or within `tolerance` of it?
bool is_in_face(const Polyhedron& cell, const PolyhedronFace& face, const Point3& point, double tolerance) {
  Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const Point3 b = cell.vertices[cell.loops[face.first + i]];
    const Vector3 along = b - a;
    const double length = norm(along);
    // Which way an edge without length runs is rounding: it bounds nothing.
    if (length > tolerance && dot(face.normal, cross(along, point - a)) < -tolerance * length) return false;
    a = b;
  }
  return true;
}

// Highest point of the shape in direction `up` (+1 or -1), as up * z. The point is the pole of the ball, the top of a facet's
// circle, a pierced edge, or a vertex; the largest of those that belong to the shape.
double highest_point(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape, double up) {
  const double radius = std::sqrt(squared_radius), tolerance = kTouchOfExtent * radius;
  bool pole_inside = true;
  for (const PolyhedronFace& face : cell.faces)
    pole_inside = pole_inside && up * face.normal.z * radius <= face.offset + tolerance;
  if (pole_inside) return radius;
  double best = up * shape.point_inside.z;
  for (const Point3& v : cell.vertices) {
    if (squared_norm(v) <= squared_radius) best = std::max(best, up * v.z);
  }
  for (const PolyhedronFace& face : cell.faces) {
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
    const PolyhedronFace& face = cell.faces[k];
    const double rho2 = squared_radius - face.offset * face.offset;
    if (!(shape.areas[k] > 0) || !(rho2 > 0)) continue;
    const Vector3 foot = face.offset * face.normal;
    // What is left of `up` in the facet's plane, without a difference of nearly equal numbers: level facets have none.
    const Vector3& n = face.normal;
    const Vector3 rise = up * Vector3{-n.z * n.x, -n.z * n.y, n.x * n.x + n.y * n.y};
    const double steepness = norm(rise);
    const Point3 top = steepness > 0 ? foot + (std::sqrt(rho2) / steepness) * rise : foot;
    if (up * top.z > best && (steepness == 0 || is_in_face(cell, face, top, tolerance))) best = up * top.z;
  }
  return best;
}

}  // namespace

void measure_extent(const Polyhedron& cell, double squared_radius, ShapeMeasure& shape) {
  if (cell.reach_squared <= squared_radius) {
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

double section_area(const Polyhedron& cell, double squared_radius, double z) {
  FacetSum sum({0, 0, 1}, z, squared_radius, nullptr);
  if (!sum.has_disc()) return 0;
  const auto place = [&](Point3 at) {
    at.z = z;
    return Place::of(at, squared_radius);
  };
  for (const PolyhedronFace& face : cell.faces) {
    // The outline of the section runs, counter-clockwise from above, from where a face's loop goes down to where it goes up.
    // Both are taken from the lower to the upper vertex, so that neighbouring faces get the same bits.
    Point3 down, rise;
    bool has_down = false, has_rise = false;
    const auto loop = cell.loop(face);
    std::uint32_t from = loop[face.count - 1];
    for (const std::uint32_t to : loop) {
      const bool from_above = cell.vertices[from].z > z, to_above = cell.vertices[to].z > z;
      if (from_above != to_above) {
        const Point3& low = cell.vertices[from_above ? to : from];
        const Point3& high = cell.vertices[from_above ? from : to];
        (from_above ? down : rise) = low + ((z - low.z) / (high.z - low.z)) * (high - low);
        (from_above ? has_down : has_rise) = true;
      }
      from = to;
    }
    if (has_down && has_rise) sum.add_edge(place(down), place(rise), 1);
  }
  sum.close();
  return sum.area;
}

double floor_area(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape, double storey_height) {
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

double footprint_area(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape) {
  double sum = section_area(cell, squared_radius, 0);
  std::vector<Point3> part;
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const PolyhedronFace& face = cell.faces[k];
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
    FacetSum area(face.normal, face.offset, squared_radius, nullptr);
    for (std::size_t i = 0; area.has_disc() && i < part.size(); ++i) {
      area.add_edge(Place::of(part[i], squared_radius), Place::of(part[(i + 1) % part.size()], squared_radius), 1);
    }
    if (area.has_disc()) area.close();
    sum += std::abs(nz) * area.area;
  }
  return sum;
}

}  // namespace bl::geometry
