// Rules at the junctions of a district as forbidden turns between the links of its streets.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/traffic/district.h"
#include "core/traffic/turns.h"

namespace bl::traffic {

/// The node of a network that stands for a junction of a district: junctions and zones may have one id, because a node may be
/// both; `:` stands in no id.
inline std::string junction_node(const std::string& id) { return "j:" + id; }

/// `links`: those of streets ("street:forth", "street:back") that are in the network; a rule about others forbids nothing now.
/// `results` gets one entry for each junction with rules. A rule that does not hold has its reason there and forbids nothing.
std::vector<ForbiddenTurn> forbidden_turns(std::span<const DistrictRules> rules, std::span<const DistrictStreet> streets,
                                           std::span<const TrafficLink> links, std::vector<DistrictResult::Rules>& results);

}  // namespace bl::traffic
