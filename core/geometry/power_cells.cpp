// The cells of a power diagram: neighbours, clipping, measures, meshes, and a record for every site.
#include "core/geometry/power_cells.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <string>

#include "core/base/text.h"
#include "core/geometry/clipper.h"
#include "core/geometry/coincidence.h"
#include "core/geometry/power_neighbours.h"
#include "core/geometry/shape_measure.h"
#include "core/geometry/tessellate.h"

namespace bl {

namespace {

constexpr std::uint32_t kNone = PowerNeighbours::kNone;
// Facets below this share of the cell's squared reach are slivers of rounding: they carry no name.
constexpr double kSliverShare = 1e-14;
// A site this share of its radius inside its own cell is the centre of the shrink-wrap, as in 2007.
constexpr double kInsideShare = 1e-6;
constexpr std::size_t kChunk = 8;

// What one thread needs to make one cell after the other.
struct Bench {
  struct Cut {
    double offset;
    std::uint32_t index;
    Vector3 normal;
  };
  Clipper cell;
  ShapeMeasure shape;
  std::vector<Cut> cuts;
  std::vector<FaceLoop> loops;
};

Result<void> check_input(std::span<const PowerSite> sites, const ConvexDomain& domain, const CellOptions& options) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const PowerSite& site = sites[i];
    if (!is_finite(site.position) || !std::isfinite(site.weight)) {
      return Error{ErrorCode::not_finite, "", "site " + std::to_string(i) + " has a position or weight that is not a number"};
    }
    const Point3& p = site.position;
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > kLargestCoordinate) {
      return Error{ErrorCode::out_of_range, "", "site " + std::to_string(i) + " lies more than 1e8 m from the origin"};
    }
    if (std::abs(site.weight) > kLargestWeight) {
      return Error{ErrorCode::out_of_range, "", "the weight of site " + std::to_string(i) + " exceeds 1e18 m²"};
    }
  }
  if (options.tessellation_depth > kDeepestTessellation) {
    return Error{ErrorCode::out_of_range, "", "the tessellation depth is at most " + std::to_string(kDeepestTessellation)};
  }
  if (!options.storey_heights.empty() && options.storey_heights.size() != sites.size()) {
    return Error{ErrorCode::out_of_range, "", "there has to be one storey height for each site"};
  }
  if (!options.with_shape) return {};
  const auto is_fit = [&](double storey) {
    return storey > 0 && std::isfinite(storey) && (domain.maximum.z - domain.minimum.z) / storey <= kMostStoreys;
  };
  const bool all_fit = options.storey_heights.empty()
                           ? is_fit(options.storey_height)
                           : std::all_of(options.storey_heights.begin(), options.storey_heights.end(), is_fit);
  if (!all_fit) {
    return Error{ErrorCode::out_of_range, "",
                 "a storey height has to be positive, and the boundary no higher than 10000 storeys"};
  }
  return {};
}

// Cuts the domain by the bisectors with the neighbours, in coordinates relative to the site, nearest plane first.
void clip_cell(const ConvexDomain& domain, std::span<const PowerSite> sites, std::span<const std::uint32_t> neighbours,
               std::uint32_t site, Bench& bench) {
  bench.cell.start(domain, sites[site].position);
  bench.cuts.clear();
  for (const std::uint32_t j : neighbours) {
    const Vector3 to = sites[j].position - sites[site].position;
    const double squared = squared_norm(to), d = std::sqrt(squared);
    bench.cuts.push_back({0.5 * (d + (sites[site].weight - sites[j].weight) / d), j, to / d});
  }
  std::sort(bench.cuts.begin(), bench.cuts.end(), [](const Bench::Cut& a, const Bench::Cut& b) {
    return a.offset != b.offset ? a.offset < b.offset : a.index < b.index;
  });
  for (const Bench::Cut& cut : bench.cuts) {
    if (!bench.cell.cut(cut.normal, cut.offset, FacetArea::Kind::site, cut.index)) return;
  }
}

void gather_facets(const Bench& bench, std::span<const PowerSite> sites, std::uint32_t site, CellMeasure& out) {
  const double sliver = kSliverShare * bench.cell.reach_squared();
  for (std::size_t k = 0; k < bench.cell.faces.size(); ++k) {
    const ClippedFace& face = bench.cell.faces[k];
    if (bench.shape.areas[k] > 0) out.facets.push_back({face.kind, face.index, bench.shape.areas[k]});
  }
  std::sort(out.facets.begin(), out.facets.end(), [](const FacetArea& a, const FacetArea& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.index != b.index ? a.index < b.index : a.area < b.area;
  });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < out.facets.size();) {
    FacetArea facet = out.facets[k++];
    while (k < out.facets.size() && out.facets[k].kind == facet.kind && out.facets[k].index == facet.index) {
      facet.area += out.facets[k++].area;
    }
    if (facet.area > sliver) out.facets[kept++] = facet;
  }
  out.facets.resize(kept);
  out.surface_area = out.spherical_area;
  out.volume_by_own_weight = out.spherical_area > 0 ? out.spherical_area / (2 * std::sqrt(sites[site].weight)) : 0;
  for (const FacetArea& facet : out.facets) {
    out.surface_area += facet.area;
    if (facet.kind != FacetArea::Kind::site) continue;
    out.volume_by_own_weight += facet.area / (2 * distance(sites[site].position, sites[facet.index].position));
  }
}

bool holds(const Bench& bench, double squared_radius, const Point3& point, double margin) {
  for (const ClippedFace& face : bench.cell.faces) {
    if (!(dot(face.normal, point) <= face.offset - margin)) return false;
  }
  return squared_norm(point) <= squared_radius;
}

// The point towards which the mesh is wrapped: the site, or where it is not inside its own cell, the shape's centroid.
Point3 wrap_centre(const Bench& bench, double squared_radius) {
  if (holds(bench, squared_radius, {}, kInsideShare * std::sqrt(squared_radius))) return {};
  return bench.shape.centroid;
}

MeshPointer make_mesh(Bench& bench, const PowerSite& site, int depth) {
  bench.loops.clear();
  for (const ClippedFace& face : bench.cell.faces)
    bench.loops.push_back(std::span(bench.cell.loops).subspan(face.first, face.count));
  return std::make_shared<const Mesh>(tessellate(bench.cell.vertices, bench.loops, depth, {}, std::sqrt(site.weight),
                                                 wrap_centre(bench, site.weight), site.position));
}

void measure_cell(std::span<const PowerSite> sites, std::uint32_t index, const CellOptions& options, Bench& bench,
                  CellMeasure& out) {
  const PowerSite& site = sites[index];
  Point3 cell_centroid;
  out.cell_volume = bench.cell.volume_and_centroid(cell_centroid);
  if (!(site.weight > 0) || bench.cell.is_empty()) return;
  measure_shape(bench.cell, site.weight, out.cell_volume, cell_centroid, bench.shape);
  if (bench.shape.is_empty || !(bench.shape.volume > 0)) return;
  // A sliver seen from a far-away site may have a centroid of pure rounding; a point of its facets is then the better answer.
  if (!holds(bench, site.weight, bench.shape.centroid, 0)) bench.shape.centroid = bench.shape.point_inside;
  out.volume = bench.shape.volume;
  out.spherical_area = bench.shape.spherical_area;
  out.centroid = site.position + bench.shape.centroid;
  gather_facets(bench, sites, index, out);
  if (options.with_shape) {
    measure_extent(bench.cell, site.weight, bench.shape);
    out.height = bench.shape.highest - bench.shape.lowest;
    out.bottom = site.position.z + bench.shape.lowest;
    const double storey = options.storey_heights.empty() ? options.storey_height : options.storey_heights[index];
    out.floor_area = floor_area(bench.cell, site.weight, bench.shape, storey);
    out.footprint = footprint_area(bench.cell, site.weight, bench.shape);
  }
  if (options.tessellation_depth >= 0) out.mesh = make_mesh(bench, site, options.tessellation_depth);
}

std::string number(std::uint32_t site) { return "site " + std::to_string(site); }

void judge(const ConvexDomain& domain, const PowerSite& site, std::uint32_t twin, bool has_cell, std::uint32_t swallower,
           CellMeasure& out) {
  const std::string emptiness = !has_cell                ? "swallowed: " + number(swallower) + " outweighs it at its position"
                                : !(out.cell_volume > 0) ? std::string("its power cell lies outside the domain")
                                : !(site.weight > 0)     ? std::string("its weight is not positive, so it has no ball")
                                : !(out.volume > 0)
                                    ? std::string("its ball does not reach its own power cell: neighbours are heavier")
                                    : std::string();
  if (twin != kNone) {
    out.state = SiteState::coincident;
    out.reason = "lies at the position of " + number(twin) + ", which is heavier or comes first";
  } else if (!domain.contains(site.position, 1e-12 * domain.size())) {
    out.state = SiteState::outside;
    out.reason = "lies outside the domain" + (emptiness.empty() ? std::string("; its cell reaches in") : "; " + emptiness);
  } else if (!emptiness.empty()) {
    out.state = out.cell_volume > 0 ? SiteState::starved : SiteState::hidden;
    out.reason = emptiness;
  }
}

}  // namespace

struct PowerDiagram::Workshop {
  ConvexDomain domain;
  std::vector<CellMeasure> cells, next;
  PowerNeighbours neighbours;
  std::vector<std::uint32_t> twin, participants;
  std::vector<std::unique_ptr<Bench>> benches;
  std::mutex mutex;

  std::unique_ptr<Bench> take_bench() {
    const std::lock_guard lock(mutex);
    if (benches.empty()) return std::make_unique<Bench>();
    auto bench = std::move(benches.back());
    benches.pop_back();
    return bench;
  }
  void give_back(std::unique_ptr<Bench> bench) {
    const std::lock_guard lock(mutex);
    benches.push_back(std::move(bench));
  }

  void make_cells(std::span<const PowerSite> sites, const CellOptions& options, std::size_t begin, std::size_t end) {
    auto bench = take_bench();
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t index = static_cast<std::uint32_t>(i);
      CellMeasure& out = next[i];
      out.centroid = sites[i].position;
      out.bottom = sites[i].position.z;
      const bool has_cell = neighbours.has_cell[i] != 0;
      if (has_cell) {
        clip_cell(domain, sites, neighbours.of(i), index, *bench);
        measure_cell(sites, index, options, *bench, out);
      }
      judge(domain, sites[i], twin[i], has_cell, neighbours.swallower[i], out);
    }
    give_back(std::move(bench));
  }

  Result<void> update(std::span<const PowerSite> sites, const CellOptions& options) {
    if (domain.vertices.empty()) return Error{ErrorCode::missing, "", "the power diagram has no domain yet"};
    if (auto checked = check_input(sites, domain, options); !checked) return checked.error();
    find_coincident(sites, kCoincidenceShare * domain.size(), twin);
    participants.clear();
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      if (twin[i] == kNone) participants.push_back(i);
    }
    if (auto found = find_power_neighbours(sites, participants, neighbours); !found) return found.error();
    next.assign(sites.size(), CellMeasure{});
    const auto body = [&](std::size_t begin, std::size_t end) { make_cells(sites, options, begin, end); };
    if (options.pool != nullptr) {
      options.pool->for_each_chunk(sites.size(), kChunk, body);
    } else {
      body(0, sites.size());
    }
    cells.swap(next);
    return {};
  }
};

PowerDiagram::PowerDiagram() : workshop_(std::make_unique<Workshop>()) {}
PowerDiagram::~PowerDiagram() = default;
PowerDiagram::PowerDiagram(PowerDiagram&&) noexcept = default;
PowerDiagram& PowerDiagram::operator=(PowerDiagram&&) noexcept = default;

Result<void> PowerDiagram::set_domain(const ConvexDomain& domain) {
  if (domain.vertices.empty() || domain.faces.size() != domain.planes.size()) {
    return Error{ErrorCode::geometry, "", "the domain is empty: make it with convex_hull, from_planes, extrude or from_mesh"};
  }
  workshop_->domain = domain;
  workshop_->cells.clear();
  return {};
}

const ConvexDomain& PowerDiagram::domain() const { return workshop_->domain; }
std::span<const CellMeasure> PowerDiagram::cells() const { return workshop_->cells; }

Result<std::span<const CellMeasure>> PowerDiagram::update(std::span<const PowerSite> sites, const CellOptions& options) try {
  if (auto done = workshop_->update(sites, options); !done) return done.error();
  return std::span<const CellMeasure>(workshop_->cells);
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the power cells failed: ") + problem.what()};
}

Result<std::vector<CellMeasure>> power_cells(const ConvexDomain& domain, std::span<const PowerSite> sites,
                                             const CellOptions& options) {
  PowerDiagram diagram;
  if (auto set = diagram.set_domain(domain); !set) return set.error();
  const auto cells = diagram.update(sites, options);
  if (!cells) return cells.error();
  return std::vector<CellMeasure>(cells->begin(), cells->end());
}

std::string_view name_of(SiteState state) {
  switch (state) {
    case SiteState::alive: return "alive";
    case SiteState::hidden: return "hidden";
    case SiteState::outside: return "outside";
    case SiteState::coincident: return "coincident";
    case SiteState::starved: return "starved";
  }
  return "unknown";
}

CellTotals totals_of(std::span<const CellMeasure> cells) {
  CellTotals totals;
  for (const CellMeasure& cell : cells) {
    totals.alive += cell.state == SiteState::alive;
    totals.hidden += cell.state == SiteState::hidden;
    totals.outside += cell.state == SiteState::outside;
    totals.coincident += cell.state == SiteState::coincident;
    totals.starved += cell.state == SiteState::starved;
    totals.volume += cell.volume;
    totals.cell_volume += cell.cell_volume;
    totals.floor_area += cell.floor_area;
  }
  return totals;
}

}  // namespace bl
