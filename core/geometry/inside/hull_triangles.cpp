// Convex hull with exact predicates.
#include "core/geometry/inside/hull_triangles.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <exception>

namespace bl::geometry {

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

bool comes_first(const CgalPoint& a, const CgalPoint& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

// Four points that are not flat: the four faces with the fourth corner on their inner side. The library's own special case of
// them leaves the orientation open, and for some orders names corners that it does not hand out.
std::vector<std::array<std::uint32_t, 3>> tetrahedron(const std::vector<CgalPoint>& points) {
  const bool is_positive = CGAL::orientation(points[0], points[1], points[2], points[3]) == CGAL::POSITIVE;
  if (is_positive) return {{0, 1, 3}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}};
  return {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<CgalPoint>& points) {
  if (points.size() == 4) return tetrahedron(points);
  // Into a mesh, not into lists: for lists the library takes planes that are constructed inexactly, and leaves out points.
  CGAL::Surface_mesh<CgalPoint> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto face : hull.faces()) {
    std::array<std::uint32_t, 3> t{};
    std::size_t i = 0;
    for (const auto corner : hull.vertices_around_face(hull.halfedge(face)))
      t[i++] = static_cast<std::uint32_t>(std::lower_bound(points.begin(), points.end(), hull.point(corner), comes_first) -
                                          points.begin());
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

}  // namespace bl::geometry
