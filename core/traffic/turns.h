// Forbidden turns: splits the nodes that have any, so that the allowed links depend on the link of arrival.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/traffic/network.h"

namespace bl::traffic {

/// The turn from the link `from` into the link `to`, which begins where `from` ends, is forbidden. Both are ids of links.
struct ForbiddenTurn {
  std::string from, to;
};

/// Where all meet who arrive at a node that was split, and from where they go on by links that are forbidden to nobody.
inline std::string arrivals_of(const std::string& node) { return node + ">"; }
/// Do the links of this id stand for turns within a split node? They cost nothing and have no length.
inline bool is_turn(std::string_view link) { return link.ends_with(":turn"); }

/// Changes nodes and links as TrafficNetwork::make() takes them; only nodes with forbidden turns are touched. Such a node becomes
///   `node`        who sets out there, and who arrives by links without a forbidden turn,
///   `node<link`   who arrives by a link from which some turn is forbidden,
///   `node>link`   who leaves by a link that is forbidden to some,
///   `node>`       arrivals_of(node): all others who leave, and all who end there,
/// joined by turns for what is allowed. Links keep their ids, and all names follow from ids. Turns named twice count once.
/// An unknown link, links that do not meet, and a node that lets nothing through anyway are errors with `from` as their place.
Result<void> forbid_turns(std::vector<TrafficNode>& nodes, std::vector<TrafficLink>& links,
                          const std::vector<ForbiddenTurn>& turns);

}  // namespace bl::traffic
