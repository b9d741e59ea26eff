// Welding, triangles, edges and outlines; ordered containers throughout, so that the result depends on the surfaces alone.
#include "core/import/city_surfaces.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "core/geometry/polygon_triangles.h"

namespace bl::importing {

namespace {

constexpr double kUpright = 0.01;     // [ratio] a normal with less of it along z is that of a wall
constexpr double kSameHeight = 0.01;  // [m]

// Newell's normal, twice the area long.
Vector3 normal_of(const std::vector<Point3>& vertices, const std::vector<std::uint32_t>& ring) {
  Vector3 sum;
  const Point3& origin = vertices[ring.front()];
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += cross(vertices[ring[i]] - origin, vertices[ring[(i + 1) % ring.size()]] - origin);
  return sum;
}

// The face seen along the axis that its normal is nearest to, so that it turns as it does from outside.
Point3 seen_along(const Point3& p, const Vector3& normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (z >= x && z >= y) return normal.z > 0 ? Point3{p.x, p.y, 0} : Point3{p.y, p.x, 0};
  if (y >= x) return normal.y > 0 ? Point3{p.z, p.x, 0} : Point3{p.x, p.z, 0};
  return normal.x > 0 ? Point3{p.y, p.z, 0} : Point3{p.z, p.y, 0};
}

void add_triangles(const std::vector<Point3>& vertices, const CitySurface& surface, Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  std::vector<geometry::Ring> rings;
  const Vector3 normal = normal_of(vertices, surface.rings.front());
  for (const auto& ring : surface.rings) {
    if (ring.size() < 3) continue;
    rings.emplace_back();
    for (const std::uint32_t index : ring) {
      corners.push_back(index);
      rings.back().push_back(seen_along(vertices[index], normal));
    }
  }
  if (rings.empty()) return;
  if (rings.size() == 1 && !(geometry::signed_area(rings[0]) > 0)) {  // of no area: any triangles that keep its edges
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) mesh.triangles.push_back({corners[0], corners[i], corners[i + 1]});
    return;
  }
  for (const auto& [a, b, c] : geometry::polygon_triangles(rings)) mesh.triangles.push_back({corners[a], corners[b], corners[c]});
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// How often each edge is run along, less how often it is run back; only those that do not cancel out.
std::map<Edge, int> unmatched_edges(const Mesh& mesh) {
  std::map<Edge, int> sums;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      if (a != b) sums[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  std::erase_if(sums, [](const auto& entry) { return entry.second == 0; });
  return sums;
}

// Turns triangles so that neighbours run along their common edge in opposite directions, from the first of each piece on.
void turn_alike(Mesh& mesh) {
  std::map<Edge, std::vector<std::size_t>> users;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      users[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  const auto runs = [&](std::size_t t, const Edge& edge) {
    for (std::size_t i = 0; i < 3; ++i)
      if (mesh.triangles[t][i] == edge.first && mesh.triangles[t][(i + 1) % 3] == edge.second) return true;
    return false;
  };
  std::vector<bool> is_seen(mesh.triangles.size(), false);
  for (std::size_t start = 0; start < mesh.triangles.size(); ++start) {
    std::vector<std::size_t> open;
    if (!is_seen[start]) open.push_back(start);
    is_seen[start] = true;
    while (!open.empty()) {
      const std::size_t t = open.back();
      open.pop_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
        const auto& pair = users.at({std::min(a, b), std::max(a, b)});
        if (pair.size() != 2) continue;
        const std::size_t other = pair[0] == t ? pair[1] : pair[0];
        if (is_seen[other]) continue;
        if (runs(other, {a, b})) std::swap(mesh.triangles[other][1], mesh.triangles[other][2]);
        is_seen[other] = true;
        open.push_back(other);
      }
    }
  }
}

// The surfaces over vertices that are welded: each place is one vertex.
std::vector<CitySurface> welded(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces,
                                std::vector<Point3>& kept) {
  std::map<std::array<double, 3>, std::uint32_t> known;
  std::vector<CitySurface> result;
  for (const CitySurface& surface : surfaces) {
    CitySurface& copy = result.emplace_back();
    copy.semantic = surface.semantic;
    for (const auto& ring : surface.rings) {
      auto& fresh = copy.rings.emplace_back();
      for (const std::uint32_t index : ring) {
        const Point3& p = vertices[index];
        const auto [it, is_new] = known.emplace(std::array{p.x, p.y, p.z}, static_cast<std::uint32_t>(kept.size()));
        if (is_new) kept.push_back(p);
        if (fresh.empty() || fresh.back() != it->second) fresh.push_back(it->second);
      }
      while (fresh.size() > 1 && fresh.front() == fresh.back()) fresh.pop_back();
    }
    std::erase_if(copy.rings, [](const auto& ring) { return ring.size() < 3; });
  }
  std::erase_if(result, [](const CitySurface& surface) { return surface.rings.empty(); });
  return result;
}

// Which surfaces make the outline in plan.
std::vector<const CitySurface*> ground_of(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces) {
  std::vector<const CitySurface*> named, down, up;
  for (const CitySurface& surface : surfaces) {
    const Vector3 normal = normal_of(vertices, surface.rings.front());
    if (std::abs(normal.z) < kUpright * norm(normal) || norm(normal) == 0) continue;
    if (surface.semantic == "GroundSurface") named.push_back(&surface);
    (normal.z < 0 ? down : up).push_back(&surface);
  }
  return !named.empty() ? named : !down.empty() ? down : up;
}

// Where edges lead from each vertex, in the order that they are taken.
using Ways = std::map<std::uint32_t, std::deque<std::uint32_t>>;

// Directed edges to rings. Where a way comes back to a place that it has passed, what lies between is a ring of its own, so
// that rings that touch themselves come apart.
std::vector<std::vector<std::uint32_t>> chained(Ways ways) {
  std::vector<std::vector<std::uint32_t>> rings;
  while (!ways.empty()) {
    std::vector<std::uint32_t> chain{ways.begin()->first};
    std::map<std::uint32_t, std::size_t> at{{chain.front(), 0}};
    for (auto it = ways.begin(); it != ways.end(); it = ways.find(chain.back())) {
      const std::uint32_t next = it->second.front();
      it->second.pop_front();
      if (it->second.empty()) ways.erase(it);
      const auto known = at.find(next);
      if (known == at.end()) {
        at.emplace(next, chain.size());
        chain.push_back(next);
        continue;
      }
      const std::size_t from = known->second;
      if (chain.size() - from >= 3) rings.emplace_back(chain.begin() + static_cast<std::ptrdiff_t>(from), chain.end());
      for (std::size_t i = from + 1; i < chain.size(); ++i) at.erase(chain[i]);
      chain.resize(from + 1);
    }
  }
  return rings;
}

// Closes holes whose edges all lie at the foot of the surfaces: city models often leave the floor out. Are there no others?
bool add_floor(Mesh& mesh) {
  double foot = mesh.vertices.front().z;
  for (const Point3& p : mesh.vertices) foot = std::min(foot, p.z);
  Ways ways;
  for (const auto& [edge, sum] : unmatched_edges(mesh)) {
    if (mesh.vertices[edge.first].z > foot + kSameHeight || mesh.vertices[edge.second].z > foot + kSameHeight) return false;
    // The missing face runs along its edges the other way round.
    for (int i = 0; i < std::abs(sum); ++i)
      ways[sum > 0 ? edge.second : edge.first].push_back(sum > 0 ? edge.first : edge.second);
  }
  for (const auto& ring : chained(std::move(ways))) {
    CitySurface floor;
    floor.rings.push_back(ring);
    add_triangles(mesh.vertices, floor, mesh);
  }
  return unmatched_edges(mesh).empty();
}

}  // namespace

double triangles_effort(const std::vector<CitySurface>& surfaces) {
  constexpr double kHoleCost = 30, kFew = 256;
  double effort = 0;
  for (const CitySurface& surface : surfaces) {
    double corners = 0;
    for (const auto& ring : surface.rings) corners += static_cast<double>(ring.size());
    if (corners >= kFew) effort += corners * (corners + kHoleCost * static_cast<double>(surface.rings.size() - 1));
  }
  return effort;
}

CitySolid city_solid(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces) {
  CitySolid solid;
  for (const CitySurface& surface : welded(vertices, surfaces, solid.mesh.vertices))
    add_triangles(solid.mesh.vertices, surface, solid.mesh);
  if (solid.mesh.triangles.empty()) return solid;
  auto open = unmatched_edges(solid.mesh);
  if (!open.empty()) {
    Mesh turned = solid.mesh;
    turn_alike(turned);
    if (unmatched_edges(turned).empty()) {
      solid.mesh = std::move(turned);
      solid.was_turned = true;
      open.clear();
    }
  }
  solid.open_edges = open.size();
  solid.is_closed = open.empty();
  if (!solid.is_closed) {
    Mesh closed = solid.mesh;
    if (add_floor(closed)) {
      solid.mesh = std::move(closed);
      solid.is_closed = solid.had_no_floor = true;
    }
  }
  if (!solid.is_closed) return solid;
  solid.volume = enclosed_volume(solid.mesh);
  if (solid.volume < 0) {
    for (auto& triangle : solid.mesh.triangles) std::swap(triangle[1], triangle[2]);
    solid.volume = -solid.volume;
    solid.was_turned = true;
  }
  return solid;
}

std::vector<geometry::Ring> city_outlines(const std::vector<Point3>& vertices, const std::vector<CitySurface>& surfaces) {
  std::vector<Point3> kept;
  const std::vector<CitySurface> sound = welded(vertices, surfaces, kept);
  std::map<std::array<double, 2>, std::uint32_t> known;
  std::vector<Point3> places;
  std::vector<std::uint32_t> place_of;
  for (const Point3& p : kept) {
    const auto [it, is_new] = known.emplace(std::array{p.x, p.y}, static_cast<std::uint32_t>(places.size()));
    if (is_new) places.push_back({p.x, p.y, 0});
    place_of.push_back(it->second);
  }
  std::map<Edge, int> sums;
  for (const CitySurface* surface : ground_of(kept, sound)) {
    const bool looks_down = normal_of(kept, surface->rings.front()).z < 0;
    for (const auto& ring : surface->rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        std::uint32_t a = place_of[ring[i]], b = place_of[ring[(i + 1) % ring.size()]];
        if (looks_down) std::swap(a, b);
        if (a != b) sums[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      }
  }
  Ways ways;
  for (const auto& [edge, sum] : sums)
    for (int i = 0; i < std::abs(sum); ++i)
      ways[sum > 0 ? edge.first : edge.second].push_back(sum > 0 ? edge.second : edge.first);
  std::vector<geometry::Ring> rings;
  for (const auto& chain : chained(std::move(ways))) {
    geometry::Ring& ring = rings.emplace_back();
    for (const std::uint32_t index : chain) ring.push_back(places[index]);
  }
  return rings;
}

}  // namespace bl::importing
