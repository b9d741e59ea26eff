// Planting, balancing and improving the bush of one origin, and shifting its flow.
#include "core/traffic/bush.h"

#include <algorithm>

namespace bl::traffic {

namespace {

// Ways that differ by less than this share count as equally long: shifting between them would only stir rounding.
constexpr double kEqualShare = 1e-15;
// Newton's steps at one pair of ways; costs are convex, so that the second already meets the balance closely.
constexpr int kNewtonSteps = 2;

}  // namespace

LinkLoads::LinkLoads(const TrafficNetwork& network)
    : flows(network.link_count(), 0), costs(network.link_count()), slopes(network.link_count()) {
  for (std::uint32_t l = 0; l < flows.size(); ++l) set(network, l, 0);
}

void LinkLoads::set(const TrafficNetwork& network, std::uint32_t link, double flow) {
  flows[link] = std::max(0.0, flow);
  const auto [cost, slope] = network.cost_and_slope(link, flows[link]);
  costs[link] = cost;
  slopes[link] = slope;
}

BushWorker::BushWorker(const TrafficNetwork& network)
    : network_(&network),
      paths_(network),
      heap_(network.node_count()),
      labels_(network.node_count(), kUnreached),
      longest_(network.node_count(), kUnreached),
      node_flow_(network.node_count(), 0),
      link_flow_(network.link_count(), 0),
      place_(network.node_count(), kNoTrafficIndex),
      short_slot_(network.node_count(), kNoTrafficIndex),
      long_slot_(network.node_count(), kNoTrafficIndex),
      pending_(network.node_count(), 0),
      in_bush_(network.link_count(), 0) {}

void BushWorker::plant(Bush& bush, std::span<const TripDemand> demands, std::span<const double> flows, const LinkLoads& loads) {
  grow(bush, flows, loads);
  bush.demands.clear();
  for (const TripDemand& demand : demands)
    if (demand.destination != bush.origin && place_[demand.destination] != kNoTrafficIndex) bush.demands.push_back(demand);
  for (std::uint32_t l = 0; l < flows.size(); ++l) {
    const std::uint32_t i = network_->from(l), j = network_->to(l);
    const bool leads_on = place_[i] != kNoTrafficIndex && place_[j] != kNoTrafficIndex && place_[i] < place_[j];
    if (!(flows[l] > 0) || !network_->is_open(l) || !leads_on || (i != bush.origin && !network_->is_through(i))) continue;
    in_bush_[l] = 1;
    link_flow_[l] = flows[l];
    short_slot_[j] = kNoTrafficIndex;  // has a way of its own and needs no other
  }
  for (std::size_t k = 1; k < bush.order.size(); ++k)
    if (const std::uint32_t l = short_slot_[bush.order[k]]; l != kNoTrafficIndex) in_bush_[l] = 1;
  rebuild(bush);
  balance(bush);
}

void BushWorker::replant(Bush& bush, std::span<const TripDemand> demands, const BushFlows& flows, std::span<const double> labels,
                         std::span<const double> costs, const LinkLoads& loads) {
  std::fill(pending_.begin(), pending_.end(), 0);
  chosen_.clear();
  chosen_flows_.clear();
  for (std::size_t k = 0; k < flows.links.size(); ++k) {
    const std::uint32_t l = flows.links[k], i = network_->from(l), j = network_->to(l);
    const bool leads_on = network_->is_open(l) && labels[i] != kUnreached && j != bush.origin && passes(i, bush.origin);
    if (!(flows.flows[k] > 0) || !leads_on) continue;
    ++pending_[j];
    chosen_.push_back(l);
    chosen_flows_.push_back(flows.flows[k]);
  }
  hang(bush.origin, labels, costs);
  const auto reached = labels.size() - static_cast<std::size_t>(std::count(labels.begin(), labels.end(), kUnreached));
  if (!put_in_order(bush, reached)) {
    std::vector<double> by_link(link_flow_.size(), 0);
    for (std::size_t k = 0; k < chosen_.size(); ++k) by_link[chosen_[k]] = chosen_flows_[k];
    return plant(bush, demands, by_link, loads);
  }
  bush.demands.clear();
  for (const TripDemand& demand : demands)
    if (demand.destination != bush.origin && labels[demand.destination] != kUnreached) bush.demands.push_back(demand);
  balance(bush);
}

// A link of a shortest way for every node that nothing flows to.
void BushWorker::hang(std::uint32_t origin, std::span<const double> labels, std::span<const double> costs) {
  for (std::uint32_t j = 0; j < labels.size(); ++j) {
    if (pending_[j] > 0 || j == origin || labels[j] == kUnreached) continue;
    for (const std::uint32_t l : network_->in_links(j)) {
      const std::uint32_t i = network_->from(l);
      if (labels[i] + costs[l] != labels[j] || !network_->is_open(l) || !passes(i, origin)) continue;
      chosen_.push_back(l);
      chosen_flows_.push_back(0);
      pending_[j] = 1;
      break;
    }
  }
}

// Order and slots of the chosen links, each node as soon as all that leads to it has its place; false where there is no such
// order. `pending_` counts the links to each node.
bool BushWorker::put_in_order(Bush& bush, std::size_t reached) {
  begin_.assign(network_->node_count() + 1, 0);
  for (const std::uint32_t l : chosen_) ++begin_[network_->from(l) + 1];
  for (std::size_t n = 1; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  next_.assign(begin_.begin(), begin_.end() - 1);
  onward_.resize(chosen_.size());
  for (const std::uint32_t l : chosen_) onward_[next_[network_->from(l)]++] = network_->to(l);
  arrived_.assign(network_->node_count(), 0);
  bush.order.assign(1, bush.origin);
  bush.slot_begin.assign(1, 0);
  std::vector<std::uint32_t>& slot = next_;  // by node, from here on: where its next link stands
  std::uint32_t slots = 0;
  for (std::size_t k = 0; k < bush.order.size(); ++k) {
    const std::uint32_t i = bush.order[k];
    place_[i] = static_cast<std::uint32_t>(k);
    slot[i] = slots;
    slots += pending_[i];
    bush.slot_begin.push_back(slots);
    for (std::uint32_t at = begin_[i]; at < begin_[i + 1]; ++at) {
      // How many links lead there stays known in `pending_`; those that are still missing are counted beside it.
      const std::uint32_t j = onward_[at];
      if (++arrived_[j] == pending_[j]) bush.order.push_back(j);
    }
  }
  if (bush.order.size() < reached) return false;
  bush.links.resize(chosen_.size());
  bush.flows.resize(chosen_.size());
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const std::uint32_t at = slot[network_->to(chosen_[k])]++;
    bush.links[at] = chosen_[k];
    bush.flows[at] = chosen_flows_[k];
  }
  return true;
}

// Dijkstra's search in which a node waits for the tails of all links that carry flow to it. So flow always leads onward in the
// order found, and the rest hangs on shortest ways. Here `short_slot_` holds links: the last one of the shortest way.
void BushWorker::grow(Bush& bush, std::span<const double> flows, const LinkLoads& loads) {
  std::fill(labels_.begin(), labels_.end(), kUnreached);
  std::fill(place_.begin(), place_.end(), kNoTrafficIndex);
  std::fill(short_slot_.begin(), short_slot_.end(), kNoTrafficIndex);
  std::fill(pending_.begin(), pending_.end(), 0);
  auto passes = [&](std::uint32_t node) { return node == bush.origin || network_->is_through(node); };
  for (std::uint32_t l = 0; l < flows.size(); ++l)
    if (flows[l] > 0 && network_->is_open(l) && passes(network_->from(l))) ++pending_[network_->to(l)];
  bush.order.clear();
  pending_[bush.origin] = 0;
  labels_[bush.origin] = 0;
  heap_.push(bush.origin, labels_);
  do {
    while (!heap_.is_empty()) {
      const std::uint32_t i = heap_.pop(labels_);
      place_[i] = static_cast<std::uint32_t>(bush.order.size());
      bush.order.push_back(i);
      if (!passes(i)) continue;
      for (const std::uint32_t l : network_->out_links(i)) {
        const std::uint32_t j = network_->to(l);
        if (!network_->is_open(l) || place_[j] != kNoTrafficIndex) continue;
        if (labels_[i] + loads.costs[l] < labels_[j]) {
          labels_[j] = labels_[i] + loads.costs[l];
          short_slot_[j] = l;
        }
        if (flows[l] > 0 && pending_[j] > 0) --pending_[j];
        if (pending_[j] == 0) heap_.push(j, labels_);
      }
    }
  } while (release());
}

// Flow that runs in a circle, or comes from where nothing leads any more, keeps nodes waiting for ever: the nearest of them
// goes on without it.
bool BushWorker::release() {
  std::uint32_t nearest = kNoTrafficIndex;
  for (std::uint32_t n = 0; n < labels_.size(); ++n)
    if (place_[n] == kNoTrafficIndex && labels_[n] != kUnreached && (nearest == kNoTrafficIndex || labels_[n] < labels_[nearest]))
      nearest = n;
  if (nearest == kNoTrafficIndex) return false;
  pending_[nearest] = 0;
  heap_.push(nearest, labels_);
  return true;
}

// Slots from `order`, and from the links and flows marked in `in_bush_` and `link_flow_`, which are clean again afterwards.
void BushWorker::rebuild(Bush& bush) {
  const std::size_t count = bush.order.size();
  for (std::size_t k = 0; k < count; ++k) place_[bush.order[k]] = static_cast<std::uint32_t>(k);
  bush.slot_begin.assign(count + 1, 0);
  for (std::uint32_t l = 0; l < in_bush_.size(); ++l)
    if (in_bush_[l]) ++bush.slot_begin[place_[network_->to(l)] + 1];
  for (std::size_t k = 0; k < count; ++k) bush.slot_begin[k + 1] += bush.slot_begin[k];
  bush.links.resize(bush.slot_begin[count]);
  bush.flows.resize(bush.slot_begin[count]);
  std::vector<std::uint32_t>& next = up_short_;
  next.assign(bush.slot_begin.begin(), bush.slot_begin.end() - 1);
  for (std::uint32_t l = 0; l < in_bush_.size(); ++l) {
    if (!in_bush_[l]) continue;
    const std::uint32_t slot = next[place_[network_->to(l)]]++;
    bush.links[slot] = l;
    bush.flows[slot] = link_flow_[l];
    in_bush_[l] = 0;
    link_flow_[l] = 0;
  }
}

void BushWorker::balance(Bush& bush) {
  for (const std::uint32_t node : bush.order) node_flow_[node] = 0;
  for (const TripDemand& demand : bush.demands) node_flow_[demand.destination] += demand.trips;
  for (std::size_t k = bush.order.size(); k-- > 1;) {
    const double wanted = node_flow_[bush.order[k]];
    double sum = 0;
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) sum += bush.flows[s];
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) {
      if (!(wanted > 0)) bush.flows[s] = 0;
      else if (sum > 0) bush.flows[s] *= wanted / sum;
      else bush.flows[s] = s == bush.slot_begin[k] ? wanted : 0;
      node_flow_[network_->from(bush.links[s])] += bush.flows[s];
    }
  }
}

// Shortest and longest used ways to all nodes of the bush. To a node that nobody uses, the longest way is the shortest link's.
void BushWorker::label(const Bush& bush, const LinkLoads& loads) {
  labels_[bush.origin] = longest_[bush.origin] = 0;
  place_[bush.origin] = 0;
  for (std::size_t k = 1; k < bush.order.size(); ++k) {
    const std::uint32_t j = bush.order[k];
    place_[j] = static_cast<std::uint32_t>(k);
    double shortest = kUnreached, longest = -1;
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) {
      const std::uint32_t l = bush.links[s], i = network_->from(l);
      if (const double way = labels_[i] + loads.costs[l]; way < shortest) {
        shortest = way;
        short_slot_[j] = s;
      }
      if (!(bush.flows[s] > 0)) continue;
      if (const double way = longest_[i] + loads.costs[l]; way > longest) {
        longest = way;
        long_slot_[j] = s;
      }
    }
    if (longest < 0) {
      const std::uint32_t l = bush.links[short_slot_[j]];
      long_slot_[j] = short_slot_[j];
      longest = longest_[network_->from(l)] + loads.costs[l];
    }
    labels_[j] = shortest;
    longest_[j] = longest;
  }
}

void BushWorker::improve(Bush& bush, const LinkLoads& loads) {
  balance(bush);
  std::fill(longest_.begin(), longest_.end(), kUnreached);
  label(bush, loads);
  for (std::size_t k = 1; k < bush.order.size(); ++k) {
    const std::uint32_t j = bush.order[k];
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) {
      if (!(bush.flows[s] > 0) && s != long_slot_[j]) continue;
      in_bush_[bush.links[s]] = 1;
      link_flow_[bush.links[s]] = bush.flows[s];
    }
  }
  // A link joins that is shorter than the longest way to its end: no circle can arise, because all links lead to longer ways.
  for (std::uint32_t l = 0; l < in_bush_.size(); ++l) {
    const std::uint32_t i = network_->from(l), j = network_->to(l);
    if (longest_[i] == kUnreached || !network_->is_open(l) || !(longest_[i] + loads.costs[l] < longest_[j])) continue;
    if (i == bush.origin || network_->is_through(i)) in_bush_[l] = 1;
  }
  std::sort(bush.order.begin(), bush.order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return longest_[a] != longest_[b] ? longest_[a] < longest_[b] : place_[a] < place_[b];
  });
  rebuild(bush);
}

double BushWorker::shift(Bush& bush, LinkLoads& loads) {
  label(bush, loads);
  double largest = 0;
  for (std::size_t k = bush.order.size(); k-- > 1;) {
    const std::uint32_t j = bush.order[k];
    if (short_slot_[j] == long_slot_[j] || !(longest_[j] - labels_[j] > kEqualShare * longest_[j])) continue;
    largest = std::max(largest, (longest_[j] - labels_[j]) / longest_[j]);
    shift_at(bush, j, loads);
  }
  return largest;
}

void BushWorker::shift_at(Bush& bush, std::uint32_t node, LinkLoads& loads) {
  up_short_.assign(1, short_slot_[node]);
  up_long_.assign(1, long_slot_[node]);
  std::uint32_t a = network_->from(bush.links[up_short_[0]]), b = network_->from(bush.links[up_long_[0]]);
  while (a != b) {  // back to where the two ways part; whoever is farther on goes back
    const bool is_short = place_[a] > place_[b];
    std::uint32_t& at = is_short ? a : b;
    const std::uint32_t slot = is_short ? short_slot_[at] : long_slot_[at];
    (is_short ? up_short_ : up_long_).push_back(slot);
    at = network_->from(bush.links[slot]);
  }
  double most = bush.flows[up_long_[0]], least = 0;  // least: what may flow back of what this call has moved
  for (const std::uint32_t s : up_long_) most = std::min(most, bush.flows[s]);
  for (int step = 0; step < kNewtonSteps; ++step) {
    double difference = 0, slope = 0;
    for (const std::uint32_t s : up_long_) {
      difference += loads.costs[bush.links[s]];
      slope += loads.slopes[bush.links[s]];
    }
    for (const std::uint32_t s : up_short_) {
      difference -= loads.costs[bush.links[s]];
      slope += loads.slopes[bush.links[s]];
    }
    const double wanted = slope > 0 ? difference / slope : difference > 0 ? most : 0;
    const double moved = std::clamp(wanted, least, most);
    if (moved == 0) return;
    for (const std::uint32_t s : up_long_) {
      bush.flows[s] -= moved;
      loads.set(*network_, bush.links[s], loads.flows[bush.links[s]] - moved);
    }
    for (const std::uint32_t s : up_short_) {
      bush.flows[s] += moved;
      loads.set(*network_, bush.links[s], loads.flows[bush.links[s]] + moved);
    }
    most -= moved;
    least -= moved;
  }
}

double BushWorker::excess(const Bush& bush, const LinkLoads& loads) {
  std::fill(labels_.begin(), labels_.end(), kUnreached);
  labels_[bush.origin] = 0;
  for (std::size_t k = 1; k < bush.order.size(); ++k)
    for (std::uint32_t s = bush.slot_begin[k]; s < bush.slot_begin[k + 1]; ++s) {
      const std::uint32_t l = bush.links[s];
      labels_[bush.order[k]] = std::min(labels_[bush.order[k]], labels_[network_->from(l)] + loads.costs[l]);
    }
  paths_.mend(bush.origin, loads.costs, labels_);
  return excess(bush, loads, labels_);
}

double BushWorker::excess(const Bush& bush, const LinkLoads& loads, std::span<const double> labels) const {
  double sum = 0;
  for (std::size_t s = 0; s < bush.links.size(); ++s) {
    const std::uint32_t l = bush.links[s];
    sum += bush.flows[s] * ((labels[network_->from(l)] + loads.costs[l]) - labels[network_->to(l)]);
  }
  return sum;
}

}  // namespace bl::traffic
