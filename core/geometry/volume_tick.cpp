// The two ways of a tick: exact cells of the power metric, sampled ones of the others.
#include "core/geometry/volume_tick.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/differences.h"

namespace bl::geometry {

namespace {

void start_newcomers(const Domain& domain, std::span<PowerSite> sites, std::span<const double> wanted) {
  if (std::none_of(sites.begin(), sites.end(), [](const PowerSite& s) { return s.weight > 0; })) return;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!(sites[i].weight > 0)) {
      sites[i].weight = 0.5 * initial_weights(domain, sites.subspan(i, 1), wanted.subspan(i, 1)).front();
    }
  }
}

void take_weights(const FitReport& fit, std::span<PowerSite> sites) {
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = fit.weights[i];
}

// Marks the sites whose number in a list of the fit's state has changed; a list that is empty says nothing.
void mark_changes(const std::vector<double>& before, const std::vector<double>& after, std::vector<std::uint8_t>& differs) {
  if (before.size() == after.size()) {
    visit_differences(std::span(before), std::span(after), [&](std::uint32_t i) { differs[i] |= before[i] != after[i]; });
    return;
  }
  for (std::size_t i = 0; i < differs.size(); ++i)
    if ((before.empty() ? 0 : before[i]) != (after.empty() ? 0 : after[i])) differs[i] = 1;
}

// `made`: the sites whose cells were made.
void find_differing(const FitState& before, std::span<const std::uint32_t> made, const StanceFinder& stances,
                    VolumeTick::Outcome& outcome) {
  outcome.stances = stances.stances();
  std::vector<std::uint8_t> differs(outcome.stances.size(), 0);
  for (const std::uint32_t i : made) differs[i] = 1;
  for (const std::uint32_t i : stances.differing()) differs[i] = 1;
  mark_changes(before.previous_move, outcome.state.previous_move, differs);
  mark_changes(before.direction, outcome.state.direction, differs);
  for (std::uint32_t i = 0; i < differs.size(); ++i)
    if (differs[i]) outcome.differing.push_back(i);
}

}  // namespace

Result<VolumeTick::Outcome> VolumeTick::run(const Domain& domain, std::vector<PowerSite>& sites, std::span<const double> wanted,
                                            const FitState& state, Cache& kept) const {
  if (steps > 0) start_newcomers(domain, sites, wanted);
  return metric == Metric::power ? run_exact(domain, sites, wanted, state, kept)
                                 : run_sampled(domain, sites, wanted, state, kept);
}

Result<VolumeTick::Outcome> VolumeTick::run_exact(const Domain& domain, std::vector<PowerSite>& sites,
                                                  std::span<const double> wanted, const FitState& state, Cache& kept) const {
  FitReport fit;
  if (steps <= 0) {
    fit.state = state;
  } else {
    const FitOptions options{.method = method,
                             .gain = gain,
                             .steps = steps,
                             .tolerance = tolerance,
                             .is_local = true,
                             .pool = pool,
                             .diagram = &kept.cells,
                             .with_whole_cells = true};
    auto adapted = adapt_weights(domain, sites, wanted, {}, state, options);
    if (!adapted) return adapted.error();
    fit = std::move(*adapted);
    take_weights(fit, sites);
  }
  // The fit has made most of these cells. What people read of them is measured once, of those that it ends with.
  if (auto set = kept.cells.set_domain(domain); !set) return set.error();
  const auto made = kept.cells.update(sites, {.with_storeys = false, .with_outlines = true, .pool = pool});
  if (!made) return made.error();
  const auto cells = kept.cells.complete(
      {.storey_heights = storey_heights, .with_coarse_mesh = true, .tessellation_depth = tessellation_depth, .pool = pool});
  if (!cells) return cells.error();
  Outcome outcome{std::move(fit.state), std::move(fit.losses), "", *cells, {}, {}};
  kept.stances.update(domain, sites, *cells, standing, kept.cells.completed());
  find_differing(state, kept.cells.completed(), kept.stances, outcome);
  return outcome;
}

Result<VolumeTick::Outcome> VolumeTick::run_sampled(const Domain& domain, std::vector<PowerSite>& sites,
                                                    std::span<const double> wanted, const FitState& state, Cache& kept) const {
  // Weights that the power metric has left below zero are no radii.
  for (PowerSite& site : sites) site.weight = std::max(0.0, site.weight);
  const SampledFitOptions options{
      .metric = metric, .samples = samples, .tolerance = tolerance, .most_steps = steps, .pool = pool, .diagram = &kept.lines};
  auto fit = adapt_sampled_weights(domain, sites, wanted, {}, state, options);
  if (!fit) return fit.error();
  take_weights(fit->report, sites);
  auto cells = kept.lines.measure(sites, {.metric = metric, .samples = samples, .storey_heights = storey_heights, .pool = pool});
  if (!cells) return cells.error();
  kept.sampled = std::move(*cells);
  Outcome outcome{
      std::move(fit->report.state), std::move(fit->report.losses), std::move(fit->resolution), kept.sampled.cells, {}, {}};
  std::vector<std::uint32_t> all(sites.size());
  std::iota(all.begin(), all.end(), 0u);
  kept.stances.update(domain, sites, kept.sampled.cells, standing, all);
  // Stances and the exact cells, which are made anew in the next exact tick, no longer belong together.
  kept.cells = PowerDiagram();
  find_differing(state, all, kept.stances, outcome);
  return outcome;
}

}  // namespace bl::geometry
