// Moves the trips of a district a step towards equilibrium, and reads the results back.
#include "core/traffic/district.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/traffic/district_network.h"
#include "core/traffic/equilibrium.h"
#include "core/traffic/reach.h"

namespace bl::traffic {

namespace {

// At most, of one iteration; no more than the wanted gap needs.
constexpr int kSweeps = 8;
// A pair with a smaller share of what leaves a zone has no trips: halved tick by tick, it would never come to an end.
constexpr double kLeastShare = 1e-9;
// Trips that a zone lacks are told where they are more than this share of those that it would take.
constexpr double kNoticed = 1e-6;
// Where a smaller share of the trips wants to go elsewhere, all stay: else the last digits would never come to rest.
constexpr double kRest = 1e-7;

}  // namespace

// `equilibrium` works on a network of its own, and the trees on that one.
struct DistrictMemo::Content {
  DistrictNetwork network;
  std::unique_ptr<Equilibrium> equilibrium;
  std::unique_ptr<ShortestTrees> trees;
  std::optional<DistrictWalks> walks;
  std::map<std::size_t, std::vector<double>> walking;  // by zone
};

DistrictMemo::DistrictMemo() = default;
DistrictMemo::DistrictMemo(DistrictMemo&&) noexcept = default;
DistrictMemo& DistrictMemo::operator=(DistrictMemo&&) noexcept = default;
DistrictMemo::~DistrictMemo() = default;

double DistrictState::trips(const std::string& origin, const std::string& destination) const {
  const auto place = [&](const std::string& id) {
    return static_cast<std::size_t>(std::find_if(zones.begin(), zones.end(), [&](const Zone& z) { return z.id == id; }) -
                                    zones.begin());
  };
  const std::size_t from = place(origin), to = place(destination);
  return from < zones.size() && to < zones[from].trips.size() ? zones[from].trips[to] : 0;
}

namespace {

// The places of one list's ids in another; the number of those where they are missing.
std::vector<std::size_t> places_in(const std::vector<std::string>& ids, const std::vector<std::string>& others) {
  std::vector<std::size_t> places(ids.size());
  if (ids == others) {
    for (std::size_t i = 0; i < ids.size(); ++i) places[i] = i;
    return places;
  }
  std::map<std::string_view, std::size_t> place_of;
  for (std::size_t i = 0; i < others.size(); ++i) place_of.emplace(others[i], i);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto found = place_of.find(ids[i]);
    places[i] = found == place_of.end() ? others.size() : found->second;
  }
  return places;
}

class District {
 public:
  District(const std::vector<DistrictZone>& zones, const DistrictSettings& settings, DistrictMemo::Content& held)
      : zones_(zones),
        settings_(settings),
        made_(held.network),
        held_(held),
        equilibrium_(*held.equilibrium),
        trees_(*held.trees) {}

  Result<DistrictResult> step(const DistrictState& last) {
    out_.streets = made_.street_results;
    out_.rules = made_.rule_results;
    for (const int streets : made_.streets_at) out_.junctions.push_back({streets, 0, 0});
    for (const std::string& reason : made_.zone_reasons) out_.zones.emplace_back().reason = reason;
    recall(last);
    equilibrium_.load(flows_);
    trees_.update(equilibrium_.costs());
    equilibrium_.begin(trips_wanted(), flows_, trees_);
    EquilibriumFigures figures = equilibrium_.figures(trees_);
    for (int i = 0; i < settings_.steps && figures.gap > settings_.gap; ++i) {
      equilibrium_.iterate(kSweeps, settings_.gap);
      figures = equilibrium_.figures(trees_);
    }
    read_totals(figures);
    for (std::size_t s = 0; s < out_.streets.size(); ++s) read_street(s);
    read_zones();
    if (auto read = read_reach(); !read) return read.error();
    out_.is_at_rest = has_same_trips_ && out_.iterations == 0 && is_recalled_whole_;
    if (out_.is_at_rest) out_.state = last;
    else remember();
    return std::move(out_);
  }

 private:
  // Flows by ascending node of their zone and link, and trips by zone and zone.
  void recall(const DistrictState& last) {
    const std::size_t n = zones_.size();
    std::vector<std::string> ids, now;
    for (const DistrictState::Zone& zone : last.zones) ids.push_back(zone.id);
    for (const DistrictZone& zone : zones_) now.push_back(zone.id);
    const std::vector<std::size_t> zone_at = places_in(ids, now), link_at = places_in(last.links, made_.link_ids);
    std::vector<const DistrictState::Zone*> by_node(made_.zone_at.size(), nullptr);
    last_.assign(n * n, 0);
    seen_at_.assign(made_.link_ids.size(), kNoTrafficIndex);
    for (std::size_t z = 0; z < last.zones.size(); ++z) {
      const DistrictState::Zone& zone = last.zones[z];
      if (zone_at[z] == n) {
        is_recalled_whole_ = false;
        continue;
      }
      by_node[made_.zone_nodes[zone_at[z]]] = &zone;
      for (std::size_t d = 0; d < std::min(zone.trips.size(), last.zones.size()); ++d)
        if (zone_at[d] < n && zone.trips[d] > 0) last_[zone_at[z] * n + zone_at[d]] = zone.trips[d];
    }
    for (std::uint32_t node = 0; node < by_node.size(); ++node)
      if (by_node[node] != nullptr) recall_flows(node, *by_node[node], link_at);
  }

  // Where the links are those of the last step, its lists serve as they are.
  void recall_flows(std::uint32_t node, const DistrictState::Zone& zone, const std::vector<std::size_t>& link_at) {
    const std::size_t count = std::min(zone.used.size(), zone.flows.size());
    const auto serves = [&](std::size_t k) {
      const std::uint32_t l = zone.used[k];
      if (l >= link_at.size() || link_at[l] != l || l >= made_.link_ids.size() || !(zone.flows[k] > 0)) return false;
      return std::exchange(seen_at_[l], node) != node;  // twice: broken data
    };
    std::size_t k = 0;
    while (k < count && serves(k)) ++k;
    if (k == count) {
      flows_.push_back({node, std::span(zone.used).first(count), std::span(zone.flows).first(count)});
      return;
    }
    std::map<std::uint32_t, double> found;
    for (k = 0; k < count; ++k) {
      const bool is_there = zone.used[k] < link_at.size() && link_at[zone.used[k]] < made_.link_ids.size();
      if (is_there && zone.flows[k] > 0) found.emplace(static_cast<std::uint32_t>(link_at[zone.used[k]]), zone.flows[k]);
      else is_recalled_whole_ = false;
    }
    auto& [links, flows] = mapped_.emplace_back();
    for (const auto& [link, flow] : found) links.push_back(link), flows.push_back(flow);
    flows_.push_back({node, links, flows});
  }

  // Costs between all zones as the trees are now.
  void measure_costs() {
    costs_.clear();
    for (std::size_t z = 0; z < zones_.size(); ++z) {
      const std::span<const double> labels = trees_.labels(z);
      for (const std::uint32_t other : made_.zone_nodes) costs_.push_back(labels[other]);
    }
  }

  // The trips that the gravity model wants, approached from those of the last step.
  std::vector<TripDemand> trips_wanted() {
    const std::size_t n = zones_.size();
    std::vector<double> leaving, arriving;
    for (const DistrictZone& zone : zones_) {
      leaving.push_back(zone.leaving);
      arriving.push_back(zone.arriving);
    }
    measure_costs();
    const TripDistribution wanted = distribute_trips(costs_, leaving, arriving, settings_.fade, settings_.constraint);
    tell_missing(wanted, std::accumulate(leaving.begin(), leaving.end(), 0.0),
                 std::accumulate(arriving.begin(), arriving.end(), 0.0));
    const std::vector<double> before = last_;
    double apart = 0, all = 0, changed = 0;
    std::size_t gone = 0;
    std::vector<double> next(n * n, 0);
    for (std::size_t i = 0; i < n; ++i) {
      // A zone whose sum has changed follows at once; only where its trips go is approached.
      double sum = 0, aim = 0;
      for (std::size_t k = i * n; k < (i + 1) * n; ++k) {
        // Who cannot be reached any more is not waited for: those trips end elsewhere at once.
        if (costs_[k] == kUnreached) last_[k] = 0;
        sum += last_[k], aim += wanted.trips[k];
      }
      for (std::size_t k = i * n; k < (i + 1) * n; ++k) {
        const double goal = wanted.trips[k], kept = sum > 0 ? last_[k] * (aim / sum) : goal;
        apart += std::abs(goal - kept);
        all += goal;
        changed += std::abs(last_[k] - kept);
        const double trip = kept + settings_.haste * (goal - kept);
        if (trip > kLeastShare * aim) next[k] = trip;
        if ((next[k] > 0) != (before[k] > 0)) ++gone;
      }
      tell_lost(i, wanted.lost[i]);
    }
    out_.restlessness = all > 0 ? apart / all : 0;
    has_same_trips_ = apart <= kRest * all && changed <= kRest * all && gone == 0;
    trips_ = has_same_trips_ ? before : next;
    return demands();
  }

  // What both sums together do not allow: too few trips leave, too many, or those that leave do not get there.
  void tell_missing(const TripDistribution& wanted, double leaving, double arriving) {
    for (std::size_t z = 0; z < wanted.missing.size(); ++z) {
      const double missing = wanted.missing[z], all = zones_[z].arriving;
      if (std::abs(missing) <= kNoticed * std::max(1.0, all)) continue;
      out_.missing += std::max(0.0, missing);
      const bool is_share = std::abs(all - missing - all * (leaving / arriving)) <= kNoticed * std::max(1.0, all);
      std::string reason;
      if (missing < 0)
        reason = is_share ? "more trips leave all zones than would end in them, and each zone gets its share of them"
                          : "trips end here that cannot get to other zones";
      else if (is_share) reason = "fewer trips leave all zones than would end in them, and each zone gets its share of them";
      else if (!(missing < all)) reason = "no trips can get here: no open way leads here from another zone that trips leave";
      else reason = "too few trips leave the zones from which one can get here";
      out_.arrivals.push_back({z, missing, reason});
    }
  }

  // Ascending nodes.
  std::vector<TripDemand> demands() const {
    const std::size_t n = zones_.size();
    std::vector<std::size_t> order(n);
    for (std::size_t z = 0; z < n; ++z) order[z] = z;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return made_.zone_nodes[a] < made_.zone_nodes[b]; });
    std::vector<TripDemand> demands;
    for (const std::size_t i : order)
      for (const std::size_t j : order)
        if (const double trips = trips_[i * n + j]; trips > 0)
          demands.push_back({made_.zone_nodes[i], made_.zone_nodes[j], trips});
    return demands;
  }

  void tell_lost(std::size_t z, double lost) {
    DistrictResult::Zone& zone = out_.zones[z];
    zone.lost += lost;
    if (lost > 0 && zone.reason.empty()) zone.reason = "no other zone that trips could end in can be reached";
  }

  void read_totals(const EquilibriumFigures& figures) {
    out_.gap = figures.gap;
    out_.trips = figures.trips;
    for (std::uint32_t l = 0; l < equilibrium_.network().link_count(); ++l) {
      const double flow = equilibrium_.flows()[l];
      times_.push_back(equilibrium_.network().time(l, flow));
      out_.total_time += flow * times_.back();
    }
    out_.objective = figures.objective;
    out_.iterations = figures.iterations;
    for (const LostTrips& lost : equilibrium_.lost()) {
      DistrictResult::Zone& zone = out_.zones[made_.zone_at[lost.origin]];
      zone.lost += lost.trips;
      if (zone.reason.empty()) zone.reason = "no open street leads to `" + zones_[made_.zone_at[lost.destination]].id + "`";
    }
    for (const DistrictResult::Zone& zone : out_.zones) out_.lost += zone.lost;
  }

  void read_street(std::size_t s) {
    const TrafficNetwork& network = equilibrium_.network();
    DistrictResult::Street& result = out_.streets[s];
    const auto [start, end] = made_.street_ends[s];
    for (const bool is_back : {false, true}) {
      const std::uint32_t link = made_.street_links[s][is_back ? 1 : 0];
      if (link == kNoTrafficIndex) continue;
      const double flow = equilibrium_.flows()[link], time = network.time(link, flow);
      (is_back ? result.flow_back : result.flow_forth) = flow;
      (is_back ? result.time_back : result.time_forth) = time;
      result.delay = std::max(result.delay, time - network.time(link, 0));
      result.load = std::max(result.load, flow / made_.parts.streets[s].capacity);
      out_.junctions[is_back ? start : end].flow += flow;
    }
    for (const std::uint32_t junction : {start, end})
      if (junction != kNoTrafficIndex) out_.junctions[junction].load = std::max(out_.junctions[junction].load, result.load);
  }

  void read_zones() {
    const std::size_t n = zones_.size();
    std::vector<double> others;
    for (const DistrictZone& zone : zones_) others.push_back(zone.arriving);
    std::vector<double> there(n);
    for (std::size_t z = 0; z < n; ++z) {
      const std::vector<double> drive = drive_from(z);
      for (std::size_t other = 0; other < n; ++other) there[other] = drive[made_.zone_nodes[other]];
      others[z] = 0;
      out_.zones[z].accessibility = accessibility(there, others, settings_.fade);
      others[z] = zones_[z].arriving;
      if (zones_[z].wants_reach) drives_[z] = drive;
    }
    for (const Bush& bush : equilibrium_.bushes()) {
      DistrictResult::Zone& zone = out_.zones[made_.zone_at[bush.origin]];
      for (const TripDemand& trip : bush.demands) {
        zone.served += trip.trips;
        out_.zones[made_.zone_at[trip.destination]].ending += trip.trips;
      }
      for (std::size_t s = 0; s < bush.links.size(); ++s) zone.mean_time += bush.flows[s] * times_[bush.links[s]];
      if (zone.served > 0) zone.mean_time /= zone.served;
    }
  }

  // Times to all nodes on the cheapest ways.
  std::vector<double> drive_from(std::size_t z) const {
    const std::span<const double> labels = trees_.labels(z);
    if (!equilibrium_.network().has_other_costs()) return {labels.begin(), labels.end()};
    return times_along(equilibrium_.network(), made_.zone_nodes[z], labels, trees_.costs(), times_);
  }

  Result<void> read_reach() {
    for (std::size_t z = 0; z < zones_.size(); ++z) {
      if (!zones_[z].wants_reach) continue;
      if (!held_.walks) {
        auto walks = DistrictWalks::make(made_);
        if (!walks) return walks.error();
        held_.walks = std::move(*walks);
      }
      std::vector<double>& walking = held_.walking[z];
      if (walking.empty()) walking = held_.walks->from(made_, z);
      read_reach_of(z, walking);
    }
    return {};
  }

  void read_reach_of(std::size_t z, const std::vector<double>& walking) {
    const std::vector<double>& drive = drives_.at(z);
    for (std::size_t j = 0; j < made_.parts.junctions.size(); ++j) {
      const double driving = drive[made_.arrivals[j]];
      auto known = [](double time) { return time == kUnreached ? -1.0 : time; };
      if (driving != kUnreached || walking[j] != kUnreached)
        out_.zones[z].reach.push_back({made_.parts.junctions[j].id, known(driving), known(walking[j])});
    }
  }

  void remember() {
    const std::size_t n = zones_.size();
    out_.state.links = made_.link_ids;
    for (std::size_t z = 0; z < n; ++z) {
      const auto row = trips_.begin() + static_cast<std::ptrdiff_t>(z * n);
      out_.state.zones.push_back({zones_[z].id, {}, {}, {row, row + static_cast<std::ptrdiff_t>(n)}});
    }
    for (const Bush& bush : equilibrium_.bushes()) {
      DistrictState::Zone& zone = out_.state.zones[made_.zone_at[bush.origin]];
      zone.used.reserve(bush.links.size());
      zone.flows.reserve(bush.links.size());
      for (std::size_t s = 0; s < bush.links.size(); ++s) {
        if (!(bush.flows[s] > 0)) continue;
        zone.used.push_back(bush.links[s]);
        zone.flows.push_back(bush.flows[s]);
      }
    }
  }

  const std::vector<DistrictZone>& zones_;
  const DistrictSettings& settings_;
  const DistrictNetwork& made_;
  DistrictMemo::Content& held_;
  Equilibrium& equilibrium_;
  ShortestTrees& trees_;
  std::vector<std::uint32_t> seen_at_;                                             // by link: the last origin that was on it
  std::vector<BushFlows> flows_;                                                   // of the last step, ascending node
  std::deque<std::pair<std::vector<std::uint32_t>, std::vector<double>>> mapped_;  // those of them that had to be translated
  std::vector<double> last_, trips_;  // from zone i to zone j at [i · zones + j], of the last step and of this one
  std::vector<double> costs_;         // in the same order
  std::vector<double> times_;         // by link, at the flows of this step
  std::map<std::size_t, std::vector<double>> drives_;  // times to all nodes, of zones that list them
  bool is_recalled_whole_ = true;                      // nothing of the last step was passed over
  bool has_same_trips_ = false;                        // as in the last step
  DistrictResult out_;
};

// The network and all that hangs on it; where it is another one, the ways found in the last one are still a good start.
Result<void> renew(std::unique_ptr<DistrictMemo::Content>& held, Result<DistrictNetwork> made) {
  if (!made) return made.error();
  auto fresh = std::make_unique<DistrictMemo::Content>();
  fresh->network = std::move(*made);
  fresh->equilibrium = std::make_unique<Equilibrium>(fresh->network.network, std::vector<TripDemand>());
  if (held && held->network.zone_nodes == fresh->network.zone_nodes) {
    fresh->trees = std::move(held->trees);
    fresh->trees->move_to(fresh->equilibrium->network());
  } else {
    fresh->trees = std::make_unique<ShortestTrees>(fresh->equilibrium->network(), fresh->network.zone_nodes);
  }
  held = std::move(fresh);
  return {};
}

}  // namespace

Result<DistrictResult> step_district(const DistrictParts& parts, const DistrictState& last, DistrictMemo* memo) {
  DistrictMemo own;
  std::unique_ptr<DistrictMemo::Content>& held = (memo != nullptr ? *memo : own).held;
  if (!held || !held->network.is_made_of(parts))
    if (auto renewed = renew(held, make_district_network(parts)); !renewed) return renewed.error();
  return District(parts.zones, parts.settings, *held).step(last);
}

}  // namespace bl::traffic
