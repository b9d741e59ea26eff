// One damped Newton step after the other, in the potentials of any metric, on sampled volumes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/demand_fit.h"
#include "core/geometry/inside/fit_targets.h"
#include "core/geometry/inside/sampled_diagram.h"

namespace bl::geometry {

/// The fit as a thing that is measured and moved in turn: measure(), look at error() and is_met(), then move() or stop.
class SampledNewton {
 public:
  struct Options {
    Metric metric = Metric::power;
    int samples = 96;
    double tolerance = 0.01;
    ThreadPool* pool = nullptr;
  };

  /// `diagram` holds the domain's lines.
  SampledNewton(const Domain& domain, const SampledDiagram& diagram, std::span<const PowerSite> sites, FitTargets targets,
                const FitState& state, const Options& options);

  Result<void> measure();
  void move();

  /// Is every demand within the tolerance, or within the declared error of its volume where that is more?
  bool is_met() const { return is_met_; }
  /// Is every demand within the tolerance, or within a tenth of the declared error? Further steps would change nothing that the
  /// samples can tell.
  bool is_settled() const { return is_settled_; }
  double error() const { return error_; }
  std::uint32_t worst() const { return worst_; }
  int evaluations() const { return evaluations_; }
  int iterations() const { return iterations_; }
  std::span<const PowerSite> sites() const { return sites_; }
  const SampledCells& cells() const { return cells_; }
  const FitTargets& targets() const { return targets_; }
  const FitState& state() const { return state_; }
  /// The share of a demand that its declared error is: no volume is known better than that.
  double resolution(std::size_t target) const;
  /// A sentence where that is more than the tolerance for some demand; empty otherwise.
  std::string resolution_text() const;

 private:
  bool moves(std::size_t i) const { return targets_.is_fitted(i) && targets_.is_active(targets_.owner(i)); }
  void start_fresh_sites();
  bool start_full();
  void keep_in_bounds();
  void judge();
  double scale() const;
  void step(double residual);
  void take_back(double share);
  void follow(std::size_t i, double from);
  double repaired_weight(std::size_t i) const;
  void repair();
  void recognise();

  const Domain& domain_;
  const SampledDiagram& diagram_;
  Options options_;
  std::vector<PowerSite> sites_;
  FitTargets targets_;
  FitState state_;
  SampledCells cells_;
  double error_ = 0;
  std::uint32_t worst_ = 0;
  int evaluations_ = 0, iterations_ = 0;
  bool is_met_ = false, is_settled_ = false;
};

}  // namespace bl::geometry
