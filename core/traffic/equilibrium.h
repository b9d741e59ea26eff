// User equilibrium: an assignment in which no trip has a cheaper route, found from a cold or a warm start.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/traffic/bush.h"
#include "core/traffic/shortest_trees.h"

namespace bl::traffic {

/// Trips that are not on the streets, and why.
struct LostTrips {
  std::uint32_t origin = 0, destination = 0;
  double trips = 0;
  std::string reason;
};

/// Where an assignment stands. Costs are generalised where factors were given.
struct EquilibriumFigures {
  int iterations = 0;
  double gap = 1;            ///< relative: the share of the total cost saved if each trip took its cheapest route now
  double objective = 0;      ///< Beckmann's: the sum of the areas under the cost curves
  double total_cost = 0;     ///< sum of flow · cost
  double shortest_cost = 0;  ///< the same with all trips on the cheapest routes at these costs
  double trips = 0;          ///< on the streets
  double lost = 0;           ///< trips that cannot reach their destination
  double within = 0;         ///< trips that begin and end in one zone and need no street
  double waiting = 0;        ///< trips that were not loaded, because the work was stopped before; the gap is 1 then
  std::size_t cut = 0;       ///< links whose cost is not that of the formula (`TrafficNetwork::is_cut`)
};

/// One way that trips of a pair use, or could use.
struct Route {
  std::vector<std::uint32_t> links;
  double trips = 0, cost = 0;
};

/// Holds the bushes of all origins. After an edit the flows stay where they are as far as they can: a warm start.
/// Origins take turns in ascending index, so that the result depends on network, demands and start alone.
class Equilibrium {
 public:
  /// Demands of one pair add up; those without trips are dropped. Starts with everybody on the shortest way, origin by origin.
  /// Where the work is stopped (`core/base/stop.h`) in between, the trips of the other origins wait: whoever wants them on the
  /// streets begins anew.
  Equilibrium(TrafficNetwork network, std::vector<TripDemand> demands, std::span<const OriginFlow> start = {});

  Equilibrium(const Equilibrium&) = delete;  // the bushes work on this very network
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// One iteration: bushes are improved, then flow is shifted until `sweeps` are done, or until used ways differ nowhere by more
  /// than the share `enough`: who wants no smaller gap need not sweep for it.
  void iterate(int sweeps = 8, double enough = 0);
  /// Iterates until the gap is reached; false where `most_iterations` did not suffice.
  bool run(double gap, int most_iterations, int sweeps = 8);

  /// Edits. Streets that change their capacity or time keep their flow. Closing, opening and other demands replant the bushes
  /// around the flow that is left.
  Result<void> set_capacity(std::uint32_t link, double capacity);
  Result<void> set_free_time(std::uint32_t link, double free_time);
  void set_open(std::uint32_t link, bool is_open);
  void set_demands(std::vector<TripDemand> demands);

  /// For whoever goes on from flows that were kept and knows the shortest ways of all origins: in two steps, because the demands
  /// may follow from the costs in between. load() puts the flows on the streets and begin() plants the bushes around them, with
  /// the ways of `trees`, which have to be those at the costs after load(). `flows` in ascending origin. What comes of it depends
  /// on nothing that was here before.
  void load(std::span<const BushFlows> flows);
  void begin(std::vector<TripDemand> demands, std::span<const BushFlows> flows, const ShortestTrees& trees);

  const TrafficNetwork& network() const { return network_; }
  /// Measures gap and totals of the state as it is.
  EquilibriumFigures figures();
  /// The same figures with the ways of `trees`, which are brought to the costs as they are.
  EquilibriumFigures figures(ShortestTrees& trees);
  const std::vector<double>& flows() const { return loads_.flows; }
  const std::vector<double>& costs() const { return loads_.costs; }
  const std::vector<LostTrips>& lost() const { return lost_; }
  const std::vector<TripDemand>& demands() const { return demands_; }
  const std::vector<Bush>& bushes() const { return bushes_; }
  /// Everything that a warm start needs, ascending origin and link.
  std::vector<OriginFlow> origin_flows() const;
  /// The ways that trips of a pair use, most used first: the flow of the bush taken apart.
  std::vector<Route> routes(std::uint32_t origin, std::uint32_t destination) const;

 private:
  void plant(std::span<const OriginFlow> start);
  template <class PlantOne>
  void plant_all(PlantOne&& plant_one);
  void add_up();
  EquilibriumFigures totals(double excess) const;

  TrafficNetwork network_;
  std::vector<TripDemand> demands_;  ///< ascending origin and destination
  std::vector<Bush> bushes_;         ///< ascending origin
  std::vector<LostTrips> lost_;
  LinkLoads loads_;
  BushWorker worker_;
  double within_ = 0, waiting_ = 0;
  int iterations_ = 0;
};

}  // namespace bl::traffic
