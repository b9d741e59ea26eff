// Both directions of a street, each reached from its own end, laid over each other.
#include "core/traffic/street_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/traffic/district_turns.h"
#include "core/traffic/reach.h"

namespace bl::traffic {

namespace {

// Where one comes from; junctions are told apart from it by their prefix.
constexpr const char* kOrigin = "origin";

TrafficLink way(std::string id, std::string from, std::string to, double seconds) {
  TrafficLink link;
  link.id = std::move(id);
  link.from = std::move(from);
  link.to = std::move(to);
  link.free_time = seconds;
  link.alpha = 0;
  link.power = 1;
  return link;
}

std::vector<ForbiddenTurn> turns_of(std::span<const ReachStreet> streets, std::span<const TrafficLink> links,
                                    std::span<const DistrictRules> rules) {
  std::vector<DistrictStreet> known;
  for (const ReachStreet& street : streets) {
    DistrictStreet& one = known.emplace_back();
    one.id = street.id;
    one.start = street.start;
    one.end = street.end;
    one.is_one_way = !std::isfinite(street.back);
  }
  std::vector<DistrictResult::Rules> unread;  // the network of the scene has told what does not hold
  return forbidden_turns(rules, known, links, unread);
}

Result<TrafficNetwork> network_of(std::span<const ReachStreet> streets, std::span<const ReachEntry> entries,
                                  std::span<const DistrictRules> rules) {
  std::set<std::string> junctions;
  std::vector<TrafficLink> links;
  for (const ReachStreet& street : streets) {
    junctions.insert({street.start, street.end});
    if (street.start == street.end) continue;  // no way leads over it
    const std::string start = junction_node(street.start), end = junction_node(street.end);
    if (std::isfinite(street.forth)) links.push_back(way(street.id + ":forth", start, end, street.forth));
    if (std::isfinite(street.back)) links.push_back(way(street.id + ":back", end, start, street.back));
  }
  const std::vector<ForbiddenTurn> turns = turns_of(streets, links, rules);
  std::vector<TrafficNode> nodes{{kOrigin, false}};
  for (const std::string& id : junctions) nodes.push_back({junction_node(id), true});
  std::set<std::string> entered;
  for (const ReachEntry& entry : entries)
    if (junctions.contains(entry.junction) && entered.insert(entry.junction).second)
      links.push_back(way(":" + entry.junction, kOrigin, junction_node(entry.junction), entry.seconds));
  if (auto split = forbid_turns(nodes, links, turns); !split) return split.error();
  return TrafficNetwork::make(std::move(nodes), std::move(links));
}

// How far one comes on each link within a time, as a share of it; 0 for links that are not begun.
std::vector<double> shares_of(const TrafficNetwork& network, std::uint32_t origin, std::span<const double> labels,
                              std::span<const double> costs, double time) {
  std::vector<double> shares(network.link_count(), 0);
  for (const ReachedLink& reached : reached_links(network, origin, labels, costs, time)) shares[reached.link] = reached.share;
  return shares;
}

// The same for a loop, which is no link of the network: it is begun from its junction on both sides.
double share_of_loop(double at_junction, double seconds, double time) {
  if (!std::isfinite(seconds) || !(at_junction < time)) return 0;
  return seconds > 0 ? std::min(1.0, (time - at_junction) / seconds) : 1;
}

// When one is at a junction, by whatever street one came.
double time_at(const TrafficNetwork& network, std::span<const double> labels, const std::string& junction) {
  const std::string name = junction_node(junction);
  const std::uint32_t split = network.node_index(arrivals_of(name));
  return labels[split == kNoTrafficIndex ? network.node_index(name) : split];
}

Result<void> check_loop(const ReachStreet& street) {
  for (const auto& [seconds, direction] : {std::pair{street.forth, ":forth"}, {street.back, ":back"}})
    if (!(seconds >= 0)) return Error{ErrorCode::out_of_range, street.id + direction, "its time has to be 0 or more"};
  return {};
}

// `forth` and `back`: per time, the shares that are reached from the start and from the end.
void lay_over(std::size_t street, std::span<const std::array<double, 2>> shares, std::vector<ReachedPart>& parts) {
  std::vector<double> cuts{0, 1};
  for (const auto& [forth, back] : shares) cuts.insert(cuts.end(), {forth, 1 - back});
  std::sort(cuts.begin(), cuts.end());
  const std::size_t before = parts.size();
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double begin = cuts[k], end = cuts[k + 1], middle = 0.5 * (begin + end);
    if (!(end > begin)) continue;
    const auto first =
        std::find_if(shares.begin(), shares.end(), [&](const auto& s) { return middle < s[0] || middle > 1 - s[1]; });
    if (first == shares.end()) continue;
    const auto band = static_cast<std::size_t>(first - shares.begin());
    const bool goes_on = parts.size() > before && parts.back().band == band && parts.back().end == begin;
    if (goes_on) parts.back().end = end;
    else parts.push_back({street, band, begin, end});
  }
}

}  // namespace

Result<std::vector<ReachedPart>> reached_parts(std::span<const ReachStreet> streets, std::span<const ReachEntry> entries,
                                               std::span<const double> times, std::span<const DistrictRules> rules) {
  const auto network = network_of(streets, entries, rules);
  if (!network) return network.error();
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network->link_count(); ++l) costs.push_back(network->cost(l, 0));
  const std::uint32_t origin = network->node_index(kOrigin);
  const std::vector<double> labels = travel_costs(*network, origin, costs);
  std::vector<std::vector<double>> reached;
  for (const double time : times) reached.push_back(shares_of(*network, origin, labels, costs, time));
  std::vector<ReachedPart> parts;
  for (std::size_t s = 0; s < streets.size(); ++s) {
    if (streets[s].start == streets[s].end) {
      if (auto sound = check_loop(streets[s]); !sound) return sound.error();
      const double label = time_at(*network, labels, streets[s].start);
      std::vector<std::array<double, 2>> shares;
      for (const double time : times)
        shares.push_back({share_of_loop(label, streets[s].forth, time), share_of_loop(label, streets[s].back, time)});
      lay_over(s, shares, parts);
      continue;
    }
    const std::uint32_t forth = network->link_index(streets[s].id + ":forth"),
                        back = network->link_index(streets[s].id + ":back");
    std::vector<std::array<double, 2>> shares;
    for (const std::vector<double>& of : reached)
      shares.push_back({forth == kNoTrafficIndex ? 0 : of[forth], back == kNoTrafficIndex ? 0 : of[back]});
    lay_over(s, shares, parts);
  }
  return parts;
}

}  // namespace bl::traffic
