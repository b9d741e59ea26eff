// The damped Newton method on floor areas; see the README under "Standing volumes" for its matrix.
#include "core/geometry/footprint_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/geometry/inside/footprint_maker.h"
#include "core/geometry/inside/row_system.h"

namespace bl::geometry {

namespace {

constexpr double kSmallShare = 0.02;
constexpr int kMostSmallSteps = 4, kMostHalvings = 10, kMostRepairs = 12, kScalings = 7, kStepsOfATry = 30, kRings = 2,
              kMostLeftOut = 4;
constexpr std::uint32_t kNoDemand = 0xffffffffu;

// Of who has no footprint: no form, or so light a cell that there is none of it.
double weight_of_nothing(const StandingSite& site, const FootprintDiagram& diagram) {
  return site.form == FootprintForm::cell ? -4 * diagram.plot_area() : 0;
}

class Fit {
 public:
  Fit(FootprintDiagram& diagram, std::vector<StandingSite>& sites, std::span<const FloorDemand> demands,
      const FootprintFitOptions& options, FootprintFit& report)
      : diagram_(diagram),
        sites_(sites),
        demands_(demands),
        options_(options),
        report_(report),
        demand_of_(sites.size(), kNoDemand),
        is_out_(demands.size(), 0) {
    for (std::uint32_t g = 0; g < demands.size(); ++g)
      for (const std::uint32_t i : demands[g].sites) {
        demand_of_[i] = g;
        fills_plot_ &= sites[i].form == FootprintForm::cell;
      }
  }

  // All footprints are whole cells: together they take the plot whatever the weights are, and demands are met by proportion only.
  bool fills_plot() const { return fills_plot_; }
  double factor() const { return factor_; }
  bool is_stalled() const { return is_stalled_; }
  std::size_t doubled() const { return count_of(kDoubled); }
  std::size_t left_out() const { return count_of(kLeftOut); }

  // Where the demands cannot be met in any share, one of them may need what nobody can give it, such as a set-back that leaves
  // it a plate only on most of the plot. Takes out the one that has least of what it wants; false: nobody is to be taken out.
  bool leave_out_worst() {
    std::uint32_t worst = kNoDemand;
    for (std::uint32_t g = 0; g < demands_.size(); ++g) {
      if (!counts(g) || !(demands_[g].least > 0)) continue;
      if (worst == kNoDemand || floors_[g] * demands_[worst].least < floors_[worst] * demands_[g].least) worst = g;
    }
    // What has half of what it wants is not what stands in the way of all.
    if (worst == kNoDemand || floors_[worst] > 0.5 * demands_[worst].least) return false;
    is_out_[worst] = kLeftOut;
    return true;
  }

  // Steps until the demands, times `factor`, are met. False: they are not, because no step brings them nearer (`is_stalled`), or
  // because `most_steps` were not enough.
  Result<bool> run(double factor, int most_steps) {
    factor_ = factor;
    is_stalled_ = false;
    make_room();
    if (auto done = evaluate(); !done) return done.error();
    leave_doubled();
    if (auto done = repair(); !done) return done.error();
    least_ratio_ = 0.5 * std::min(1.0, smallest_ratio());
    int small_steps = 0;
    for (int step = 0; step < most_steps; ++step) {
      if (error() <= options_.tolerance) return true;
      const std::vector<double> move = newton_move();
      const auto taken = take(move);
      if (!taken) return taken.error();
      is_stalled_ = !*taken;
      if (is_stalled_) return false;
      // Demands that cannot be met are approached by ever smaller steps.
      small_steps = share_ < kSmallShare ? small_steps + 1 : 0;
      is_stalled_ = small_steps >= kMostSmallSteps;
      if (is_stalled_) return false;
      ++report_.steps;
      if (options_.progress && !options_.progress(report_.evaluations, error())) report_.is_stopped = true;
      if (report_.is_stopped) return false;
    }
    return error() <= options_.tolerance;
  }

  double floor_of(std::uint32_t g) const {
    double sum = 0;
    for (const std::uint32_t i : demands_[g].sites) sum += diagram_.footprints()[i].floor_area;
    return sum;
  }
  // What a demand aims at: between its bounds it asks for nothing else than it has.
  double aim(std::uint32_t g, double factor) const {
    return std::clamp(floor_of(g), factor * demands_[g].least, factor * demands_[g].most);
  }
  double error_of(std::uint32_t g, double factor) const {
    const double wanted = aim(g, factor);
    return wanted > 0 ? std::abs(floor_of(g) - wanted) / wanted : 0;
  }
  Result<void> evaluate() {
    ++report_.evaluations;
    if (auto made = diagram_.update(sites_, options_.pool); !made) return made.error();
    floors_.resize(demands_.size());
    double floors = 0, asked = 0;
    for (std::uint32_t g = 0; g < demands_.size(); ++g) {
      floors_[g] = floor_of(g);
      if (!counts(g)) continue;
      floors += floors_[g];
      asked += demands_[g].least;
    }
    if (fills_plot_ && asked > 0) factor_ = floors / asked;
    return {};
  }

 private:
  static constexpr std::uint8_t kDoubled = 1, kLeftOut = 2;

  std::size_t count_of(std::uint8_t why) const {
    return static_cast<std::size_t>(std::count(is_out_.begin(), is_out_.end(), why));
  }
  double wanted(std::uint32_t g) const { return std::clamp(floors_[g], factor_ * demands_[g].least, factor_ * demands_[g].most); }
  bool counts(std::uint32_t g) const { return is_out_[g] == 0 && !demands_[g].sites.empty() && demands_[g].most > 0; }

  // Of sites in one place only the heaviest has a footprint. The others have no weight with which they could get one.
  void leave_doubled() {
    const auto is_doubled = [this](std::uint32_t i) { return diagram_.footprints()[i].state == SiteState::coincident; };
    for (std::uint32_t g = 0; g < demands_.size(); ++g) {
      const std::vector<std::uint32_t>& sites = demands_[g].sites;
      if (!counts(g) || floors_[g] > 0 || !std::all_of(sites.begin(), sites.end(), is_doubled)) continue;
      is_out_[g] = kDoubled;
      for (const std::uint32_t i : sites) sites_[i].site.weight = 0;
    }
  }
  // Those that are left out take no ground from the others.
  void make_room() {
    for (std::uint32_t g = 0; g < demands_.size(); ++g)
      if (is_out_[g] == kLeftOut)
        for (const std::uint32_t i : demands_[g].sites) sites_[i].site.weight = weight_of_nothing(sites_[i], diagram_);
  }

  double error() const {
    double largest = 0;
    for (std::uint32_t g = 0; g < demands_.size(); ++g)
      if (counts(g) && wanted(g) > 0) largest = std::max(largest, std::abs(floors_[g] - wanted(g)) / wanted(g));
    return largest;
  }
  double residual() const {
    double sum = 0;
    for (std::uint32_t g = 0; g < demands_.size(); ++g)
      if (counts(g) && wanted(g) > 0) sum += (floors_[g] - wanted(g)) * (floors_[g] - wanted(g)) / wanted(g);
    return std::sqrt(sum);
  }
  double smallest_ratio() const {
    double least = 1;
    for (std::uint32_t g = 0; g < demands_.size(); ++g)
      if (counts(g) && wanted(g) > 0) least = std::min(least, floors_[g] / wanted(g));
    return least;
  }

  // Sites without any floor say nothing about how they could get one: they are made heavier until they have some.
  Result<void> repair() {
    for (int round = 0; round < kMostRepairs; ++round) {
      bool is_repaired = false;
      for (std::uint32_t g = 0; g < demands_.size(); ++g) {
        if (!counts(g) || !(demands_[g].least > 0) || floors_[g] > 0) continue;
        is_repaired = true;
        for (const std::uint32_t i : demands_[g].sites) sites_[i].site.weight = heavier(i, round);
      }
      if (!is_repaired) return {};
      if (auto done = evaluate(); !done) return done;
    }
    return {};
  }

  double heavier(std::uint32_t i, int round) const {
    const StandingSite& own = sites_[i];
    double deepest = 0;
    for (const StoreyRun& run : own.runs) {
      const PlateOffset offset = outer_offset(own, run);
      deepest = std::max({deepest, offset.own, offset.plot.border, offset.plot.street});
    }
    double weight = 1.5 * std::max(own.site.weight, deepest * deepest);
    // So heavy that the site lies in its own cell, the more so the longer that was not enough.
    const double share = 0.9 - 0.1 * std::min(round, 8);
    for (std::uint32_t j = 0; j < sites_.size(); ++j) {
      if (j == i) continue;
      const double x = sites_[j].site.position.x - own.site.position.x, y = sites_[j].site.position.y - own.site.position.y;
      weight = std::max(weight, sites_[j].site.weight - share * (x * x + y * y));
    }
    return weight;
  }

  // Which demands may move: all, or where few miss theirs, these and those around them.
  std::vector<std::uint32_t> movable() const {
    std::vector<std::uint32_t> all, off;
    for (std::uint32_t g = 0; g < demands_.size(); ++g) {
      if (!counts(g) || !(wanted(g) > 0)) continue;
      all.push_back(g);
      if (std::abs(floors_[g] - wanted(g)) > 0.1 * options_.tolerance * wanted(g)) off.push_back(g);
    }
    if (!options_.is_local || 4 * off.size() > all.size()) return all;
    std::vector<std::uint8_t> is_in(demands_.size(), 0);
    for (const std::uint32_t g : off) is_in[g] = 1;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t count = off.size();
      for (std::size_t k = 0; k < count; ++k)
        for (const std::uint32_t i : demands_[off[k]].sites)
          for (const FootprintMeasure::Neighbour& n : diagram_.footprints()[i].neighbours) {
            const std::uint32_t h = demand_of_[n.site];
            if (h == kNoDemand || is_in[h] != 0 || !counts(h)) continue;
            is_in[h] = 1;
            off.push_back(h);
          }
    }
    if (2 * off.size() > all.size()) return all;
    std::sort(off.begin(), off.end());
    return off;
  }

  // The change of the weights of each demand [m²] by which the linear response meets all that may move.
  std::vector<double> newton_move() const {
    const std::vector<std::uint32_t> active = movable();
    std::vector<std::uint32_t> row_of(demands_.size(), kNoDemand);
    for (std::uint32_t r = 0; r < active.size(); ++r) row_of[active[r]] = r;
    RowSystem system;
    std::vector<double> right, entries(active.size(), 0);
    std::vector<std::uint32_t> touched;
    for (std::uint32_t r = 0; r < active.size(); ++r) {
      double diagonal = 0;
      touched.clear();
      for (const std::uint32_t i : demands_[active[r]].sites) {
        const FootprintMeasure& measure = diagram_.footprints()[i];
        diagonal += measure.own_response;
        for (const FootprintMeasure::Neighbour& n : measure.neighbours) {
          const std::uint32_t h = demand_of_[n.site], column = h == kNoDemand ? kNoDemand : row_of[h];
          if (column == r) diagonal -= n.response;
          if (column == kNoDemand || column == r) continue;
          if (entries[column] == 0) touched.push_back(column);
          entries[column] -= n.response;
        }
      }
      // Where nobody has a free side, weights matter by their differences only: a little of the diagonal holds them.
      const double hold = 1e-9 * std::max(diagonal, 1e-12);
      system.diagonal.push_back(diagonal + hold);
      for (const std::uint32_t column : touched) {
        system.columns.push_back(column);
        system.values.push_back(entries[column]);
        entries[column] = 0;
      }
      system.starts.push_back(static_cast<std::uint32_t>(system.columns.size()));
      right.push_back(wanted(active[r]) - floors_[active[r]]);
    }
    const double share = std::clamp(0.1 * error(), 1e-10, 1e-3);
    const std::vector<double> found = solve(system, right, share);
    std::vector<double> move(demands_.size(), 0);
    for (std::uint32_t r = 0; r < active.size(); ++r) move[active[r]] = found[r];
    return move;
  }

  // As much of a move as brings the demands nearer and leaves every site some floor. False: nothing of it does.
  Result<bool> take(const std::vector<double>& move) {
    std::vector<double> before;
    for (const StandingSite& s : sites_) before.push_back(s.site.weight);
    const double residual_before = residual();
    double share = 1;
    for (int halving = 0; halving <= kMostHalvings; ++halving, share *= 0.5) {
      for (std::size_t i = 0; i < sites_.size(); ++i) {
        if (demand_of_[i] == kNoDemand || is_out_[demand_of_[i]] != 0) continue;
        const double to = before[i] + share * move[demand_of_[i]];
        // A nearly singular matrix asks for moves without an end.
        const double most = 4 * std::abs(before[i]) + diagram_.plot_area();
        sites_[i].site.weight =
            std::clamp(to, sites_[i].form == FootprintForm::cell ? -most : std::min(most, 0.1 * before[i]), most);
      }
      if (auto done = evaluate(); !done) return done.error();
      if (smallest_ratio() >= least_ratio_ && residual() <= (1 - 0.1 * share) * residual_before) {
        share_ = share;
        return true;
      }
    }
    for (std::size_t i = 0; i < sites_.size(); ++i) sites_[i].site.weight = before[i];
    if (auto done = evaluate(); !done) return done.error();
    return false;
  }

  FootprintDiagram& diagram_;
  std::vector<StandingSite>& sites_;
  std::span<const FloorDemand> demands_;
  const FootprintFitOptions& options_;
  FootprintFit& report_;
  std::vector<std::uint32_t> demand_of_;
  std::vector<std::uint8_t> is_out_;  // per demand: why it cannot have anything, or 0
  std::vector<double> floors_;
  double factor_ = 1, least_ratio_ = 0;
  double share_ = 1;  // of the last full step, that was taken
  bool fills_plot_ = true, is_stalled_ = false;
};

// The plot that all demands need at the least: each plate is a whole footprint.
double needed_plot(std::span<const StandingSite> sites, std::span<const FloorDemand> demands) {
  double sum = 0;
  for (const FloorDemand& demand : demands) {
    int most = 0;
    for (const std::uint32_t i : demand.sites) most = std::max(most, sites[i].storeys());
    if (most > 0) sum += demand.least / most;
  }
  return sum;
}

void start(const FootprintDiagram& diagram, std::vector<StandingSite>& sites, std::span<const FloorDemand> demands) {
  // A cell without a form may well have a weight below zero; one that has none yet has exactly zero.
  const auto has_weight = [](const StandingSite& s) {
    return s.form == FootprintForm::cell ? s.site.weight != 0 : s.site.weight > 0;
  };
  const bool is_fresh = std::none_of(sites.begin(), sites.end(), has_weight);
  const double equal = is_fresh ? equal_footprint_weight(diagram, sites, demands) : 0;
  for (const FloorDemand& demand : demands)
    for (const std::uint32_t i : demand.sites) {
      if (!(demand.most > 0)) sites[i].site.weight = weight_of_nothing(sites[i], diagram);
      if (has_weight(sites[i]) || !(demand.most > 0)) continue;
      // Newcomers among others start with half of what they need, so that they hide nobody.
      const double own =
          0.5 * demand.least / (std::numbers::pi * std::max(1, sites[i].storeys()) * static_cast<double>(demand.sites.size()));
      sites[i].site.weight = is_fresh ? equal : std::max(own, 1e-6);
    }
}

// The largest share of all demands that can be met, by halving: each try starts from the best so far, whose weights `sites` gets.
Result<double> share_of_all(Fit& fit, double most, const std::vector<StandingSite>& initial, std::vector<StandingSite>& sites,
                            const FootprintFit& report, const FootprintFitOptions& options) {
  double low = 0, high = most;
  std::vector<StandingSite> best = initial;
  for (int k = 0; k < kScalings && !report.is_stopped; ++k) {
    const double middle = k == 0 ? 0.9 * most : 0.5 * (low + high);
    sites = best;
    const auto met = fit.run(middle, std::max(options.most_steps, kStepsOfATry));
    if (!met) return met.error();
    (*met ? low : high) = middle;
    if (*met) best = sites;
  }
  sites = best;
  if (auto done = fit.evaluate(); !done) return done.error();
  return low;
}

}  // namespace

double equal_footprint_weight(const FootprintDiagram& diagram, std::span<const StandingSite> sites,
                              std::span<const FloorDemand> demands) {
  double setback = 0;
  std::size_t count = 0;
  for (const FloorDemand& demand : demands)
    for (const std::uint32_t i : demand.sites) {
      ++count;
      for (const StoreyRun& run : sites[i].runs) setback = std::max(setback, run.setback);
    }
  if (count == 0) return 0;
  const double plot = diagram.plot_area(), fill = std::min(0.99, needed_plot(sites, demands) / plot);
  const double mean = std::max(fill, 1e-6) * plot / static_cast<double>(count);
  // Discs overlap the more, the fuller the plot is; the mean share that is not covered is then about 1 - fill.
  const double enlarged = fill > 1e-6 ? -mathematics::logarithm_of_one_more(-fill) / fill : 1;
  const double own = std::sqrt(mean * enlarged / std::numbers::pi);
  // Where all were as large as one with a huge set-back needs, nobody would have a free side, and steps no direction.
  const double radius = own + std::min(setback, own);
  return radius * radius;
}

Result<FootprintFit> fit_footprints(FootprintDiagram& diagram, std::vector<StandingSite>& sites,
                                    std::span<const FloorDemand> demands, const FootprintFitOptions& options) {
  FootprintFit report;
  start(diagram, sites, demands);
  const std::vector<StandingSite> initial = sites;
  Fit fit(diagram, sites, demands, options, report);
  const double needed = needed_plot(sites, demands);
  const double most = !fit.fills_plot() && needed > (1 + 1e-9) * diagram.plot_area() ? diagram.plot_area() / needed : 1;
  Result<bool> met = most < 1 ? Result<bool>(false) : fit.run(1, options.most_steps);
  if (!met) return met.error();
  if (fit.fills_plot()) {
    report.factor = fit.factor();
    if (std::abs(report.factor - 1) > options.tolerance) {
      met = false;
      report.infeasible = "all footprints are whole cells, which share the plot: each volume has " +
                          fixed(100 * report.factor, 1) + " % of the floor area that it asks for";
    }
  } else if (!*met && !report.is_stopped && options.is_final && (most < 1 || fit.is_stalled())) {
    auto share = share_of_all(fit, most, initial, sites, report, options);
    for (int k = 0; share && *share == 0 && k < kMostLeftOut && !report.is_stopped; ++k) {
      if (!fit.leave_out_worst()) break;
      sites = initial;
      met = fit.run(1, std::max(options.most_steps, kStepsOfATry));
      if (!met) return met.error();
      if (*met) share = 1;
      else share = share_of_all(fit, 1, initial, sites, report, options);
    }
    if (!share) return share.error();
    report.factor = *share;
    if (*share < 1) report.infeasible = "the demands cannot be met together: " + fixed(100 * *share, 1) + " % of each can";
    met = false;
  }
  if (fit.left_out() > 0)
    report.infeasible += (report.infeasible.empty() ? "" : "; ") + std::to_string(fit.left_out()) +
                         " of the demands can have nothing, because no ground that the others leave is large enough";
  if (fit.doubled() > 0)
    report.infeasible += (report.infeasible.empty() ? "" : "; ") + std::to_string(fit.doubled()) +
                         " of the demands can have nothing, because their sites stand in the place of others";
  report.is_met = *met && fit.doubled() == 0 && fit.left_out() == 0;
  for (std::uint32_t g = 0; g < demands.size(); ++g) {
    const double error = fit.error_of(g, 1);
    if (error > report.error) {
      report.error = error;
      report.worst_demand = g;
    }
    const double had = fit.floor_of(g);
    if (!report.is_met && had < demands[g].least * (1 - options.tolerance)) report.losses.push_back({g, demands[g].least, had});
  }
  return report;
}

}  // namespace bl::geometry
