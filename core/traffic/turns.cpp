// Splitting nodes: one more node for each restricted way in and out, and one for all other ways out.
#include "core/traffic/turns.h"

#include <map>
#include <set>

namespace bl::traffic {

namespace {

// What is forbidden at one node: ways out by way in, and all ways out that are forbidden to somebody.
struct NodeTurns {
  std::map<std::string, std::set<std::string>> by_arrival;
  std::set<std::string> departures;
};

// By node, so that all names below come in one order whatever the order of the input.
Result<std::map<std::string, NodeTurns>> turns_by_node(const std::vector<TrafficNode>& nodes,
                                                       const std::vector<TrafficLink>& links,
                                                       const std::vector<ForbiddenTurn>& turns) {
  std::map<std::string_view, const TrafficLink*> link_of;
  for (const TrafficLink& link : links) link_of[link.id] = &link;
  std::set<std::string_view> closed;
  for (const TrafficNode& node : nodes)
    if (!node.is_through) closed.insert(node.id);
  std::map<std::string, NodeTurns> found;
  for (const ForbiddenTurn& turn : turns) {
    const auto from = link_of.find(turn.from), to = link_of.find(turn.to);
    if (from == link_of.end() || to == link_of.end())
      return Error{ErrorCode::not_found, turn.from,
                   "there is no link `" + (from == link_of.end() ? turn.from : turn.to) + "` to forbid a turn at"};
    const std::string& node = from->second->to;
    if (to->second->from != node)
      return Error{ErrorCode::conflict, turn.from, "it ends at `" + node + "`, where `" + turn.to + "` does not begin"};
    if (closed.contains(node))
      return Error{ErrorCode::conflict, turn.from,
                   "nothing passes `" + node + "` anyway; leave the turn to `" + turn.to + "` out"};
    found[node].by_arrival[turn.from].insert(turn.to);
    found[node].departures.insert(turn.to);
  }
  return found;
}

void add_turns(const std::string& node, const NodeTurns& turns, std::vector<TrafficNode>& nodes,
               std::vector<TrafficLink>& links) {
  nodes.push_back({arrivals_of(node), true});
  for (const std::string& departure : turns.departures) nodes.push_back({node + ">" + departure, true});
  const auto leave = [&](const std::string& place, const std::set<std::string>& forbidden) {
    const auto turn = [&](const std::string& departure) {
      links.push_back({place + ">" + departure + ":turn", place, node + ">" + departure, 0, 0, 0, 1, 0, 0, true});
    };
    turn("");
    for (const std::string& departure : turns.departures)
      if (!forbidden.contains(departure)) turn(departure);
  };
  leave(node, {});
  for (const auto& [arrival, forbidden] : turns.by_arrival) {
    nodes.push_back({node + "<" + arrival, true});
    leave(node + "<" + arrival, forbidden);
  }
}

}  // namespace

Result<void> forbid_turns(std::vector<TrafficNode>& nodes, std::vector<TrafficLink>& links,
                          const std::vector<ForbiddenTurn>& turns) {
  if (turns.empty()) return {};
  const auto by_node = turns_by_node(nodes, links, turns);
  if (!by_node) return by_node.error();
  for (TrafficLink& link : links) {
    const auto begin = by_node->find(link.from), end = by_node->find(link.to);
    if (begin != by_node->end()) link.from += begin->second.departures.contains(link.id) ? ">" + link.id : ">";
    if (end != by_node->end() && end->second.by_arrival.contains(link.id)) link.to += "<" + link.id;
  }
  for (const auto& [node, forbidden] : *by_node) add_turns(node, forbidden, nodes, links);
  return {};
}

}  // namespace bl::traffic
