// The network of a district: what follows from its streets, junctions, rules and the places of its zones, whatever the trips are.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/traffic/district.h"
#include "core/traffic/network.h"

namespace bl::traffic {

struct DistrictNetwork {
  DistrictParts parts;  ///< what it was made of

  TrafficNetwork network;
  std::vector<std::string> link_ids;                   ///< as the network's links
  std::vector<DistrictResult::Street> street_results;  ///< length and reason
  std::vector<DistrictResult::Rules> rule_results;
  std::vector<int> streets_at;                             ///< by junction
  std::vector<std::string> zone_reasons;                   ///< why a zone is not attached
  std::vector<std::array<std::uint32_t, 2>> street_links;  ///< forth and back; kNoTrafficIndex where nobody drives
  std::vector<std::array<std::uint32_t, 2>> street_ends;   ///< start and end as junctions of the list, or kNoTrafficIndex
  std::vector<std::uint32_t> arrivals;                     ///< by junction: the node where all arrive
  std::vector<std::uint32_t> zone_nodes, zone_at;          ///< node by zone, and zone by node
  std::vector<TrafficLink> access;                         ///< walks between zones and junctions

  /// Would the same come of these? Trips of zones, and settings that streets do not depend on, may differ.
  bool is_made_of(const DistrictParts& others) const;
};

/// An error's place is the id of what is wrong.
Result<DistrictNetwork> make_district_network(const DistrictParts& parts);

/// The name of a zone's node; `:` stands in no id.
inline std::string zone_node(const std::string& id) { return "z:" + id; }

/// Walking leads along all streets that are open, both ways, and through the access of a zone to the first junction. Times on
/// foot from one zone to all junctions [s]; kUnreached where no way leads.
class DistrictWalks {
 public:
  static Result<DistrictWalks> make(const DistrictNetwork& district);
  std::vector<double> from(const DistrictNetwork& district, std::size_t zone) const;

 private:
  TrafficNetwork network_;
  std::vector<double> costs_;
};

}  // namespace bl::traffic
