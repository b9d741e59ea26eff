// The steps of the fit: feedback, where each weight follows its own error, and Newton, where all follow the exact response.
#include "core/geometry/demand_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/geometry/cell_workshop.h"
#include "core/geometry/fit_numbers.h"
#include "core/geometry/fit_targets.h"
#include "core/geometry/ray_start.h"
#include "core/geometry/response_system.h"

namespace bl {

namespace {

// In one step r³ at most doubles, and loses at most half: beyond that the linear response says nothing any more.
constexpr double kMostGrowth = 2, kMostLoss = 0.5;
// An emptied cell's site is put back into its own cell by this margin (1 would put it on the bisector).
constexpr double kRepair = 0.8;
// Newton's step leaves at least this share of r³.
constexpr double kLeastOfCube = 0.1;
// Up to this share of the demands may be repaired one by one after a step that all others gain by.
constexpr double kFewOffenders = 0.02;
// Such a step has to bring the residual below this share, and below that one after the repair.
constexpr double kFallWorthRepair = 0.5, kRepairedFall = 0.7;
// A change of weight that moves no volume by more than this share of the tolerance is not made: what it would move stays as it
// is, bit for bit, and need not be measured again.
constexpr double kIdleShare = 0.25;
// Farther from the demands than this, a step of Newton's is careful with growth.
constexpr double kFarError = 1.6;
// Newton's step is halved no further than this.
constexpr double kLeastStep = 1.0 / 256;
// Share of the diagonal step: the response matrix, scaled by its diagonal, has eigenvalues between 0 and 2.
constexpr double kStep = 0.8;
// A weight never falls below this share of the weight whose whole ball has the demanded volume.
constexpr double kLeastShare = 1e-4;
// A free ball never exceeds so many times what it takes to hold the whole domain: more weight only drowns the others.
constexpr double kMostReach = 4;

class Fit {
 public:
  Fit(const Domain& domain, std::span<const PowerSite> sites, FitTargets targets, const FitState& state,
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

  Result<FitReport> run() {
    PowerDiagram own;
    PowerDiagram& diagram = options_.diagram != nullptr ? *options_.diagram : own;
    if (auto set = diagram.set_domain(domain_); !set) return set.error();
    CellOptions cells;
    cells.with_shape = cells.with_centroid = false;
    cells.pool = options_.pool;
    for (int step = 0; step < std::max(1, options_.steps); ++step) {
      auto measured = diagram.update(sites_, cells);
      if (!measured) return measured.error();
      if (step == 0) {
        targets_.grant(*measured, domain_.volume, out_of_reach(domain_, sites_));
        if (start_full()) measured = diagram.update(sites_, cells);
        if (!measured) return measured.error();
      }
      report_.steps = step + 1;
      judge(*measured);
      report_.evaluated.clear();
      for (const PowerSite& site : sites_) report_.evaluated.push_back(site.weight);
      if (report_.is_met) break;
      move(*measured);
      keep_in_bounds();
    }
    for (const PowerSite& site : sites_) report_.weights.push_back(site.weight);
    for (std::size_t k = 0; k < targets_.size(); ++k) report_.demands.push_back(targets_.aim(k));
    report_.infeasible = targets_.infeasible();
    report_.losses = targets_.losses();
    return std::move(report_);
  }

 private:
  bool is_fitted(std::size_t i) const { return targets_.is_fitted(i); }
  bool moves(std::size_t i) const { return is_fitted(i) && targets_.is_active(targets_.owner(i)); }
  double missing(std::span<const CellMeasure> cells, std::size_t i) const {
    const std::uint32_t k = targets_.owner(i);
    return targets_.sites(k).size() == 1 ? targets_.aim(k) - cells[i].volume
                                         : (targets_.aim(k) - targets_.total(k)) / static_cast<double>(targets_.sites(k).size());
  }

  // Sites without a weight yet: all of them alike where no site has one, else each by its own demand.
  void start_fresh_sites() {
    const bool all_fresh = std::none_of(sites_.begin(), sites_.end(), [](const PowerSite& s) { return s.weight > 0; });
    std::vector<double> parts(sites_.size(), 0), start;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (targets_.owner(i) != FitTargets::kNone) parts[i] = targets_.part(i);
    }
    if (all_fresh) start = initial_weights(domain_, sites_, parts);
    if (all_fresh && options_.method == FitMethod::newton && targets_.is_plain()) {
      start = weights_by_rays(domain_, sites_, std::move(start), parts, options_.pool);
    }
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (targets_.owner(i) == FitTargets::kNone || sites_[i].weight > 0) continue;
      sites_[i].weight = all_fresh ? start[i] : weight_of_volume(parts[i]);
    }
  }

  // Balls that take the whole domain never cut: all weights are raised alike, which changes no bisector, until none does.
  // Otherwise the last corners, beyond the balls, would be won ever more slowly.
  bool start_full() {
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

  void keep_in_bounds() {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const double reach = kMostReach * (domain_.size() + distance(sites_[i].position, domain_.centroid));
      if (targets_.owner(i) == FitTargets::kNone) continue;
      sites_[i].weight = std::clamp(sites_[i].weight, 0.0, std::min(kLargestWeight, reach * reach));
    }
  }

  void judge(std::span<const CellMeasure> cells) {
    targets_.measure(cells);
    report_.volumes.resize(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) report_.volumes[i] = cells[i].volume;
    report_.error = 0;
    report_.worst_site = 0;
    for (std::uint32_t k = 0; k < targets_.size(); ++k) {
      const double error = targets_.error(k);
      if (!(error > report_.error)) continue;
      report_.error = error;
      report_.worst_site = k;
    }
    report_.is_met = report_.error <= options_.tolerance;
  }

  // Weight that brings an emptied cell back: with it the site wins at its own position (or at a place inside the domain).
  double repaired_weight(std::size_t i) const {
    const Point3 place = domain_.place_inside(sites_[i].position);
    double best = 0.1 * weight_of_volume(targets_.part(i));
    for (std::size_t j = 0; j < sites_.size(); ++j) {
      if (j != i) best = std::max(best, sites_[j].weight - kRepair * squared_norm(sites_[j].position - place));
    }
    return std::max(sites_[i].weight, best + squared_norm(place - sites_[i].position));
  }

  // The change of weight [m²] that brings one cell to its demand while the others stay. A cell bounded by its neighbours
  // grows like the cube of the change, a free ball slower, so a cell far too small is led by its cube root, and one too
  // large by its volume: of the two estimates always the more careful one.
  static double response_step(const CellMeasure& cell, double missing) {
    const double linear = missing / cell.volume_by_own_weight;
    if (missing <= 0) return linear;
    const double side = cube_root(cell.volume);
    return std::min(linear, 3 * side * side * (cube_root(cell.volume + missing) - side) / cell.volume_by_own_weight);
  }

  void move(std::span<const CellMeasure> cells) {
    if (options_.method == FitMethod::newton) return move_together(cells);
    ++report_.iterations;
    if (options_.gain > 0) return move_by_gain(cells);
    move_alone(cells);
  }

  // Feedback: each site by its own response, with Nesterov's acceleration in radius³ (the ball's volume is linear in it).
  void move_alone(std::span<const CellMeasure> cells) {
    FitState& state = report_.state;
    // Against the slope: the acceleration has overshot and starts again (O'Donoghue and Candès 2015).
    double agreement = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (moves(i)) agreement += missing(cells, i) * state.previous_move[i] / std::max(1e-300, sites_[i].weight);
    }
    if (agreement < 0) state.momentum = 1;
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * state.momentum * state.momentum));
    const double share = (state.momentum - 1) / next;
    state.momentum = next;
    std::vector<double> weights(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      weights[i] = sites_[i].weight;
      if (!moves(i)) continue;
      if (!(cells[i].volume > 0) || !(cells[i].volume_by_own_weight > 0)) {
        // Emptied by its own last move: half of that back. Otherwise its neighbours did it.
        const double back = -0.5 * state.previous_move[i];
        weights[i] = back > 0 ? weight_of_cube(cube_of_radius(sites_[i].weight) + back) : repaired_weight(i);
        state.previous_move[i] = 0;
        continue;
      }
      const double part = targets_.part(i);
      const double cube = cube_of_radius(sites_[i].weight), stretch = 1.5 * std::sqrt(sites_[i].weight);
      const double step = options_.damping * kStep * stretch * response_step(cells[i], missing(cells, i));
      const double volume = cells[i].volume, per_volume = stretch / cells[i].volume_by_own_weight;
      const double least = std::max((kMostLoss - 1) * cube, (kMostLoss - 1) * volume * per_volume);
      const double most = std::min((kMostGrowth - 1) * cube, (kMostGrowth - 1) * std::max(volume, 0.1 * part) * per_volume);
      const double move = std::clamp(step + share * state.previous_move[i], least, most);
      state.previous_move[i] = move;
      weights[i] = std::max(weight_of_cube(cube + move), kLeastShare * weight_of_volume(part));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
  }

  // Damped Newton. The last move is judged by what it led to: taken back by half where it went too far (Kitagawa, Mérigot and
  // Thibert 2019: cells must not vanish, the residual has to fall), else followed by the next step.
  void move_together(std::span<const CellMeasure> cells) {
    FitState& state = report_.state;
    double squares = 0, ratio = 1;
    std::vector<std::uint32_t> offenders;
    for (std::uint32_t k = 0; k < targets_.size(); ++k) {
      if (targets_.sites(k).empty() || !(targets_.aim(k) > 0)) continue;
      const double error = targets_.total(k) - targets_.aim(k), part = targets_.total(k) / targets_.aim(k);
      squares += error * error / targets_.aim(k);
      ratio = std::min(ratio, part);
      if (part < state.least_ratio) offenders.push_back(k);
    }
    const double residual = std::sqrt(squares), share = std::abs(state.share);
    if (state.residual >= 0 && share > kLeastStep) {
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

  void take_back(double share) {
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
  void move_groups_alike(std::span<const double> from) {
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
  void raise(std::uint32_t target, std::vector<double>& weights) const {
    double lift = 1e300;
    for (const std::uint32_t i : targets_.sites(target)) lift = std::min(lift, repaired_weight(i) - sites_[i].weight);
    for (const std::uint32_t i : targets_.sites(target)) {
      weights[i] = targets_.sites(target).size() == 1 ? repaired_weight(i) : sites_[i].weight + lift;
    }
  }

  void repair_offenders(std::span<const std::uint32_t> offenders) {
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

  void repair(std::span<const CellMeasure> cells) {
    report_.state.residual = -1;
    report_.state.share = 0;
    std::vector<double> weights(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) weights[i] = sites_[i].weight;
    for (std::uint32_t k = 0; k < targets_.size(); ++k) {
      if (!targets_.sites(k).empty() && targets_.most(k) > 0 && !(targets_.total(k) > 0)) raise(k, weights);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
  }

  // What the linear response is asked for, per demand [m³]. Far from the demands growth is asked for by the 2/3 power of what it
  // is short: the large ones grow all at once, into the same small neighbours, and would empty them. What all together ask for
  // stays what it was: in a full domain anything else has no solution.
  std::vector<double> wanted_changes() const {
    std::vector<double> wanted(targets_.size(), 0);
    double lost = 0, volume = 0;
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      if (targets_.sites(k).empty() || !targets_.is_active(k)) continue;
      const double total = targets_.total(k), missing = targets_.aim(k) - total;
      wanted[k] = missing;
      if (report_.error > kFarError && missing > 0 && total > 0) {
        const double side = cube_root(targets_.aim(k) / total);
        wanted[k] = 1.5 * total * (side * side - 1);
      }
      lost += missing - wanted[k];
      volume += total;
    }
    for (std::size_t k = 0; k < targets_.size() && lost > 0 && volume > 0; ++k) {
      if (!targets_.sites(k).empty() && targets_.is_active(k)) wanted[k] += lost / volume * targets_.total(k);
    }
    return wanted;
  }

  void step_together(std::span<const CellMeasure> cells, double residual) {
    FitState& state = report_.state;
    ++report_.iterations;
    std::vector<std::uint8_t> fitted(cells.size());
    std::vector<std::uint32_t> unknown(cells.size(), FitTargets::kNone);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      fitted[i] = moves(i);
      if (fitted[i]) unknown[i] = targets_.owner(i);
    }
    const std::vector<double> change = ResponseSystem(sites_, cells, fitted)
                                           .solve(wanted_changes(), unknown, std::min(1e-3, 0.1 * std::max(1e-9, report_.error)));
    state.residual = residual;
    state.share = options_.damping;
    state.direction.assign(cells.size(), 0);
    state.previous_move.assign(cells.size(), 0);
    std::vector<double> from(cells.size(), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool counts = fitted[i] && cells[i].volume > 0 && !is_idle(cells, i, std::abs(change[unknown[i]]));
      if (counts) state.direction[i] = 1.5 * std::sqrt(sites_[i].weight) * change[unknown[i]];
      from[i] = cube_of_radius(sites_[i].weight);
      if (fitted[i]) follow(i, from[i]);
    }
    move_groups_alike(from);
  }

  // Would this change of weight [m²] move no volume by what anybody counts?
  bool is_idle(std::span<const CellMeasure> cells, std::size_t i, double change) const {
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
  void follow(std::size_t i, double from) {
    FitState& state = report_.state;
    state.previous_move[i] = 0;
    if (state.direction[i] == 0) {
      if (from != cube_of_radius(sites_[i].weight)) sites_[i].weight = weight_of_cube(from);
      return;
    }
    const double cube = std::max(from + state.share * state.direction[i], kLeastOfCube * from);
    sites_[i].weight = std::max(weight_of_cube(cube), kLeastShare * weight_of_volume(targets_.part(i)));
    state.previous_move[i] = cube_of_radius(sites_[i].weight) - from;
  }

  // Moves of the last call are comparable only while the problem is the same.
  void recognise(std::span<const PowerSite> sites) {
    Hash hash;
    for (const Domain::Piece& piece : domain_.pieces) {
      for (const Point3& v : piece.shape.vertices) hash.add(v);
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const std::uint32_t k = targets_.owner(i);
      hash.add(sites[i].position);
      hash.add(std::uint64_t{k});
      hash.add(k != FitTargets::kNone ? targets_.least(k) : sites[i].weight);
      if (k != FitTargets::kNone) hash.add(targets_.most(k));
    }
    if (report_.state.problem != hash.value()) report_.state.residual = -1;
    report_.state.problem = hash.value();
  }

  // The constant gain of 2007.
  void move_by_gain(std::span<const CellMeasure> cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!moves(i)) continue;
      const double weight = sites_[i].weight + options_.gain * missing(cells, i);
      sites_[i].weight = std::max(weight, kLeastShare * weight_of_volume(targets_.part(i)));
    }
  }

  const Domain& domain_;
  FitOptions options_;
  std::vector<PowerSite> sites_;
  FitTargets targets_;
  FitReport report_;
};

Result<void> check(const FitOptions& options) {
  if (!(options.gain >= 0) || !std::isfinite(options.gain) || !(options.damping > 0 && options.damping <= 1) ||
      !(options.tolerance >= 0)) {
    return Error{ErrorCode::out_of_range, "", "gain and tolerance have to be zero or more, damping between 0 and 1"};
  }
  return {};
}

}  // namespace

Result<FitReport> adapt_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands,
                                std::span<const std::uint8_t> locked, const FitState& state, const FitOptions& options) {
  if (auto checked = check_demands(sites.size(), demands, locked); !checked) return checked.error();
  if (auto checked = check(options); !checked) return checked.error();
  return Fit(domain, sites, FitTargets(demands, locked), state, options).run();
}

Result<FitReport> adapt_weights(const Domain& domain, const FitProblem& problem, const FitState& state,
                                const FitOptions& options) {
  if (auto checked = check_demands(problem); !checked) return checked.error();
  if (auto checked = check(options); !checked) return checked.error();
  return Fit(domain, problem.sites, FitTargets(problem), state, options).run();
}

}  // namespace bl
