// Local change: exact cells around it, the linear response for all others, until every volume is where it should be.
#include "core/geometry/volume_solver.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/local_response.h"

namespace bl::geometry {

namespace {

// Shares of the tolerance: how far the predicted volumes are brought, and what a prediction may be wrong by.
constexpr double kAimedShare = 0.3, kTrustedShare = 0.25;
// In one round no cell is moved by more than this share of itself. Shares smaller than the least lead nowhere.
constexpr double kMostSwept = 0.6, kLeastSolvedShare = 1e-3;
// An emptied cell's site is put back into its own cell by this margin (1 would put it on the bisector).
constexpr double kSolverRepair = 0.8;

CellOptions plain_cells(ThreadPool* pool) {
  CellOptions options;
  options.with_shape = options.with_centroid = false;
  options.pool = pool;
  return options;
}

}  // namespace

struct VolumeSolver::Workspace {
  CellWorkshop workshop;
  std::vector<PowerSite> sites;
  std::vector<double> demand, volume, shift;  // shift: how far the cell's borders may have moved since it was made [m]
  std::vector<std::uint8_t> absent, is_marked;
  std::vector<CellMeasure> cells;
  std::vector<std::vector<std::uint32_t>> borders;
  LocalResponse response;
  std::vector<std::uint32_t> changed, made;
  std::vector<std::uint32_t> lost;  // sites that a cell made anew no longer borders
  bool is_fresh = true;             // everything has to be fitted anew

  std::size_t size() const { return sites.size(); }
  bool counts(std::uint32_t i) const { return !absent[i] && demand[i] > 0; }

  void touch(std::uint32_t site) {
    if (std::find(changed.begin(), changed.end(), site) == changed.end()) changed.push_back(site);
  }

  void mark(std::uint32_t site) {
    if (is_marked[site] || absent[site]) return;
    is_marked[site] = 1;
    made.push_back(site);
  }

  // Measures the marked cells and takes over what they say.
  void make_marked(std::size_t from, const SolveOptions& options, SolveReport& report) {
    const auto which = std::span(made).subspan(from);
    workshop.make(which, plain_cells(options.pool), cells, {.borders = borders.data()});
    for (const std::uint32_t i : which) {
      volume[i] = cells[i].volume;
      shift[i] = 0;
    }
    for (const std::uint32_t i : which) response.set_row(i, sites, cells[i], lost);
    report.cells_made += which.size();
  }

  // A border that one side has found and the other has never heard of makes that one's cell anew too; and so does one that one
  // side has lost: something has come between, and may have swallowed the other.
  void make_new_neighbours(const SolveOptions& options, SolveReport& report) {
    for (std::size_t from = 0; from < made.size() || !lost.empty();) {
      const std::size_t end = made.size();
      for (const std::uint32_t i : lost) mark(i);
      lost.clear();
      for (; from < end; ++from) {
        for (const FacetArea& facet : cells[made[from]].facets) {
          if (facet.kind != FacetArea::Kind::site || is_marked[facet.index]) continue;
          const auto& others = cells[facet.index].facets;
          const FacetArea own{FacetArea::Kind::site, made[from], 0};
          const bool is_known = std::any_of(others.begin(), others.end(), [&](const FacetArea& other) {
            return other.kind == own.kind && other.index == own.index;
          });
          if (!is_known) mark(facet.index);
        }
      }
      make_marked(end, options, report);
    }
  }

  // The cells of changed sites, and those next to them before and after.
  bool make_changed(const SolveOptions& options, SolveReport& report) {
    is_marked.assign(size(), 0);
    made.clear();
    std::sort(changed.begin(), changed.end());
    for (const std::uint32_t i : changed) {
      if (absent[i]) {
        workshop.erase(i);
      } else if (i >= workshop.sites().size() || workshop.twins()[i] == i) {
        if (!workshop.insert(i, sites[i])) return false;
      } else if (!workshop.change(i, sites[i])) {
        return false;
      }
      mark(i);
    }
    const std::size_t own = made.size();
    for (const std::uint32_t i : changed) {
      for (const std::uint32_t j : borders[i]) mark(j);
      if (absent[i]) borders[i].clear();
    }
    std::vector<std::uint32_t> outer(made.begin() + static_cast<std::ptrdiff_t>(own), made.end());
    made.resize(own);
    make_marked(0, options, report);
    const auto add_outer = [&](std::uint32_t j) {
      if (!is_marked[j] && !absent[j]) outer.push_back(j), is_marked[j] = 1;
    };
    for (const std::uint32_t i : changed) {
      for (const std::uint32_t j : borders[i]) add_outer(j);
      // Where it outweighs others at their own positions it may have swallowed them without bordering anything of theirs.
      if (absent[i] || !(sites[i].weight > 0)) continue;
      workshop.visit_near(sites[i].position, std::sqrt(sites[i].weight), [&](const SiteGrid::Entry& entry) {
        if (squared_norm(entry.position - sites[i].position) < sites[i].weight - entry.weight) add_outer(entry.site);
      });
    }
    std::sort(outer.begin(), outer.end());
    made.insert(made.end(), outer.begin(), outer.end());
    make_marked(own, options, report);
    make_new_neighbours(options, report);
    changed.clear();
    return true;
  }

  // A cell that has vanished, or nearly: with this weight its site wins at its own position again.
  double repaired_weight(std::uint32_t i) const {
    double best = 0.1 * weight_of_volume(demand[i]);
    for (std::uint32_t j = 0; j < size(); ++j) {
      if (j != i && !absent[j])
        best = std::max(best, sites[j].weight - kSolverRepair * squared_norm(sites[j].position - sites[i].position));
    }
    return std::max(sites[i].weight, best);
  }

  bool repair_emptied(const SolveOptions& options, SolveReport& report) {
    for (int attempt = 0; attempt < 4; ++attempt) {
      for (const std::uint32_t i : made) {
        if (!counts(i) || volume[i] > 0.02 * demand[i]) continue;
        const double weight = repaired_weight(i);
        if (!(weight > sites[i].weight)) return false;
        sites[i].weight = weight;
        changed.push_back(i);
      }
      if (changed.empty()) return true;
      if (!make_changed(options, report)) return false;
    }
    return false;
  }

  double largest_error() const {
    double error = 0;
    for (std::uint32_t i = 0; i < size(); ++i) {
      if (counts(i)) error = std::max(error, std::abs(volume[i] - demand[i]) / demand[i]);
    }
    return error;
  }

  // One linear solve for the sites around those that miss their demand, the weights that follow from it, and exact cells where
  // these have shift too much.
  bool round(const SolveOptions& options, int rings, SolveReport& report) {
    const double enough = kAimedShare * options.tolerance;
    const auto active = response.active_around(demand, volume, absent, enough, rings);
    const std::vector<double>& change = response.solve(active, demand, volume, 0.3 * enough);
    double share = std::min(1.0, kMostSwept / std::max(1e-300, response.largest_sweep(active, volume)));
    for (const std::uint32_t i : active) {
      if (change[i] * share < -0.5 * sites[i].weight) share = -0.5 * sites[i].weight / change[i];
    }
    if (!(share > kLeastSolvedShare)) return false;
    response.apply(active, share, volume, shift);
    for (const std::uint32_t i : active) sites[i].weight += share * change[i];
    if (active.size() > size() / 4) {
      if (auto set = workshop.set_weights(sites); !set) return false;
    } else {
      for (const std::uint32_t i : active) {
        if (!workshop.change(i, sites[i])) return false;
      }
    }
    // The response is right to first order: what it misses grows with the square of how far the borders have moved. In a round
    // cell all of them by one length sweep a share 3 length / radius of it, with the radius of 0.62 times the cube root.
    const double trusted = 0.207 * std::sqrt(kTrustedShare * options.tolerance);
    is_marked.assign(size(), 0);
    made.clear();
    for (const std::uint32_t i : response.touched()) {
      if (shift[i] > trusted * cube_root(std::max(volume[i], 1e-300))) mark(i);
    }
    std::sort(made.begin(), made.end());
    make_marked(0, options, report);
    make_new_neighbours(options, report);
    return repair_emptied(options, report);
  }

  bool solve_locally(const SolveOptions& options, SolveReport& report) {
    if (!changed.empty() && (!make_changed(options, report) || !repair_emptied(options, report))) return false;
    int rings = 3;
    double last = 1e300;
    while (report.rounds < options.most_rounds) {
      report.error = largest_error();
      if (report.error <= 2 * kAimedShare * options.tolerance) return true;
      if (!(report.error < 0.5 * last)) rings *= 2;
      last = report.error;
      ++report.rounds;
      if (!round(options, rings, report)) return false;
    }
    return false;
  }

  Result<SolveReport> solve_all(const SolveOptions& options, SolveReport report) {
    FitProblem problem;
    std::vector<std::uint32_t> place;
    for (std::uint32_t i = 0; i < size(); ++i) {
      if (absent[i]) continue;
      VolumeDemand wanted;
      wanted.sites = {static_cast<std::uint32_t>(place.size())};
      wanted.least = wanted.most = demand[i];
      problem.sites.push_back(sites[i]);
      problem.demands.push_back(std::move(wanted));
      place.push_back(i);
    }
    VolumeFitOptions fit_options;
    fit_options.tolerance = kAimedShare * options.tolerance;
    fit_options.pool = options.pool;
    auto fit = fit_volumes(workshop.domain(), problem, fit_options);
    if (!fit) return fit.error();
    for (std::size_t k = 0; k < place.size(); ++k) sites[place[k]].weight = fit->weights[k];
    if (auto set = workshop.set_sites(sites, absent); !set) return set.error();
    workshop.make_all(plain_cells(options.pool), cells, {.borders = borders.data()});
    response.reset(size());
    for (std::uint32_t i = 0; i < size(); ++i) {
      volume[i] = cells[i].volume;
      shift[i] = 0;
      response.set_row(i, sites, cells[i], lost);
    }
    lost.clear();
    report.cells_made += size();
    report.was_local = false;
    report.status = fit->status;
    report.reasons = fit->reasons;
    report.error = fit->max_relative_error;
    is_fresh = fit->status != FitStatus::met;
    changed.clear();
    return report;
  }

  Result<SolveReport> solve(const SolveOptions& options) {
    SolveReport report;
    if (!is_fresh && solve_locally(options, report)) return report;
    return solve_all(options, std::move(report));
  }

  void resize(std::size_t count) {
    sites.resize(count);
    demand.resize(count, 0);
    volume.resize(count, 0);
    shift.resize(count, 0);
    absent.resize(count, 0);
    cells.resize(count);
    borders.resize(count);
    response.resize(count);
  }
};

VolumeSolver::VolumeSolver() : workspace_(std::make_unique<Workspace>()) {}
VolumeSolver::~VolumeSolver() = default;
VolumeSolver::VolumeSolver(VolumeSolver&&) noexcept = default;
VolumeSolver& VolumeSolver::operator=(VolumeSolver&&) noexcept = default;

namespace {

Result<void> check_place(const Point3& position, double demand) {
  const PowerSite site{position, 0};
  if (auto checked = check_sites(std::span(&site, 1)); !checked) return checked.error();
  if (!(demand >= 0) || !std::isfinite(demand)) return Error{ErrorCode::out_of_range, "", "a demand has to be zero or more"};
  return {};
}

Error no_such_site(std::uint32_t site) { return Error{ErrorCode::missing, "", "there is no site " + std::to_string(site)}; }

}  // namespace

Result<void> VolumeSolver::start(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands) {
  if (domain.pieces.empty()) return Error{ErrorCode::geometry, "", "the domain is empty"};
  if (sites.size() != demands.size()) return Error{ErrorCode::out_of_range, "", "there has to be one demand for each site"};
  if (auto checked = check_sites(sites); !checked) return checked.error();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (auto checked = check_place(sites[i].position, demands[i]); !checked) return checked.error();
  }
  auto workspace = std::make_unique<Workspace>();
  workspace->workshop.set_domain(domain);
  workspace->resize(sites.size());
  workspace->sites.assign(sites.begin(), sites.end());
  workspace->demand.assign(demands.begin(), demands.end());
  workspace_ = std::move(workspace);
  return {};
}

Result<void> VolumeSolver::move(std::uint32_t site, const Point3& position) {
  if (site >= workspace_->size() || workspace_->absent[site]) return no_such_site(site);
  if (auto checked = check_place(position, 0); !checked) return checked;
  workspace_->sites[site].position = position;
  workspace_->touch(site);
  return {};
}

Result<void> VolumeSolver::set_demand(std::uint32_t site, double demand) {
  if (site >= workspace_->size() || workspace_->absent[site]) return no_such_site(site);
  if (auto checked = check_place({}, demand); !checked) return checked;
  // From or to nothing is another set of free weights; and a sum that may not fit has to be looked at as a whole.
  if (!(demand > 0) || !(workspace_->demand[site] > 0)) workspace_->is_fresh = true;
  workspace_->demand[site] = demand;
  return {};
}

Result<std::uint32_t> VolumeSolver::add(const Point3& position, double demand) {
  if (auto checked = check_place(position, demand); !checked) return checked.error();
  Workspace& workspace = *workspace_;
  const auto free = std::find(workspace.absent.begin(), workspace.absent.end(), std::uint8_t{1});
  const auto place = static_cast<std::uint32_t>(free - workspace.absent.begin());
  if (place == workspace.size()) workspace.resize(workspace.size() + 1);
  workspace.absent[place] = 0;
  workspace.demand[place] = demand;
  // Among settled ones a newcomer starts small, so that it pushes nobody out.
  workspace.sites[place] = {position, weight_of_volume(0.3 * demand)};
  workspace.touch(place);
  return place;
}

Result<void> VolumeSolver::remove(std::uint32_t site) {
  if (site >= workspace_->size() || workspace_->absent[site]) return no_such_site(site);
  workspace_->absent[site] = 1;
  workspace_->sites[site].weight = workspace_->demand[site] = workspace_->volume[site] = workspace_->shift[site] = 0;
  workspace_->cells[site] = {};
  workspace_->touch(site);
  return {};
}

Result<SolveReport> VolumeSolver::solve(const SolveOptions& options) try {
  if (!(options.tolerance > 0)) return Error{ErrorCode::out_of_range, "", "the tolerance has to be above zero"};
  if (workspace_->workshop.domain().pieces.empty()) return Error{ErrorCode::missing, "", "the solver has not been started"};
  return workspace_->solve(options);
} catch (const std::exception& problem) {
  return Error{ErrorCode::internal, "", std::string("the fit failed: ") + problem.what()};
}

std::span<const PowerSite> VolumeSolver::sites() const { return workspace_->sites; }
std::span<const double> VolumeSolver::volumes() const { return workspace_->volume; }
std::span<const double> VolumeSolver::demands() const { return workspace_->demand; }

}  // namespace bl::geometry
