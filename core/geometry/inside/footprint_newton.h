// The weights of standing sites on their way to the floor areas that are asked for: damped Newton steps, and what to do where
// they lead nowhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/footprint_fit.h"

namespace bl::geometry {

/// Of who has no footprint: no form, or so light a cell that there is none of it [m²].
double weight_of_nothing(const StandingSite& site, const FootprintDiagram& diagram);

class FootprintNewton {
 public:
  FootprintNewton(FootprintDiagram& diagram, std::vector<StandingSite>& sites, std::span<const FloorDemand> demands,
                  const FootprintFitOptions& options, FootprintFit& report);

  /// To be called first, and once: finds who can have nothing, in the place of others or without any ground within its set-backs.
  Result<void> prepare();
  /// Steps from the weights of the sites until the demands, times `factor`, are met. False: they are not, because no step brings
  /// them nearer (`is_stalled`), or because `most_steps` were not enough.
  /// Where it `ends_with_lost`, it ends at once if a site has nothing however heavy it was made (`has_lost`).
  Result<bool> run(double factor, int most_steps, bool ends_with_lost = true);
  static constexpr double kAll = 1e9;  ///< more than any part of a demand
  /// The largest part of what it asks for that a demand aims at, whatever the factor of a run is.
  void aim(std::uint32_t demand, double most) { aims_[demand] = most; }
  /// Measures the sites as they are.
  Result<void> evaluate();

  /// All footprints are whole cells: together they take the plot whatever the weights are, and demands are met by proportion
  /// only.
  bool fills_plot() const { return fills_plot_; }
  double factor() const { return factor_; }
  bool is_stalled() const { return is_stalled_; }
  std::size_t doubled() const { return count_of(kDoubled); }
  std::size_t left_out() const { return count_of(kLeftOut); }
  /// Where the demands cannot be met in any share, one of them may need what nobody can give it, such as a set-back that leaves
  /// it a plate only on most of the plot. Takes out the one that has least of what it wants; false: nobody is to be taken out.
  /// Of those that have nothing all are taken out together.
  bool leave_out_worst();
  /// Takes out those that had no floor before the last run, and whose sites, made ever heavier, got none. False: there are none.
  bool leave_out_lost();
  bool has_lost() const;
  bool may_have(std::uint32_t demand) const { return is_out_[demand] == 0; }
  /// It may have some floor, and asks for some.
  bool counts(std::uint32_t g) const { return is_out_[g] == 0 && !demands_[g].sites.empty() && demands_[g].most > 0; }
  /// Those that take part, parted into groups whose footprints touch each other, of their members and of nobody else.
  std::vector<std::vector<std::uint32_t>> touching() const;

  double floor_of(std::uint32_t demand) const;
  /// The part of what it asks for that a demand gains by more weight of its own [1/m²].
  double gain_of(std::uint32_t demand) const;
  double error_of(std::uint32_t demand, double factor) const;

 private:
  static constexpr std::uint8_t kDoubled = 1, kLeftOut = 2;

  std::size_t count_of(std::uint8_t why) const;
  double wanted(std::uint32_t g) const;
  Result<void> measure();
  void leave_doubled();
  void leave_groundless();
  bool is_lost(std::uint32_t g) const;
  void find_filled();
  void make_room();
  double error() const;
  double residual() const;
  double smallest_ratio() const;
  Result<void> repair();
  double heavier(std::uint32_t i, int round) const;
  std::vector<std::uint32_t> movable() const;
  std::vector<double> newton_move() const;
  Result<bool> take(const std::vector<double>& move);
  bool is_tight() const;
  void lower(const std::vector<double>& before, double by);
  double least_kept(const std::vector<double>& floors) const;
  Result<bool> loosen();

  FootprintDiagram& diagram_;
  std::vector<StandingSite>& sites_;
  std::span<const FloorDemand> demands_;
  const FootprintFitOptions& options_;
  FootprintFit& report_;
  std::vector<std::uint32_t> demand_of_;
  std::vector<std::uint8_t> is_out_;       // per demand: why it cannot have anything, or 0
  std::vector<std::uint8_t> began_empty_;  // per demand: had it no floor when the last run began?
  std::vector<double> floors_, aims_;
  double factor_ = 1, least_ratio_ = 0;
  double share_ = 1;  // of the last full step, that was taken
  int loosenings_ = 0;
  bool fills_plot_ = false, is_stalled_ = false;
};

}  // namespace bl::geometry
