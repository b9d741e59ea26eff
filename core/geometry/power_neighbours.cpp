// Neighbours from a regular triangulation with exact predicates.
#include "core/geometry/power_neighbours.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <exception>
#include <string>
#include <utility>

namespace bl::geometry {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PowerVertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<Kernel>;
using Structure = CGAL::Triangulation_data_structure_3<PowerVertexBase, CellBase>;
using PowerTriangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;

// The site of least power at the position of `site`; of equals the lowest index among it and its neighbours.
std::uint32_t find_swallower(const PowerTriangulation& triangulation, std::span<const PowerSite> sites,
                             const PowerNeighbours& neighbours, std::uint32_t site) {
  const Point3 p = sites[site].position;
  const auto vertex = triangulation.nearest_power_vertex({p.x, p.y, p.z});
  const auto power = [&](std::uint32_t j) { return squared_norm(sites[j].position - p) - sites[j].weight; };
  std::uint32_t best = vertex->info();
  const std::uint32_t found = best;
  for (const std::uint32_t j : neighbours.of(found)) {
    const double pj = power(j), pb = power(best);
    if (pj < pb || (pj == pb && j < best)) best = j;
  }
  return best;
}

void fill(std::span<const PowerSite> sites, std::span<const std::uint32_t> participants, PowerNeighbours& out) {
  std::vector<std::pair<Kernel::Weighted_point_3, std::uint32_t>> points;
  points.reserve(participants.size());
  for (const std::uint32_t i : participants) {
    const Point3& p = sites[i].position;
    points.emplace_back(Kernel::Weighted_point_3({p.x, p.y, p.z}, sites[i].weight), i);
  }
  PowerTriangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  for (auto v = triangulation.finite_vertices_begin(); v != triangulation.finite_vertices_end(); ++v) out.has_cell[v->info()] = 1;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  if (triangulation.dimension() >= 1) {
    for (auto e = triangulation.finite_edges_begin(); e != triangulation.finite_edges_end(); ++e) {
      const std::uint32_t a = e->first->vertex(e->second)->info(), b = e->first->vertex(e->third)->info();
      pairs.emplace_back(a, b);
      ++out.first[a + 1];
      ++out.first[b + 1];
    }
  }
  for (std::size_t i = 0; i < sites.size(); ++i) out.first[i + 1] += out.first[i];
  out.list.resize(2 * pairs.size());
  std::vector<std::uint32_t> at(out.first.begin(), out.first.end() - 1);
  for (const auto& [a, b] : pairs) {
    out.list[at[a]++] = b;
    out.list[at[b]++] = a;
  }
  for (std::size_t i = 0; i < sites.size(); ++i) std::sort(out.list.begin() + out.first[i], out.list.begin() + out.first[i + 1]);
  for (const std::uint32_t i : participants) {
    if (!out.has_cell[i]) out.swallower[i] = find_swallower(triangulation, sites, out, i);
  }
}

}  // namespace

Result<void> find_power_neighbours(std::span<const PowerSite> sites, std::span<const std::uint32_t> participants,
                                   PowerNeighbours& out) try {
  out.first.assign(sites.size() + 1, 0);
  out.list.clear();
  out.has_cell.assign(sites.size(), 0);
  out.swallower.assign(sites.size(), PowerNeighbours::kNone);
  if (!participants.empty()) fill(sites, participants, out);
  return {};
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the power diagram failed: ") + problem.what()};
}

}  // namespace bl::geometry
