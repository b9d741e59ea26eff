// Looks up the settings of nodes, and the ports of the members of sets.
#include "core/graph/node_compiler.h"

#include <algorithm>

#include "core/graph/port_finder.h"

namespace bl {

namespace {

// Of several sets over one selection the first says what its nodes must have; a further one takes those that have more.
bool is_further(const TypificationDefinition& definition, std::uint32_t s) {
  return std::any_of(definition.sets.begin(), definition.sets.begin() + s,
                     [&](const SetDefinition& set) { return set.selection == definition.sets[s].selection; });
}

}  // namespace

NodePlan compiled_node(const Scene& scene, const Registry& registry, const std::string& id, const NodeRecord& record) {
  NodePlan node{id, record.name.empty() ? id : record.name, id, {}};
  for (const auto& [type_id, values] : record.types) {
    const TypificationDefinition* definition = registry.typification(type_id);
    if (definition == nullptr) continue;
    TypePlan& type = node.types.emplace_back();
    type.definition = definition;
    type.is_served = static_cast<bool>(definition->evaluate);
    for (const PortDefinition& port : definition->ports) {
      const Value& value = set_value(scene.settings, values, port);
      type.is_set.push_back(is_said(values, port, value));
      type.set_values.push_back(value);
      type.is_locked.push_back(!record.locked.empty() && record.locked.contains(definition->id + "." + port.id));
    }
  }
  return node;
}

SetPlan compiled_set(const Plan& plan, const Registry& registry, std::uint32_t n, std::uint32_t t, std::uint32_t s) {
  SetPlan set{n, t, s, {}, {}, {}, std::nullopt};
  const TypePlan& type = plan.nodes[n].types[t];
  const SetDefinition& definition = type.definition->sets[s];
  const std::string place = "nodes/" + plan.nodes[n].id + "/" + type.definition->id + "/" + definition.selection;
  const auto& selection = *std::get<Shared<Selection>>(type.set_values[type.definition->port_index(definition.selection)]);
  const auto finders_of = [&](const auto& declared) {
    std::vector<PortFinder> finders;
    for (const auto& one : declared) finders.emplace_back(plan, actual_path(*type.definition, one.path, type.set_values));
    return finders;
  };
  std::vector<PortFinder> read_finders = finders_of(definition.reads), write_finders = finders_of(definition.writes);
  for (const std::uint32_t node : selected_nodes(plan, registry, selection)) {
    const std::size_t reads = set.reads.size(), writes = set.writes.size();
    const PortPath* missing = nullptr;
    const auto look_up = [&](PortFinder& finder, std::vector<PortRef>& refs) {
      if (const auto ref = finder.at(node)) refs.push_back(*ref);
      else missing = &finder.path();
    };
    for (std::size_t r = 0; r < read_finders.size(); ++r) {
      look_up(read_finders[r], set.reads);
      if (missing != nullptr || set.reads.back().type == PortRef::kNodeId) continue;
      const ReadDefinition& read = definition.reads[r];
      if (auto kind = check_kind(plan, set.reads.back(), read.kind, read.made, "evaluation reads"); !kind)
        set.error = kind.error().within(place);
    }
    for (PortFinder& finder : write_finders) look_up(finder, set.writes);
    if (missing == nullptr) {
      set.members.push_back(node);
      continue;
    }
    set.reads.resize(reads);
    set.writes.resize(writes);
    if (!selection.is_query() && !is_further(*type.definition, s))
      set.error = Error{ErrorCode::conflict, place,
                        "the node `" + plan.nodes[node].id + "` has no `" + missing->typification + "." + missing->port + "`"};
  }
  return set;
}

std::vector<std::uint32_t> mark_served(Plan& plan) {
  // By node and typification: is it written to by a set?
  std::vector<std::uint64_t> written;
  for (const SetPlan& set : plan.sets)
    for (const PortRef& ref : set.writes)
      if (const std::uint64_t one = std::uint64_t{ref.node} << 16 | ref.type; written.empty() || written.back() != one)
        written.push_back(one);
  std::sort(written.begin(), written.end());
  std::vector<std::uint32_t> changed;
  SharedItems<NodePlan>::Draft nodes(plan.nodes);
  for (std::uint32_t n = 0; n < nodes.size(); ++n)
    for (std::uint32_t t = 0; t < nodes[n].types.size(); ++t) {
      const TypePlan& type = nodes[n].types[t];
      const bool is_served =
          type.definition->evaluate || std::binary_search(written.begin(), written.end(), std::uint64_t{n} << 16 | t);
      if (type.is_served == is_served) continue;
      nodes.edit(n).types[t].is_served = is_served;
      if (changed.empty() || changed.back() != n) changed.push_back(n);
    }
  plan.nodes = published<NodePlan>(std::move(nodes));
  return changed;
}

}  // namespace bl
