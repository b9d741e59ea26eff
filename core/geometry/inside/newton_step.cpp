// Newton: all weights follow the exact response of all volumes, and every step is judged by what it led to.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/geometry/inside/careful_growth.h"
#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/response_system.h"
#include "core/geometry/inside/weight_fit.h"

namespace bl::geometry {

namespace {

// Newton's step leaves at least this share of r³.
constexpr double kLeastOfStepCube = 0.1;
// Up to this share of the demands may be repaired one by one after a step that all others gain by.
constexpr double kFewOffenders = 0.02;
// Such a step has to bring the residual below this share, and below that one after the repair.
constexpr double kFallWorthRepair = 0.5, kRepairedFall = 0.7;
// A change of weight that moves no volume by more than this share of the tolerance is not made: what it would move stays as it
// is, bit for bit, and need not be measured again.
constexpr double kIdleShare = 0.25;
// A local step moves those who miss their demands, and those who by that would come to miss theirs by more than this share of
// the tolerance: found in so many rounds. Where it comes to more than this share of the demands, all move.
constexpr double kStayShare = 0.9, kFewMovers = 0.25;
constexpr int kMostRounds = 8;
// Farther from the demands than this, a step of Newton's is careful with growth.
constexpr double kFarError = 1.6;
// Newton's step is halved no further than this.
constexpr double kLeastNewtonStep = 1.0 / 256;

}  // namespace

// Damped Newton. The last move is judged by what it led to: taken back by half where it went too far (Kitagawa, Mérigot and
// Thibert 2019: cells must not vanish, the residual has to fall), else followed by the next step.
void WeightFit::move_together(std::span<const CellMeasure> cells) {
  FitState& state = report_.state;
  double squares = 0, ratio = 1;
  std::vector<std::uint32_t> offenders;
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    if (targets_.sites(k).empty() || !(targets_.aim(k) > 0)) continue;
    const double error = targets_.total(k) - targets_.aim(k);
    // Of many, those within the tolerance stay as they are and are no part of what a step has to bring down.
    const double counted = is_local() ? std::max(0.0, std::abs(error) - options_.tolerance * targets_.aim(k)) : error;
    if (counted != 0) squares += counted * counted / targets_.aim(k);
    // Who has enough is never the emptiest, nor an offender.
    if (error >= 0 && state.least_ratio <= 1) continue;
    const double part = targets_.total(k) / targets_.aim(k);
    ratio = std::min(ratio, part);
    if (part < state.least_ratio) offenders.push_back(k);
  }
  const double residual = std::sqrt(squares), share = std::abs(state.share);
  if (state.residual >= 0 && share > kLeastNewtonStep) {
    const bool is_repaired = state.share < 0;
    const bool falls = residual <= (is_repaired ? kRepairedFall : 1 - 0.1 * share) * state.residual;
    const double most_repairs = std::max(1.0, kFewOffenders * static_cast<double>(targets_.size()));
    // A full step that does all much good but a few: these are helped, and then it is judged again, more strictly.
    if (!offenders.empty() && !is_repaired && share == options_.damping && residual <= kFallWorthRepair * state.residual &&
        static_cast<double>(offenders.size()) <= most_repairs) {
      return repair_offenders(offenders);
    }
    if (!falls || !offenders.empty()) return take_back(0.5 * share);
  }
  // A round of repair first; what is empty even then must not hold up the others.
  if (ratio <= 0 && state.share != 0) return repair(cells);
  if (state.residual < 0) state.least_ratio = 0.5 * ratio;
  step_together(cells, residual);
}

void WeightFit::take_back(double share) {
  report_.state.share = share;
  std::vector<double> from(sites_.size(), 0);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    if (!is_fitted(i)) continue;
    from[i] = cube_of_radius(sites_[i].weight) - report_.state.previous_move[i];
    follow(i, from[i]);
  }
  move_groups_alike(from);
}

// The weights of a group all move as that of its lightest member that moves at all: otherwise they would drift apart in r³, and
// what the group becomes would depend on the way.
void WeightFit::move_groups_alike(std::span<const double> from) {
  if (!targets_.has_groups()) return;
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    const auto members = targets_.sites(k);
    if (members.size() < 2 || !(targets_.most(k) > 0)) continue;
    std::uint32_t lead = FitTargets::kNone;
    for (const std::uint32_t i : members) {
      if (report_.state.direction[i] != 0 && (lead == FitTargets::kNone || from[i] < from[lead])) lead = i;
    }
    const double change = lead == FitTargets::kNone ? 0 : sites_[lead].weight - weight_of_cube(from[lead]);
    for (const std::uint32_t i : members) {
      if (i == lead || lead == FitTargets::kNone) continue;
      sites_[i].weight = std::max(0.0, weight_of_cube(from[i]) + change);
      report_.state.previous_move[i] = cube_of_radius(sites_[i].weight) - from[i];
    }
  }
}

// Raises the weights of a demand's sites alike, until the first of them has a cell again.
void WeightFit::raise(std::uint32_t target, std::vector<double>& weights) const {
  double lift = 1e300;
  for (const std::uint32_t i : targets_.sites(target)) lift = std::min(lift, repaired_weight(i) - sites_[i].weight);
  for (const std::uint32_t i : targets_.sites(target)) {
    weights[i] = targets_.sites(target).size() == 1 ? repaired_weight(i) : sites_[i].weight + lift;
  }
}

void WeightFit::repair_offenders(std::span<const std::uint32_t> offenders) {
  report_.state.share = -report_.state.share;
  std::vector<double> weights(sites_.size());
  for (const std::uint32_t k : offenders) {
    raise(k, weights);
    for (const std::uint32_t i : targets_.sites(k)) {
      const double before = cube_of_radius(sites_[i].weight);
      sites_[i].weight = weights[i];
      report_.state.previous_move[i] += cube_of_radius(sites_[i].weight) - before;
    }
  }
}

void WeightFit::repair(std::span<const CellMeasure> cells) {
  report_.state.residual = -1;
  report_.state.share = 0;
  std::vector<double> weights(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) weights[i] = sites_[i].weight;
  for (std::uint32_t k = 0; k < targets_.size(); ++k) {
    if (!targets_.sites(k).empty() && targets_.most(k) > 0 && !(targets_.total(k) > 0)) raise(k, weights);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
}

// Where few miss their demands by more than the tolerance, the step is theirs, and that of those whom it would make miss theirs;
// all others stay as they are, bit for bit. Empty where all have to move.
WeightFit::Step WeightFit::local_step(std::span<const CellMeasure> cells) {
  movers_.assign(targets_.size(), 0);
  for (const std::uint32_t k : missed_) movers_[k] = 1;
  moving_ = missed_;
  totals_.resize(targets_.size());
  for (std::uint32_t k = 0; k < targets_.size(); ++k) totals_[k] = targets_.total(k);
  const auto most = static_cast<std::size_t>(kFewMovers * static_cast<double>(targets_.size()));
  for (int round = 0; moving_.size() <= most; ++round) {
    Step step = solve(cells);
    if (round == kMostRounds || !add_movers(cells, step)) return step;
  }
  movers_.clear();
  return {};
}

// Adds those who would come to miss their demands by a step to those who take part in it. Is there one? Only those are looked at
// who border the sites of the step.
bool WeightFit::add_movers(std::span<const CellMeasure> cells, const Step& step) {
  std::vector<std::uint32_t> touched;
  for (std::size_t s = 0; s < step.sites.size(); ++s) {
    const std::uint32_t i = step.sites[s];
    for (const FacetArea& facet : cells[i].facets) {
      const std::uint32_t k = facet.kind == FacetArea::Kind::site ? targets_.owner(facet.index) : FitTargets::kNone;
      if (k == FitTargets::kNone || movers_[k]) continue;
      if (totals_[k] == targets_.total(k)) touched.push_back(k);
      totals_[k] -= step.change[s] * facet.area / (2 * distance(sites_[i].position, sites_[facet.index].position));
    }
  }
  const std::size_t before = moving_.size();
  for (const std::uint32_t k : touched) {
    const double total = std::exchange(totals_[k], targets_.total(k));
    if (total == targets_.total(k) || !(targets_.most(k) > 0) || !targets_.is_active(k)) continue;
    if (std::abs(total - targets_.aim(k)) <= kStayShare * options_.tolerance * targets_.aim(k)) continue;
    movers_[k] = 1;
    moving_.push_back(k);
  }
  std::sort(moving_.begin(), moving_.end());
  return moving_.size() > before;
}

// Of those who take part alone: nothing in it is as long as the list of all sites.
WeightFit::Step WeightFit::solve(std::span<const CellMeasure> cells) {
  Step step;
  unknown_of_.resize(sites_.size(), ResponseSystem::kStays);
  std::vector<std::uint32_t> all;
  if (movers_.empty()) {
    all.resize(targets_.size());
    std::iota(all.begin(), all.end(), 0u);
  }
  const std::vector<std::uint32_t>& targets = movers_.empty() ? all : moving_;
  for (std::uint32_t u = 0; u < targets.size(); ++u)
    for (const std::uint32_t i : targets_.sites(targets[u])) {
      if (!moves(i)) continue;
      unknown_of_[i] = u;
      step.sites.push_back(i);
    }
  if (!std::is_sorted(step.sites.begin(), step.sites.end())) std::sort(step.sites.begin(), step.sites.end());
  const std::vector<double> change = ResponseSystem(sites_, cells, step.sites, unknown_of_)
                                         .solve(wanted_changes(targets), std::min(1e-3, 0.1 * std::max(1e-9, report_.error)));
  step.change.reserve(step.sites.size());
  for (const std::uint32_t i : step.sites) step.change.push_back(change[std::exchange(unknown_of_[i], ResponseSystem::kStays)]);
  return step;
}

// What the linear response is asked for, of some demands [m³].
std::vector<double> WeightFit::wanted_changes(std::span<const std::uint32_t> targets) const {
  std::vector<double> demands(targets.size(), 0), volumes(targets.size(), 0);
  for (std::size_t u = 0; u < targets.size(); ++u) {
    const std::uint32_t k = targets[u];
    if (targets_.sites(k).empty() || !targets_.is_active(k)) continue;
    demands[u] = targets_.aim(k);
    volumes[u] = targets_.total(k);
  }
  return changes_towards(demands, volumes, report_.error > kFarError);
}

void WeightFit::step_together(std::span<const CellMeasure> cells, double residual) {
  FitState& state = report_.state;
  ++report_.iterations;
  // After a step that went too far, or was too small to help, the next one is that of the whole.
  movers_.clear();
  Step step;
  if (is_local() && std::abs(state.share) == options_.damping) step = local_step(cells);
  const bool is_local_step = !movers_.empty();
  if (!is_local_step) step = solve(cells);
  state.residual = residual;
  state.share = options_.damping;
  state.direction.assign(cells.size(), 0);
  state.previous_move.assign(cells.size(), 0);
  std::vector<double> from(cells.size(), 0);
  for (std::size_t s = 0; s < step.sites.size(); ++s) {
    const std::uint32_t i = step.sites[s];
    const double change = step.change[s];
    const bool counts = cells[i].volume > 0 && (is_local_step || !is_idle(cells, i, std::abs(change)));
    if (counts) state.direction[i] = 1.5 * std::sqrt(sites_[i].weight) * change;
    from[i] = cube_of_radius(sites_[i].weight);
    follow(i, from[i]);
  }
  move_groups_alike(from);
}

// Would this change of weight [m²] move no volume by what anybody counts?
bool WeightFit::is_idle(std::span<const CellMeasure> cells, std::size_t i, double change) const {
  const double enough = kIdleShare * options_.tolerance;
  if (change * cells[i].volume_by_own_weight > enough * targets_.part(i)) return false;
  for (const FacetArea& facet : cells[i].facets) {
    if (facet.kind != FacetArea::Kind::site || !is_fitted(facet.index)) continue;
    const double moved = change * facet.area / (2 * distance(sites_[i].position, sites_[facet.index].position));
    if (moved > enough * targets_.part(facet.index)) return false;
  }
  return true;
}

// Goes the current share of the step from a place. The bounds bend the way, but less and less as the share shrinks.
void WeightFit::follow(std::size_t i, double from) {
  FitState& state = report_.state;
  state.previous_move[i] = 0;
  if (state.direction[i] == 0) {
    if (from != cube_of_radius(sites_[i].weight)) sites_[i].weight = weight_of_cube(from);
    return;
  }
  const double cube = std::max(from + state.share * state.direction[i], kLeastOfStepCube * from);
  sites_[i].weight = std::max(weight_of_cube(cube), kLeastShare * weight_of_volume(targets_.part(i)));
  state.previous_move[i] = cube_of_radius(sites_[i].weight) - from;
}

}  // namespace bl::geometry
