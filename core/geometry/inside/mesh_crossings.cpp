// Exact search for triangles of a mesh that meet where they must not.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <exception>
#include <string>

#include "core/geometry/inside/mesh_shells.h"

namespace bl::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<std::uint32_t, 3>;

class CrossingSearch {
 public:
  explicit CrossingSearch(const Mesh& mesh) : mesh_(mesh) {
    for (const Point3& v : mesh.vertices) points_.emplace_back(v.x, v.y, v.z);
  }

  // The first crossing in the order of a sweep along x is enough.
  std::vector<TrianglePair> run() const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Corners& c = mesh_.triangles[t];
      if (CGAL::collinear(points_[c[0]], points_[c[1]], points_[c[2]])) return {{t, t}};
      order.emplace_back(range(t, &Vector3::x).first, t);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> active;
    for (const auto& [x, t] : order) {
      const double low = x;
      std::erase_if(active, [&](std::uint32_t other) { return range(other, &Vector3::x).second < low; });
      for (const std::uint32_t other : active)
        if (overlap(t, other, &Vector3::y) && overlap(t, other, &Vector3::z) && cross(t, other))
          return {{std::min(t, other), std::max(t, other)}};
      active.push_back(t);
    }
    return {};
  }

 private:
  std::pair<double, double> range(std::uint32_t t, double Vector3::*axis) const {
    const Corners& c = mesh_.triangles[t];
    return std::minmax({mesh_.vertices[c[0]].*axis, mesh_.vertices[c[1]].*axis, mesh_.vertices[c[2]].*axis});
  }

  bool overlap(std::uint32_t a, std::uint32_t b, double Vector3::*axis) const {
    const auto first = range(a, axis), second = range(b, axis);
    return first.first <= second.second && second.first <= first.second;
  }

  Kernel::Triangle_3 triangle(const Corners& c) const { return {points_[c[0]], points_[c[1]], points_[c[2]]}; }

  bool cross(std::uint32_t a, std::uint32_t b) const {
    Corners first = mesh_.triangles[a], second = mesh_.triangles[b];
    // Common corners to the front, in the same order.
    std::size_t common = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto twin = std::find(second.begin() + static_cast<std::ptrdiff_t>(common), second.end(), first[i]);
      if (twin == second.end()) continue;
      std::iter_swap(second.begin() + static_cast<std::ptrdiff_t>(common), twin);
      std::swap(first[common++], first[i]);
    }
    const auto point = [&](std::uint32_t v) { return points_[v]; };
    if (common == 0) return CGAL::do_intersect(triangle(first), triangle(second));
    if (common == 1)
      return CGAL::do_intersect(Kernel::Segment_3(point(first[1]), point(first[2])), triangle(second)) ||
             CGAL::do_intersect(Kernel::Segment_3(point(second[1]), point(second[2])), triangle(first));
    if (common == 3) return true;
    // Over a common edge they cross only where one lies folded onto the other.
    return CGAL::coplanar(point(first[0]), point(first[1]), point(first[2]), point(second[2])) &&
           CGAL::coplanar_orientation(point(first[0]), point(first[1]), point(first[2]), point(second[2])) == CGAL::POSITIVE;
  }

  const Mesh& mesh_;
  std::vector<Kernel::Point_3> points_;
};

}  // namespace

Result<std::vector<TrianglePair>> crossing_triangles(const Mesh& mesh) try {
  return CrossingSearch(mesh).run();
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the check of the mesh failed: ") + problem.what()};
}

}  // namespace bl::geometry
