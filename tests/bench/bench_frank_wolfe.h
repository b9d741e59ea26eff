// The yardstick of the bench for assignments: bi-conjugate Frank-Wolfe, as most planning programs use it.
#pragma once

#include <span>
#include <vector>

#include "core/traffic/bush.h"
#include "core/traffic/shortest_paths.h"

namespace bl::cli::bench {

/// Flows move along directions that are made of the shortest ways and the last two directions (Mitradjieva and Lindberg, The
/// stiff is moving, Transportation Science 47, 2013). Its shortest ways are our own, so that only the methods differ.
class FrankWolfe {
 public:
  /// Demands in ascending origin; what has no way is left out.
  FrankWolfe(traffic::TrafficNetwork network, std::vector<traffic::TripDemand> demands);

  /// Goes on from the flows as they are until the relative gap is reached; false where `most` iterations did not suffice.
  bool run(double gap, int most);
  /// The flows stay.
  void set_capacity(std::uint32_t link, double capacity);
  void set_flows(std::vector<double> flows);

  const std::vector<double>& flows() const { return flows_; }
  double gap() const { return gap_; }
  int iterations() const { return iterations_; }
  double objective() const;

 private:
  void load_shortest(std::vector<double>& target);
  void choose_target();
  double step_length(std::span<const double> direction) const;

  traffic::TrafficNetwork network_;
  std::vector<traffic::TripDemand> demands_;
  traffic::ShortestPaths paths_;
  std::vector<double> flows_, costs_, shortest_, target_, last_, before_last_;
  double last_step_ = 0, gap_ = 1;
  int directions_ = 0, iterations_ = 0;  // how many of the last targets can be used
};

}  // namespace bl::cli::bench
