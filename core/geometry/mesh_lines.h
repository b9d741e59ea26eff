// Lines of a triangle mesh for drawings: outlines, creases, sections.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/mesh.h"

namespace bl::geometry {

/// Points joined by lines.
struct Polyline {
  std::vector<Point3> points;
  bool is_closed = false;
};

/// Edges between named points, joined end to end into as few chains as their order gives; every edge is used once.
struct Chain {
  std::vector<std::uint64_t> points;
  bool is_closed = false;
};
std::vector<Chain> chain_edges(std::span<const std::pair<std::uint64_t, std::uint64_t>> edges);

/// Unit normals of the triangles; zero where a triangle has no area.
std::vector<Vector3> unit_normals(const Mesh& mesh);

/// An edge and the triangles beside it; `second` equals `first` where there is only one.
struct MeshEdge {
  std::uint32_t a = 0, b = 0;
  std::uint32_t first = 0, second = 0;
};
/// Ascending (a, b) with a < b.
std::vector<MeshEdge> mesh_edges(const Mesh& mesh);

/// The same with one vertex for each place, so that adjacent bodies are connected.
Mesh joined(const Mesh& mesh);
/// The separate bodies of a mesh, each with its own vertices.
std::vector<Mesh> bodies_of(const Mesh& mesh);

/// Which triangles count.
using TriangleFilter = std::function<bool(std::size_t)>;
/// The lines at height z on the triangles that count; closed where they go all around.
std::vector<Polyline> section(const Mesh& mesh, double z, const TriangleFilter& counts);
/// The outline of the triangles that count: edges between them and the others, closed loops in a closed mesh. Where bodies have
/// been put side by side, edges that lie on one another in opposite directions are none.
std::vector<Polyline> outline(const Mesh& mesh, const TriangleFilter& counts);
/// The outline of all that faces upward: of a closed body that nowhere overhangs itself, its shadow at noon. Where its parts have
/// been put side by side there is no line between them.
std::vector<Polyline> seen_from_above(const Mesh& mesh);

}  // namespace bl::geometry
