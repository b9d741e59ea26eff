// Finds the changes by comparing scenes, so that commands need not report them.
#include "core/graph/amend.h"

#include <algorithm>
#include <utility>

#include "core/graph/link_compiler.h"

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

// The nodes of the plan with the values of the changes.
void amend_nodes(const std::vector<Change>& changes, Amended& amended, Plan& plan) {
  SharedItems<NodePlan>::Draft drafts(plan.nodes);
  for (const Change& change : changes) {
    TypePlan& type = drafts.edit(change.node).types[change.type];
    for (std::size_t p = 0; p < type.definition->ports.size(); ++p) {
      const PortDefinition& port = type.definition->ports[p];
      type.set_values[p] = set_value(plan.scene.settings, *change.values, port);
      type.is_set[p] = is_said(*change.values, port, type.set_values[p]);
    }
    if (amended.nodes.empty() || amended.nodes.back() != change.node) amended.nodes.push_back(change.node);
  }
  plan.nodes = published<NodePlan>(std::move(drafts));
}

// A link that differs between two scenes; nullptr where there is none.
struct LinkChange {
  const SharedMap<LinkRecord>::value_type *before = nullptr, *now = nullptr;
};

// Where the link is, or would be.
std::uint32_t link_place(const SharedItems<LinkPlan>& links, const std::string& id) {
  const auto at = std::lower_bound(links.begin(), links.end(), id,
                                   [](const LinkPlan& link, const std::string& key) { return link.id < key; });
  return static_cast<std::uint32_t>(at - links.begin());
}

// The nodes of the plan are done: the ports of the links are found among them.
void amend_links(const Plan& before, const std::vector<LinkChange>& changes, const Registry& program, Amended& amended,
                 Plan& plan) {
  std::uint32_t added = 0, removed = 0;
  for (const LinkChange& change : changes) {
    LinkEdit& edit = amended.links.emplace_back();
    const std::uint32_t place = link_place(before.links, (change.now != nullptr ? change.now : change.before)->first);
    if (change.before != nullptr) edit.before = place;
    if (change.now != nullptr) edit.now = place + added - removed;
    if (change.before == nullptr) ++added;
    if (change.now == nullptr) ++removed;
  }
  if (changes.empty()) return;
  const LinkCompiler compiler(plan, plan.scene.scripts.types(program));
  auto drafts = moved_links(before.links, plan.scene.links.size(), amended.links);
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const auto& [old, now] = changes[c];
    const LinkEdit& edit = amended.links[c];
    if (now == nullptr) continue;
    drafts.put(edit.now, old == nullptr ? compiler.compiled(now->first, now->second)
                                        : compiler.amended(before.links[edit.before], old->second, now->second));
  }
  plan.links = published<LinkPlan>(std::move(drafts));
}

}  // namespace

std::optional<Amended> amend(const Plan& plan, const Scene& scene, const Registry& registry) {
  const Scene& before = plan.scene;
  if (before.nodes.size() != scene.nodes.size() || before.settings != scene.settings || !(before.scripts == scene.scripts))
    return std::nullopt;
  std::vector<Change> nodes;
  const bool are_plain = before.nodes.each_difference(scene.nodes, [&](const auto* old, const auto* now) {
    if (old == nullptr || now == nullptr) return false;
    const std::uint32_t index = plan.node_index(now->first);
    return find_changes(plan.nodes[index], index, old->second, now->second, nodes);
  });
  if (!are_plain) return std::nullopt;
  std::vector<LinkChange> links;
  before.links.each_difference(scene.links, [&](const auto* old, const auto* now) {
    links.push_back({old, now});
    return true;
  });
  Amended amended;
  auto made = std::make_shared<Plan>(plan);
  // Definitions belong to the scripts of the scene that was compiled: the copy keeps these, which say the same.
  made->scene.nodes = scene.nodes;
  made->scene.links = scene.links;
  made->scene.view = scene.view;
  amend_nodes(nodes, amended, *made);
  amend_links(plan, links, registry, amended, *made);
  made->dependents = amended_dependents(plan, *made, amended.links);
  amended.plan = std::move(made);
  return amended;
}

}  // namespace bl
