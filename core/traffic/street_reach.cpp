// Both directions of a street, each reached from its own end, laid over each other.
#include "core/traffic/street_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/traffic/reach.h"

namespace bl {

namespace {

// Where one comes from; junctions are told apart from it by their prefix.
constexpr const char* kOrigin = "origin";
std::string junction_name(const std::string& id) { return "j:" + id; }

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

Result<TrafficNetwork> network_of(std::span<const ReachStreet> streets, std::span<const ReachEntry> entries) {
  std::set<std::string> junctions;
  std::vector<TrafficLink> links;
  for (const ReachStreet& street : streets) {
    if (street.start == street.end) continue;
    junctions.insert({street.start, street.end});
    const std::string start = junction_name(street.start), end = junction_name(street.end);
    if (std::isfinite(street.forth)) links.push_back(way(street.id + ":forth", start, end, street.forth));
    if (std::isfinite(street.back)) links.push_back(way(street.id + ":back", end, start, street.back));
  }
  std::vector<TrafficNode> nodes{{kOrigin, false}};
  for (const std::string& id : junctions) nodes.push_back({junction_name(id), true});
  std::set<std::string> entered;
  for (const ReachEntry& entry : entries)
    if (junctions.contains(entry.junction) && entered.insert(entry.junction).second)
      links.push_back(way(":" + entry.junction, kOrigin, junction_name(entry.junction), entry.seconds));
  return TrafficNetwork::make(std::move(nodes), std::move(links));
}

// How far one comes on each link within a time, as a share of it; 0 for links that are not begun.
std::vector<double> shares_of(const TrafficNetwork& network, std::uint32_t origin, std::span<const double> labels,
                              std::span<const double> costs, double time) {
  std::vector<double> shares(network.link_count(), 0);
  for (const ReachedLink& reached : reached_links(network, origin, labels, costs, time)) shares[reached.link] = reached.share;
  return shares;
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
                                               std::span<const double> times) {
  const auto network = network_of(streets, entries);
  if (!network) return network.error();
  std::vector<double> costs;
  for (std::uint32_t l = 0; l < network->link_count(); ++l) costs.push_back(network->cost(l, 0));
  const std::uint32_t origin = network->node_index(kOrigin);
  const std::vector<double> labels = travel_costs(*network, origin, costs);
  std::vector<std::vector<double>> reached;
  for (const double time : times) reached.push_back(shares_of(*network, origin, labels, costs, time));
  std::vector<ReachedPart> parts;
  for (std::size_t s = 0; s < streets.size(); ++s) {
    const std::uint32_t forth = network->link_index(streets[s].id + ":forth"),
                        back = network->link_index(streets[s].id + ":back");
    std::vector<std::array<double, 2>> shares;
    for (const std::vector<double>& of : reached)
      shares.push_back({forth == kNoTrafficIndex ? 0 : of[forth], back == kNoTrafficIndex ? 0 : of[back]});
    lay_over(s, shares, parts);
  }
  return parts;
}

}  // namespace bl
