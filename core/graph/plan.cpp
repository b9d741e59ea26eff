// Compiling a scene: resolving ends, ports and units once, so that a tick only follows indices.
#include "core/graph/plan.h"

#include <algorithm>

#include "core/graph/link_compiler.h"

namespace bl {

std::uint32_t Plan::node_index(std::string_view id) const {
  const auto it =
      std::lower_bound(nodes.begin(), nodes.end(), id, [](const NodePlan& node, std::string_view key) { return node.id < key; });
  return static_cast<std::uint32_t>(it != nodes.end() && it->id == id ? it - nodes.begin() : nodes.end() - nodes.begin());
}

std::optional<PortRef> Plan::find(std::uint32_t node, const PortPath& path) const {
  if (path.typification == kBaseNode && path.port == "id") return PortRef{node, PortRef::kNodeId, 0};
  const auto& types = nodes[node].types;
  for (std::size_t t = 0; t < types.size(); ++t) {
    const TypificationDefinition& definition = *types[t].definition;
    if (definition.id != path.typification &&
        std::find(definition.aliases.begin(), definition.aliases.end(), path.typification) == definition.aliases.end())
      continue;
    const std::size_t port = definition.port_index(path.port);
    if (port < definition.ports.size()) return PortRef{node, static_cast<std::uint16_t>(t), static_cast<std::uint16_t>(port)};
  }
  return std::nullopt;
}

std::string Plan::path_text(PortRef ref) const {
  if (ref.type == PortRef::kNodeId) return "node.id";
  return nodes[ref.node].types[ref.type].definition->id + "." + port(ref).id;
}

namespace {

class Compiler {
 public:
  Compiler(const Scene& scene, const Registry& program)
      : plan_(std::make_shared<Plan>()), registry_((plan_->scene = scene).scripts.types(program)) {
    plan_->settings = settings_of(scene);
  }

  std::shared_ptr<const Plan> run() {
    std::vector<NodePlan> nodes;
    for (const auto& [id, record] : plan_->scene.nodes) nodes.push_back(node_plan(id, record));
    plan_->nodes = published<NodePlan>(SharedItems<NodePlan>::Draft(std::move(nodes)));
    const LinkCompiler compiler(*plan_, registry_);
    std::vector<LinkPlan> links;
    for (const auto& [id, record] : plan_->scene.links) links.push_back(compiler.compiled(id, record));
    plan_->links = published<LinkPlan>(SharedItems<LinkPlan>::Draft(std::move(links)));
    std::vector<SetPlan> sets;
    for (std::uint32_t n = 0; n < plan_->nodes.size(); ++n)
      for (std::uint32_t t = 0; t < plan_->nodes[n].types.size(); ++t) add_sets(n, t, sets);
    plan_->sets = SharedVector<SetPlan>(std::move(sets));
    mark_served();
    plan_->dependents = dependents_of(*plan_);
    return plan_;
  }

 private:
  NodePlan node_plan(const std::string& id, const NodeRecord& record) const {
    NodePlan node{id, record.name.empty() ? id : record.name, id, {}};
    for (const auto& [type_id, values] : record.types) {
      const TypificationDefinition* definition = registry_.typification(type_id);
      if (definition == nullptr) continue;
      TypePlan& type = node.types.emplace_back();
      type.definition = definition;
      type.is_served = static_cast<bool>(definition->evaluate);
      for (const PortDefinition& port : definition->ports) {
        const Value& value = set_value(plan_->scene.settings, values, port);
        type.is_set.push_back(is_said(values, port, value));
        type.set_values.push_back(value);
        type.is_locked.push_back(!record.locked.empty() && record.locked.contains(definition->id + "." + port.id));
      }
    }
    return node;
  }

  void add_sets(std::uint32_t n, std::uint32_t t, std::vector<SetPlan>& sets) {
    const TypificationDefinition& definition = *plan_->nodes[n].types[t].definition;
    if (!definition.latency.empty())
      plan_->analyses.push_back({n, t, sets.size(), definition.sets.size(), definition.port_index(definition.latency)});
    for (std::uint32_t s = 0; s < definition.sets.size(); ++s) sets.push_back(set_plan(n, t, s));
  }

  // Members of sets get their results from there.
  void mark_served() {
    SharedItems<NodePlan>::Draft nodes(plan_->nodes);
    for (const SetPlan& set : plan_->sets)
      for (const PortRef& ref : set.writes)
        if (!nodes[ref.node].types[ref.type].is_served) nodes.edit(ref.node).types[ref.type].is_served = true;
    plan_->nodes = published<NodePlan>(std::move(nodes));
  }

  SetPlan set_plan(std::uint32_t n, std::uint32_t t, std::uint32_t s) const {
    SetPlan set{n, t, s, {}, {}, {}, std::nullopt};
    const TypePlan& type = plan_->nodes[n].types[t];
    const SetDefinition& definition = type.definition->sets[s];
    const std::string place = "nodes/" + plan_->nodes[n].id + "/" + type.definition->id + "/" + definition.selection;
    const auto& selection = *std::get<Shared<Selection>>(type.set_values[type.definition->port_index(definition.selection)]);
    const auto finders_of = [&](const auto& declared) {
      std::vector<PortFinder> finders;
      for (const auto& one : declared) finders.emplace_back(*plan_, actual_path(*type.definition, one.path, type.set_values));
      return finders;
    };
    std::vector<PortFinder> read_finders = finders_of(definition.reads), write_finders = finders_of(definition.writes);
    for (const std::uint32_t node : selected_nodes(*plan_, registry_, selection)) {
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
        if (auto kind = check_kind(*plan_, set.reads.back(), read.kind, read.made, "evaluation reads"); !kind)
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
        set.error =
            Error{ErrorCode::conflict, place,
                  "the node `" + plan_->nodes[node].id + "` has no `" + missing->typification + "." + missing->port + "`"};
    }
    return set;
  }

  // Of several sets over one selection the first says what its nodes must have; a further one takes those that have more.
  static bool is_further(const TypificationDefinition& definition, std::uint32_t s) {
    return std::any_of(definition.sets.begin(), definition.sets.begin() + s,
                       [&](const SetDefinition& set) { return set.selection == definition.sets[s].selection; });
  }

  std::shared_ptr<Plan> plan_;
  const Registry& registry_;  // kept alive by the plan's scene
};

}  // namespace

std::shared_ptr<const Plan> compile(const Scene& scene, const Registry& registry) { return Compiler(scene, registry).run(); }

}  // namespace bl
