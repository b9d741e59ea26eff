// Compiling a scene: resolving ends, ports and units once, so that a tick only follows indices.
#include "core/graph/plan.h"

#include <algorithm>

#include "core/base/text.h"

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
    std::vector<LinkPlan> links;
    for (const auto& [id, record] : plan_->scene.links) {
      LinkPlan& link = links.emplace_back();
      link.id = id;
      fill(link, record);
    }
    plan_->links = SharedVector<LinkPlan>(std::move(links));
    std::vector<SetPlan> sets;
    for (std::uint32_t n = 0; n < plan_->nodes.size(); ++n)
      for (std::uint32_t t = 0; t < plan_->nodes[n].types.size(); ++t) add_sets(n, t, sets);
    plan_->sets = SharedVector<SetPlan>(std::move(sets));
    mark_served();
    plan_->dependents = std::make_shared<const Dependents>(dependents_of(*plan_));
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
        type.is_locked.push_back(record.locked.contains(definition->id + "." + port.id));
      }
    }
    return node;
  }

  void fill(LinkPlan& link, const LinkRecord& record) const {
    link.definition = record.ghost.empty() ? registry_.link(record.kind) : nullptr;
    link.is_enabled = record.is_enabled;
    link.is_muted = record.is_muted;
    link.strength = record.strength;
    if (link.definition == nullptr) {
      link.error = Error{ErrorCode::unknown_type, "links/" + link.id, why_it_rests(record.kind)};
      return;
    }
    std::vector<Value> values;
    for (const PortDefinition& port : link.definition->ports) {
      const auto it = record.parameters.find(port.id);
      values.push_back(it != record.parameters.end() ? it->second : port.default_value);
    }
    link.parameters = link.definition->instantiate(values);
    for (const End end : {End::from, End::to}) {
      auto nodes = end_nodes(link, record, end, values);
      if (!nodes) {
        link.error = nodes.error().within("links/" + link.id);
        return;
      }
      link.nodes[static_cast<int>(end)] = std::move(*nodes);
    }
    link.is_symmetric = link.nodes[0] == link.nodes[1] && link.nodes[0].size() > 1;
    if (auto ports = resolve_ports(link, values); !ports) link.error = ports.error().within("links/" + link.id);
  }

  std::string why_it_rests(const std::string& kind) const {
    if (registry_.link(kind) != nullptr)
      return "the link does not fit its kind `" + kind + "`: kept as it is, not run; correct it in the scene file";
    std::string guess = did_you_mean(kind, keys_of(registry_.links()));
    return "unknown link kind `" + kind + "`: kept as it is, not run" +
           (guess.empty()
                ? "; a Lua file of yours is put into the scene by `script` or --script, a library is named by --plugins FOLDER"
                : guess);
  }

  // Every path of the declaration at this end, with parameters put in for chosen ones.
  std::vector<std::pair<PortPath, const std::optional<Unit>*>> paths(const LinkDefinition& definition, End end,
                                                                     std::span<const Value> values) const {
    std::vector<std::pair<PortPath, const std::optional<Unit>*>> list;
    for (const LinkRead& read : definition.reads)
      if (read.end == end) list.emplace_back(actual(definition, read.path, values), &read.unit);
    for (const LinkWrite& write : definition.proposes)
      if (write.end == end) list.emplace_back(actual(definition, write.path, values), &write.unit);
    return list;
  }

  static PortPath actual(const TypeDefinition& definition, const PortPath& path, std::span<const Value> values) {
    if (path.chosen_by.empty()) return path;
    const std::string* text = std::get_if<std::string>(&values[definition.port_index(path.chosen_by)]);
    return parse_port_path(text ? *text : "").value_or(PortPath{});
  }

  // The nodes of an end that have all the ports. A query leaves out those that lack one; a named node must have them.
  Result<std::vector<std::uint32_t>> end_nodes(const LinkPlan& link, const LinkRecord& record, End end,
                                               std::span<const Value> values) const {
    const Selection& selection = end == End::from ? record.from : record.to;
    const auto wanted = paths(*link.definition, end, values);
    std::vector<std::uint32_t> nodes;
    for (const std::string& id : resolve(plan_->scene, registry_, selection)) {
      const std::uint32_t node = plan_->node_index(id);
      const auto missing =
          std::find_if(wanted.begin(), wanted.end(), [&](const auto& path) { return !plan_->find(node, path.first); });
      if (missing == wanted.end()) {
        nodes.push_back(node);
        if (auto unit = check_units(node, wanted); !unit) return unit.error().within(name_of(end));
      } else if (!selection.is_query()) {
        const PortPath& path = missing->first;
        if (path.typification.empty())
          return Error{ErrorCode::missing, "", "choose the port that `" + link.definition->id + "` works on"};
        return Error{ErrorCode::conflict, std::string(name_of(end)),
                     "the node `" + id + "` has no `" + path.typification + "." + path.port + "`, which `" + link.definition->id +
                         "` needs" + nearest_port(path)};
      }
    }
    if (nodes.empty())
      return Error{ErrorCode::not_found, std::string(name_of(end)), "no node fits this end; the link does nothing"};
    return nodes;
  }

  // ", did you mean `radius`?" for a misspelt port of a known typification.
  std::string nearest_port(const PortPath& path) const {
    const TypificationDefinition* type = registry_.typification(path.typification);
    if (type == nullptr) return did_you_mean(path.typification, keys_of(registry_.typifications()));
    return type->find_port(path.port) != nullptr ? "" : did_you_mean(path.port, port_ids(*type));
  }

  Result<void> check_units(std::uint32_t node, const std::vector<std::pair<PortPath, const std::optional<Unit>*>>& wanted) const {
    for (const auto& [path, unit] : wanted) {
      if (!unit->has_value()) continue;
      const Unit found = unit_at(node, path);
      if (!same_dimension(found, **unit))
        return Error{ErrorCode::wrong_unit, "",
                     "`" + plan_->nodes[node].id + "." + path.typification + "." + path.port + "` is in " +
                         std::string(info(found).name) + "s, the link works in " + std::string(info(**unit).name) + "s"};
    }
    return {};
  }

  Unit unit_at(std::uint32_t node, const PortPath& path) const {
    const auto ref = plan_->find(node, path);
    if (!ref || ref->type == PortRef::kNodeId) return Unit::none;
    return unit_of(registry_, plan_->scene.nodes.at(plan_->nodes[node].id), *plan_->nodes[node].types[ref->type].definition,
                   plan_->port(*ref));
  }

  Result<void> check_same_units(const LinkPlan& link, std::span<const Value> values) const {
    const LinkDefinition& definition = *link.definition;
    if (!definition.same_units_unless.empty() && std::get<bool>(values[definition.port_index(definition.same_units_unless)]))
      return {};
    for (const auto& [parameter, other] : definition.same_units) {
      const PortPath from = actual(definition, {"", "", parameter}, values), to = actual(definition, {"", "", other}, values);
      for (const std::uint32_t f : link.nodes[0])
        for (const std::uint32_t t : link.nodes[1]) {
          const Unit a = unit_at(f, from), b = unit_at(t, to);
          if (!same_dimension(a, b))
            return Error{
                ErrorCode::wrong_unit, "",
                "`" + plan_->nodes[f].id + "." + from.typification + "." + from.port + "` is in " + std::string(info(a).name) +
                    "s, `" + plan_->nodes[t].id + "." + to.typification + "." + to.port + "` in " + std::string(info(b).name) +
                    "s" +
                    (definition.same_units_unless.empty() ? "" : "; give ranges with `" + definition.same_units_unless + "`")};
        }
    }
    return {};
  }

  Result<void> resolve_ports(LinkPlan& link, std::span<const Value> values) const {
    const LinkDefinition& definition = *link.definition;
    if (auto units = check_same_units(link, values); !units) return units;
    for (const LinkRead& read : definition.reads) {
      auto& refs = link.reads.emplace_back();
      for (const std::uint32_t node : link.nodes[static_cast<int>(read.end)]) {
        const PortRef ref = *plan_->find(node, actual(definition, read.path, values));
        if (ref.type != PortRef::kNodeId && !read.is_lock)
          if (auto kind = check_kind(ref, read.kind, read.made, "link reads"); !kind) return kind;
        refs.push_back(ref);
      }
    }
    std::vector<std::vector<PortRef>> write_refs;
    for (const LinkWrite& write : definition.proposes) {
      auto& refs = write_refs.emplace_back();
      for (const std::uint32_t node : link.nodes[static_cast<int>(write.end)]) {
        const PortRef ref = *plan_->find(node, actual(definition, write.path, values));
        if (ref.type == PortRef::kNodeId || plan_->port(ref).rule == CombineRule::none)
          return Error{ErrorCode::conflict, "", "`" + plan_->path_text(ref) + "` cannot be changed by links"};
        if (auto kind = check_kind(ref, write.kind, {}, "link proposes"); !kind) return kind;
        refs.push_back(ref);
        link.targets.push_back(ref);
      }
    }
    std::sort(link.targets.begin(), link.targets.end());
    link.targets.erase(std::unique(link.targets.begin(), link.targets.end()), link.targets.end());
    for (const PortRef& ref : link.targets) link.target_ports.push_back(&plan_->port(ref));
    for (const auto& refs : write_refs) {
      auto& indices = link.writes.emplace_back();
      for (const PortRef& ref : refs)
        indices.push_back(
            static_cast<std::uint32_t>(std::lower_bound(link.targets.begin(), link.targets.end(), ref) - link.targets.begin()));
    }
    return {};
  }

  Result<void> check_kind(PortRef ref, ValueKind expected, const MadeType& made, const char* verb) const {
    const PortDefinition& port = plan_->port(ref);
    const ValueKind found = port.kind;
    if (can_read(expected, found) && port.made == made) return {};
    return Error{ErrorCode::wrong_kind, "",
                 "the " + std::string(verb) + " " + std::string(kind_text(expected, made)) + ", but `" + plan_->path_text(ref) +
                     "` holds " + std::string(kind_text(found, port.made))};
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
    for (const std::string& id : resolve(plan_->scene, registry_, selection)) {
      const std::uint32_t node = plan_->node_index(id);
      std::vector<PortRef> reads, writes;
      std::string missing;
      auto look_up = [&](const PortPath& declared, std::vector<PortRef>& refs) {
        const PortPath path = actual(*type.definition, declared, type.set_values);
        if (const auto ref = plan_->find(node, path)) refs.push_back(*ref);
        else missing = path.typification + "." + path.port;
      };
      for (const ReadDefinition& read : definition.reads) {
        look_up(read.path, reads);
        if (!missing.empty() || reads.back().type == PortRef::kNodeId) continue;
        if (auto kind = check_kind(reads.back(), read.kind, read.made, "evaluation reads"); !kind)
          set.error = kind.error().within(place);
      }
      for (const WriteDefinition& write : definition.writes) look_up(write.path, writes);
      if (missing.empty()) {
        set.members.push_back(node);
        set.reads.insert(set.reads.end(), reads.begin(), reads.end());
        set.writes.insert(set.writes.end(), writes.begin(), writes.end());
      } else if (!selection.is_query() && !is_further(*type.definition, s)) {
        set.error = Error{ErrorCode::conflict, place, "the node `" + id + "` has no `" + missing + "`"};
      }
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
