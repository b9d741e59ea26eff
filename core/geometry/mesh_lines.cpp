// Chaining of edges by their end points, and sections that never meet a vertex exactly.
#include "core/geometry/mesh_lines.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace bl::geometry {

namespace {

using Edges = std::span<const std::pair<std::uint64_t, std::uint64_t>>;

// Walks from `start` over edges that nobody has taken yet.
class Walker {
 public:
  explicit Walker(Edges edges) : edges_(edges), taken_(edges.size(), false) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      around_[edges[e].first].push_back(e);
      around_[edges[e].second].push_back(e);
    }
  }

  Chain walk(std::uint64_t start) {
    Chain chain;
    chain.points.push_back(start);
    std::uint64_t at = start;
    while (const std::size_t* edge = next_edge(at)) {
      taken_[*edge] = true;
      at = edges_[*edge].first == at ? edges_[*edge].second : edges_[*edge].first;
      if (at == start) {
        chain.is_closed = true;
        break;
      }
      chain.points.push_back(at);
    }
    return chain;
  }

  std::vector<Chain> all() {
    std::vector<Chain> chains;
    // Open lines first, from their ends; what remains are loops.
    for (const bool only_ends : {true, false})
      for (const auto& [point, edges] : around_)
        while ((!only_ends || edges.size() % 2 == 1) && next_edge(point) != nullptr) chains.push_back(walk(point));
    return chains;
  }

 private:
  const std::size_t* next_edge(std::uint64_t at) const {
    for (const std::size_t& edge : around_.at(at))
      if (!taken_[edge]) return &edge;
    return nullptr;
  }

  Edges edges_;
  std::vector<bool> taken_;
  std::map<std::uint64_t, std::vector<std::size_t>> around_;
};

std::uint64_t key_of(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

// An edge of one body may end in the middle of one of its neighbour's: cut at all vertices on the way, both are made of equal
// parts. Only what is there an odd number of times is a border.
std::vector<std::pair<std::uint64_t, std::uint64_t>> without_seams(
    const Mesh& mesh, const std::vector<std::pair<std::uint64_t, std::uint64_t>>& border) {
  std::vector<std::uint64_t> ends;
  for (const auto& [a, b] : border) ends.insert(ends.end(), {a, b});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<std::pair<std::uint64_t, std::uint64_t>> parts;
  std::vector<std::pair<double, std::uint64_t>> stops;
  for (const auto& [a, b] : border) {
    const Point3 from = mesh.vertices[a];
    const Vector3 way = mesh.vertices[b] - from;
    const double squared = squared_norm(way);
    stops.assign({{0, a}, {1, b}});
    for (const std::uint64_t v : ends) {
      const double share = dot(mesh.vertices[v] - from, way) / std::max(1e-300, squared);
      if (v == a || v == b || !(share > 0 && share < 1)) continue;
      if (squared_norm(mesh.vertices[v] - from - share * way) <= 1e-14 * squared) stops.emplace_back(share, v);
    }
    std::sort(stops.begin(), stops.end());
    for (std::size_t i = 1; i < stops.size(); ++i) parts.push_back(std::minmax(stops[i - 1].second, stops[i].second));
  }
  std::sort(parts.begin(), parts.end());
  std::vector<std::pair<std::uint64_t, std::uint64_t>> kept;
  for (std::size_t i = 0; i < parts.size();) {
    std::size_t end = i;
    while (end < parts.size() && parts[end] == parts[i]) ++end;
    if ((end - i) % 2 == 1) kept.push_back(parts[i]);
    i = end;
  }
  return kept;
}

}  // namespace

Mesh joined(const Mesh& mesh) {
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::vector<std::uint32_t> place_of;
  Mesh result;
  for (const Point3& v : mesh.vertices) {
    const auto [found, is_new] = places.emplace(std::tuple(v.x, v.y, v.z), static_cast<std::uint32_t>(result.vertices.size()));
    if (is_new) result.vertices.push_back(v);
    place_of.push_back(found->second);
  }
  for (const auto& [a, b, c] : mesh.triangles) result.triangles.push_back({place_of[a], place_of[b], place_of[c]});
  return result;
}

std::vector<Mesh> bodies_of(const Mesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto root_of = [&](std::uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t least = std::min({root_of(a), root_of(b), root_of(c)});
    for (const std::uint32_t v : {a, b, c}) parent[root_of(v)] = least;
  }
  std::map<std::uint32_t, Mesh> bodies;
  std::vector<std::uint32_t> place_of(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    std::vector<Point3>& vertices = bodies[root_of(v)].vertices;
    place_of[v] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(mesh.vertices[v]);
  }
  for (const auto& [a, b, c] : mesh.triangles) bodies[root_of(a)].triangles.push_back({place_of[a], place_of[b], place_of[c]});
  std::vector<Mesh> result;
  for (auto& [root, body] : bodies)
    if (!body.triangles.empty()) result.push_back(std::move(body));
  return result;
}

std::vector<Chain> chain_edges(Edges edges) { return Walker(edges).all(); }

std::vector<Vector3> unit_normals(const Mesh& mesh) {
  std::vector<Vector3> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3 normal = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
    const double length = norm(normal);
    normals.push_back(length > 0 ? normal / length : Vector3{});
  }
  return normals;
}

std::vector<MeshEdge> mesh_edges(const Mesh& mesh) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sides;
  sides.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) sides.emplace_back(key_of(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]), t);
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool has_second = i + 1 < sides.size() && sides[i + 1].first == sides[i].first;
    const auto [key, triangle] = sides[i];
    edges.push_back({static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key), triangle,
                     has_second ? sides[i + 1].second : triangle});
    if (has_second) ++i;
  }
  return edges;
}

std::vector<Polyline> section(const Mesh& mesh, double z, const TriangleFilter& counts) {
  // A vertex at z counts as above, so that every triangle is crossed at two of its edges or not at all.
  const auto is_above = [&](std::uint32_t v) { return mesh.vertices[v].z >= z; };
  std::vector<std::pair<std::uint64_t, std::uint64_t>> segments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!counts(t)) continue;
    std::vector<std::uint64_t> crossed;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      if (is_above(a) != is_above(b)) crossed.push_back(key_of(a, b));
    }
    if (crossed.size() == 2) segments.emplace_back(crossed[0], crossed[1]);
  }
  std::vector<Polyline> lines;
  for (const Chain& chain : chain_edges(segments)) {
    Polyline line{{}, chain.is_closed};
    for (const std::uint64_t key : chain.points) {
      const Point3& a = mesh.vertices[key >> 32];
      const Point3& b = mesh.vertices[key & 0xffffffffu];
      line.points.push_back(a + (b - a) * ((z - a.z) / (b.z - a.z)));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<Polyline> outline(const Mesh& mesh, const TriangleFilter& counts) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> border;
  for (const MeshEdge& edge : mesh_edges(mesh))
    if (counts(edge.first) != counts(edge.second) || (edge.first == edge.second && counts(edge.first)))
      border.emplace_back(edge.a, edge.b);
  std::vector<Polyline> lines;
  for (const Chain& chain : chain_edges(without_seams(mesh, border))) {
    Polyline line{{}, chain.is_closed};
    for (const std::uint64_t vertex : chain.points) line.points.push_back(mesh.vertices[vertex]);
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<Polyline> seen_from_above(const Mesh& mesh) {
  const Mesh whole = joined(mesh);
  const std::vector<Vector3> normals = unit_normals(whole);
  // Walls are upright but for rounding.
  return outline(whole, [&](std::size_t t) { return normals[t].z > 1e-6; });
}

}  // namespace bl::geometry
