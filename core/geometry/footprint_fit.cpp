// Finds the weights of standing sites for demands on floor area; see the README under "Standing volumes".
#include "core/geometry/footprint_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/geometry/inside/footprint_newton.h"

namespace bl::geometry {

namespace {

constexpr int kScalings = 7, kStepsOfATry = 30, kMostLeftOut = 4, kMostRaises = 120, kMostCandidates = 4;
// Parts of the equal weights, from which fits start that lead nowhere otherwise: the smaller forms are, the more of them end
// inside their cells.
constexpr double kLooseStarts[] = {0.02, 0.0005};

// The plot that a demand needs at the least: each plate is a whole footprint.
double needed_plot(std::span<const StandingSite> sites, const FloorDemand& demand) {
  int most = 0;
  for (const std::uint32_t i : demand.sites) most = std::max(most, sites[i].storeys());
  return most > 0 ? demand.least / most : 0;
}

// Of discs that would cover, without overlaps, `share` of what all demands need.
double equal_weight(double plot, std::span<const StandingSite> sites, std::span<const FloorDemand> demands, double share) {
  double setback = 0, needed = 0;
  std::size_t count = 0;
  for (const FloorDemand& demand : demands) {
    needed += needed_plot(sites, demand);
    for (const std::uint32_t i : demand.sites) {
      ++count;
      for (const StoreyRun& run : sites[i].runs) setback = std::max(setback, run.setback);
    }
  }
  if (count == 0) return 0;
  const double fill = std::min(0.99, needed / plot);
  const double mean = std::max(fill, 1e-6) * plot / static_cast<double>(count);
  // Discs overlap the more, the fuller the plot is; the mean share that is not covered is then about 1 - fill.
  const double enlarged = fill > 1e-6 ? -mathematics::logarithm_of_one_more(-fill) / fill : 1;
  const double own = std::sqrt(share * mean * enlarged / std::numbers::pi);
  // Where all were as large as one with a huge set-back needs, nobody would have a free side, and steps no direction.
  const double radius = own + std::min(setback, own);
  return radius * radius;
}

void start(const FootprintDiagram& diagram, std::vector<StandingSite>& sites, std::span<const FloorDemand> demands) {
  // A cell without a form may well have a weight below zero; one that has none yet has exactly zero.
  const auto has_weight = [](const StandingSite& s) {
    return s.form == FootprintForm::cell ? s.site.weight != 0 : s.site.weight > 0;
  };
  const bool is_fresh = std::none_of(sites.begin(), sites.end(), has_weight);
  std::vector<std::uint8_t> had_weight;
  for (const StandingSite& site : sites) had_weight.push_back(has_weight(site) ? 1 : 0);
  // Who comes to a place where another one has a footprint does not take it from there.
  const auto is_taken = [&](const Point3& at) {
    for (std::size_t j = 0; j < sites.size(); ++j)
      if (had_weight[j] != 0 && sites[j].site.position.x == at.x && sites[j].site.position.y == at.y) return true;
    return false;
  };
  const double equal = is_fresh ? equal_footprint_weight(diagram, sites, demands) : 0;
  for (const FloorDemand& demand : demands)
    for (const std::uint32_t i : demand.sites) {
      if (!(demand.most > 0)) sites[i].site.weight = weight_of_nothing(sites[i], diagram);
      if (has_weight(sites[i]) || !(demand.most > 0)) continue;
      if (!is_fresh && is_taken(sites[i].site.position)) {
        sites[i].site.weight = weight_of_nothing(sites[i], diagram);
        continue;
      }
      // Newcomers among others start with half of what they need, so that they hide nobody.
      const double own =
          0.5 * demand.least / (std::numbers::pi * std::max(1, sites[i].storeys()) * static_cast<double>(demand.sites.size()));
      sites[i].site.weight = is_fresh ? equal : std::max(own, 1e-6);
    }
}

// Weights on the way to demands, and the places from which they may set out.
class DemandSearch {
 public:
  DemandSearch(FootprintNewton& newton, const FootprintDiagram& diagram, std::vector<StandingSite>& sites,
               std::span<const FloorDemand> demands, const FootprintFitOptions& options, const FootprintFit& report)
      : newton_(newton), sites_(sites), report_(report), steps_(std::max(options.most_steps, kStepsOfATry)), starts_{sites} {
    const double plot = diagram.plot_area();
    for (const double share : kLooseStarts) {
      const double weight = equal_weight(plot, sites, demands, share);
      std::vector<StandingSite>& loose = starts_.emplace_back(sites);
      for (const FloorDemand& demand : demands)
        for (const std::uint32_t i : demand.sites)
          if (demand.most > 0) {
            // What parts the weights of a group stays as it is.
            const double beside = sites[i].site.weight - sites[demand.sites.front()].site.weight;
            const bool is_cell = sites[i].form == FootprintForm::cell;
            loose[i].site.weight = is_cell ? weight + beside : std::max(weight + beside, 1e-6);
          }
    }
  }

  // All demands at once, from the start with that number and, where steps lead nowhere from there, from the next.
  Result<bool> run_again(std::size_t first) {
    Result<bool> met = false;
    for (std::size_t k = first; k < starts_.size() && !report_.is_stopped; ++k) {
      sites_ = starts_[k];
      met = newton_.run(1, steps_, false);
      if (!met || *met) break;
    }
    return met;
  }

  // The largest share of all demands that can be met; where there is none, of those that do not stand in the way of all others.
  Result<double> compromise(double most) {
    auto share = largest_share(most);
    for (int k = 0; share && *share == 0 && k < kMostLeftOut && !report_.is_stopped; ++k) {
      if (!newton_.leave_out_worst()) break;
      const auto met = run_again(0);
      if (!met) return met.error();
      share = *met ? Result<double>(1.0) : largest_share(1);
    }
    return share;
  }

  // Where the largest share of all has been found: those whose footprints touch nobody who stands in the way get all that they
  // ask for, and so do all but one of a group that touch each other, where it is that one. The others have the largest share that
  // is left for them, which `share` becomes: how many.
  Result<std::size_t> raise_others(double& share) {
    const std::vector<std::vector<std::uint32_t>> groups = newton_.touching();
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& group : groups) all.insert(all.end(), group.begin(), group.end());
    for (const std::uint32_t g : all) newton_.aim(g, share);
    tries_ = 0;
    std::vector<std::uint32_t> raised;
    // All of them at once could not be met before. Their halves are tried, and the halves of those.
    std::vector<Part> parts;
    if (groups.size() > 1) parts = halves_of({0, groups.size()});
    else if (!groups.empty()) parts = {{0, 1}};
    while (!parts.empty() && !report_.is_stopped) {
      const Part part = parts.back();
      parts.pop_back();
      std::vector<std::uint32_t> members;
      for (std::size_t k = part.first; k < part.first + part.count; ++k)
        members.insert(members.end(), groups[k].begin(), groups[k].end());
      const auto done = groups.size() > 1 ? raise(members, share) : Result<bool>(false);
      if (!done) return done.error();
      if (*done) {
        raised.insert(raised.end(), members.begin(), members.end());
      } else if (part.count > 1) {
        for (const Part& half : halves_of(part)) parts.push_back(half);
      } else if (const auto others = raise_all_but_one(members, share); !others) {
        return others.error();
      } else raised.insert(raised.end(), others->begin(), others->end());
    }
    std::ranges::sort(all);
    std::ranges::sort(raised);
    std::vector<std::uint32_t> kept;
    std::ranges::set_difference(all, raised, std::back_inserter(kept));
    if (!raised.empty() && !kept.empty())
      if (auto done = share_among(kept, share); !done) return done.error();
    return kept.size();
  }

 private:
  struct Part {
    std::size_t first = 0, count = 0;
  };
  static std::vector<Part> halves_of(const Part& part) {
    const std::size_t half = part.count / 2;
    return {{part.first + half, part.count - half}, {part.first, half}};
  }

  // Can these have all that they ask for, and the others what they have? If not, or after too many tries, all stays as it is.
  Result<bool> raise(std::span<const std::uint32_t> demands, double share) {
    if (tries_ >= kMostRaises) return false;
    ++tries_;
    const std::vector<StandingSite> before = sites_;
    for (const std::uint32_t g : demands) newton_.aim(g, FootprintNewton::kAll);
    const auto met = newton_.run(1, steps_);
    if (!met || *met) return met;
    for (const std::uint32_t g : demands) newton_.aim(g, share);
    sites_ = before;
    if (auto done = newton_.evaluate(); !done) return done.error();
    return false;
  }

  // The largest share of these, where all others keep what they have; by halving, from the share that they have.
  Result<void> share_among(const std::vector<std::uint32_t>& kept, double& share) {
    std::vector<StandingSite> best = sites_;
    double high = 1;
    for (int k = 0; k < kScalings && !report_.is_stopped; ++k) {
      const double middle = 0.5 * (share + high);
      for (const std::uint32_t g : kept) newton_.aim(g, middle);
      sites_ = best;
      const auto met = newton_.run(1, steps_);
      if (!met) return met.error();
      (*met ? share : high) = middle;
      if (*met) best = sites_;
    }
    for (const std::uint32_t g : kept) newton_.aim(g, share);
    sites_ = best;
    return newton_.evaluate();
  }

  // Who gains least by more weight is tried first. Who has been raised.
  Result<std::vector<std::uint32_t>> raise_all_but_one(const std::vector<std::uint32_t>& group, double share) {
    if (group.size() < 2) return std::vector<std::uint32_t>{};
    std::vector<std::uint32_t> candidates = group;
    std::ranges::sort(candidates, {}, [&](std::uint32_t g) { return std::pair(newton_.gain_of(g), g); });
    candidates.resize(std::min<std::size_t>(candidates.size(), kMostCandidates));
    for (const std::uint32_t kept : candidates) {
      std::vector<std::uint32_t> others;
      std::ranges::copy_if(group, std::back_inserter(others), [&](std::uint32_t g) { return g != kept; });
      const auto done = raise(others, share);
      if (!done) return done.error();
      if (*done) return others;
    }
    return std::vector<std::uint32_t>{};
  }

  Result<double> largest_share(double most) {
    Result<double> share = 0.0;
    for (std::size_t k = 0; k < starts_.size() && !report_.is_stopped; ++k) {
      share = share_from(starts_[k], most);
      if (!share || *share > 0) return share;
    }
    sites_ = starts_.front();
    if (auto done = newton_.evaluate(); !done) return done.error();
    return share;
  }

  // By halving: each try starts from the best so far, whose weights the sites get.
  Result<double> share_from(const std::vector<StandingSite>& start, double most) {
    double low = 0, high = most;
    std::vector<StandingSite> best = start;
    for (int k = 0; k < kScalings && !report_.is_stopped; ++k) {
      const double middle = k == 0 ? 0.9 * most : 0.5 * (low + high);
      sites_ = best;
      const auto met = newton_.run(middle, steps_);
      if (!met) return met.error();
      (*met ? low : high) = middle;
      if (*met) best = sites_;
    }
    sites_ = best;
    if (auto done = newton_.evaluate(); !done) return done.error();
    return low;
  }

  FootprintNewton& newton_;
  std::vector<StandingSite>& sites_;
  const FootprintFit& report_;
  int steps_, tries_ = 0;
  std::vector<std::vector<StandingSite>> starts_;
};

// Weights of an earlier state may hide somebody so deep that it gets nothing however heavy it is made. Before it is left out, all
// start from equal weights.
Result<bool> run_first(FootprintNewton& newton, const FootprintDiagram& diagram, std::vector<StandingSite>& sites,
                       std::span<const FloorDemand> demands, const FootprintFitOptions& options, const FootprintFit& report) {
  const std::vector<StandingSite> initial = sites;
  const auto met = newton.run(1, options.most_steps);
  if (!met || *met || report.is_stopped || !newton.has_lost()) return met;
  sites = initial;
  const auto again = DemandSearch(newton, diagram, sites, demands, options, report).run_again(1);
  if (!again || *again) return again;
  sites = initial;
  return newton.run(1, options.most_steps);
}

void add_words(const std::string& words, FootprintFit& report) {
  report.infeasible += (report.infeasible.empty() ? "" : "; ") + words;
}

void add_losses(const FootprintNewton& newton, std::span<const FloorDemand> demands, double tolerance, FootprintFit& report) {
  for (std::uint32_t g = 0; g < demands.size(); ++g) {
    const double error = newton.error_of(g, 1);
    if (error > report.error) {
      report.error = error;
      report.worst_demand = g;
    }
    const double had = newton.floor_of(g);
    if (!report.is_met && had < demands[g].least * (1 - tolerance)) report.losses.push_back({g, demands[g].least, had});
  }
}

// Those that may have what they ask for.
std::size_t count_of_asking(const FootprintNewton& newton, std::span<const FloorDemand> demands) {
  std::size_t count = 0;
  for (std::uint32_t g = 0; g < demands.size(); ++g) count += newton.counts(g) ? 1 : 0;
  return count;
}

// What cannot be met together is met in shares. Has everybody all after that?
Result<bool> share_out(DemandSearch& search, const FootprintNewton& newton, std::span<const FloorDemand> demands, double most,
                       FootprintFit& report) {
  bool is_met = false;
  auto share = search.compromise(most);
  if (!share) return share.error();
  if (*share == 0) {
    add_words("the demands cannot be met together, nor in any share of all: the weights stay as they are", report);
  } else if (*share < 1) {
    // Where all need more ground than there is, nobody gets all without another who goes without: no time is spent on that.
    const auto short_of = most < 1 ? Result<std::size_t>(count_of_asking(newton, demands)) : search.raise_others(*share);
    if (!short_of) return short_of.error();
    const std::size_t asking = count_of_asking(newton, demands);
    is_met = *short_of == 0;
    if (is_met) *share = 1;
    else
      add_words((*short_of < asking ? std::to_string(*short_of) + " of the demands cannot be met"
                 : asking > 1       ? "the demands cannot be met together"
                                    : "the demand cannot be met") +
                    std::string(": ") + fixed(100 * *share, 1) + (*short_of == 1 ? " % of it can" : " % of each can"),
                report);
  }
  report.factor = *share;
  return is_met;
}

}  // namespace

double equal_footprint_weight(const FootprintDiagram& diagram, std::span<const StandingSite> sites,
                              std::span<const FloorDemand> demands) {
  return equal_weight(diagram.plot_area(), sites, demands, 1);
}

Result<FootprintFit> fit_footprints(FootprintDiagram& diagram, std::vector<StandingSite>& sites,
                                    std::span<const FloorDemand> demands, const FootprintFitOptions& options) {
  FootprintFit report;
  start(diagram, sites, demands);
  FootprintNewton newton(diagram, sites, demands, options, report);
  if (auto done = newton.prepare(); !done) return done.error();
  const std::vector<StandingSite> initial = sites;
  double needed = 0;
  for (std::uint32_t g = 0; g < demands.size(); ++g)
    if (newton.may_have(g)) needed += needed_plot(sites, demands[g]);
  const double most = !newton.fills_plot() && needed > (1 + 1e-9) * diagram.plot_area() ? diagram.plot_area() / needed : 1;
  Result<bool> met = most < 1 ? Result<bool>(false) : run_first(newton, diagram, sites, demands, options, report);
  while (met && !*met && most == 1 && newton.leave_out_lost()) {
    sites = initial;
    met = newton.run(1, options.most_steps);
  }
  if (!met) return met.error();
  if (newton.fills_plot()) {
    report.factor = newton.factor();
    if (std::abs(report.factor - 1) > options.tolerance) {
      met = false;
      add_words("all footprints are whole cells, which share the plot: each volume has " + fixed(100 * report.factor, 1) +
                    " % of the floor area that it asks for",
                report);
    }
  } else if (!*met && !report.is_stopped && options.is_final && (most < 1 || newton.is_stalled())) {
    sites = initial;
    DemandSearch search(newton, diagram, sites, demands, options, report);
    if (most == 1) met = search.run_again(1);
    if (!met) return met.error();
    if (!*met && !report.is_stopped) met = share_out(search, newton, demands, most, report);
    if (!met) return met.error();
  }
  if (newton.left_out() > 0)
    add_words(std::to_string(newton.left_out()) +
                  " of the demands can have nothing, because no ground that the others leave is large enough",
              report);
  if (newton.doubled() > 0)
    add_words(
        std::to_string(newton.doubled()) + " of the demands can have nothing, because their sites stand in the place of others",
        report);
  report.is_met = *met && newton.doubled() == 0 && newton.left_out() == 0;
  add_losses(newton, demands, options.tolerance, report);
  return report;
}

}  // namespace bl::geometry
