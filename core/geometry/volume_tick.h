// One tick of a SmartVolumes solver: some steps of the fit, then the cells, under any metric.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/demand_fit.h"
#include "core/geometry/inside/sampled_fit.h"
#include "core/geometry/inside/stance_finder.h"
#include "core/geometry/standing.h"

namespace bl::geometry {

struct VolumeTick {
  Metric metric = Metric::power;
  int samples = 64;                      ///< not for the power metric, which is exact
  FitMethod method = FitMethod::newton;  ///< power metric only: the others always take Newton steps
  double gain = 0;                       ///< [1/m], as in FitOptions
  int steps = 4;                         ///< 0: the cells of the present weights
  double tolerance = 0.005;
  int tessellation_depth = 1;
  std::span<const double> storey_heights = {};  ///< [m], per site
  std::span<const Standing> standing = {};      ///< per site: what it may stand on
  ThreadPool* pool = nullptr;

  /// Cells and lines of the last tick, so that unchanged ones are not computed again. It changes no bit.
  struct Cache {
    PowerDiagram cells;
    SampledDiagram lines;
    SampledCells sampled;
    StanceFinder stances;
  };

  struct Outcome {
    FitState state;
    std::vector<DemandLoss> losses;
    std::string note;                    ///< a sentence where samples are too coarse for the tolerance; empty otherwise
    std::span<const CellMeasure> cells;  ///< in `kept`, valid until its next use
    std::span<const Stance> stances;     ///< likewise
    /// Ascending: the sites whose cell or stance may differ from those of the last run with `kept`, or whose part of the fit's
    /// state differs from the one given.
    std::vector<std::uint32_t> differing;
  };

  /// Moves the weights of `sites` towards `wanted` [m³] and measures their cells. New sites among settled ones start small, so
  /// that they displace none; where all are new, the fit starts them all alike.
  Result<Outcome> run(const Domain& domain, std::vector<PowerSite>& sites, std::span<const double> wanted, const FitState& state,
                      Cache& kept) const;

 private:
  Result<Outcome> run_exact(const Domain& domain, std::vector<PowerSite>& sites, std::span<const double> wanted,
                            const FitState& state, Cache& kept) const;
  Result<Outcome> run_sampled(const Domain& domain, std::vector<PowerSite>& sites, std::span<const double> wanted,
                              const FitState& state, Cache& kept) const;
};

}  // namespace bl::geometry
