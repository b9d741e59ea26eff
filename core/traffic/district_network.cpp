// Junctions, streets and zones by id become nodes and links; what is left out gets its reason.
#include "core/traffic/district_network.h"

#include <algorithm>
#include <map>

#include "core/traffic/district_turns.h"
#include "core/traffic/reach.h"
#include "core/traffic/street_line.h"

namespace bl::traffic {

namespace {

// Streets that let pass fewer are closed [1/h]: nobody could wait for them.
constexpr double kLeastCapacity = 1e-9;

std::vector<TrafficNode> places_of(const DistrictNetwork& district) {
  std::vector<TrafficNode> nodes;
  for (const DistrictJunction& junction : district.parts.junctions) nodes.push_back({junction_node(junction.id), true});
  for (const DistrictZone& zone : district.parts.zones) nodes.push_back({zone_node(zone.id), false});
  return nodes;
}

class Maker {
 public:
  explicit Maker(DistrictNetwork& district) : out_(district) {
    for (std::size_t j = 0; j < out_.parts.junctions.size(); ++j)
      junction_at_[out_.parts.junctions[j].id] = static_cast<std::uint32_t>(j);
    out_.street_results.resize(out_.parts.streets.size());
    out_.street_ends.resize(out_.parts.streets.size());
    out_.streets_at.resize(out_.parts.junctions.size());
    out_.zone_reasons.resize(out_.parts.zones.size());
  }

  Result<void> make() {
    std::vector<TrafficNode> nodes = places_of(out_);
    std::vector<TrafficLink> links;
    for (std::size_t s = 0; s < out_.parts.streets.size(); ++s) add_street(s, links);
    const std::vector<ForbiddenTurn> turns = forbidden_turns(out_.parts.rules, out_.parts.streets, links, out_.rule_results);
    for (std::size_t z = 0; z < out_.parts.zones.size(); ++z) add_access(z);
    links.insert(links.end(), out_.access.begin(), out_.access.end());
    if (auto split = forbid_turns(nodes, links, turns); !split) return split.error();
    auto made = TrafficNetwork::make(std::move(nodes), std::move(links),
                                     {out_.parts.settings.toll_factor, out_.parts.settings.distance_factor});
    if (!made) return made.error();
    out_.network = std::move(*made);
    find_indices();
    return {};
  }

 private:
  std::uint32_t junction_of(const std::string& id) const {
    const auto junction = junction_at_.find(id);
    return junction == junction_at_.end() ? kNoTrafficIndex : junction->second;
  }

  void add_street(std::size_t s, std::vector<TrafficLink>& links) {
    const DistrictStreet& street = out_.parts.streets[s];
    DistrictResult::Street& result = out_.street_results[s];
    const std::uint32_t start = junction_of(street.start), end = junction_of(street.end);
    out_.street_ends[s] = {start, end};
    if (start == kNoTrafficIndex || end == kNoTrafficIndex) {
      const bool is_start = start == kNoTrafficIndex;
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
    ++out_.streets_at[start];
    if (!is_loop) ++out_.streets_at[end];
    result.length = street.length > 0
                        ? street.length
                        : street_length(out_.parts.junctions[start].position, street.course, out_.parts.junctions[end].position);
    if (!street.is_for_cars) result.reason = "it is for walking only";
    else if (!street.is_open) result.reason = "it is closed";
    else if (street.capacity < kLeastCapacity) result.reason = "its capacity is next to nothing, so that it counts as closed";
    if (!result.reason.empty()) return;
    const double time = result.length / street.speed;
    if (is_loop) {  // one may drive round, but no way from zone to zone is the shorter for it
      result.time_forth = time + out_.parts.junctions[end].delay;
      if (!street.is_one_way) result.time_back = result.time_forth;
      return;
    }
    const DistrictSettings& settings = out_.parts.settings;
    links.push_back({street.id + ":forth", junction_node(street.start), junction_node(street.end), time, street.capacity,
                     settings.alpha, settings.beta, result.length, street.toll, true, out_.parts.junctions[end].delay});
    if (street.is_one_way) return;
    links.push_back({street.id + ":back", junction_node(street.end), junction_node(street.start), time, street.capacity,
                     settings.alpha, settings.beta, result.length, street.toll, true, out_.parts.junctions[start].delay});
  }

  // On foot between a zone and its junctions.
  void add_access(std::size_t z) {
    const DistrictZone& zone = out_.parts.zones[z];
    std::vector<std::string> access = zone.access;
    if (access.empty() && junction_at_.contains(zone.id)) access.push_back(zone.id);
    std::sort(access.begin(), access.end());
    access.erase(std::unique(access.begin(), access.end()), access.end());
    std::string unknown;
    bool is_attached = false;
    for (const std::string& id : access) {
      const std::uint32_t junction = junction_of(id);
      if (junction == kNoTrafficIndex) {
        unknown += (unknown.empty() ? "`" : ", `") + id + "`";
        continue;
      }
      is_attached = true;
      const double walk = distance(zone.position, out_.parts.junctions[junction].position) / out_.parts.settings.walking_speed;
      out_.access.push_back({zone.id + ":out:" + id, zone_node(zone.id), junction_node(id), walk, 0, 0, 1, 0, 0, true});
      out_.access.push_back({zone.id + ":in:" + id, junction_node(id), zone_node(zone.id), walk, 0, 0, 1, 0, 0, true});
    }
    if (!unknown.empty()) out_.zone_reasons[z] = "its access " + unknown + " is no junction of this network";
    else if (!is_attached) out_.zone_reasons[z] = "it has no access: lay a link to a junction, or allow a longer walk to one";
  }

  void find_indices() {
    const TrafficNetwork& network = out_.network;
    for (std::uint32_t l = 0; l < network.link_count(); ++l) out_.link_ids.push_back(network.link(l).id);
    for (const DistrictStreet& street : out_.parts.streets)
      out_.street_links.push_back({network.link_index(street.id + ":forth"), network.link_index(street.id + ":back")});
    for (const DistrictJunction& junction : out_.parts.junctions) {
      const std::string name = junction_node(junction.id);
      const std::uint32_t split = network.node_index(arrivals_of(name));
      out_.arrivals.push_back(split == kNoTrafficIndex ? network.node_index(name) : split);
    }
    out_.zone_at.assign(network.node_count(), kNoTrafficIndex);
    for (const DistrictZone& zone : out_.parts.zones) {
      out_.zone_nodes.push_back(network.node_index(zone_node(zone.id)));
      out_.zone_at[out_.zone_nodes.back()] = static_cast<std::uint32_t>(out_.zone_nodes.size() - 1);
    }
  }

  DistrictNetwork& out_;
  std::map<std::string, std::uint32_t> junction_at_;
};

}  // namespace

bool DistrictNetwork::is_made_of(const DistrictParts& others) const {
  const DistrictSettings &own = parts.settings, &other = others.settings;
  const bool has_settings = own.alpha == other.alpha && own.beta == other.beta && own.toll_factor == other.toll_factor &&
                            own.distance_factor == other.distance_factor && own.walking_speed == other.walking_speed;
  return has_settings && parts.junctions == others.junctions && parts.streets == others.streets && parts.rules == others.rules &&
         std::equal(parts.zones.begin(), parts.zones.end(), others.zones.begin(), others.zones.end(),
                    [](const DistrictZone& a, const DistrictZone& b) {
                      return a.id == b.id && a.position == b.position && a.access == b.access;
                    });
}

Result<DistrictNetwork> make_district_network(const DistrictParts& parts) {
  DistrictNetwork district;
  district.parts = parts;
  if (auto made = Maker(district).make(); !made) return made.error();
  return district;
}

Result<DistrictWalks> DistrictWalks::make(const DistrictNetwork& district) {
  std::vector<TrafficLink> links = district.access;
  for (TrafficLink& link : links) link.length = link.free_time * district.parts.settings.walking_speed;
  for (std::size_t s = 0; s < district.parts.streets.size(); ++s) {
    const DistrictStreet& street = district.parts.streets[s];
    const auto [first, last] = district.street_ends[s];
    if (!street.is_open || first == kNoTrafficIndex || last == kNoTrafficIndex || street.start == street.end) continue;
    const std::string start = junction_node(street.start), end = junction_node(street.end);
    links.push_back({street.id + ":forth", start, end, 0, 0, 0, 1, district.street_results[s].length, 0, true});
    links.push_back({street.id + ":back", end, start, 0, 0, 0, 1, district.street_results[s].length, 0, true});
  }
  auto made = TrafficNetwork::make(places_of(district), std::move(links));
  if (!made) return made.error();
  DistrictWalks walks;
  walks.network_ = std::move(*made);
  walks.costs_ = walking_costs(walks.network_, district.parts.settings.walking_speed);
  return walks;
}

std::vector<double> DistrictWalks::from(const DistrictNetwork& district, std::size_t zone) const {
  const std::vector<double> labels =
      travel_costs(network_, network_.node_index(zone_node(district.parts.zones[zone].id)), costs_);
  std::vector<double> times;
  for (const DistrictJunction& junction : district.parts.junctions)
    times.push_back(labels[network_.node_index(junction_node(junction.id))]);
  return times;
}

}  // namespace bl::traffic
