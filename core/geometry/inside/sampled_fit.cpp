// The two doors of the sampled fit: some steps of a tick, and the whole fit with its reasons.
#include "core/geometry/inside/sampled_fit.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "core/base/text.h"
#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/inside/fit_outcome.h"
#include "core/geometry/inside/fit_targets.h"
#include "core/geometry/inside/sampled_newton.h"

namespace bl::geometry {

namespace {

// Floor areas are met by correcting the volumes asked for, which mostly takes three or four rounds; where it does not, it ends.
constexpr int kMostSampledCorrections = 12;
// No smaller error for so many evaluations, and the fit is going nowhere.
constexpr int kSampledStalled = 25;

Result<void> check_sampled(const SampledFitOptions& options) {
  if (options.most_steps < 1) return Error{ErrorCode::out_of_range, "", "a fit takes at least one step"};
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    return Error{ErrorCode::out_of_range, "", "the tolerance has to be above zero"};
  }
  return {};
}

SampledNewton::Options newton_options(const SampledFitOptions& options) {
  return {.metric = options.metric, .samples = options.samples, .tolerance = options.tolerance, .pool = options.pool};
}

class SampledAttempt {
 public:
  SampledAttempt(const Domain& domain, const FitProblem& problem, const SampledFitOptions& options)
      : domain_(domain),
        asked_(problem),
        problem_(problem),
        options_(options),
        diagram_(options.diagram != nullptr ? *options.diagram : own_) {}

  Result<VolumeFit> run() {
    if (auto set = diagram_.set_domain(domain_, options_.samples, options_.pool); !set) return set.error();
    has_floors_ = ask_for_volumes(problem_);
    if (auto done = fit(); !done) return done.error();
    for (int k = 0; has_floors_ && k < kMostSampledCorrections && !is_stopped_ && fit_.evaluations < options_.most_steps; ++k) {
      const auto cells = measure_storeys();
      if (!cells) return cells.error();
      if (correct_floors(asked_, cells->cells, options_.tolerance, problem_)) break;
      if (auto done = fit(); !done) return done.error();
    }
    return finish();
  }

 private:
  Result<void> fit() {
    newton_.emplace(domain_, diagram_, problem_.sites, FitTargets(problem_), FitState{}, newton_options(options_));
    double best = 1e300;
    for (int since = 0;;) {
      if (auto measured = newton_->measure(); !measured) return measured.error();
      ++fit_.evaluations;
      const bool goes_on = !options_.progress || options_.progress(fit_.evaluations, newton_->error());
      since = newton_->error() < 0.9 * best ? 0 : since + 1;
      best = std::min(best, newton_->error());
      is_stopped_ = !goes_on;
      if (newton_->is_settled() || !goes_on || fit_.evaluations >= options_.most_steps || since > kSampledStalled) break;
      newton_->move();
    }
    fit_.iterations += newton_->iterations();
    for (std::size_t i = 0; i < problem_.sites.size(); ++i) problem_.sites[i].weight = newton_->sites()[i].weight;
    return {};
  }

  Result<SampledCells> measure_storeys() const {
    const std::vector<double> storeys = storey_heights_of(domain_, asked_);
    return diagram_.measure(problem_.sites, {.metric = options_.metric,
                                             .samples = options_.samples,
                                             .storey_heights = storeys,
                                             .with_storeys = has_floors_,
                                             .pool = options_.pool});
  }

  Result<VolumeFit> finish() {
    const auto measured = measure_storeys();
    if (!measured) return measured.error();
    const std::span<const CellMeasure> cells = measured->cells;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      fit_.weights.push_back(problem_.sites[i].weight);
      fit_.volumes.push_back(cells[i].volume);
    }
    for (std::uint32_t k = 0; k < asked_.demands.size(); ++k) {
      const VolumeDemand& demand = asked_.demands[k];
      const double has = had(demand, cells), bound = std::clamp(has, demand.least, demand.most);
      const double error = bound > 0 ? std::abs(has - bound) / bound : has > 0 ? 1.0 : 0.0;
      const bool is_gone = bound > 0 && !(has > 0);
      if (is_gone || error > std::max(options_.tolerance, newton_->resolution(k))) fit_.losses.push_back({k, bound, has});
      if (!(error > fit_.max_relative_error)) continue;
      fit_.max_relative_error = error;
      fit_.worst_demand = k;
    }
    const bool cannot = !newton_->targets().infeasible().empty() || !newton_->targets().losses().empty();
    // Of a fit that was stopped with its volumes met, the floors may not have been.
    const bool is_cancelled = is_stopped_ && (!newton_->is_met() || (has_floors_ && !fit_.losses.empty() && !cannot));
    fit_.status = is_cancelled          ? FitStatus::cancelled
                  : fit_.losses.empty() ? FitStatus::met
                  : cannot              ? FitStatus::infeasible
                                        : FitStatus::step_limit;
    explain(cells);
    return std::move(fit_);
  }

  void explain(std::span<const CellMeasure> cells) {
    std::vector<std::string>& reasons = fit_.reasons;
    const FitTargets& targets = newton_->targets();
    if (!targets.infeasible().empty()) reasons.push_back(targets.infeasible());
    if (const std::string text = newton_->resolution_text(); !text.empty()) reasons.push_back(text);
    explain_losses(asked_, cells, fit_);
    if (fit_.status == FitStatus::step_limit && !has_floors_) {
      reasons.push_back("stopped after " + std::to_string(fit_.evaluations) + " evaluations with an error of " +
                        shortest(fit_.max_relative_error) + " at " + sites_text(asked_.demands[fit_.worst_demand]));
    }
  }

  const Domain& domain_;
  const FitProblem& asked_;
  FitProblem problem_;
  const SampledFitOptions& options_;
  SampledDiagram own_;
  SampledDiagram& diagram_;
  std::optional<SampledNewton> newton_;
  VolumeFit fit_;
  bool has_floors_ = false, is_stopped_ = false;
};

FitReport report_of(const SampledNewton& newton, int steps) {
  FitReport report;
  report.state = newton.state();
  report.error = newton.error();
  report.worst_site = newton.worst();
  report.steps = steps;
  report.iterations = newton.iterations();
  report.is_met = newton.is_met();
  report.infeasible = newton.targets().infeasible();
  report.losses = newton.targets().losses();
  for (const PowerSite& site : newton.sites()) report.weights.push_back(site.weight);
  for (const CellMeasure& cell : newton.cells().cells) report.volumes.push_back(cell.volume);
  for (std::size_t k = 0; k < newton.targets().size(); ++k) report.demands.push_back(newton.targets().aim(k));
  return report;
}

}  // namespace

Result<SampledSteps> adapt_sampled_weights(const Domain& domain, std::span<const PowerSite> sites,
                                           std::span<const double> demands, std::span<const std::uint8_t> locked,
                                           const FitState& state, const SampledFitOptions& options) try {
  if (auto checked = check_sampled(options); !checked) return checked.error();
  if (auto checked = check_demands(sites.size(), demands, locked); !checked) return checked.error();
  SampledDiagram own;
  SampledDiagram& diagram = options.diagram != nullptr ? *options.diagram : own;
  if (auto set = diagram.set_domain(domain, options.samples, options.pool); !set) return set.error();
  if (auto checked = check_sites(sites); !checked) return checked.error();
  SampledNewton newton(domain, diagram, sites, FitTargets(demands, locked), state, newton_options(options));
  int steps = 0;
  while (true) {
    if (auto measured = newton.measure(); !measured) return measured.error();
    ++steps;
    if (newton.is_settled() || (options.progress && !options.progress(steps, newton.error()))) break;
    newton.move();
    if (steps >= options.most_steps) break;
  }
  return SampledSteps{report_of(newton, steps), newton.resolution_text()};
} catch (const std::exception& trouble) {
  return Error{ErrorCode::internal, "", std::string("the sampled fit failed: ") + trouble.what()};
}

Result<VolumeFit> sampled_fit(const Domain& domain, const FitProblem& problem, const SampledFitOptions& options) try {
  if (domain.pieces.empty()) return Error{ErrorCode::geometry, "", "the domain is empty"};
  if (auto checked = check_sites(problem.sites); !checked) return checked.error();
  if (auto checked = check_demands(problem); !checked) return checked.error();
  if (auto checked = check_sampled(options); !checked) return checked.error();
  return SampledAttempt(domain, problem, options).run();
} catch (const std::exception& trouble) {
  return Error{ErrorCode::internal, "", std::string("the sampled fit failed: ") + trouble.what()};
}

}  // namespace bl::geometry
