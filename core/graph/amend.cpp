// Finds the changes by comparing scenes, so that commands need not report them.
#include "core/graph/amend.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/graph/link_compiler.h"
#include "core/graph/node_compiler.h"

namespace bl {

namespace {

// Some tenths of a second.
constexpr std::size_t kMostQuestions = 1'000'000;

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

bool differs_plainly(const NodePlan& plan, const NodeRecord& before, const NodeRecord& after) {
  return std::all_of(plan.types.begin(), plan.types.end(), [&](const TypePlan& type) {
    const auto old = before.types.find(type.definition->id), now = after.types.find(type.definition->id);
    if (old == before.types.end() || now == after.types.end()) return false;
    return old->second == now->second || differs_plainly(*type.definition, old->second, now->second);
  });
}

// A node that differs between two scenes; nullptr where there is none.
struct NodeDifference {
  ItemEdit edit;
  const SharedMap<NodeRecord>::value_type *before = nullptr, *now = nullptr;
  // Links and sets may find something else there: it has come or gone, or has other tags, locks, or values that name nodes, ports
  // or units.
  bool is_other_to_find = true;
  bool is_only_tagged = false;  // this because of its tags alone: who found it before and finds it now finds the same
};

NodeRecord with_tags_of(const NodeRecord& other, NodeRecord node) {
  const std::string base(kBaseNode), tags = "tags";
  const auto from = other.types.find(base);
  const auto to = node.types.find(base);
  if (from == other.types.end() || to == node.types.end()) return node;
  to->second.erase(tags);
  if (const auto said = from->second.find(tags); said != from->second.end()) to->second.insert(*said);
  return node;
}

template <class Item>
std::uint32_t index_in(const SharedItems<Item>& items, const std::string& id) {
  const auto at =
      std::lower_bound(items.begin(), items.end(), id, [](const Item& item, const std::string& key) { return item.id < key; });
  return static_cast<std::uint32_t>(at - items.begin());
}

// Ascending; nothing where nodes have got other typifications.
std::optional<std::vector<NodeDifference>> node_changes(const Plan& plan, const Scene& scene) {
  std::vector<NodeDifference> changes;
  EditCount count;
  const bool has_same_types = plan.scene.nodes.each_difference(scene.nodes, [&](const auto* old, const auto* now) {
    const std::uint32_t place = index_in(plan.nodes, (now != nullptr ? now : old)->first);
    NodeDifference& change = changes.emplace_back(NodeDifference{count.next(place, old, now), old, now});
    if (old == nullptr || now == nullptr) return true;
    const auto &before = old->second.types, &after = now->second.types;
    const bool has_same_locks = old->second.locked == now->second.locked;
    change.is_other_to_find = !has_same_locks || !differs_plainly(plan.nodes[place], old->second, now->second);
    change.is_only_tagged = change.is_other_to_find && has_same_locks &&
                            differs_plainly(plan.nodes[place], with_tags_of(now->second, old->second), now->second);
    return std::equal(before.begin(), before.end(), after.begin(), after.end(),
                      [](const auto& x, const auto& y) { return x.first == y.first; });
  });
  if (!has_same_types) return std::nullopt;
  return changes;
}

void amend_nodes(const std::vector<NodeDifference>& changes, const Registry& registry, Amended& amended, Plan& plan) {
  SharedItems<NodePlan>::Draft drafts(plan.nodes);
  for (const auto& [edit, before, now, is_other, is_tagged] : changes) {
    if (edit.is_removed()) continue;
    if (is_other || before->second.types != now->second.types) amended.nodes.push_back(edit.now);
    if (edit.is_added()) continue;  // it was made where the others were moved
    NodePlan node = compiled_node(plan.scene, registry, now->first, now->second);
    for (std::size_t t = 0; t < node.types.size(); ++t) node.types[t].is_served = plan.nodes[edit.now].types[t].is_served;
    drafts.put(edit.now, std::move(node));
  }
  plan.nodes = published<NodePlan>(std::move(drafts));
}

// May the selection find other nodes or ports now, among these?
bool concerns(const std::vector<NodeDifference>& changes, const Registry& registry, const Selection& selection) {
  const auto means = [&](const auto* node) { return node != nullptr && selects(registry, selection, node->first, node->second); };
  return std::any_of(changes.begin(), changes.end(), [&](const NodeDifference& change) {
    const bool was_meant = means(change.before), is_meant = means(change.now);
    return change.is_only_tagged ? was_meant != is_meant : was_meant || is_meant;
  });
}

// The sets that may have other members or ports now. The nodes of the plan are done.
void amend_sets(const Plan& before, const std::vector<NodeDifference>& found, const Registry& registry, Amended& amended,
                Plan& plan) {
  std::vector<SetPlan> sets;
  for (std::size_t s = 0; s < before.sets.size(); ++s) {
    const SetPlan& set = before.sets[s];
    const TypePlan &old = before.nodes[set.node].types[set.type], &now = plan.nodes[set.node].types[set.type];
    const std::size_t port = now.definition->port_index(now.definition->sets[set.set].selection);
    const bool is_own = std::any_of(found.begin(), found.end(),
                                    [&](const NodeDifference& one) { return !one.is_only_tagged && one.edit.now == set.node; });
    const bool may_differ = is_own || concerns(found, registry, *std::get<Shared<Selection>>(old.set_values[port])) ||
                            concerns(found, registry, *std::get<Shared<Selection>>(now.set_values[port]));
    if (!may_differ) continue;
    if (sets.empty()) sets.assign(before.sets.begin(), before.sets.end());
    sets[s] = compiled_set(plan, registry, set.node, set.type, set.set);
    amended.sets.emplace_back(set.node, set.type);
  }
  if (sets.empty() && !amended.moved) return;
  if (!sets.empty()) plan.sets = SharedVector<SetPlan>(std::move(sets));
  std::vector<std::uint32_t> nodes;
  const std::vector<std::uint32_t> served = mark_served(plan);
  std::set_union(amended.nodes.begin(), amended.nodes.end(), served.begin(), served.end(), std::back_inserter(nodes));
  amended.nodes = std::move(nodes);
}

// A link that differs between two scenes, or whose ends have to be found anew; nullptr where there is none.
struct LinkChange {
  const SharedMap<LinkRecord>::value_type *before = nullptr, *now = nullptr;
  bool finds_anew = false;
};

// The links that differ, and those that are the same but may find other nodes or ports at their ends; ascending.
std::vector<LinkChange> link_changes(const Scene& before, const Scene& scene, const std::vector<NodeDifference>& found,
                                     const Registry& registry) {
  std::vector<LinkChange> changes;
  before.links.each_difference(scene.links, [&](const auto* old, const auto* now) {
    changes.push_back({old, now, !found.empty()});
    return true;
  });
  if (found.empty()) return changes;
  const auto id_of = [](const LinkChange& change) -> const std::string& {
    return (change.now ? change.now : change.before)->first;
  };
  std::vector<LinkChange> all;
  auto next = changes.begin();
  for (const auto& link : scene.links) {
    while (next != changes.end() && id_of(*next) < link.first) all.push_back(*next++);
    if (next != changes.end() && id_of(*next) == link.first) continue;  // taken in the next round
    if (concerns(found, registry, link.second.from) || concerns(found, registry, link.second.to))
      all.push_back({&link, &link, true});
  }
  all.insert(all.end(), next, changes.end());
  return all;
}

// The nodes of the plan are done: the ports of the links are found among them.
void amend_links(const Plan& before, const std::vector<LinkChange>& changes, const Registry& registry, Amended& amended,
                 Plan& plan) {
  EditCount count;
  for (const LinkChange& change : changes)
    amended.links.push_back(count.next(index_in(before.links, (change.now != nullptr ? change.now : change.before)->first),
                                       change.before, change.now));
  if (changes.empty()) return;
  const LinkCompiler compiler(plan, registry);
  SharedItems<LinkPlan>::Draft drafts(before.links, origins_of(plan.scene.links.size(), amended.links));
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const auto& [old, now, finds_anew] = changes[c];
    const ItemEdit& edit = amended.links[c];
    if (now == nullptr) continue;
    drafts.put(edit.now, old == nullptr || finds_anew ? compiler.compiled(now->first, now->second)
                                                      : compiler.amended(before.links[edit.before], old->second, now->second));
  }
  plan.links = published<LinkPlan>(std::move(drafts));
}

}  // namespace

std::optional<Amended> amend(const Plan& plan, const Scene& scene, const Registry& program) {
  const Scene& before = plan.scene;
  if (before.settings != scene.settings || !(before.scripts == scene.scripts)) return std::nullopt;
  const auto nodes = node_changes(plan, scene);
  if (!nodes) return std::nullopt;
  std::vector<NodeDifference> found;
  std::copy_if(nodes->begin(), nodes->end(), std::back_inserter(found),
               [](const NodeDifference& one) { return one.is_other_to_find; });
  // Every link and set is asked about each of these nodes: of many, compiling everything takes less.
  if (found.size() * (scene.links.size() + plan.sets.size()) > kMostQuestions) return std::nullopt;
  // Definitions belong to the scripts of the scene that was compiled: the copies keep these, which say the same.
  const Registry& registry = before.scripts.types(program);
  Amended amended;
  std::vector<ItemEdit> edits;
  for (const NodeDifference& one : *nodes) edits.push_back(one.edit);
  const bool is_moved =
      std::any_of(edits.begin(), edits.end(), [](const ItemEdit& one) { return one.is_added() || one.is_removed(); });
  if (is_moved) amended.moved = moved_plan(plan, scene, edits, registry);
  const Plan& base = is_moved ? *amended.moved->plan : plan;
  auto made = std::make_shared<Plan>(base);
  made->scene.nodes = scene.nodes;
  made->scene.links = scene.links;
  made->scene.view = scene.view;
  amend_nodes(*nodes, registry, amended, *made);
  amend_sets(base, found, registry, amended, *made);
  amend_links(base, link_changes(before, scene, found, registry), registry, amended, *made);
  made->dependents = is_moved ? dependents_of(*made) : amended_dependents(plan, *made, amended.links, !amended.sets.empty());
  // Names and tags are no part of it, but readers who keep what they have read go by it.
  const bool is_told = !is_moved && std::any_of(nodes->begin(), nodes->end(), [](const NodeDifference& one) {
    return one.is_other_to_find || one.before->second.name != one.now->second.name;
  });
  if (is_told) made->dependents = std::make_shared<const Dependents>(*made->dependents);
  amended.plan = std::move(made);
  return amended;
}

}  // namespace bl
