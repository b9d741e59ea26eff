// The bounded power diagram: all cells, or those that a change can have touched.
#include "core/geometry/power_cells.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <string>

#include "core/geometry/cell_workshop.h"
#include "core/geometry/tessellate.h"

namespace bl {

namespace {

// Where more than this share of the sites has changed, all cells are made anew.
constexpr double kManyChanges = 0.2;
// A bisector this little beyond a ball still counts as near it.
constexpr double kSlack = 1 + 1e-9;

Result<void> check_options(std::span<const PowerSite> sites, const Domain& domain, const CellOptions& options) {
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

}  // namespace

struct PowerDiagram::Workshop {
  CellWorkshop workshop;
  std::vector<CellMeasure> cells;
  std::vector<std::vector<std::uint32_t>> borders;
  std::vector<std::uint32_t> changed, made, empty;
  std::vector<PowerSite> old;  // of the changed sites
  std::vector<std::uint8_t> is_marked;
  std::vector<double> storey_heights;
  CellOptions last;
  bool is_whole = false;  // do `cells` belong to the sites and options of the last call?

  bool asks_the_same(const CellOptions& options) const {
    return last.storey_height == options.storey_height && last.with_shape == options.with_shape &&
           last.with_centroid == options.with_centroid && last.with_outlines == options.with_outlines &&
           last.tessellation_depth == options.tessellation_depth &&
           std::equal(storey_heights.begin(), storey_heights.end(), options.storey_heights.begin(), options.storey_heights.end());
  }

  void mark(std::uint32_t site) {
    if (is_marked[site]) return;
    is_marked[site] = 1;
    made.push_back(site);
  }

  // A cell that a changed site has swallowed whole borders on nothing any more, so nobody's new borders tell of it. Either some
  // neighbour has lost it (mark_lost), or all of the domain went over, its own position with it.
  void mark_swallowed(std::span<const PowerSite> sites) {
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      if (is_marked[i]) continue;
      const PowerSite& own = sites[i];
      const auto outweighs = [&](std::uint32_t j) {
        return squared_norm(own.position - sites[j].position) - sites[j].weight <= -own.weight;
      };
      // The position of a site outside says nothing.
      if (cells[i].state == SiteState::outside || std::any_of(changed.begin(), changed.end(), outweighs)) mark(i);
    }
  }

  // Cells that are cut only as far as their balls reach do not border on each other both ways: who may have been cut, or may
  // be now, is whose ball the bisector comes near.
  void mark_reached(std::span<const PowerSite> sites) {
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      if (is_marked[i]) continue;
      const PowerSite& own = sites[i];
      if (!(own.weight > 0)) continue;
      const auto reaches = [&](const PowerSite& other) {
        const double squared = squared_norm(own.position - other.position), sum = squared + (own.weight - other.weight);
        return sum <= 0 || sum * sum <= 4 * squared * own.weight * kSlack;
      };
      // A ball of half the domain's size is none: its cell is made whole.
      const double size = workshop.domain().size();
      bool is_near = 4 * own.weight * kSlack > size * size;
      for (std::size_t k = 0; k < changed.size() && !is_near; ++k) is_near = reaches(sites[changed[k]]) || reaches(old[k]);
      if (is_near) mark(i);
    }
  }

  // Sites that have bordered on a cell and do so no more.
  void mark_lost(std::span<const std::uint32_t> before, std::span<const FacetArea> facets, std::uint32_t site) {
    for (const std::uint32_t j : before) {
      if (!std::binary_search(borders[site].begin(), borders[site].end(), j)) mark(j);
    }
    // Where the order of the cuts may show, the borders name more sites than have a facet.
    for (const FacetArea& facet : facets) {
      const auto is_same = [&](const FacetArea& now) { return now.kind == facet.kind && now.index == facet.index; };
      if (facet.kind != FaceKind::site || is_marked[facet.index]) continue;
      if (std::none_of(cells[site].facets.begin(), cells[site].facets.end(), is_same)) mark(facet.index);
    }
  }

  // Makes what is marked from place `done` of `made` on, and what is found to be touched thereby.
  void make_marked(std::size_t done, const CellOptions& options) {
    while (done < made.size()) {
      const std::size_t end = made.size();
      std::sort(made.begin() + static_cast<std::ptrdiff_t>(done), made.end());
      std::vector<std::vector<std::uint32_t>> before;
      std::vector<std::vector<FacetArea>> facets;
      for (std::size_t k = done; k < end; ++k) {
        before.push_back(borders[made[k]]);
        facets.push_back(cells[made[k]].facets);
      }
      workshop.make(std::span(made).subspan(done, end - done), options, cells, borders.data());
      for (std::size_t k = done; k < end; ++k) mark_lost(before[k - done], facets[k - done], made[k]);
      done = end;
    }
  }

  // Only what the changed sites can have touched: themselves, their neighbours before and after, cells that have been empty, and
  // cells that are swallowed.
  bool update_locally(std::span<const PowerSite> sites, const CellOptions& options) {
    old.clear();
    for (const std::uint32_t site : changed) old.push_back(workshop.sites()[site]);
    for (const std::uint32_t site : changed) {
      if (!workshop.change(site, sites[site])) return false;
    }
    is_marked.assign(sites.size(), 0);
    made.clear();
    for (const std::uint32_t site : changed) mark(site);
    for (const std::uint32_t site : changed) {
      for (const std::uint32_t j : borders[site]) mark(j);
    }
    for (const std::uint32_t site : empty) mark(site);
    workshop.make(changed, options, cells, borders.data());
    const std::size_t done = changed.size();
    for (std::size_t k = 0; k < done; ++k) {
      for (const std::uint32_t j : borders[changed[k]]) mark(j);
    }
    if (options.with_shape) {
      mark_swallowed(sites);
    } else {
      mark_reached(sites);
    }
    make_marked(done, options);
    return true;
  }

  Result<void> update_all(std::span<const PowerSite> sites, const CellOptions& options, bool same_places) {
    if (auto set = same_places ? workshop.set_weights(sites) : workshop.set_sites(sites); !set) return set.error();
    cells.resize(sites.size());
    borders.resize(sites.size());
    made.resize(sites.size());
    std::iota(made.begin(), made.end(), 0u);
    workshop.make_all(options, cells, borders.data());
    return {};
  }

  Result<void> update(std::span<const PowerSite> sites, const CellOptions& options) {
    if (workshop.domain().pieces.empty()) return Error{ErrorCode::missing, "", "the power diagram has no domain yet"};
    if (auto checked = check_sites(sites); !checked) return checked.error();
    if (auto checked = check_options(sites, workshop.domain(), options); !checked) return checked.error();
    const bool comparable = is_whole && workshop.sites().size() == sites.size();
    bool same_places = comparable;
    changed.clear();
    for (std::uint32_t i = 0; comparable && i < sites.size(); ++i) {
      if (sites[i] == workshop.sites()[i]) continue;
      changed.push_back(i);
      same_places = same_places && sites[i].position == workshop.sites()[i].position;
    }
    const bool is_local = comparable && asks_the_same(options) &&
                          static_cast<double>(changed.size()) <= kManyChanges * static_cast<double>(sites.size());
    is_whole = false;
    if (!is_local || !update_locally(sites, options)) {
      if (auto done = update_all(sites, options, same_places); !done) return done.error();
    }
    empty.clear();
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      if (!(cells[i].volume > 0)) empty.push_back(i);
    }
    last = options;
    storey_heights.assign(options.storey_heights.begin(), options.storey_heights.end());
    is_whole = true;
    return {};
  }
};

PowerDiagram::PowerDiagram() : workshop_(std::make_unique<Workshop>()) {}
PowerDiagram::~PowerDiagram() = default;
PowerDiagram::PowerDiagram(PowerDiagram&&) noexcept = default;
PowerDiagram& PowerDiagram::operator=(PowerDiagram&&) noexcept = default;

Result<void> PowerDiagram::set_domain(const Domain& domain) {
  if (domain.pieces.empty()) {
    return Error{ErrorCode::geometry, "", "the domain is empty: make it with convex_hull, from_planes, extrude or from_mesh"};
  }
  if (workshop_->is_whole && workshop_->workshop.domain() == domain) return {};
  workshop_->workshop.set_domain(domain);
  workshop_->cells.clear();
  workshop_->is_whole = false;
  return {};
}

const Domain& PowerDiagram::domain() const { return workshop_->workshop.domain(); }
std::span<const CellMeasure> PowerDiagram::cells() const { return workshop_->cells; }
std::span<const std::uint32_t> PowerDiagram::made() const { return workshop_->made; }

Result<std::span<const CellMeasure>> PowerDiagram::update(std::span<const PowerSite> sites, const CellOptions& options) try {
  if (auto done = workshop_->update(sites, options); !done) return done.error();
  return std::span<const CellMeasure>(workshop_->cells);
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the power cells failed: ") + problem.what()};
}

Result<std::vector<CellMeasure>> power_cells(const Domain& domain, std::span<const PowerSite> sites, const CellOptions& options) {
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
