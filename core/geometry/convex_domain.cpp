// Making convex domains from points, planes and meshes (a plan polygon: plan_domain.cpp).
#include "core/geometry/convex_domain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "core/base/text.h"
#include "core/geometry/domain_parts.h"
#include "core/geometry/hull_triangles.h"
#include "core/geometry/polyhedron.h"

namespace bl {

namespace {

constexpr std::uint32_t kNoPlane = 0xffffffffu;
// Corners within this share of the domain's size of a plane belong to the same face: the noise of rotated boxes.
constexpr double kCoplanarShare = 1e-11;
constexpr double kRounding = 0x1.0p-52;
// Thinner than this (volume against size³) is flat for every purpose here.
constexpr double kFlatShare = 1e-13;

using Triangle = std::array<std::uint32_t, 3>;

// Order of planes that small noise in the normals does not change: bottom first, then walls by direction, top last.
std::tuple<long long, long long, double> plane_key(const Plane& plane) {
  constexpr double kSteps = 1e9;
  const long long level = std::llround(plane.normal.z * kSteps);
  const double horizontal = std::sqrt(plane.normal.x * plane.normal.x + plane.normal.y * plane.normal.y);
  const long long east = std::llround(plane.normal.x * kSteps), north = std::llround(plane.normal.y * kSteps);
  if (horizontal < 1e-9 || (east == 0 && north == 0)) return {level, 0, plane.offset};
  double angle = std::atan2(static_cast<double>(north), static_cast<double>(east));
  if (angle < 0) angle += 2 * std::acos(-1.0);
  return {level, std::llround(angle * kSteps), plane.offset};
}

// The triangles of a hull, gathered into faces.
class FaceMerger {
 public:
  FaceMerger(std::span<const Point3> points, std::vector<Triangle> triangles)
      : points_(points), triangles_(std::move(triangles)) {
    Vector3 low = points[0], high = points[0];
    double largest = 0;
    for (const Point3& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    tolerance_ = std::max(kCoplanarShare * distance(low, high), 8 * kRounding * largest);
  }

  ConvexDomain merge() {
    group_of_.assign(triangles_.size(), kNoPlane);
    for (const std::uint32_t seed : by_area()) {
      if (group_of_[seed] == kNoPlane) grow(seed);
    }
    return build();
  }

 private:
  Vector3 area_vector(const Triangle& t) const {
    return 0.5 * cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
  }

  // Largest first: their planes are the best conditioned.
  std::vector<std::uint32_t> by_area() const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) order.emplace_back(-squared_norm(area_vector(triangles_[t])), t);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> result;
    for (const auto& entry : order) result.push_back(entry.second);
    return result;
  }

  std::uint32_t owner_of(std::uint32_t from, std::uint32_t to) {
    if (owners_.empty()) {
      for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (unsigned i = 0; i < 3; ++i) owners_.push_back({{triangles_[t][i], triangles_[t][(i + 1) % 3]}, t});
      }
      std::sort(owners_.begin(), owners_.end());
    }
    const std::pair<std::uint32_t, std::uint32_t> edge{from, to};
    const auto found = std::lower_bound(owners_.begin(), owners_.end(), std::pair{edge, 0u});
    return found != owners_.end() && found->first == edge ? found->second : kNoPlane;
  }

  void grow(std::uint32_t seed) {
    const Vector3 area = area_vector(triangles_[seed]);
    const double size = norm(area);
    const Vector3 normal = size > 0 ? area / size : Vector3{0, 0, 1};
    const Point3 at = points_[triangles_[seed][0]];
    const auto lies_in = [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](std::uint32_t v) { return std::abs(dot(normal, points_[v] - at)) <= tolerance_; });
    };
    const std::uint32_t group = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back({normal, dot(normal, at)});
    std::vector<std::uint32_t> open{seed};
    group_of_[seed] = group;
    while (!open.empty()) {
      const Triangle t = triangles_[open.back()];
      open.pop_back();
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t other = owner_of(t[(i + 1) % 3], t[i]);
        if (other == kNoPlane || group_of_[other] != kNoPlane || !lies_in(triangles_[other])) continue;
        group_of_[other] = group;
        open.push_back(other);
      }
    }
  }

  // The outline of one group: its directed edges without a twin in the group, linked from the smallest corner on.
  std::vector<std::uint32_t> outline(std::uint32_t group) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (group_of_[t] != group) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = triangles_[t][i], b = triangles_[t][(i + 1) % 3];
        const std::uint32_t other = owner_of(b, a);
        if (other == kNoPlane || group_of_[other] != group) edges.emplace_back(a, b);
      }
    }
    std::sort(edges.begin(), edges.end());
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

  ConvexDomain build() {
    std::vector<std::uint32_t> order(planes_.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tuple(plane_key(planes_[a]), a) < std::tuple(plane_key(planes_[b]), b);
    });
    ConvexDomain domain;
    std::vector<std::uint32_t> number(points_.size(), kNoPlane);
    for (const std::uint32_t group : order) {
      domain.planes.push_back(planes_[group]);
      domain.faces.push_back(outline(group));
      for (const std::uint32_t v : domain.faces.back()) number[v] = 0;
    }
    for (std::uint32_t v = 0; v < points_.size(); ++v) {
      if (number[v] == kNoPlane) continue;
      number[v] = static_cast<std::uint32_t>(domain.vertices.size());
      domain.vertices.push_back(points_[v]);
    }
    for (auto& face : domain.faces) {
      for (std::uint32_t& v : face) v = number[v];
    }
    return domain;
  }

  std::span<const Point3> points_;
  std::vector<Triangle> triangles_;
  double tolerance_ = 0;
  std::vector<std::uint32_t> group_of_;
  std::vector<Plane> planes_;
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> owners_;
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
  ConvexDomain domain = FaceMerger(sorted, std::move(*triangles)).merge();
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

Result<ConvexDomain> from_mesh(const Mesh& mesh) {
  if (mesh.triangles.size() < 4) return Error{ErrorCode::geometry, "", "a boundary mesh needs at least 4 triangles"};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  std::vector<Point3> used;
  for (const auto& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      if (t[i] >= mesh.vertices.size())
        return Error{ErrorCode::geometry, "", "a triangle of the boundary mesh names a vertex that is not there"};
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      twins.emplace_back(t[(i + 1) % 3], t[i]);
      used.push_back(mesh.vertices[t[i]]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  if (edges != twins || std::adjacent_find(edges.begin(), edges.end()) != edges.end()) {
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh is not closed: each edge needs one triangle on either side, turned the same way"};
  }
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

}  // namespace bl
