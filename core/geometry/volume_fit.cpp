// The one-call fit.
#include "core/geometry/volume_fit.h"

#include <cmath>
#include <utility>

namespace bl {

std::string_view name_of(FitStatus status) {
  switch (status) {
    case FitStatus::met: return "met";
    case FitStatus::infeasible: return "infeasible";
    case FitStatus::step_limit: return "step limit";
    case FitStatus::cancelled: return "cancelled";
  }
  return "unknown";
}

Result<VolumeFit> fit_volumes(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options) {
  std::vector<double> demands(problem.sites.size(), 0);
  std::vector<std::uint8_t> locked(problem.sites.size(), 1);
  for (const VolumeDemand& demand : problem.demands) {
    for (const std::uint32_t site : demand.sites) {
      demands[site] = demand.most / static_cast<double>(demand.sites.size());
      locked[site] = 0;
    }
  }
  auto fit = adapt_weights(domain, problem.sites, demands, locked, {},
                           {.method = options.method,
                            .gain = options.gain,
                            .steps = options.most_steps,
                            .tolerance = options.tolerance,
                            .pool = options.pool});
  if (!fit) return fit.error();
  VolumeFit result;
  result.weights = std::move(fit->weights);
  result.volumes = std::move(fit->volumes);
  result.iterations = result.evaluations = fit->steps;
  result.max_relative_error = fit->error;
  result.status = !fit->infeasible.empty() ? FitStatus::infeasible : fit->is_met ? FitStatus::met : FitStatus::step_limit;
  if (!fit->infeasible.empty()) result.reasons.push_back(fit->infeasible);
  return result;
}

}  // namespace bl
