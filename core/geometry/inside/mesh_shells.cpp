// Which shell of a mesh lies within which decides how it is turned: solid, cavity, solid in the cavity, and so on.
#include "core/geometry/inside/mesh_shells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <tuple>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/geometry/inside/domain_parts.h"

namespace bl::geometry {

namespace {

std::string place_text(const Point3& p) {
  return std::string("(").append(fixed(p.x, 3)).append(", ").append(fixed(p.y, 3)).append(", ").append(fixed(p.z, 3)).append(")");
}

// Each place one vertex, in the order of the coordinates; triangles from their smallest corner on, in ascending order.
Mesh welded(const Mesh& mesh) {
  const auto is_less = [](const Point3& a, const Point3& b) { return std::tuple(a.x, a.y, a.z) < std::tuple(b.x, b.y, b.z); };
  Mesh result;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) result.vertices.push_back(mesh.vertices[v] + Vector3{});
  std::sort(result.vertices.begin(), result.vertices.end(), is_less);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (unsigned i = 0; i < 3; ++i) {
      const auto at = std::lower_bound(result.vertices.begin(), result.vertices.end(), mesh.vertices[t[i]] + Vector3{}, is_less);
      corners[i] = static_cast<std::uint32_t>(at - result.vertices.begin());
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.triangles.push_back(corners);
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

// Triangles that hang together by edges.
std::vector<Mesh> shells_of(const Mesh& mesh) {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i) edges.push_back({{mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]}, t});
  std::sort(edges.begin(), edges.end());
  std::vector<bool> is_taken(mesh.triangles.size(), false);
  std::vector<Mesh> shells;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (is_taken[seed]) continue;
    Mesh& shell = shells.emplace_back();
    shell.vertices = mesh.vertices;
    std::vector<std::uint32_t> open{seed};
    is_taken[seed] = true;
    while (!open.empty()) {
      const auto t = mesh.triangles[open.back()];
      open.pop_back();
      shell.triangles.push_back(t);
      for (unsigned i = 0; i < 3; ++i) {
        const std::pair<std::uint32_t, std::uint32_t> twin{t[(i + 1) % 3], t[i]};
        const std::uint32_t other = std::lower_bound(edges.begin(), edges.end(), std::pair{twin, 0u})->second;
        if (!is_taken[other]) open.push_back(other);
        is_taken[other] = true;
      }
    }
  }
  return shells;
}

double volume_of(const Mesh& shell) {
  // Relative to one of its own corners; the first vertex of the list may belong to a far shell.
  const Point3 origin = shell.vertices[shell.triangles.front()[0]];
  double six_volumes = 0;
  for (const auto& t : shell.triangles) {
    const Vector3 a = shell.vertices[t[0]] - origin, b = shell.vertices[t[1]] - origin, c = shell.vertices[t[2]] - origin;
    six_volumes += dot(a, cross(b, c));
  }
  return six_volumes / 6;
}

}  // namespace

double winding_number(const Mesh& mesh, const Point3& point) {
  double angle = 0;
  for (const auto& t : mesh.triangles) {
    const Vector3 a = mesh.vertices[t[0]] - point, b = mesh.vertices[t[1]] - point, c = mesh.vertices[t[2]] - point;
    const double u = norm(a), v = norm(b), w = norm(c);
    // Half of the solid angle of a triangle (van Oosterom and Strackee, 1983).
    angle += mathematics::arc_tangent(dot(a, cross(b, c)), u * v * w + dot(a, b) * w + dot(b, c) * u + dot(c, a) * v);
  }
  return angle / (2 * std::numbers::pi);
}

Result<Mesh> ready_mesh(const Mesh& mesh) {
  if (auto checked = check_points(mesh.vertices, "mesh vertex"); !checked) return checked.error();
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t)
      if (v >= mesh.vertices.size())
        return Error{ErrorCode::geometry, "", "a triangle of the boundary mesh names a vertex that is not there"};
  Mesh result = welded(mesh);
  if (auto closed = check_closed(result); !closed) return closed.error();
  const auto crossing = crossing_triangles(result);
  if (!crossing) return crossing.error();
  if (!crossing->empty()) {
    const auto &first = result.triangles[crossing->front().first], &second = result.triangles[crossing->front().second];
    const auto middle = [&](const auto& t) {
      return (1.0 / 3) * (result.vertices[t[0]] + result.vertices[t[1]] + result.vertices[t[2]]);
    };
    if (crossing->front().first == crossing->front().second)
      return Error{ErrorCode::geometry, "", "the boundary mesh has a triangle without area at " + place_text(middle(first))};
    return Error{ErrorCode::geometry, "",
                 "the boundary mesh crosses or touches itself: the triangles around " + place_text(middle(first)) + " and " +
                     place_text(middle(second)) + " meet elsewhere than in a common edge or corner"};
  }
  const std::vector<Mesh> shells = shells_of(result);
  result.triangles.clear();
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const Point3 at = shells[s].vertices[shells[s].triangles.front()[0]];
    int depth = 0;
    for (std::size_t other = 0; other < shells.size(); ++other)
      if (other != s && std::abs(winding_number(shells[other], at)) > 0.5) ++depth;
    const bool is_turned = (volume_of(shells[s]) > 0) != (depth % 2 == 0);
    for (auto t : shells[s].triangles) {
      if (is_turned) std::swap(t[1], t[2]);
      result.triangles.push_back(t);
    }
  }
  std::sort(result.triangles.begin(), result.triangles.end());
  return result;
}

}  // namespace bl::geometry
