// The bounded power diagram: all cells, or those that a change can have touched.
#include "core/geometry/power_cells.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <numeric>
#include <string>

#include "core/base/differences.h"
#include "core/base/stop_check.h"
#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/tessellate.h"

namespace bl::geometry {

namespace {

// Where more than this share of the sites has changed, all cells are made anew.
constexpr double kManyChanges = 0.2;

Result<void> check_options(std::span<const PowerSite> sites, const Domain& domain, const CellOptions& options) {
  if (options.tessellation_depth > kDeepestTessellation) {
    return Error{ErrorCode::out_of_range, "", "the tessellation depth is at most " + std::to_string(kDeepestTessellation)};
  }
  if (!options.storey_heights.empty() && options.storey_heights.size() != sites.size()) {
    return Error{ErrorCode::out_of_range, "", "there has to be one storey height for each site"};
  }
  if (!options.with_shape || !options.with_storeys) return {};
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

Error no_domain() {
  return {ErrorCode::geometry, "", "the domain is empty: make it with convex_hull, from_planes, extrude or from_mesh"};
}
Error failure(const std::exception& problem) {
  return {ErrorCode::internal, "", std::string("the power cells failed: ") + problem.what()};
}

}  // namespace

struct PowerDiagram::Workshop {
  CellWorkshop workshop;
  std::vector<CellMeasure> cells;
  std::vector<double> volumes;  // the same as in the cells, side by side
  std::vector<std::vector<std::uint32_t>> borders, faces;
  std::vector<std::vector<std::uint32_t>> faces_before;  // room for the faces of cells that are being made anew
  std::vector<std::vector<ShapeMeasure>> shapes;         // of cells that are to be completed
  std::vector<std::uint32_t> changed, made, completed, empty, unlimited;
  std::vector<std::uint8_t> is_marked;
  std::vector<double> limits;  // how far from its site each cell is made [m]
  double largest_limit = 0;    // of those that end
  std::vector<double> storey_heights;
  CellOptions last;
  bool is_whole = false;  // do `cells` belong to the sites and options of the last call?
  // Of the last complete(): what it asked for, and which cells have not been made anew since.
  CellOptions completed_with;
  std::vector<double> completed_heights;
  std::vector<std::uint8_t> is_complete;

  static bool asks_the_same(const CellOptions& a, const CellOptions& b) {
    return a.storey_height == b.storey_height && a.with_shape == b.with_shape && a.with_storeys == b.with_storeys &&
           a.with_centroid == b.with_centroid && a.with_outlines == b.with_outlines && a.with_coarse_mesh == b.with_coarse_mesh &&
           a.tessellation_depth == b.tessellation_depth;
  }

  CellLists lists() { return {borders.data(), faces.data(), shapes.empty() ? nullptr : shapes.data()}; }

  void mark(std::uint32_t site) {
    if (is_marked[site]) return;
    is_marked[site] = 1;
    made.push_back(site);
  }

  // A cell that ends at its ball is cut by every bisector that comes into the ball, also where no facet is left of it. A whole
  // cell among cells that end at their balls may have borders that those do not know of.
  void mark_reached(const PowerSite& by, const CellOptions& options) {
    if (std::isfinite(workshop.limit_of(by.weight, options))) {
      for (const std::uint32_t site : unlimited) mark(site);
    }
    const double radius = std::sqrt(std::max(0.0, by.weight)) * (1 + 1e-9);
    if (radius == 0 || largest_limit == 0) return;
    workshop.visit_near(by.position, radius + largest_limit, [&](const SiteGrid::Entry& entry) {
      const double limit = limits[entry.site];
      if (limit > 0 && std::isfinite(limit) && std::abs(distance(entry.position, by.position) - limit) < radius) mark(entry.site);
    });
  }

  // Whole cells have none.
  void find_limits(std::span<const PowerSite> sites, const CellOptions& options) {
    unlimited.clear();
    largest_limit = 0;
    if (options.with_shape) return;
    limits.resize(sites.size());
    for (std::uint32_t i = 0; i < sites.size(); ++i) {
      limits[i] = workshop.limit_of(sites[i].weight, options);
      if (!std::isfinite(limits[i])) {
        unlimited.push_back(i);
      } else {
        largest_limit = std::max(largest_limit, limits[i]);
      }
    }
  }

  // Makes the cells from a place of the list on, and then those that these no longer border: something has come between, and may
  // have swallowed them together with all that it touches.
  void make_and_follow(std::size_t from, const CellOptions& options) {
    while (from < made.size()) {
      const std::size_t end = made.size();
      std::sort(made.begin() + static_cast<std::ptrdiff_t>(from), made.end());
      if (faces_before.size() < end - from) faces_before.resize(end - from);
      for (std::size_t k = from; k < end; ++k) faces_before[k - from] = faces[made[k]];
      workshop.make(std::span(made).subspan(from), options, cells, lists());
      for (std::size_t k = from; k < end; ++k) {
        const auto& now = faces[made[k]];
        for (const std::uint32_t j : faces_before[k - from]) {
          if (!std::binary_search(now.begin(), now.end(), j)) mark(j);
        }
      }
      from = end;
    }
  }

  // Only what the changed sites can have touched: themselves, what they reach, their neighbours before and after with all that
  // these have lost sight of, and cells that have been empty.
  bool update_locally(std::span<const PowerSite> sites, const CellOptions& options) {
    if (changed.empty()) return made.clear(), true;
    std::vector<PowerSite> before;
    for (const std::uint32_t site : changed) {
      before.push_back(workshop.sites()[site]);
      if (!workshop.change(site, sites[site])) return false;
    }
    is_marked.assign(sites.size(), 0);
    made.clear();
    for (const std::uint32_t site : changed) mark(site);
    const std::size_t done = changed.size();
    for (const std::uint32_t site : changed) {
      for (const std::uint32_t j : borders[site]) mark(j);
    }
    workshop.make(changed, options, cells, lists());
    for (const std::uint32_t site : changed) {
      for (const std::uint32_t j : borders[site]) mark(j);
    }
    // Nothing else borders them: whole cells that have appeared out of nothing may have swallowed everything.
    find_limits(sites, options);
    if (made.size() == done && (options.with_shape || !unlimited.empty()) && done < sites.size()) return false;
    for (const std::uint32_t site : empty) mark(site);
    for (std::size_t k = 0; k < done && !options.with_shape; ++k) {
      mark_reached(before[k], options);
      mark_reached(sites[changed[k]], options);
    }
    make_and_follow(done, options);
    return true;
  }

  Result<void> update_all(std::span<const PowerSite> sites, const CellOptions& options, bool same_places) {
    if (auto set = same_places ? workshop.set_weights(sites) : workshop.set_sites(sites); !set) return set.error();
    cells.resize(sites.size());
    is_complete.resize(sites.size());
    borders.resize(sites.size());
    faces.resize(sites.size());
    shapes.resize(options.with_outlines ? sites.size() : 0);
    made.resize(sites.size());
    std::iota(made.begin(), made.end(), 0u);
    workshop.make_all(options, cells, lists());
    return {};
  }

  // Cells that were empty are made anew in every update that makes any.
  void note_made() {
    empty.clear();
    volumes.resize(cells.size());
    for (const std::uint32_t i : made) {
      volumes[i] = cells[i].volume;
      is_complete[i] = 0;
      if (!(cells[i].volume > 0)) empty.push_back(i);
    }
  }

  Result<void> update(std::span<const PowerSite> sites, const CellOptions& options) {
    if (workshop.domain().pieces.empty()) return Error{ErrorCode::missing, "", "the power diagram has no domain yet"};
    const bool comparable = is_whole && workshop.sites().size() == sites.size();
    bool same_places = comparable;
    changed.clear();
    if (comparable)
      visit_differences(workshop.sites(), sites, [&](std::uint32_t i) {
        const PowerSite& before = workshop.sites()[i];
        if (sites[i] == before) return;
        changed.push_back(i);
        same_places = same_places && sites[i].position == before.position;
      });
    // The others have been checked before.
    for (const std::uint32_t i : changed)
      if (auto checked = check_site(i, sites[i]); !checked) return checked.error();
    if (auto checked = comparable ? Result<void>{} : check_sites(sites); !checked) return checked.error();
    if (auto checked = check_options(sites, workshop.domain(), options); !checked) return checked.error();
    const bool is_same = asks_the_same(last, options) && std::equal(storey_heights.begin(), storey_heights.end(),
                                                                    options.storey_heights.begin(), options.storey_heights.end());
    const bool is_local =
        comparable && is_same && static_cast<double>(changed.size()) <= kManyChanges * static_cast<double>(sites.size());
    is_whole = false;
    if (!is_local || !update_locally(sites, options)) {
      if (auto done = update_all(sites, options, same_places); !done) return done.error();
    }
    if (!made.empty() || cells.empty()) note_made();
    last = options;
    storey_heights.assign(options.storey_heights.begin(), options.storey_heights.end());
    is_whole = !is_stop_wished();
    return {};
  }

  Result<void> complete(const CellOptions& options) {
    if (!is_whole || !last.with_shape || !last.with_outlines || !last.with_centroid)
      return Error{ErrorCode::missing, "", "only cells that were made with outlines and centroids can be completed"};
    if (auto checked = check_options(workshop.sites(), workshop.domain(), options); !checked) return checked.error();
    const bool is_same = asks_the_same(completed_with, options) && completed_heights.size() == options.storey_heights.size();
    const auto is_due = [&](std::uint32_t i) {
      return !is_same || !is_complete[i] || (!completed_heights.empty() && completed_heights[i] != options.storey_heights[i]);
    };
    completed.clear();
    for (std::uint32_t i = 0; i < cells.size(); ++i)
      if (is_due(i)) completed.push_back(i);
    is_whole = false;
    workshop.complete(completed, options, cells, shapes.data());
    for (const std::uint32_t i : completed) is_complete[i] = 1;
    completed_with = options;
    completed_heights.assign(options.storey_heights.begin(), options.storey_heights.end());
    is_whole = !is_stop_wished();
    return {};
  }
};

PowerDiagram::PowerDiagram() : workshop_(std::make_unique<Workshop>()) {}
PowerDiagram::~PowerDiagram() = default;
PowerDiagram::PowerDiagram(PowerDiagram&&) noexcept = default;
PowerDiagram& PowerDiagram::operator=(PowerDiagram&&) noexcept = default;

Result<void> PowerDiagram::set_domain(const Domain& domain) {
  if (domain.pieces.empty()) return no_domain();
  if (workshop_->is_whole && workshop_->workshop.domain() == domain) return {};
  workshop_->workshop.set_domain(domain);
  workshop_->cells.clear();
  workshop_->volumes.clear();
  workshop_->is_whole = false;
  return {};
}

const Domain& PowerDiagram::domain() const { return workshop_->workshop.domain(); }
std::span<const CellMeasure> PowerDiagram::cells() const { return workshop_->cells; }
std::span<const double> PowerDiagram::volumes() const { return workshop_->volumes; }
bool PowerDiagram::has_coincident() const { return workshop_->workshop.has_twins(); }
std::span<const std::uint32_t> PowerDiagram::made() const { return workshop_->made; }
std::span<const std::uint32_t> PowerDiagram::completed() const { return workshop_->completed; }

Result<std::span<const CellMeasure>> PowerDiagram::update(std::span<const PowerSite> sites, const CellOptions& options) try {
  if (auto done = workshop_->update(sites, options); !done) return done.error();
  return std::span<const CellMeasure>(workshop_->cells);
} catch (const std::exception& problem) { return failure(problem); }

Result<std::span<const CellMeasure>> PowerDiagram::complete(const CellOptions& options) try {
  if (auto done = workshop_->complete(options); !done) return done.error();
  return std::span<const CellMeasure>(workshop_->cells);
} catch (const std::exception& problem) { return failure(problem); }

// Nothing is kept for a next time.
Result<std::vector<CellMeasure>> power_cells(const Domain& domain, std::span<const PowerSite> sites,
                                             const CellOptions& options) try {
  if (domain.pieces.empty()) return no_domain();
  if (auto checked = check_sites(sites); !checked) return checked.error();
  if (auto checked = check_options(sites, domain, options); !checked) return checked.error();
  CellWorkshop workshop;
  workshop.set_domain(domain);
  if (auto set = workshop.set_sites(sites); !set) return set.error();
  std::vector<CellMeasure> cells(sites.size());
  workshop.make_all(options, cells);
  return cells;
} catch (const std::exception& problem) { return failure(problem); }

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

}  // namespace bl::geometry
