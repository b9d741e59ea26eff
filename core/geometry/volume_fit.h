// Weights that meet demands on volume or floor area, of single sites and of groups: the one-call door of the fit.
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
#include "core/geometry/power_cells.h"

namespace bl {

/// What one site, or several sites together (a stand, a building with wings), are to have.
struct VolumeDemand {
  enum class Kind : std::uint8_t { volume, floor_area };
  std::vector<std::uint32_t> sites;  ///< whose volumes are added up; a site belongs to one demand at most
  double least = 0, most = 0;        ///< [m³], or [m²] of floor; equal: exactly this much
  Kind kind = Kind::volume;
  double storey_height = 3;  ///< [m]; for floor areas only
};

/// A site that belongs to no demand keeps its weight.
struct FitProblem {
  std::vector<PowerSite> sites;  ///< weights to start from; not positive: the solver starts this one by itself
  std::vector<VolumeDemand> demands;
};

enum class FitStatus : std::uint8_t { met, infeasible, step_limit, cancelled };
/// "met", "infeasible", "step limit", "cancelled".
std::string_view name_of(FitStatus status);

struct VolumeFitOptions {
  FitMethod method = FitMethod::newton;
  double tolerance = 1e-6;  ///< of the largest relative error
  int most_steps = 200;     ///< evaluations of the diagram
  double gain = 0;          ///< [1/m], as in FitOptions
  ThreadPool* pool = nullptr;
  /// Called after each evaluation with the steps made and the largest error; false stops the fit with what it has.
  std::function<bool(int steps, double error)> progress;
};

/// A demand that is not met, and what it has instead.
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

/// Deterministic: the same arguments give the same bits with any number of threads. Fails on input that makes no sense
/// (non-finite numbers, an index that is not there, a site in two demands); demands that cannot be met are a status.
Result<VolumeFit> fit_volumes(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options = {});

}  // namespace bl
