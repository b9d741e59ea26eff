// Finds the weights with which standing volumes have the floor areas that are asked for.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/footprint.h"

namespace bl::geometry {

/// What one site, or several sites together, should have.
struct FloorDemand {
  std::vector<std::uint32_t> sites;  ///< a site belongs to one demand at most; their weights move alike
  double least = 0, most = 0;        ///< [m²] of plates; equal: exactly this much
};

struct FootprintFitOptions {
  double tolerance = 1e-6;  ///< largest |floor area - demand| as a share of the demand
  int most_steps = 60;      ///< Newton steps
  bool is_local = false;    ///< where few miss their demands, only these and those around them move
  bool is_final = true;     ///< where demands cannot be met, all are scaled by the largest factor that can be found
  ThreadPool* pool = nullptr;
  std::function<bool(int evaluations, double error)> progress;  ///< may be empty; false stops the fit
};

struct FloorLoss {
  std::uint32_t demand = 0;
  double wanted = 0, had = 0;  ///< [m²]
};

struct FootprintFit {
  int steps = 0, evaluations = 0;
  double error = 0;                ///< largest relative error of a demand as it was given
  std::uint32_t worst_demand = 0;  ///< which has it
  bool is_met = false, is_stopped = false;
  double factor = 1;              ///< by which demands were scaled, where they cannot be met together
  std::string infeasible;         ///< a sentence where they cannot; else empty
  std::vector<FloorLoss> losses;  ///< those that have less than they asked for
};

/// Equal weights [m²] from which no site inside a plot is empty; a common radius from the mean demand.
double equal_footprint_weight(const FootprintDiagram& diagram, std::span<const StandingSite> sites,
                              std::span<const FloorDemand> demands);

/// Damped Newton steps from the weights of `sites`, which it changes; where none is positive, from equal ones. The matrix is not
/// symmetric where set-backs differ. A site that belongs to no demand keeps its weight. Pure: the same arguments give the same
/// bits, whatever `diagram` has measured before.
Result<FootprintFit> fit_footprints(FootprintDiagram& diagram, std::vector<StandingSite>& sites,
                                    std::span<const FloorDemand> demands, const FootprintFitOptions& options = {});

}  // namespace bl::geometry
