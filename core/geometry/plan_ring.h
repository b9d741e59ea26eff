// Plane geometry of closed rings of points, the outlines of plans: area, orientation, crossings, nearness and the convex hull.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

/// A closed polygon line in metres; the first point is not repeated at the end. Only x and y count.
using Ring = std::vector<Point3>;

/// Twice the signed area of the triangle a, b, c [m²]: positive where c lies left of a → b.
inline double turn(const Point3& a, const Point3& b, const Point3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Shoelace area [m²], positive for counter-clockwise rings; summed about the first point, so that large coordinates
/// do not eat the digits.
double signed_area(std::span<const Point3> ring);
/// Length of the closed line [m].
double perimeter(std::span<const Point3> ring);
/// Is the point inside by the even-odd rule? For points on the line the result is arbitrary.
bool ring_contains(std::span<const Point3> ring, const Point3& point);
/// The point of the ring that lies nearest to `point`.
Point3 nearest_on_ring(std::span<const Point3> ring, const Point3& point);

/// Two edges that cross or touch; edge k runs from point k to the next point of its ring.
struct Crossing {
  std::size_t first_edge = 0, second_edge = 0;
  Point3 where;
};
/// A place where the ring crosses or touches itself or doubles back, or nothing for a simple ring.
std::optional<Crossing> find_self_crossing(std::span<const Point3> ring);
/// A place where the two rings meet; first_edge belongs to `a`, second_edge to `b`.
std::optional<Crossing> find_crossing(std::span<const Point3> a, std::span<const Point3> b);

/// Counter-clockwise convex hull without collinear points, starting at the smallest (x, y).
/// Andrew's monotone chain (1979).
Ring hull_of_plan(std::span<const Point3> points);
/// The largest distance of a point from the nearest side of the hull [m]: 0 for a convex polygon.
double depth_below_hull(std::span<const Point3> ring, std::span<const Point3> hull);

}  // namespace bl::geometry
