// Weights that meet demands under any metric, by the sampled diagram: the reports of the exact fit, as fine as the samples allow.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "core/geometry/demand_fit.h"
#include "core/geometry/inside/sampled_diagram.h"
#include "core/geometry/volume_fit.h"

namespace bl::geometry {

struct SampledFitOptions {
  Metric metric = Metric::power;
  int samples = 96;         ///< as in SampleOptions
  double tolerance = 0.01;  ///< of the largest relative error; where the samples resolve less, a demand is met when its volume is
                            ///< within its declared error, and the report says so
  int most_steps = 100;     ///< evaluations of the diagram at most
  ThreadPool* pool = nullptr;
  SampledDiagram* diagram = nullptr;  ///< kept between calls it saves the making of the domain's lines; it changes no bit
  /// Called after each evaluation with the steps made and the largest error; false stops the fit with what it has.
  std::function<bool(int steps, double error)> progress = {};
};

struct SampledSteps {
  FitReport report;
  std::string resolution;  ///< a sentence where the tolerance is finer than the samples resolve; empty otherwise
};

/// Takes up to `most_steps` damped Newton steps in the potentials of the metric (see Metric), as adapt_weights() does for the
/// exact cells: same state, same judgement of every step by the next evaluation, same scaling of too much demand. Pure.
Result<SampledSteps> adapt_sampled_weights(const Domain& domain, std::span<const PowerSite> sites,
                                           std::span<const double> demands, std::span<const std::uint8_t> locked,
                                           const FitState& state, const SampledFitOptions& options);

/// The one-call fit of fit_volumes() under any metric: groups, intervals, floor areas; status, reasons and losses as there.
/// `volumes` and errors are those of the samples. Deterministic: the same bits with any number of threads.
Result<VolumeFit> sampled_fit(const Domain& domain, const FitProblem& problem, const SampledFitOptions& options = {});

}  // namespace bl::geometry
