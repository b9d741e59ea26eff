// The fit from its start to its report: first weights, judgement after every evaluation, the choice of the next step.
#include "core/geometry/demand_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/fit_targets.h"
#include "core/geometry/inside/ray_start.h"
#include "core/geometry/inside/weight_fit.h"

namespace bl::geometry {

namespace {

// An emptied cell's site is put back into its own cell by this margin (1 would put it on the bisector).
constexpr double kRepair = 0.8;
// A free ball never exceeds so many times what it takes to hold the whole domain: more weight only drowns the others.
constexpr double kMostReach = 4;

Result<void> check(const FitOptions& options) {
  if (!(options.gain >= 0) || !std::isfinite(options.gain) || !(options.damping > 0 && options.damping <= 1) ||
      !(options.tolerance >= 0)) {
    return Error{ErrorCode::out_of_range, "", "gain and tolerance have to be zero or more, damping between 0 and 1"};
  }
  return {};
}

}  // namespace

WeightFit::WeightFit(const Domain& domain, std::span<const PowerSite> sites, FitTargets targets, const FitState& state,
                     const FitOptions& options)
    : domain_(domain), options_(options), sites_(sites.begin(), sites.end()), targets_(std::move(targets)) {
  report_.state = state;
  if (report_.state.previous_move.size() != sites.size()) {
    report_.state = {};
    report_.state.previous_move.assign(sites.size(), 0);
  }
  recognise(sites);
  start_fresh_sites();
  keep_in_bounds();
}

Result<FitReport> WeightFit::run() {
  std::optional<PowerDiagram> own;
  PowerDiagram& diagram = options_.diagram != nullptr ? *options_.diagram : own.emplace();
  if (auto set = diagram.set_domain(domain_); !set) return set.error();
  CellOptions cells;
  cells.with_shape = cells.with_outlines = cells.with_centroid = options_.with_whole_cells;
  cells.with_storeys = false;
  cells.pool = options_.pool;
  for (int step = 0; step < std::max(1, options_.steps); ++step) {
    auto measured = diagram.update(sites_, cells);
    if (!measured) return measured.error();
    if (step == 0) {
      std::vector<std::uint8_t> is_lost = out_of_reach(domain_, sites_);
      for (std::size_t i = 0; diagram.has_coincident() && i < is_lost.size(); ++i)
        if ((*measured)[i].state == SiteState::coincident) is_lost[i] = 1;
      targets_.grant(diagram.volumes(), domain_.volume, is_lost);
      if (start_full()) measured = diagram.update(sites_, cells);
      if (!measured) return measured.error();
    }
    report_.steps = step + 1;
    judge(diagram.volumes());
    report_.evaluated.resize(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) report_.evaluated[i] = sites_[i].weight;
    if (report_.is_met) break;
    if (step == 0 && has_lost_cells(*measured)) {
      begin_evenly();
      continue;
    }
    move(*measured);
    keep_in_bounds();
  }
  report_.weights.resize(sites_.size());
  for (std::size_t i = 0; i < sites_.size(); ++i) report_.weights[i] = sites_[i].weight;
  report_.demands = targets_.aims();
  report_.infeasible = targets_.infeasible();
  report_.losses = targets_.losses();
  return std::move(report_);
}

double WeightFit::missing(std::span<const CellMeasure> cells, std::size_t i) const {
  const std::uint32_t k = targets_.owner(i);
  return targets_.sites(k).size() == 1 ? targets_.aim(k) - cells[i].volume
                                       : (targets_.aim(k) - targets_.total(k)) / static_cast<double>(targets_.sites(k).size());
}

// Moves of the last call are comparable only while the problem is the same.
void WeightFit::recognise(std::span<const PowerSite> sites) {
  Hash hash;
  for (const Domain::Piece& piece : domain_.pieces) {
    for (const Point3& v : piece.shape.vertices) hash.add(v);
  }
  // Each site for itself, because a chain of all numbers would have the processor wait for each of them.
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const std::uint32_t k = targets_.owner(i);
    Hash own;
    own.add(std::uint64_t{i} << 32 | k);
    own.add(sites[i].position);
    own.add(k != FitTargets::kNone ? targets_.least(k) : sites[i].weight);
    if (k != FitTargets::kNone) own.add(targets_.most(k));
    sum += own.value();
  }
  hash.add(sum);
  if (report_.state.problem != hash.value()) report_.state.residual = -1;
  report_.state.problem = hash.value();
}

// Sites without a weight yet: all of them alike where no site has one, else each by its own demand.
void WeightFit::start_fresh_sites() {
  const auto has_weight = [](const PowerSite& site) { return site.weight > 0; };
  if (std::all_of(sites_.begin(), sites_.end(), has_weight)) return;
  const bool all_fresh = std::none_of(sites_.begin(), sites_.end(), has_weight);
  std::vector<double> parts(sites_.size(), 0), start;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) != FitTargets::kNone) parts[i] = targets_.part(i);
  }
  if (all_fresh) start = initial_weights(domain_, sites_, parts);
  if (all_fresh && options_.method == FitMethod::newton && options_.with_rays && targets_.is_plain()) {
    even_ = start;
    start = weights_by_rays(domain_, sites_, std::move(start), parts, options_.pool);
    report_.began_with_rays = start != even_;
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) == FitTargets::kNone || sites_[i].weight > 0) continue;
    sites_[i].weight = all_fresh ? start[i] : weight_of_volume(parts[i]);
  }
}

// Rays know a cell by a few decimals only, and now and then what they took for one is none. Newton's damping counts on a cell
// for every site, which even weights give.
bool WeightFit::has_lost_cells(std::span<const CellMeasure> cells) const {
  if (!report_.began_with_rays) return false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (is_fitted(i) && !(cells[i].volume > 0)) return true;
  }
  return false;
}

void WeightFit::begin_evenly() {
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (is_fitted(i)) sites_[i].weight = even_[i];
  }
  keep_in_bounds();
  report_.began_with_rays = false;
}

// Balls that take the whole domain never cut: all weights are raised alike, which changes no bisector, until none does.
// Otherwise the last corners, beyond the balls, would be won ever more slowly.
bool WeightFit::start_full() {
  bool has_changed = false;  // what has been measured no longer holds
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (targets_.owner(i) == FitTargets::kNone || is_fitted(i) || sites_[i].weight == 0) continue;
    sites_[i].weight = 0;
    has_changed = true;
  }
  if (!targets_.is_full()) return has_changed;
  double lift = 0;
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!is_fitted(i)) continue;
    const double reach = domain_.size() + distance(sites_[i].position, domain_.centroid);
    lift = std::max(lift, reach * reach - sites_[i].weight);
  }
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (is_fitted(i)) sites_[i].weight += lift;
  }
  return has_changed || lift > 0;
}

void WeightFit::keep_in_bounds() {
  // Within these bounds every weight is within its own, which asks for its distance from the middle.
  const double sure = std::min(kLargestWeight, kMostReach * domain_.size() * (kMostReach * domain_.size()));
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (sites_[i].weight >= 0 && sites_[i].weight <= sure) continue;
    const double reach = kMostReach * (domain_.size() + distance(sites_[i].position, domain_.centroid));
    if (targets_.owner(i) == FitTargets::kNone) continue;
    sites_[i].weight = std::clamp(sites_[i].weight, 0.0, std::min(kLargestWeight, reach * reach));
  }
}

void WeightFit::judge(std::span<const double> volumes) {
  targets_.measure(volumes);
  report_.volumes.assign(volumes.begin(), volumes.end());
  report_.error = 0;
  report_.worst_site = 0;
  missed_.clear();
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    const double error = targets_.error(k);
    if (error > options_.tolerance) missed_.push_back(k);
    if (!(error > report_.error)) continue;
    report_.error = error;
    report_.worst_site = k;
  }
  report_.is_met = report_.error <= options_.tolerance;
}

// Weight that brings an emptied cell back: with it the site wins at its own position (or at a place inside the domain).
double WeightFit::repaired_weight(std::size_t i) const {
  const Point3 place = domain_.place_inside(sites_[i].position);
  double best = 0.1 * weight_of_volume(targets_.part(i));
  for (std::size_t j = 0; j < sites_.size(); ++j) {
    if (j != i) best = std::max(best, sites_[j].weight - kRepair * squared_norm(sites_[j].position - place));
  }
  return std::max(sites_[i].weight, best + squared_norm(place - sites_[i].position));
}

void WeightFit::move(std::span<const CellMeasure> cells) {
  if (options_.method == FitMethod::newton) return move_together(cells);
  ++report_.iterations;
  if (options_.gain > 0) return move_by_gain(cells);
  move_alone(cells);
}

Result<FitReport> adapt_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands,
                                std::span<const std::uint8_t> locked, const FitState& state, const FitOptions& options) {
  if (auto checked = check_demands(sites.size(), demands, locked); !checked) return checked.error();
  if (auto checked = check(options); !checked) return checked.error();
  return WeightFit(domain, sites, FitTargets(demands, locked), state, options).run();
}

Result<FitReport> adapt_weights(const Domain& domain, const FitProblem& problem, const FitState& state,
                                const FitOptions& options) {
  if (auto checked = check_demands(problem); !checked) return checked.error();
  if (auto checked = check(options); !checked) return checked.error();
  return WeightFit(domain, problem.sites, FitTargets(problem), state, options).run();
}

}  // namespace bl::geometry
