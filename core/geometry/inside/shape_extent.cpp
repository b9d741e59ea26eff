// Vertical extent, sections, floor area and footprint of (convex polyhedron ∩ ball).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/geometry/inside/facet_sum.h"
#include "core/geometry/inside/shape_measure.h"
#include "core/geometry/inside/wide_registers.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

namespace {

// Candidates for the highest and lowest point may miss the polyhedron by this share of the radius: a point that lies exactly
// on an edge must not be lost, and the height it may be wrong by is of the same size.
constexpr double kTouchOfExtent = 1e-12;

// Lines and circles this share of the radius beyond what is looked for miss it, whatever rounding says of edges up to a million
// radii away.
constexpr double kSureMiss = 1e-9;

// Is `point`, which lies in the face's plane, in the face or within `tolerance` of it?
bool is_in_face(const Polyhedron& cell, const PolyhedronFace& face, const Point3& point, double tolerance) {
  Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
  for (std::uint32_t i = 0; i < face.count; ++i) {
    const Point3 b = cell.vertices[cell.loops[face.first + i]];
    const Vector3 along = b - a;
    const double side = dot(face.normal, cross(along, point - a));
    if (side < 0) {
      const double length = norm(along);
      // Which way an edge without length runs is rounding: it bounds nothing.
      if (length > tolerance && side < -tolerance * length) return false;
    }
    a = b;
  }
  return true;
}

// The highest point of an edge from `a` to `b` within the ball, as up * z, where that is higher than `best`; else `best`.
double highest_of_edge(const Point3& a, const Point3& b, double squared_radius, double up, double best) {
  const Vector3 along = b - a;
  const double squared_length = squared_norm(along);
  if (squared_norm(cross(a, along)) > (1 + kSureMiss) * squared_radius * squared_length) return best;
  const double length = std::sqrt(squared_length);
  if (!(length > 0)) return best;
  const Vector3 e = along / length;
  const double t = dot(a, e);
  const Vector3 nearest = a - t * e;
  const double rest = squared_radius - squared_norm(nearest);
  if (!(rest > 0)) return best;
  const double reach = std::sqrt(rest);
  const double low = std::max(t, -reach), high = std::min(t + length, reach);
  return low <= high ? std::max({best, up * (nearest.z + low * e.z), up * (nearest.z + high * e.z)}) : best;
}

// Highest point of the shape in direction `up` (+1 or -1), as up * z. The point is the pole of the ball, a vertex, the top of a
// facet's circle, or where an edge leaves the ball; the largest of those that belong to the shape. Edges come last: most of them
// lie below what is known by then.
BL_WIDE_REGISTERS double highest_point(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape, double up) {
  const double radius = std::sqrt(squared_radius), tolerance = kTouchOfExtent * radius;
  bool pole_inside = true;
  for (const PolyhedronFace& face : cell.faces)
    pole_inside = pole_inside && up * face.normal.z * radius <= face.offset + tolerance;
  if (pole_inside) return radius;
  double best = up * shape.point_inside.z, highest_vertex = best;
  for (const Point3& v : cell.vertices) {
    highest_vertex = std::max(highest_vertex, up * v.z);
    if (up * v.z > best && squared_norm(v) <= squared_radius) best = up * v.z;
  }
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const PolyhedronFace& face = cell.faces[k];
    const double rho2 = squared_radius - face.offset * face.offset;
    if (!(shape.areas[k] > 0) || !(rho2 > 0)) continue;
    const Vector3 foot = face.offset * face.normal;
    // What is left of `up` in the facet's plane, without a difference of nearly equal numbers: level facets have none.
    const Vector3& n = face.normal;
    const double level = n.x * n.x + n.y * n.y;
    // The top of the circle lies √(ρ² level) above the foot. Most lie lower than what is known, which needs no root.
    const double gap = best - up * foot.z - kSureMiss * radius;
    if (gap > 0 && gap * gap > (1 + kSureMiss) * rho2 * level) continue;
    const Vector3 rise = up * Vector3{-n.z * n.x, -n.z * n.y, level};
    const double steepness = norm(rise);
    const Point3 top = steepness > 0 ? foot + (std::sqrt(rho2) / steepness) * rise : foot;
    if (up * top.z > best && (steepness == 0 || is_in_face(cell, face, top, tolerance))) best = up * top.z;
  }
  // No edge rises above its vertices.
  if (!(highest_vertex > best)) return best;
  for (const PolyhedronFace& face : cell.faces) {
    Point3 a = cell.vertices[cell.loops[face.first + face.count - 1]];
    for (const std::uint32_t to : cell.loop(face)) {
      const Point3& b = cell.vertices[to];
      if (std::max(up * a.z, up * b.z) > best) best = highest_of_edge(a, b, squared_radius, up, best);
      a = b;
    }
  }
  return best;
}

// Where one face is cut by the horizontal sections: on its way down and on its way up.
struct FaceCrossing {
  Point3 down, rise;
  std::uint32_t down_in = 0, rise_in = 0;  // the face that it belongs to, counted from 1
};

// All sections are cut in one pass over the edges. Their heights ascend.
BL_WIDE_REGISTERS void section_areas(const Polyhedron& cell, double squared_radius, std::span<const double> heights,
                                     std::vector<double>& areas) {
  thread_local std::vector<std::uint32_t> below;     // per vertex: how many of the heights
  thread_local std::vector<FaceCrossing> crossings;  // per height
  thread_local std::vector<FacetSum> sums;           // per height
  below.clear();
  for (const Point3& v : cell.vertices)
    below.push_back(static_cast<std::uint32_t>(std::lower_bound(heights.begin(), heights.end(), v.z) - heights.begin()));
  crossings.assign(heights.size(), {});
  sums.clear();
  for (const double z : heights) sums.emplace_back(Vector3{0, 0, 1}, z, squared_radius, nullptr);
  std::uint32_t number = 0;
  for (const PolyhedronFace& face : cell.faces) {
    // The outline of a section runs, counter-clockwise from above, from where a face's loop goes down to where it goes up.
    // Both are taken from the lower to the upper vertex, so that neighbouring faces get the same bits.
    ++number;
    const auto loop = cell.loop(face);
    std::uint32_t from = loop[face.count - 1], first = below[from], last = first;
    for (const std::uint32_t to : loop) {
      const bool goes_down = below[from] > below[to];
      const std::uint32_t lower = goes_down ? to : from, upper = goes_down ? from : to;
      const Point3 &low = cell.vertices[lower], &high = cell.vertices[upper];
      for (std::uint32_t k = below[lower]; k < below[upper]; ++k) {
        (goes_down ? crossings[k].down : crossings[k].rise) = low + ((heights[k] - low.z) / (high.z - low.z)) * (high - low);
        (goes_down ? crossings[k].down_in : crossings[k].rise_in) = number;
      }
      first = std::min(first, below[to]);
      last = std::max(last, below[to]);
      from = to;
    }
    for (std::uint32_t k = first; k < last; ++k) {
      const FaceCrossing& crossing = crossings[k];
      if (crossing.down_in != number || crossing.rise_in != number || !sums[k].has_disc()) continue;
      const auto place = [&](Point3 at) {
        at.z = heights[k];
        return Place::flat(at, squared_radius);
      };
      sums[k].add_edge(place(crossing.down), place(crossing.rise), 1);
    }
  }
  areas.clear();
  for (FacetSum& sum : sums) {
    if (sum.has_disc()) sum.close();
    areas.push_back(sum.area);
  }
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

double floor_area(const Polyhedron& cell, double squared_radius, double storey_height, ShapeMeasure& shape) {
  const double height = shape.highest - shape.lowest;
  thread_local std::vector<double> heights, areas;
  heights.clear();
  // A shape without a whole storey has one floor. Above the whole ones, what is left counts by its share of a storey.
  const double whole = std::min(std::floor(height / storey_height), kMostStoreys);
  const double rest = whole < 1 ? height : height - whole * storey_height;
  const double share = whole < 1 ? 1 : rest / storey_height;
  for (int storey = 0; storey < static_cast<int>(whole); ++storey)
    heights.push_back(shape.lowest + (storey + 0.5) * storey_height);
  heights.push_back(shape.highest - 0.5 * rest);
  // The footprint asks for one more, which comes with the same pass.
  const auto own = std::lower_bound(heights.begin(), heights.end(), 0.0) - heights.begin();
  heights.insert(heights.begin() + own, 0.0);
  section_areas(cell, squared_radius, heights, areas);
  shape.own_section = areas[static_cast<std::size_t>(own)];
  areas.erase(areas.begin() + own);
  areas.back() *= share;
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

BL_WIDE_REGISTERS double footprint_area(const Polyhedron& cell, double squared_radius, const ShapeMeasure& shape) {
  double sum = shape.own_section;
  thread_local std::vector<Point3> part;
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
      area.add_edge(Place::flat(part[i], squared_radius), Place::flat(part[(i + 1) % part.size()], squared_radius), 1);
    }
    if (area.has_disc()) area.close();
    sum += std::abs(nz) * area.area;
  }
  return sum;
}

}  // namespace bl::geometry
