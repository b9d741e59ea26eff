// Turns the lists of a plan around: from who reads what to who is read by whom.
#include "core/graph/dependents.h"

#include <algorithm>

#include "core/graph/phases.h"

namespace bl {

namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

void add_links(const Plan& plan, Dependents& index, std::size_t ports) {
  Pairs reading, at;
  for (std::uint32_t l = 0; l < plan.links.size(); ++l) {
    const LinkPlan& link = plan.links[l];
    if (!link.is_enabled) continue;
    if (link.error) {
      index.broken_links.push_back(l);
      continue;
    }
    for (const auto& refs : link.reads)
      for (const PortRef& ref : refs)
        if (ref.type != PortRef::kNodeId) reading.emplace_back(index.port_index(ref), l);
    if (link.definition->reads_time) index.timed_links.push_back(l);
  }
  for (std::uint32_t l = 0; l < plan.links.size(); ++l)
    for (const PortRef& ref : plan.links[l].targets) at.emplace_back(ref.node, l);
  index.links_reading = NumberLists::made(ports, std::move(reading));
  index.links_at = NumberLists::made(plan.nodes.size(), std::move(at));
}

void add_groups(const Plan& plan, Dependents& index, std::size_t ports) {
  Pairs reading, writing;
  std::size_t analysis = 0;
  for (std::size_t begin = 0, end = 0; begin < plan.sets.size(); begin = end) {
    const SetPlan& head = plan.sets[begin];
    const auto group = static_cast<std::uint32_t>(index.groups.size());
    while (end < plan.sets.size() && plan.sets[end].node == head.node && plan.sets[end].type == head.type) ++end;
    SetGroup& one = index.groups.emplace_back(SetGroup{head.node, head.type, begin, end - begin});
    if (analysis < plan.analyses.size() && plan.analyses[analysis].first_set == begin) one.analysis = analysis++;
    const TypificationDefinition& definition = *plan.nodes[head.node].types[head.type].definition;
    one.is_always_due = definition.reads_time;
    for (std::uint16_t p = 0; p < definition.ports.size(); ++p) {
      const PortRef own{head.node, static_cast<std::uint16_t>(head.type), p};
      const PortDefinition& port = definition.ports[p];
      if (port.is_computed) writing.emplace_back(index.port_index(own), group);
      if (!port.is_computed || port.recall) reading.emplace_back(index.port_index(own), group);
    }
    for (std::size_t s = begin; s < end; ++s) {
      for (const PortRef& ref : plan.sets[s].reads)
        if (ref.type != PortRef::kNodeId) reading.emplace_back(index.port_index(ref), group);
      for (const PortRef& ref : plan.sets[s].writes) writing.emplace_back(index.port_index(ref), group);
    }
  }
  index.groups_reading = NumberLists::made(ports, std::move(reading));
  index.groups_writing = NumberLists::made(ports, std::move(writing));
  for (std::size_t port = 0; port < ports; ++port)
    if (const auto writers = index.groups_writing[port]; writers.size() > 1)
      for (const std::uint32_t group : writers) index.groups[group].is_always_due = true;
}

}  // namespace

NumberLists NumberLists::made(std::size_t keys, std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  NumberLists lists;
  lists.starts_.assign(keys + 1, 0);
  lists.numbers_.reserve(pairs.size());
  for (const auto& [key, number] : pairs) {
    ++lists.starts_[key + 1];
    lists.numbers_.push_back(number);
  }
  for (std::size_t key = 0; key < keys; ++key) lists.starts_[key + 1] += lists.starts_[key];
  return lists;
}

std::size_t Dependents::port_index(const PortRef& ref) const { return first_port[first_type[ref.node] + ref.type] + ref.port; }

Dependents dependents_of(const Plan& plan) {
  Dependents index;
  std::uint32_t ports = 0;
  for (std::uint32_t n = 0; n < plan.nodes.size(); ++n) {
    index.first_type.push_back(static_cast<std::uint32_t>(index.first_port.size()));
    bool is_timed = false;
    for (const TypePlan& type : plan.nodes[n].types) {
      index.first_port.push_back(ports);
      ports += static_cast<std::uint32_t>(type.definition->ports.size());
      is_timed |= type.definition->evaluate && type.definition->sets.empty() && type.definition->reads_time;
    }
    if (is_timed) index.timed_nodes.push_back(n);
  }
  add_links(plan, index, ports);
  add_groups(plan, index, ports);
  return index;
}

}  // namespace bl
