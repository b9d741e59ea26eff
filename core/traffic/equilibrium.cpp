// Keeps the bushes of all origins together: starts, iterations, edits, figures and routes.
#include "core/traffic/equilibrium.h"

#include <algorithm>
#include <cmath>

#include "core/base/stop_check.h"

namespace bl::traffic {

namespace {

bool comes_before(const TripDemand& a, const TripDemand& b) {
  return a.origin != b.origin ? a.origin < b.origin : a.destination < b.destination;
}

// One entry for each pair, in order. Sums do not depend on the order given: equal pairs are added by ascending trips.
std::vector<TripDemand> tidied(std::vector<TripDemand> demands) {
  const auto is_wrong = [](const TripDemand& a, const TripDemand& b) { return !comes_before(a, b) || !(b.trips > 0); };
  const bool is_tidy = std::adjacent_find(demands.begin(), demands.end(), is_wrong) == demands.end();
  if (is_tidy && (demands.empty() || demands.front().trips > 0)) return demands;
  std::sort(demands.begin(), demands.end(), [](const TripDemand& a, const TripDemand& b) {
    return comes_before(a, b) || (!comes_before(b, a) && a.trips < b.trips);
  });
  std::vector<TripDemand> tidy;
  for (const TripDemand& demand : demands) {
    if (!(demand.trips > 0)) continue;
    if (!tidy.empty() && !comes_before(tidy.back(), demand)) tidy.back().trips += demand.trips;
    else tidy.push_back(demand);
  }
  return tidy;
}

}  // namespace

Equilibrium::Equilibrium(TrafficNetwork network, std::vector<TripDemand> demands, std::span<const OriginFlow> start)
    : network_(std::move(network)), demands_(tidied(std::move(demands))), loads_(network_), worker_(network_) {
  plant(start);
}

// A warm start sees the costs of its own flows; a cold one loads origin after origin and sees those before it.
void Equilibrium::plant(std::span<const OriginFlow> start) {
  std::vector<OriginFlow> kept(start.begin(), start.end());
  std::stable_sort(kept.begin(), kept.end(), [](const OriginFlow& a, const OriginFlow& b) {
    return a.origin != b.origin ? a.origin < b.origin : a.link < b.link;
  });
  loads_ = LinkLoads(network_);
  for (const OriginFlow& flow : kept)
    if (network_.is_open(flow.link)) loads_.set(network_, flow.link, loads_.flows[flow.link] + flow.flow);
  std::vector<double> flows(network_.link_count(), 0);
  auto at = kept.begin();
  plant_all([&](Bush& bush, std::span<const TripDemand> demands) {
    while (at != kept.end() && at->origin < bush.origin) ++at;
    const auto own = at;
    for (; at != kept.end() && at->origin == bush.origin; ++at) flows[at->link] += at->flow;
    worker_.plant(bush, demands, flows, loads_);
    for (auto flow = own; flow != at; ++flow) flows[flow->link] = 0;
    return own != at;
  });
}

void Equilibrium::load(std::span<const BushFlows> flows) {
  std::vector<double> sums(network_.link_count(), 0);
  for (const BushFlows& own : flows)
    for (std::size_t k = 0; k < own.links.size(); ++k)
      if (network_.is_open(own.links[k])) sums[own.links[k]] += own.flows[k];
  for (std::uint32_t l = 0; l < sums.size(); ++l) loads_.set(network_, l, sums[l]);
}

void Equilibrium::begin(std::vector<TripDemand> demands, std::span<const BushFlows> flows, const ShortestTrees& trees) {
  demands_ = tidied(std::move(demands));
  iterations_ = 0;
  const std::vector<double> nothing(network_.link_count(), 0);
  auto at = flows.begin();
  plant_all([&](Bush& bush, std::span<const TripDemand> own) {
    while (at != flows.end() && at->origin < bush.origin) ++at;
    const bool is_warm = at != flows.end() && at->origin == bush.origin && !at->links.empty();
    if (is_warm) worker_.replant(bush, own, *at, trees.labels_of(bush.origin), trees.costs(), loads_);
    else worker_.plant(bush, own, nothing, loads_);
    return is_warm;
  });
}

// `plant_one` makes the bush of one origin with its demands, and says whether its flows are among the loads already.
template <class PlantOne>
void Equilibrium::plant_all(PlantOne&& plant_one) {
  lost_.clear();
  within_ = waiting_ = 0;
  std::size_t count = 0;
  for (auto first = demands_.begin(); first != demands_.end();) {
    if (is_stop_wished()) {
      for (; first != demands_.end(); ++first) waiting_ += first->trips;
      break;
    }
    const auto last = std::find_if(first, demands_.end(), [&](const TripDemand& d) { return d.origin != first->origin; });
    if (count == bushes_.size()) bushes_.emplace_back();
    Bush& bush = bushes_[count++];  // of whichever origin it was: its memory is used again
    bush.origin = first->origin;
    if (!plant_one(bush, std::span<const TripDemand>(first, last)))
      for (std::size_t s = 0; s < bush.links.size(); ++s)
        if (bush.flows[s] > 0) loads_.set(network_, bush.links[s], loads_.flows[bush.links[s]] + bush.flows[s]);
    auto served = bush.demands.begin();
    for (; first != last; ++first) {
      if (served != bush.demands.end() && served->destination == first->destination) ++served;
      else if (first->destination == first->origin) within_ += first->trips;
      else lost_.push_back({first->origin, first->destination, first->trips, "no open way leads there"});
    }
  }
  bushes_.resize(count);
  add_up();
}

// Sums of all bushes anew, in one order: shifts leave rounding behind.
void Equilibrium::add_up() {
  std::vector<double> flows(network_.link_count(), 0);
  for (const Bush& bush : bushes_)
    for (std::size_t s = 0; s < bush.links.size(); ++s) flows[bush.links[s]] += bush.flows[s];
  for (std::uint32_t l = 0; l < flows.size(); ++l) loads_.set(network_, l, flows[l]);
}

void Equilibrium::iterate(int sweeps, double enough) {
  // Whatever has been shifted by then, all trips are on the streets: a stop between two origins leaves a state like any other.
  for (Bush& bush : bushes_) {
    if (is_stop_wished()) break;
    worker_.improve(bush, loads_);
    worker_.shift(bush, loads_);
  }
  for (int sweep = 1; sweep < sweeps && !is_stop_wished(); ++sweep) {
    double largest = 0;
    for (Bush& bush : bushes_) {
      if (is_stop_wished()) break;
      largest = std::max(largest, worker_.shift(bush, loads_));
    }
    if (largest <= enough) break;
  }
  add_up();
  ++iterations_;
}

bool Equilibrium::run(double gap, int most_iterations, int sweeps) {
  const int end = iterations_ + most_iterations;
  while (figures().gap > gap) {
    if (iterations_ >= end || is_stop_wished()) return false;
    iterate(sweeps);
  }
  return true;
}

Result<void> Equilibrium::set_capacity(std::uint32_t link, double capacity) {
  if (auto done = network_.set_capacity(link, capacity); !done) return done;
  loads_.set(network_, link, loads_.flows[link]);
  return {};
}

Result<void> Equilibrium::set_free_time(std::uint32_t link, double free_time) {
  if (auto done = network_.set_free_time(link, free_time); !done) return done;
  loads_.set(network_, link, loads_.flows[link]);
  return {};
}

void Equilibrium::set_open(std::uint32_t link, bool is_open) {
  if (network_.is_open(link) == is_open) return;
  network_.set_open(link, is_open);
  plant(origin_flows());
}

void Equilibrium::set_demands(std::vector<TripDemand> demands) {
  demands_ = tidied(std::move(demands));
  plant(origin_flows());
}

EquilibriumFigures Equilibrium::figures() {
  double excess = 0;
  // What a stop has left half loaded has no gap; whoever stopped it waits for an answer, not for the shortest ways.
  for (const Bush& bush : bushes_) excess += waiting_ > 0 ? 0 : worker_.excess(bush, loads_);
  return totals(excess);
}

EquilibriumFigures Equilibrium::figures(ShortestTrees& trees) {
  trees.update(loads_.costs);
  double excess = 0;
  for (const Bush& bush : bushes_) excess += worker_.excess(bush, loads_, trees.labels_of(bush.origin));
  return totals(excess);
}

EquilibriumFigures Equilibrium::totals(double excess) const {
  EquilibriumFigures figures;
  figures.iterations = iterations_;
  figures.within = within_;
  figures.waiting = waiting_;
  for (const Bush& bush : bushes_)
    for (const TripDemand& demand : bush.demands) figures.trips += demand.trips;
  for (const LostTrips& lost : lost_) figures.lost += lost.trips;
  for (std::uint32_t l = 0; l < network_.link_count(); ++l) {
    if (!(loads_.flows[l] > 0)) continue;
    figures.total_cost += loads_.flows[l] * loads_.costs[l];
    figures.objective += network_.integral(l, loads_.flows[l]);
    figures.cut += network_.is_cut(l, loads_.flows[l]) ? 1 : 0;
  }
  figures.shortest_cost = figures.total_cost - excess;
  figures.gap = waiting_ > 0 ? 1 : figures.total_cost > 0 ? excess / figures.total_cost : 0;
  return figures;
}

std::vector<OriginFlow> Equilibrium::origin_flows() const {
  std::vector<OriginFlow> all;
  for (const Bush& bush : bushes_) {
    const std::size_t first = all.size();
    for (std::size_t s = 0; s < bush.links.size(); ++s)
      if (bush.flows[s] > 0) all.push_back({bush.origin, bush.links[s], bush.flows[s]});
    std::sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
              [](const OriginFlow& a, const OriginFlow& b) { return a.link < b.link; });
  }
  return all;
}

namespace {

// The flow of one pair on the slots of its bush: what arrives at a node comes in the shares in which all flow comes.
std::vector<double> pair_flows(const TrafficNetwork& network, const Bush& bush, const TripDemand& demand) {
  std::vector<double> at_node(network.node_count(), 0), on_slot(bush.links.size(), 0);
  at_node[demand.destination] = demand.trips;
  for (std::size_t k = bush.order.size(); k-- > 1;) {
    const double here = at_node[bush.order[k]];
    double sum = 0;
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) sum += bush.flows[s];
    if (!(here > 0) || !(sum > 0)) continue;
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) {
      on_slot[s] = here * (bush.flows[s] / sum);
      at_node[network.from(bush.links[s])] += on_slot[s];
    }
  }
  return on_slot;
}

}  // namespace

std::vector<Route> Equilibrium::routes(std::uint32_t origin, std::uint32_t destination) const {
  const auto bush = std::find_if(bushes_.begin(), bushes_.end(), [&](const Bush& b) { return b.origin == origin; });
  if (bush == bushes_.end()) return {};
  const auto demand =
      std::find_if(bush->demands.begin(), bush->demands.end(), [&](const TripDemand& d) { return d.destination == destination; });
  if (demand == bush->demands.end()) return {};
  std::vector<double> left = pair_flows(network_, *bush, *demand);
  std::vector<std::uint32_t> place(network_.node_count(), 0);
  for (std::size_t k = 0; k < bush->order.size(); ++k) place[bush->order[k]] = static_cast<std::uint32_t>(k);
  std::vector<Route> routes;
  // Each round empties a slot, so that rounds come to an end; what is left then is rounding.
  for (double remaining = demand->trips; remaining > 1e-9 * demand->trips && routes.size() <= left.size();) {
    Route route;
    std::vector<std::uint32_t> slots;
    for (std::uint32_t node = destination; node != origin; node = network_.from(bush->links[slots.back()])) {
      std::uint32_t best = bush->slot_begin[place[node]];
      for (std::uint32_t s = best + 1; s < bush->slot_begin[place[node] + 1]; ++s)
        if (left[s] > left[best]) best = s;
      slots.push_back(best);
    }
    route.trips = remaining;
    for (const std::uint32_t s : slots) route.trips = std::min(route.trips, left[s]);
    if (!(route.trips > 0)) break;
    for (auto s = slots.rbegin(); s != slots.rend(); ++s) {
      left[*s] -= route.trips;
      route.links.push_back(bush->links[*s]);
      route.cost += loads_.costs[bush->links[*s]];
    }
    remaining -= route.trips;
    routes.push_back(std::move(route));
  }
  std::stable_sort(routes.begin(), routes.end(), [](const Route& a, const Route& b) { return a.trips > b.trips; });
  return routes;
}

}  // namespace bl::traffic
