// Convex hull with exact predicates.
#include "core/geometry/hull_triangles.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <exception>

namespace bl {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = Kernel::Point_3;

// Do all points lie in one plane (or line, or place)? Exact.
bool is_flat(const std::vector<CgalPoint>& points) {
  std::size_t second = 1;
  while (second < points.size() && points[second] == points[0]) ++second;
  std::size_t third = second + 1;
  while (third < points.size() && CGAL::collinear(points[0], points[second], points[third])) ++third;
  for (std::size_t i = third + 1; i < points.size(); ++i) {
    if (!CGAL::coplanar(points[0], points[second], points[third], points[i])) return false;
  }
  return true;
}

bool is_less(const CgalPoint& a, const CgalPoint& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

// Does the face of a tetrahedron look at the fourth corner, which is inside?
bool is_inside_out(const std::vector<CgalPoint>& corners, const std::array<std::size_t, 3>& face) {
  const std::size_t fourth = 6 - face[0] - face[1] - face[2];
  return CGAL::orientation(corners[face[0]], corners[face[1]], corners[face[2]], corners[fourth]) == CGAL::POSITIVE;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<CgalPoint>& points) {
  std::vector<CgalPoint> corners;
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::convex_hull_3(points.begin(), points.end(), corners, faces);
  std::vector<std::uint32_t> index;
  for (const CgalPoint& corner : corners) {
    index.push_back(static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), corner, is_less) - points.begin()));
  }
  // The library hands out a single tetrahedron with whatever orientation its points have: looked at, and turned where needed.
  const bool is_inward = corners.size() == 4 && is_inside_out(corners, faces.front());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& face : faces) {
    std::array<std::uint32_t, 3> t{index[face[0]], index[face[1]], index[face[2]]};
    if (is_inward) std::swap(t[1], t[2]);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

Result<std::vector<std::array<std::uint32_t, 3>>> hull_triangles(std::span<const Point3> points) try {
  std::vector<CgalPoint> copies;
  for (const Point3& p : points) copies.emplace_back(p.x, p.y, p.z);
  if (copies.size() < 4 || is_flat(copies)) {
    return Error{ErrorCode::geometry, "", "all boundary points lie in one plane: add a point above or below it"};
  }
  return triangles_of(copies);
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the convex hull failed: ") + problem.what()};
}

}  // namespace bl
