// Finds weights that meet demands on volume or floor area, of single sites and of groups, in one call.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/demand_fit.h"
#include "core/geometry/domain.h"
#include "core/geometry/fit_problem.h"

namespace bl::geometry {

enum class FitStatus : std::uint8_t { met, infeasible, step_limit, cancelled };
/// "met", "infeasible", "step limit", "cancelled".
std::string_view name_of(FitStatus status);

struct VolumeFitOptions {
  FitMethod method = FitMethod::newton;
  double tolerance = 1e-6;  ///< of the largest relative error
  int most_steps = 200;     ///< evaluations of the diagram
  double gain = 0;          ///< [1/m], as in FitOptions
  ThreadPool* pool = nullptr;
  /// Called after each evaluation with the steps made and the largest error; if it returns false, the fit stops with its present
  /// result.
  std::function<bool(int steps, double error)> progress;
};

/// A demand that is not met, and its actual value.
struct VolumeLoss {
  std::uint32_t demand = 0;    ///< index into FitProblem::demands
  double wanted = 0, had = 0;  ///< in the demand's own unit
};

struct VolumeFit {
  std::vector<double> weights;    ///< [m²], usable whatever the status
  std::vector<double> volumes;    ///< [m³] of these weights, per site
  int iterations = 0;             ///< steps of the method
  int evaluations = 0;            ///< of the diagram, those of taken-back steps among them
  double max_relative_error = 0;  ///< of the demands as they were asked for
  std::uint32_t worst_demand = 0;
  FitStatus status = FitStatus::met;
  std::vector<std::string> reasons;  ///< sentences; sites are named `site N`, demands by their sites
  std::vector<VolumeLoss> losses;
};

/// Deterministic: the same arguments give the same bits with any number of threads. Fails on invalid input (non-finite numbers,
/// an unknown index, a site in two demands). Demands that cannot be met are reported as a status.
Result<VolumeFit> fit_volumes(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options = {});

}  // namespace bl::geometry
