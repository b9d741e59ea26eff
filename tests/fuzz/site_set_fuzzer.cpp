// Feeds the power diagram with nasty site sets: lattices, equal positions, planes, huge, zero and negative weights.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "core/geometry/demand_fit.h"
#include "core/geometry/power_cells.h"

namespace {

using bl::CellMeasure;
using bl::ConvexDomain;
using bl::Mesh;
using bl::Point3;
using bl::PowerSite;

// Bytes one after the other; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
  bool is_used_up() const { return at_ >= size_; }
  double share() { return (next() + 256.0 * next()) / 65535.0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken law: %s\n", what);
  std::abort();
}

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

ConvexDomain make_domain(Bytes& bytes) {
  const unsigned kind = bytes.next() % 4u;
  const double shift = kind == 1 ? 10000 : 0;
  const std::vector<Point3> square{{shift, 0, 0}, {shift + 10, 0, 0}, {shift + 10, 10, 0}, {shift, 10, 0}};
  if (kind < 2) return bl::extrude(square, 0, 10).value();
  if (kind == 2) return bl::extrude(square, 0, 0.1).value();
  std::vector<Point3> points;
  for (int i = 0; i < 9; ++i) {
    const double x = 10 * bytes.share(), y = 10 * bytes.share();
    points.push_back({x, y, 10 * bytes.share()});
  }
  const auto hull = bl::convex_hull(points);
  return hull ? *hull : bl::extrude(square, 0, 10).value();
}

double make_weight(Bytes& bytes) {
  static constexpr double kSpecial[] = {0, 1, 0.25, 3, -1, 1e-12, 1e12, 1e18, -1e18, 1e-300, 100, 25, 0.75, 2, 4, 1e4};
  const std::uint8_t choice = bytes.next();
  if (choice < 64) return kSpecial[choice % 16];
  return choice < 224 ? 9 * bytes.share() : 1e3 * bytes.share() - 100;
}

std::vector<PowerSite> make_sites(Bytes& bytes, const ConvexDomain& domain) {
  std::vector<PowerSite> sites;
  while (!bytes.is_used_up() && sites.size() < 200) {
    const std::uint8_t how = bytes.next();
    Point3 p{bytes.share() * 14 - 2, bytes.share() * 14 - 2, bytes.share() * 14 - 2};
    if (how & 1u) p = {std::round(p.x), std::round(p.y), std::round(p.z)};
    if (how & 2u) p.z = 5;
    if ((how & 12u) == 12u) p.y = p.x;
    p.x += domain.minimum.x;
    if ((how & 48u) == 48u && !sites.empty()) {
      p = sites[bytes.next() % sites.size()].position;
      if (how & 64u) p.x += 1e-4 * bytes.share();
      if (how & 128u) p.z += 1e-5 * bytes.share();
    }
    sites.push_back({p, (how & 192u) == 64u && !sites.empty() ? sites.back().weight : make_weight(bytes)});
  }
  return sites;
}

void check_cell(const CellMeasure& cell, const ConvexDomain& domain) {
  for (const double number :
       {cell.volume, cell.cell_volume, cell.surface_area, cell.spherical_area, cell.floor_area, cell.footprint, cell.height,
        cell.bottom, cell.volume_by_own_weight, cell.centroid.x, cell.centroid.y, cell.centroid.z}) {
    demand(std::isfinite(number), "every number is finite");
  }
  demand(cell.volume >= 0 && cell.volume <= cell.cell_volume, "the shape is part of the cell");
  demand(cell.height >= 0 && cell.height <= (domain.maximum.z - domain.minimum.z) * (1 + 1e-6),
         "the shape is no higher than the domain");
  demand(cell.footprint <= 1e-6 + 1.000001 * (domain.maximum.x - domain.minimum.x) * (domain.maximum.y - domain.minimum.y),
         "footprint");
  demand(cell.reason.empty() == (cell.state == bl::SiteState::alive), "whoever does not live has a reason");
  demand((cell.mesh != nullptr) == (cell.volume > 0), "each volume has a mesh");
  if (!cell.mesh) return;
  demand(is_closed(*cell.mesh), "meshes are closed");
  const double volume = bl::enclosed_volume(*cell.mesh);
  demand(std::isfinite(volume), "mesh vertices are finite");
  demand(volume >= -1e-9 * domain.volume && volume <= cell.volume + 1e-6 * domain.volume, "the mesh lies in the shape");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const ConvexDomain domain = make_domain(bytes);
  const std::uint8_t mode = bytes.next();
  const std::vector<PowerSite> sites = make_sites(bytes, domain);
  bl::CellOptions options;
  options.tessellation_depth = mode % 3;
  options.storey_height = 0.7;
  const auto cells = bl::power_cells(domain, sites, options);
  demand(cells.ok() && cells->size() == sites.size(), "every site gets a record");
  for (const CellMeasure& cell : *cells) check_cell(cell, domain);
  const bl::CellTotals totals = bl::totals_of(*cells);
  demand(totals.alive + totals.hidden + totals.outside + totals.coincident + totals.starved == sites.size(), "states add up");
  demand(sites.empty() || std::abs(totals.cell_volume - domain.volume) <= 1e-6 * domain.volume, "cells tile the domain");
  if ((mode & 128u) != 0 && sites.size() <= 40) {
    const std::vector<double> demands(sites.size(), 0.5 * domain.volume / static_cast<double>(sites.size() + 1));
    bl::FitOptions fit;
    fit.steps = 6;
    fit.method = (mode & 64u) != 0 ? bl::FitMethod::newton : bl::FitMethod::feedback;
    const auto fitted = bl::adapt_weights(domain, sites, demands, {}, {}, fit);
    demand(fitted.ok() && fitted->weights.size() == sites.size(), "a fit always answers");
    for (const double weight : fitted->weights) demand(std::isfinite(weight), "weights are finite");
  }
  return 0;
}
