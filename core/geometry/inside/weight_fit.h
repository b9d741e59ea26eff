// A fit at work: what its start, its steps and its judgement share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/demand_fit.h"
#include "core/geometry/domain.h"
#include "core/geometry/inside/fit_targets.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// One call of adapt_weights(). Start and judgement are in demand_fit.cpp, the steps in feedback_step.cpp and newton_step.cpp.
class WeightFit {
 public:
  /// A weight never falls below this share of the weight whose whole ball has the demanded volume.
  static constexpr double kLeastShare = 1e-4;
  /// So many sites make a local step worthwhile.
  static constexpr std::size_t kLeastForLocal = 100;

  WeightFit(const Domain& domain, std::span<const PowerSite> sites, FitTargets targets, const FitState& state,
            const FitOptions& options);
  Result<FitReport> run();

 private:
  using Cells = std::span<const CellMeasure>;

  bool is_fitted(std::size_t i) const { return targets_.is_fitted(i); }
  bool moves(std::size_t i) const {
    return is_fitted(i) && targets_.is_active(targets_.owner(i)) && (movers_.empty() || movers_[targets_.owner(i)]);
  }
  double missing(Cells cells, std::size_t i) const;
  /// Few sites are fitted together at little cost, and come out more exactly.
  bool is_local() const { return options_.is_local && sites_.size() >= kLeastForLocal; }

  // Start and judgement.
  void recognise(std::span<const PowerSite> sites);
  void start_fresh_sites();
  bool has_lost_cells(Cells cells) const;
  void begin_evenly();
  bool start_full();
  void keep_in_bounds();
  void judge(std::span<const double> volumes);
  double repaired_weight(std::size_t i) const;
  void move(Cells cells);

  // Feedback.
  void move_alone(Cells cells);
  void move_by_gain(Cells cells);

  // Newton.
  void move_together(Cells cells);
  void take_back(double share);
  void move_groups_alike(std::span<const double> from);
  void raise(std::uint32_t target, std::vector<double>& weights) const;
  void repair_offenders(std::span<const std::uint32_t> offenders);
  void repair(Cells cells);
  /// What the linear response asks for.
  struct Step {
    std::vector<std::uint32_t> sites;  ///< that take part
    std::vector<double> change;        ///< of weight [m²], of each of them
  };
  Step local_step(Cells cells);
  bool add_movers(Cells cells, const Step& step);
  Step solve(Cells cells);
  std::vector<double> wanted_changes(std::span<const std::uint32_t> targets) const;
  void step_together(Cells cells, double residual);
  bool is_idle(Cells cells, std::size_t i, double change) const;
  void follow(std::size_t i, double from);

  const Domain& domain_;
  FitOptions options_;
  std::vector<PowerSite> sites_;
  FitTargets targets_;
  FitReport report_;
  std::vector<double> even_;               // weights that rays have left for better ones
  std::vector<std::uint32_t> missed_;      // targets that are missed by more than the tolerance, ascending
  std::vector<std::uint8_t> movers_;       // per target: does it take part in the next step? Empty: all do
  std::vector<std::uint32_t> moving_;      // the targets that do where not all do, ascending
  std::vector<double> totals_;             // per target: what a step of some may lead to; what targets_ has between two of them
  std::vector<std::uint32_t> unknown_of_;  // per site, of the linear response; between two solutions all stay
};

}  // namespace bl::geometry
