// Making convex domains from points, planes and meshes (a plan polygon: plan_domain.cpp).
#include "core/geometry/convex_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "core/base/text.h"
#include "core/geometry/inside/coplanar_groups.h"
#include "core/geometry/inside/domain_parts.h"
#include "core/geometry/inside/hull_triangles.h"
#include "core/geometry/inside/none.h"
#include "core/geometry/inside/polyhedron.h"

namespace bl::geometry {

namespace {

// Thinner than this (volume against size³) is flat for every purpose here.
constexpr double kFlatShare = 1e-13;

using Triangle = std::array<std::uint32_t, 3>;

// The faces of a hull from its triangles.
class FaceMerger {
 public:
  FaceMerger(std::span<const Point3> points, const std::vector<Triangle>& triangles)
      : points_(points), triangles_(triangles), groups_(coplanar_groups(points, triangles)) {}

  ConvexDomain merge() const {
    ConvexDomain domain;
    std::vector<std::uint32_t> number(points_.size(), kNone);
    domain.planes = groups_.planes;
    for (std::uint32_t group = 0; group < groups_.planes.size(); ++group) {
      domain.faces.push_back(outline(group));
      for (const std::uint32_t v : domain.faces.back()) number[v] = 0;
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (number[v] == kNone) continue;
      number[v] = static_cast<std::uint32_t>(domain.vertices.size());
      domain.vertices.push_back(points_[v]);
    }
    for (auto& face : domain.faces) {
      for (std::uint32_t& v : face) v = number[v];
    }
    return domain;
  }

 private:
  // The outline of one group: its directed edges without a twin in the group, linked from the smallest corner on.
  std::vector<std::uint32_t> outline(std::uint32_t group) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, all;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (groups_.group_of[t] != group) continue;
      for (unsigned i = 0; i < 3; ++i) all.emplace_back(triangles_[t][i], triangles_[t][(i + 1) % 3]);
    }
    std::sort(all.begin(), all.end());
    for (const auto& [from, to] : all)
      if (!std::binary_search(all.begin(), all.end(), std::pair{to, from})) edges.emplace_back(from, to);
    std::vector<std::uint32_t> loop;
    if (edges.empty()) return loop;
    std::uint32_t at = edges.front().first;
    do {
      loop.push_back(at);
      const auto next = std::lower_bound(edges.begin(), edges.end(), std::pair{at, 0u});
      if (next == edges.end() || next->first != at) return {};
      at = next->second;
    } while (at != loop.front() && loop.size() <= edges.size());
    return loop;
  }

  std::span<const Point3> points_;
  std::span<const Triangle> triangles_;
  CoplanarGroups groups_;
};

bool is_less(const Point3& a, const Point3& b) { return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z); }

}  // namespace

Result<void> check_points(std::span<const Point3> points, std::string_view what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) {
      return Error{ErrorCode::not_finite, "",
                   std::string(what) + " " + std::to_string(i) + " has a coordinate that is not a number"};
    }
    if (std::max({std::abs(points[i].x), std::abs(points[i].y), std::abs(points[i].z)}) > kLargestCoordinate) {
      return Error{
          ErrorCode::out_of_range, "",
          std::string(what) + " " + std::to_string(i) + " lies more than 1e8 m from the origin: move the scene's origin near it"};
    }
  }
  return {};
}

Result<ConvexDomain> finish_domain(ConvexDomain domain) {
  if (domain.vertices.size() < 4) return Error{ErrorCode::geometry, "", "the boundary has no volume"};
  domain.minimum = domain.maximum = domain.vertices.front();
  for (const Point3& v : domain.vertices) {
    domain.minimum = {std::min(domain.minimum.x, v.x), std::min(domain.minimum.y, v.y), std::min(domain.minimum.z, v.z)};
    domain.maximum = {std::max(domain.maximum.x, v.x), std::max(domain.maximum.y, v.y), std::max(domain.maximum.z, v.z)};
  }
  Point3 centroid;
  domain.volume = volume_and_centroid(polyhedron_of(domain, domain.vertices.front()), centroid);
  domain.centroid = centroid + domain.vertices.front();
  const double size = domain.size();
  if (!(domain.volume > kFlatShare * size * size * size)) {
    return Error{ErrorCode::geometry, "", "the boundary is flat: its volume is " + shortest(domain.volume) + " m³"};
  }
  return domain;
}

bool ConvexDomain::contains(const Point3& point, double tolerance) const {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (faces[k].size() < 3) continue;
    // Not `<=`, so that a point that is not a number is outside.
    if (!(dot(planes[k].normal, point - vertices[faces[k].front()]) <= tolerance)) return false;
  }
  return true;
}

double ConvexDomain::share_inside(const Vector3& way, double most) const {
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (faces[k].size() < 3) continue;
    const double rise = dot(planes[k].normal, way), room = dot(planes[k].normal, vertices[faces[k].front()] - centroid);
    if (rise * most > room) most = room / rise;
  }
  return most;
}

Result<ConvexDomain> convex_hull(std::span<const Point3> points) {
  if (auto checked = check_points(points, "boundary point"); !checked) return checked.error();
  std::vector<Point3> sorted;
  // Adding zero turns -0 into +0, so that equal points have equal bits.
  for (const Point3& p : points) sorted.push_back(p + Vector3{});
  std::sort(sorted.begin(), sorted.end(), is_less);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 4) {
    return Error{ErrorCode::geometry, "",
                 "a boundary needs at least 4 points that are not in one plane; " + std::to_string(points.size()) + " given, " +
                     std::to_string(sorted.size()) + " of them at different places"};
  }
  auto triangles = hull_triangles(sorted);
  if (!triangles) return triangles.error();
  ConvexDomain domain = FaceMerger(sorted, *triangles).merge();
  for (const auto& face : domain.faces) {
    if (face.size() < 3) return Error{ErrorCode::geometry, "", "the boundary points are flat within rounding"};
  }
  return finish_domain(std::move(domain));
}

Mesh to_mesh(const ConvexDomain& domain) {
  Mesh mesh;
  mesh.vertices = domain.vertices;
  for (const auto& face : domain.faces) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i) mesh.triangles.push_back({face[0], face[i], face[i + 1]});
  }
  return mesh;
}

Result<void> check_closed(const Mesh& mesh) {
  if (mesh.triangles.size() < 4) return Error{ErrorCode::geometry, "", "a boundary mesh needs at least 4 triangles"};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  for (const auto& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      if (t[i] >= mesh.vertices.size())
        return Error{ErrorCode::geometry, "", "a triangle of the boundary mesh names a vertex that is not there"};
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      twins.emplace_back(t[(i + 1) % 3], t[i]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  if (edges != twins || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) {
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh is not closed: each edge needs one triangle on either side, turned the same way"};
  }
  return {};
}

Result<ConvexDomain> from_mesh(const Mesh& mesh) {
  if (auto closed = check_closed(mesh); !closed) return closed.error();
  std::vector<Point3> used;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) used.push_back(mesh.vertices[v]);
  auto domain = convex_hull(used);
  if (!domain) return domain.error();
  const double volume = std::abs(enclosed_volume(mesh));
  const double size = domain->size();
  if (std::abs(volume - domain->volume) > 1e-8 * domain->volume + 1e-12 * size * size * size) {
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh is not convex: it encloses " + shortest(volume) + " m³, its convex hull " +
                     shortest(domain->volume) + " m³; use the hull or cut the mesh into convex pieces"};
  }
  return domain;
}

}  // namespace bl::geometry
