// Feeds the power diagram with nasty site sets: lattices, equal positions, planes, huge, zero and negative weights.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/geometry/demand_fit.h"
#include "core/geometry/power_cells.h"
#include "tests/fuzz/nasty_sets.h"
#include "tests/fuzz/require.h"

namespace {

using bl::Mesh;
using bl::fuzz::Bytes;
using bl::fuzz::require;
using bl::geometry::CellMeasure;
using bl::geometry::ConvexDomain;
using bl::geometry::PowerSite;

bool is_closed(const Mesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, twins;
  for (const auto& t : mesh.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      edges.emplace_back(t[i], t[(i + 1) % 3]);
      twins.emplace_back(t[(i + 1) % 3], t[i]);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(twins.begin(), twins.end());
  return edges == twins && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

// What rounding may do to a volume [m³]. Within 1e-12 of the size planes may count as touching, whatever the volume: a hull of a
// micrometre's thickness shows it.
double room_of(const bl::geometry::ConvexDomain& domain) {
  const double extent = domain.size();
  return 1e-6 * domain.volume + 1e-12 * extent * extent * extent;
}

void check_cell(const bl::geometry::CellMeasure& cell, const bl::geometry::ConvexDomain& domain) {
  for (const double number :
       {cell.volume, cell.cell_volume, cell.surface_area, cell.spherical_area, cell.floor_area, cell.footprint, cell.height,
        cell.bottom, cell.volume_by_own_weight, cell.centroid.x, cell.centroid.y, cell.centroid.z}) {
    require(std::isfinite(number), "every number is finite");
  }
  require(cell.volume >= 0 && cell.volume <= cell.cell_volume, "the shape is part of the cell");
  require(cell.height >= 0 && cell.height <= (domain.maximum.z - domain.minimum.z) * (1 + 1e-6),
          "the shape is no higher than the domain");
  require(cell.footprint <= 1e-6 + 1.000001 * (domain.maximum.x - domain.minimum.x) * (domain.maximum.y - domain.minimum.y),
          "footprint");
  require(cell.reason.empty() == (cell.state == bl::geometry::SiteState::alive), "whoever does not live has a reason");
  require((cell.mesh != nullptr) == (cell.volume > 0), "each volume has a mesh");
  if (!cell.mesh) return;
  require(is_closed(*cell.mesh), "meshes are closed");
  const double volume = bl::enclosed_volume(*cell.mesh);
  require(std::isfinite(volume), "mesh vertices are finite");
  const double room = room_of(domain);
  require(volume >= -room && volume <= cell.volume + room, "the mesh lies in the shape");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const bl::geometry::ConvexDomain domain = bl::fuzz::make_domain(bytes);
  const std::uint8_t mode = bytes.next();
  const std::vector<bl::geometry::PowerSite> sites = bl::fuzz::make_sites(bytes, domain.minimum, 200);
  bl::geometry::CellOptions options;
  options.tessellation_depth = mode % 3;
  options.storey_height = 0.7;
  const auto cells = bl::geometry::power_cells(domain, sites, options);
  require(cells.ok() && cells->size() == sites.size(), "every site gets a record");
  for (const bl::geometry::CellMeasure& cell : *cells) check_cell(cell, domain);
  const bl::geometry::CellTotals totals = bl::geometry::totals_of(*cells);
  require(totals.alive + totals.hidden + totals.outside + totals.coincident + totals.starved == sites.size(), "states add up");
  require(sites.empty() || std::abs(totals.cell_volume - domain.volume) <= room_of(domain), "cells tile the domain");
  if ((mode & 128u) != 0 && sites.size() <= 40) {
    const std::vector<double> demands(sites.size(), 0.5 * domain.volume / static_cast<double>(sites.size() + 1));
    bl::geometry::FitOptions fit;
    fit.steps = 6;
    fit.method = (mode & 64u) != 0 ? bl::geometry::FitMethod::newton : bl::geometry::FitMethod::feedback;
    const auto fitted = bl::geometry::adapt_weights(domain, sites, demands, {}, {}, fit);
    require(fitted.ok() && fitted->weights.size() == sites.size(), "a fit always answers");
    for (const double weight : fitted->weights) require(std::isfinite(weight), "weights are finite");
  }
  return 0;
}
