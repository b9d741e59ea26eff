// Bodies with flat walls as the renderer takes volumes, with those of their sides that are edges.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/geometry/mesh_lines.h"
#include "ui/desktop/view/cell_marks.h"
#include "ui/desktop/view/scene_facts.h"

namespace bl::desktop {

namespace {

// Faces that meet at a smaller angle than this look like one (cosine).
constexpr double kSharp = 0.97;
// The same of bodies as they are drawn: chords of small arcs bend more.
constexpr double kBend = 0.92;

// Which sides of the triangles of a closed mesh are edges: those where its surface bends.
std::vector<std::array<bool, 3>> edges_of(const Mesh& mesh) {
  struct Side {
    std::uint32_t low, high, triangle, number;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.number) < std::tie(b.low, b.high, b.triangle, b.number);
  });
  const std::vector<Vector3> normals = geometry::unit_normals(mesh);
  std::vector<std::array<bool, 3>> edges(mesh.triangles.size(), {true, true, true});
  for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
    const Side &a = sides[k], &b = sides[k + 1];
    if (a.low != b.low || a.high != b.high || dot(normals[a.triangle], normals[b.triangle]) < kBend) continue;
    edges[a.triangle][a.number] = edges[b.triangle][b.number] = false;
  }
  return edges;
}

// The renderer draws the side opposite to a triangle's first corner. So triangles are turned, or split where they have several
// edges, and first corners of those without one are marked; `marks`: for each vertex.
Mesh with_rims(const Mesh& mesh, std::vector<std::uint32_t>& marks) {
  const std::vector<std::array<bool, 3>> edges = edges_of(mesh);
  Mesh made{mesh.vertices, {}, {}, {}};
  made.triangles.reserve(2 * mesh.triangles.size());
  marks.assign(mesh.vertices.size(), 0);
  const auto add = [&](const Point3& at, std::uint32_t mark) {
    made.vertices.push_back(at);
    marks.push_back(mark);
    return static_cast<std::uint32_t>(made.vertices.size() - 1);
  };
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> quiet(mesh.vertices.size(), kNone);             // marked copies
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;  // of sides
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& corner = mesh.triangles[t];
    const auto& edge = edges[t];
    const int count = int{edge[0]} + int{edge[1]} + int{edge[2]};
    if (count == 0) {
      std::uint32_t& first = quiet[corner[0]];
      if (first == kNone) first = add(mesh.vertices[corner[0]], kNoRim);
      made.triangles.push_back({first, corner[1], corner[2]});
      continue;
    }
    // The side that decides: the only edge, or the only one that is none.
    std::size_t i = 0;
    while (count < 3 && edge[i] != (count == 1)) ++i;
    const std::uint32_t a = corner[i], b = corner[(i + 1) % 3], c = corner[(i + 2) % 3];
    if (count == 1) {
      made.triangles.push_back({c, a, b});
      continue;
    }
    const Point3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    // On the side that is no edge, where the other half of a wall is split too.
    std::uint32_t middle = kNone;
    if (count == 2) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) at->second = add(0.5 * (p + q), 0);
      middle = at->second;
    } else {
      middle = add((p + q + r) / 3, 0);
    }
    made.triangles.push_back({middle, b, c});
    made.triangles.push_back({middle, c, a});
    if (count == 3) made.triangles.push_back({middle, a, b});
  }
  return made;
}

}  // namespace

MeshPointer ball_cell(const Point3& centre, double radius) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    const Vector3 corner{(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0};
    mesh.vertices.push_back(centre + 1.01 * radius * corner);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& face : kFaces) {
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(0.25 *
                            (mesh.vertices[face[0]] + mesh.vertices[face[1]] + mesh.vertices[face[2]] + mesh.vertices[face[3]]));
    for (std::size_t i = 0; i < 4; ++i) mesh.triangles.push_back({middle, face[i], face[(i + 1) % 4]});
  }
  MeshWrap wrap{centre, radius, {{24, centre, {}}}, std::vector<std::uint32_t>(mesh.vertices.size(), 0)};
  mesh.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return std::make_shared<const Mesh>(std::move(mesh));
}

MeshPointer as_cell(const Mesh& mesh) {
  std::vector<std::uint32_t> marks;
  Mesh cell = with_rims(mesh, marks);
  Point3 low = cell.vertices.front(), high = low;
  for (const Point3& v : cell.vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  const Point3 centre = 0.5 * (low + high);
  // Beyond all corners, so that nothing is wrapped.
  MeshWrap wrap{
      centre, 0.6 * distance(low, high) + 1, {{static_cast<std::uint32_t>(cell.triangles.size()), centre, {}}}, std::move(marks)};
  cell.wrap = std::make_shared<const MeshWrap>(std::move(wrap));
  return std::make_shared<const Mesh>(std::move(cell));
}

std::vector<std::pair<Point3, Point3>> sharp_edges(const Mesh& given) {
  const Mesh mesh = geometry::joined(given);
  const std::vector<Vector3> normals = geometry::unit_normals(mesh);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) sides[std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3])].push_back(t);
  std::vector<std::pair<Point3, Point3>> edges;
  for (const auto& [edge, faces] : sides) {
    const bool is_smooth = faces.size() == 2 && dot(normals[faces[0]], normals[faces[1]]) > kSharp;
    if (!is_smooth) edges.emplace_back(mesh.vertices[edge.first], mesh.vertices[edge.second]);
  }
  return edges;
}

}  // namespace bl::desktop
