// Finds the changes by comparing scenes, so that commands need not report them.
#include "core/graph/amend.h"

#include <algorithm>

namespace bl {

namespace {

struct Change {
  std::uint32_t node = 0, type = 0;
  const PortValues* values = nullptr;  // in the new scene
};

// Sets of nodes, tags, and texts that name ports decide about indices; so does what names a unit or is chosen by a set.
bool is_plain(const TypificationDefinition& type, const std::string& id) {
  const PortDefinition* port = type.find_port(id);
  if (port == nullptr) return false;
  switch (port->kind) {
    case ValueKind::boolean:
    case ValueKind::integer:
    case ValueKind::number:
    case ValueKind::text:
    case ValueKind::point:
    case ValueKind::points:
    case ValueKind::numbers:
    case ValueKind::table: break;
    default: return false;
  }
  for (const PortDefinition& other : type.ports)
    if (other.unit_from == id) return false;
  for (const SetDefinition& set : type.sets) {
    for (const ReadDefinition& read : set.reads)
      if (read.path.chosen_by == id) return false;
    for (const WriteDefinition& write : set.writes)
      if (write.path.chosen_by == id) return false;
  }
  return true;
}

// Both maps ascend: what stands in one only, or differs, has to be plain.
bool differs_plainly(const TypificationDefinition& type, const PortValues& before, const PortValues& after) {
  auto b = before.begin(), a = after.begin();
  while (b != before.end() || a != after.end()) {
    const bool is_old = a == after.end() || (b != before.end() && b->first < a->first);
    const bool is_new = b == before.end() || (a != after.end() && a->first < b->first);
    const std::string& id = is_old ? b->first : a->first;
    if ((is_old || is_new || !(b->second == a->second)) && !is_plain(type, id)) return false;
    if (!is_new) ++b;
    if (!is_old) ++a;
  }
  return true;
}

// False where more than plain values has changed at the node.
bool find_changes(const NodePlan& plan, std::uint32_t index, const NodeRecord& before, const NodeRecord& after,
                  std::vector<Change>& changes) {
  if (before.name != after.name || before.ghosts != after.ghosts || before.locked != after.locked) return false;
  if (before.types.size() != after.types.size()) return false;
  auto old = before.types.begin();
  for (auto now = after.types.begin(); now != after.types.end(); ++now, ++old) {
    if (now->first != old->first) return false;
    if (now->second == old->second) continue;
    const auto type =
        std::find_if(plan.types.begin(), plan.types.end(), [&](const TypePlan& t) { return t.definition->id == now->first; });
    if (type == plan.types.end() || !differs_plainly(*type->definition, old->second, now->second)) return false;
    changes.push_back({index, static_cast<std::uint32_t>(type - plan.types.begin()), &now->second});
  }
  return true;
}

}  // namespace

std::optional<Amended> amend(const Plan& plan, const Scene& scene) {
  const Scene& before = plan.scene;
  if (before.nodes.size() != scene.nodes.size() || before.settings != scene.settings || before.links != scene.links ||
      !(before.scripts == scene.scripts))
    return std::nullopt;
  std::vector<Change> changes;
  const bool are_plain = before.nodes.each_difference(scene.nodes, [&](const auto& old, const auto& now) {
    const std::uint32_t index = plan.node_index(now.first);
    return old.first == now.first && find_changes(plan.nodes[index], index, old.second, now.second, changes);
  });
  if (!are_plain) return std::nullopt;
  auto amended = std::make_shared<Plan>(plan);
  // Definitions belong to the scripts of the scene that was compiled: the copy keeps these, which say the same.
  amended->scene.nodes = scene.nodes;
  amended->scene.view = scene.view;
  SharedItems<NodePlan>::Draft drafts(plan.nodes);
  for (const Change& change : changes) {
    TypePlan& type = drafts.edit(change.node).types[change.type];
    for (std::size_t p = 0; p < type.definition->ports.size(); ++p) {
      const PortDefinition& port = type.definition->ports[p];
      type.set_values[p] = set_value(scene.settings, *change.values, port);
      type.is_set[p] = is_said(*change.values, port, type.set_values[p]);
    }
  }
  amended->nodes = published<NodePlan>(std::move(drafts));
  std::vector<std::uint32_t> nodes;
  for (const Change& change : changes)
    if (nodes.empty() || nodes.back() != change.node) nodes.push_back(change.node);
  return Amended{std::move(amended), std::move(nodes)};
}

}  // namespace bl
