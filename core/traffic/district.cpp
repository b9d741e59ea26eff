// Makes a network of a district, moves its trips a step towards equilibrium, and reads the results back.
#include "core/traffic/district.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/traffic/district_turns.h"
#include "core/traffic/equilibrium.h"
#include "core/traffic/reach.h"
#include "core/traffic/street_line.h"

namespace bl {

namespace {

// Streets that let pass fewer are closed [1/h]: nobody could wait for them.
constexpr double kLeastCapacity = 1e-9;
// A pair with a smaller share of what leaves a zone has no trips: halved tick by tick, it would never come to an end.
constexpr double kLeastShare = 1e-9;
// Where a smaller share of the trips wants to go elsewhere, all stay: else the last digits would never come to rest.
constexpr double kRest = 1e-7;

std::string zone_name(const std::string& id) { return "z:" + id; }

class District {
 public:
  District(const std::vector<DistrictJunction>& junctions, const std::vector<DistrictStreet>& streets,
           const std::vector<DistrictRules>& rules, const std::vector<DistrictZone>& zones, const DistrictSettings& settings)
      : junctions_(junctions), streets_(streets), rules_(rules), zones_(zones), settings_(settings) {
    for (std::size_t j = 0; j < junctions.size(); ++j) junction_at_[junctions[j].id] = j;
  }

  Result<DistrictResult> step(const DistrictState& last) {
    out_.streets.resize(streets_.size());
    out_.junctions.resize(junctions_.size());
    out_.zones.resize(zones_.size());
    if (auto made = make_network(); !made) return made.error();
    find_indices();
    const std::vector<TripDemand> before = trips_of(last);
    const std::vector<OriginFlow> flows = flows_of(last);
    equilibrium_ = std::make_unique<Equilibrium>(*network_, before, flows);
    equilibrium_->set_demands(trips_wanted(before));
    for (int i = 0; i < settings_.steps && equilibrium_->figures().gap > settings_.gap; ++i) equilibrium_->iterate();
    read_totals();
    for (std::size_t s = 0; s < streets_.size(); ++s) read_street(s);
    read_zones();
    if (auto read = read_reach(); !read) return read.error();
    out_.is_at_rest = has_same_trips_ && out_.iterations == 0 && before.size() == last.trips.size() && flows.size() == last.flows.size();
    if (out_.is_at_rest) out_.state = last;
    else remember();
    return std::move(out_);
  }

 private:
  Result<void> make_network() {
    std::vector<TrafficNode> nodes = places();
    std::vector<TrafficLink> links;
    for (std::size_t s = 0; s < streets_.size(); ++s) add_street(s, links);
    const std::vector<ForbiddenTurn> turns = forbidden_turns(rules_, streets_, links, out_.rules);
    for (std::size_t z = 0; z < zones_.size(); ++z) add_access(z);
    links.insert(links.end(), access_.begin(), access_.end());
    if (auto split = forbid_turns(nodes, links, turns); !split) return split.error();
    auto made = TrafficNetwork::make(std::move(nodes), std::move(links), {settings_.toll_factor, settings_.distance_factor});
    if (!made) return made.error();
    network_ = std::make_unique<TrafficNetwork>(std::move(*made));
    return {};
  }

  std::vector<TrafficNode> places() const {
    std::vector<TrafficNode> nodes;
    for (const DistrictJunction& junction : junctions_) nodes.push_back({junction_node(junction.id), true});
    for (const DistrictZone& zone : zones_) nodes.push_back({zone_name(zone.id), false});
    return nodes;
  }

  void add_street(std::size_t s, std::vector<TrafficLink>& links) {
    const DistrictStreet& street = streets_[s];
    DistrictResult::Street& result = out_.streets[s];
    const auto start = junction_at_.find(street.start), end = junction_at_.find(street.end);
    if (start == junction_at_.end() || end == junction_at_.end()) {
      const bool is_start = start == junction_at_.end();
      const std::string& id = is_start ? street.start : street.end;
      const std::string what = is_start ? "start" : "end";
      result.reason =
          id.empty() ? "its " + what + " names no junction" : "its " + what + " `" + id + "` is no junction of this network";
      return;
    }
    const bool is_loop = street.start == street.end;
    if (is_loop && street.course.empty()) {
      result.reason = "it begins and ends at the same junction";
      return;
    }
    ++out_.junctions[start->second].streets;
    if (!is_loop) ++out_.junctions[end->second].streets;
    result.length = street.length > 0 ? street.length
                                      : street_length(junctions_[start->second].position, street.course,
                                                      junctions_[end->second].position);
    if (!street.is_for_cars) result.reason = "it is for walking only";
    else if (!street.is_open) result.reason = "it is closed";
    else if (street.capacity < kLeastCapacity) result.reason = "its capacity is next to nothing, so that it counts as closed";
    if (!result.reason.empty()) return;
    const double time = result.length / street.speed;
    if (is_loop) {  // one may drive round, but no way from zone to zone is the shorter for it
      result.time_forth = time + junctions_[end->second].delay;
      if (!street.is_one_way) result.time_back = result.time_forth;
      return;
    }
    links.push_back({street.id + ":forth", junction_node(street.start), junction_node(street.end),
                     time, street.capacity, settings_.alpha, settings_.beta, result.length, street.toll, true,
                     junctions_[end->second].delay});
    if (street.is_one_way) return;
    links.push_back({street.id + ":back", junction_node(street.end), junction_node(street.start),
                     time, street.capacity, settings_.alpha, settings_.beta, result.length, street.toll, true,
                     junctions_[start->second].delay});
  }

  // On foot between a zone and its junctions.
  void add_access(std::size_t z) {
    const DistrictZone& zone = zones_[z];
    std::vector<std::string> access = zone.access;
    if (access.empty() && junction_at_.contains(zone.id)) access.push_back(zone.id);
    std::sort(access.begin(), access.end());
    access.erase(std::unique(access.begin(), access.end()), access.end());
    std::string unknown;
    bool is_attached = false;
    for (const std::string& id : access) {
      const auto junction = junction_at_.find(id);
      if (junction == junction_at_.end()) {
        unknown += (unknown.empty() ? "`" : ", `") + id + "`";
        continue;
      }
      is_attached = true;
      const double walk = distance(zone.position, junctions_[junction->second].position) / settings_.walking_speed;
      const TrafficLink out{zone.id + ":out:" + id, zone_name(zone.id), junction_node(id), walk, 0, 0, 1, 0, 0, true};
      const TrafficLink in{zone.id + ":in:" + id, junction_node(id), zone_name(zone.id), walk, 0, 0, 1, 0, 0, true};
      access_.push_back(out);
      access_.push_back(in);
    }
    if (!unknown.empty()) out_.zones[z].reason = "its access " + unknown + " is no junction of this network";
    else if (!is_attached) out_.zones[z].reason = "it has no access: lay a link to a junction, or allow a longer walk to one";
  }

  void find_indices() {
    for (const DistrictZone& zone : zones_) {
      zone_nodes_.push_back(network_->node_index(zone_name(zone.id)));
      zone_at_[zone_nodes_.back()] = zone_nodes_.size() - 1;
    }
  }

  std::vector<TripDemand> trips_of(const DistrictState& last) const {
    std::vector<TripDemand> trips;
    for (const DistrictState::Trips& row : last.trips) {
      const std::uint32_t from = network_->node_index(zone_name(row.origin)),
                          to = network_->node_index(zone_name(row.destination));
      if (from != kNoTrafficIndex && to != kNoTrafficIndex && row.trips > 0) trips.push_back({from, to, row.trips});
    }
    return trips;
  }

  std::vector<OriginFlow> flows_of(const DistrictState& last) const {
    std::vector<OriginFlow> flows;
    for (const DistrictState::Flow& row : last.flows) {
      const std::uint32_t from = network_->node_index(zone_name(row.origin)), link = network_->link_index(row.link);
      if (from != kNoTrafficIndex && link != kNoTrafficIndex && row.flow > 0) flows.push_back({from, link, row.flow});
    }
    return flows;
  }

  // Costs between all zones as the streets are now.
  void measure_times() {
    times_.clear();
    for (const std::uint32_t node : zone_nodes_) {
      const std::vector<double> labels = travel_costs(*network_, node, equilibrium_->costs());
      for (const std::uint32_t other : zone_nodes_) times_.push_back(labels[other]);
    }
  }

  // The trips that the gravity model wants, approached from those of the last step.
  std::vector<TripDemand> trips_wanted(const std::vector<TripDemand>& before) {
    const std::size_t n = zones_.size();
    std::vector<double> leaving, arriving, last(n * n, 0);
    for (const DistrictZone& zone : zones_) {
      leaving.push_back(zone.leaving);
      arriving.push_back(zone.arriving);
    }
    measure_times();
    const TripDistribution wanted = distribute_trips(times_, leaving, arriving, settings_.fade, settings_.constraint);
    for (const TripDemand& trip : before) last[zone_at_[trip.origin] * n + zone_at_[trip.destination]] += trip.trips;
    double apart = 0, all = 0, changed = 0;
    std::vector<TripDemand> trips;
    for (std::size_t i = 0; i < n; ++i) {
      // A zone whose sum has changed follows at once; only where its trips go is approached.
      double sum = 0, aim = 0;
      for (std::size_t j = 0; j < n; ++j) {
        // Who cannot be reached any more is not waited for: those trips end elsewhere at once.
        if (times_[i * n + j] == kUnreached) last[i * n + j] = 0;
        sum += last[i * n + j], aim += wanted.trips[i * n + j];
      }
      for (std::size_t j = 0; j < n; ++j) {
        const double goal = wanted.trips[i * n + j], held = sum > 0 ? last[i * n + j] * (aim / sum) : goal;
        apart += std::abs(goal - held);
        all += goal;
        changed += std::abs(last[i * n + j] - held);
        const double trip = held + settings_.haste * (goal - held);
        if (trip > kLeastShare * aim) trips.push_back({zone_nodes_[i], zone_nodes_[j], trip});
      }
      tell_lost(i, wanted.lost[i]);
    }
    out_.restlessness = all > 0 ? apart / all : 0;
    has_same_trips_ = apart <= kRest * all && changed <= kRest * all && trips.size() == before.size();
    return has_same_trips_ ? before : trips;
  }

  void tell_lost(std::size_t z, double lost) {
    DistrictResult::Zone& zone = out_.zones[z];
    zone.lost += lost;
    if (!(lost > 0)) return;
    if (zone.reason.empty()) zone.reason = "no other zone that trips could end in can be reached";
  }

  void read_totals() {
    const EquilibriumFigures figures = equilibrium_->figures();
    out_.gap = figures.gap;
    out_.trips = figures.trips;
    out_.total_time = figures.total_cost;
    out_.objective = figures.objective;
    out_.iterations = figures.iterations;
    for (const LostTrips& lost : equilibrium_->lost()) {
      DistrictResult::Zone& zone = out_.zones[zone_at_[lost.origin]];
      zone.lost += lost.trips;
      if (zone.reason.empty()) zone.reason = "no open street leads to `" + zones_[zone_at_[lost.destination]].id + "`";
    }
    for (const DistrictResult::Zone& zone : out_.zones) out_.lost += zone.lost;
  }

  void read_street(std::size_t s) {
    const DistrictStreet& street = streets_[s];
    DistrictResult::Street& result = out_.streets[s];
    for (const bool is_back : {false, true}) {
      const std::uint32_t link = network_->link_index(street.id + (is_back ? ":back" : ":forth"));
      if (link == kNoTrafficIndex) continue;
      const double flow = equilibrium_->flows()[link], time = network_->time(link, flow);
      (is_back ? result.flow_back : result.flow_forth) = flow;
      (is_back ? result.time_back : result.time_forth) = time;
      result.delay = std::max(result.delay, time - network_->time(link, 0));
      result.load = std::max(result.load, flow / street.capacity);
      out_.junctions[junction_at_.at(is_back ? street.start : street.end)].flow += flow;
    }
    for (const std::string* id : {&street.start, &street.end})
      if (const auto junction = junction_at_.find(*id); junction != junction_at_.end())
        out_.junctions[junction->second].load = std::max(out_.junctions[junction->second].load, result.load);
  }

  void read_zones() {
    measure_times();
    const std::size_t n = zones_.size();
    std::vector<double> arriving;
    for (const DistrictZone& zone : zones_) arriving.push_back(zone.arriving);
    for (std::size_t z = 0; z < n; ++z) {
      std::vector<double> others = arriving;
      others[z] = 0;
      out_.zones[z].accessibility = accessibility(std::span(times_).subspan(z * n, n), others, settings_.fade);
    }
    for (const Bush& bush : equilibrium_->bushes()) {
      const std::size_t from = zone_at_[bush.origin];
      for (const TripDemand& trip : bush.demands) {
        out_.zones[from].served += trip.trips;
        out_.zones[from].mean_time += trip.trips * times_[from * n + zone_at_[trip.destination]];
      }
    }
    for (DistrictResult::Zone& zone : out_.zones)
      if (zone.served > 0) zone.mean_time /= zone.served;
  }

  // Walking leads along all streets that are open, both ways, and through the access of the zone to the first junction.
  Result<void> read_reach() {
    if (std::none_of(zones_.begin(), zones_.end(), [](const DistrictZone& zone) { return zone.wants_reach; })) return {};
    std::vector<TrafficNode> nodes = places();
    std::vector<TrafficLink> links = access_;
    for (TrafficLink& link : links) link.length = link.free_time * settings_.walking_speed;
    for (std::size_t s = 0; s < streets_.size(); ++s) {
      const DistrictStreet& street = streets_[s];
      const bool has_ends = junction_at_.contains(street.start) && junction_at_.contains(street.end) && street.start != street.end;
      if (!street.is_open || !has_ends) continue;
      const std::string start = junction_node(street.start), end = junction_node(street.end);
      links.push_back({street.id + ":forth", start, end, 0, 0, 0, 1, out_.streets[s].length, 0, true});
      links.push_back({street.id + ":back", end, start, 0, 0, 0, 1, out_.streets[s].length, 0, true});
    }
    const auto walks = TrafficNetwork::make(std::move(nodes), std::move(links));
    if (!walks) return walks.error();
    const std::vector<double> walking = walking_costs(*walks, settings_.walking_speed);
    for (std::size_t z = 0; z < zones_.size(); ++z)
      if (zones_[z].wants_reach) read_reach_of(z, *walks, walking);
    return {};
  }

  void read_reach_of(std::size_t z, const TrafficNetwork& walks, const std::vector<double>& walking) {
    const std::vector<double> drive = travel_costs(*network_, zone_nodes_[z], equilibrium_->costs());
    const std::vector<double> walk = travel_costs(walks, walks.node_index(zone_name(zones_[z].id)), walking);
    for (const DistrictJunction& junction : junctions_) {
      const std::string name = junction_node(junction.id);
      const std::uint32_t whole = network_->node_index(name), split = network_->node_index(arrivals_of(name));
      const double driving = drive[split == kNoTrafficIndex ? whole : split], walking_there = walk[walks.node_index(name)];
      auto known = [&](double time) { return time == kUnreached ? -1.0 : time; };
      if (driving != kUnreached || walking_there != kUnreached)
        out_.zones[z].reach.push_back({junction.id, known(driving), known(walking_there)});
    }
  }

  void remember() {
    auto zone_of = [&](std::uint32_t node) { return network_->node(node).id.substr(2); };
    for (const OriginFlow& flow : equilibrium_->origin_flows())
      out_.state.flows.push_back({zone_of(flow.origin), network_->link(flow.link).id, flow.flow});
    for (const TripDemand& trip : equilibrium_->demands())
      out_.state.trips.push_back({zone_of(trip.origin), zone_of(trip.destination), trip.trips});
  }

  const std::vector<DistrictJunction>& junctions_;
  const std::vector<DistrictStreet>& streets_;
  const std::vector<DistrictRules>& rules_;
  const std::vector<DistrictZone>& zones_;
  const DistrictSettings& settings_;
  std::map<std::string, std::size_t> junction_at_;
  std::vector<TrafficLink> access_;  // between zones and junctions, as they were before turns
  std::unique_ptr<TrafficNetwork> network_;
  std::unique_ptr<Equilibrium> equilibrium_;
  std::vector<std::uint32_t> zone_nodes_;
  std::map<std::uint32_t, std::size_t> zone_at_;  // the other way round
  std::vector<double> times_;                     // from zone i to zone j at [i · zones + j]
  bool has_same_trips_ = false;  // as in the last step
  DistrictResult out_;
};

}  // namespace

Result<DistrictResult> step_district(const std::vector<DistrictJunction>& junctions, const std::vector<DistrictStreet>& streets,
                                     const std::vector<DistrictRules>& rules, const std::vector<DistrictZone>& zones,
                                     const DistrictSettings& settings, const DistrictState& last) {
  return District(junctions, streets, rules, zones, settings).step(last);
}

}  // namespace bl
