// Goes through nodes, links, sets, analyses and dependents in their order.
#include "tests/support/plan_differences.h"

#include <algorithm>

namespace bl {

namespace {

bool is_same(const std::optional<Error>& a, const std::optional<Error>& b) {
  return a.has_value() == b.has_value() && (!a || a->text() == b->text());
}

bool is_same(const TypePlan& a, const TypePlan& b) {
  return a.definition == b.definition && a.set_values == b.set_values && a.is_set == b.is_set && a.is_locked == b.is_locked &&
         a.is_served == b.is_served;
}

bool is_same(const NodePlan& a, const NodePlan& b) {
  return a.id == b.id && a.name == b.name && a.id_value == b.id_value &&
         std::equal(a.types.begin(), a.types.end(), b.types.begin(), b.types.end(),
                    [](const TypePlan& x, const TypePlan& y) { return is_same(x, y); });
}

// The parameters are structs that nobody can look into: what they do is seen in the ticks that follow.
bool is_same(const LinkPlan& a, const LinkPlan& b) {
  return a.id == b.id && a.definition == b.definition && a.is_enabled == b.is_enabled && a.is_muted == b.is_muted &&
         a.strength == b.strength && (a.parameters == nullptr) == (b.parameters == nullptr) && a.nodes[0] == b.nodes[0] &&
         a.nodes[1] == b.nodes[1] && a.is_symmetric == b.is_symmetric && a.reads == b.reads && a.targets == b.targets &&
         a.writes == b.writes && is_same(a.error, b.error);
}

bool is_same(const SetPlan& a, const SetPlan& b) {
  return a.node == b.node && a.type == b.type && a.set == b.set && a.members == b.members && a.reads == b.reads &&
         a.writes == b.writes && is_same(a.error, b.error);
}

bool is_same(const AnalysisPlan& a, const AnalysisPlan& b) {
  return a.node == b.node && a.type == b.type && a.first_set == b.first_set && a.set_count == b.set_count &&
         a.latency == b.latency;
}

bool is_same(const SetGroup& a, const SetGroup& b) {
  return a.node == b.node && a.type == b.type && a.first == b.first && a.count == b.count && a.analysis == b.analysis &&
         a.is_always_due == b.is_always_due && a.rivals == b.rivals;
}

template <class List>
bool is_same_list(const List& a, const List& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return is_same(x, y); });
}

template <class List, class Key>
bool holds_the_same(const List& a, const List& b, const Key& key) {
  const auto x = a[key], y = b[key];
  return std::equal(x.begin(), x.end(), y.begin(), y.end());
}

std::string dependents_difference(const Plan& plan, const Dependents& a, const Dependents& b) {
  if (!is_same_list(a.sets->groups, b.sets->groups)) return "groups of sets";
  if (a.sets->timed_nodes != b.sets->timed_nodes || a.links->timed != b.links->timed) return "who reads the time";
  if (a.links->broken != b.links->broken) return "broken links";
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    if (!holds_the_same(a.links->at, b.links->at, PortRef{n, 0, 0})) return "links at " + plan.nodes[n].id;
    for (std::uint16_t t = 0; t < plan.nodes[n].types.size(); ++t)
      for (std::uint16_t p = 0; p < plan.nodes[n].types[t].definition->ports.size(); ++p) {
        const PortRef port{n, t, p};
        if (a.sets->port_index(port) != b.sets->port_index(port)) return "index of a port of " + plan.nodes[n].id;
        if (!holds_the_same(a.links->reading, b.links->reading, port)) return "links that read " + plan.nodes[n].id;
        const std::size_t index = a.sets->port_index(port);
        if (!holds_the_same(a.sets->groups_reading, b.sets->groups_reading, index) ||
            !holds_the_same(a.sets->groups_writing, b.sets->groups_writing, index))
          return "sets at " + plan.nodes[n].id;
      }
  }
  return "";
}

}  // namespace

std::string plan_difference(const Plan& a, const Plan& b) {
  if (!(a.scene == b.scene)) return "scene";
  if (a.nodes.size() != b.nodes.size() || a.links.size() != b.links.size() || a.sets.size() != b.sets.size()) return "size";
  for (std::size_t n = 0; n < a.nodes.size(); ++n)
    if (!is_same(a.nodes[n], b.nodes[n])) return "node " + a.nodes[n].id;
  for (std::uint32_t n = 0; n < a.nodes.size(); ++n)
    if (a.forms->types_of(n) != b.forms->types_of(n)) return "form of " + a.nodes[n].id;
  for (std::size_t l = 0; l < a.links.size(); ++l)
    if (!is_same(a.links[l], b.links[l])) return "link " + a.links[l].id;
  for (std::size_t s = 0; s < a.sets.size(); ++s)
    if (!is_same(a.sets[s], b.sets[s])) return "set of " + a.nodes[a.sets[s].node].id;
  if (!is_same_list(a.analyses, b.analyses)) return "analyses";
  return dependents_difference(a, *a.dependents, *b.dependents);
}

}  // namespace bl
