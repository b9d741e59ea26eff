// Gives the nodes of links and sets their new numbers.
#include "core/graph/moved_plan.h"

#include <algorithm>

#include "core/graph/node_compiler.h"

namespace bl {

namespace {

using Places = std::vector<std::uint32_t>;

void move_nodes(const Places& places, std::vector<std::uint32_t>& nodes) {
  for (std::uint32_t& node : nodes) node = places[node];
}

void move_ports(const Places& places, std::vector<PortRef>& ports) {
  for (PortRef& port : ports) port.node = places[port.node];
}

// Who names nodes before the first one that moves alone stays as it is.
bool is_moved(const LinkPlan& link, std::uint32_t first) {
  return std::any_of(std::begin(link.nodes), std::end(link.nodes),
                     [&](const auto& nodes) { return !nodes.empty() && nodes.back() >= first; });
}

SetPlan moved_set(const SetPlan& before, const Places& places) {
  SetPlan set = before;
  set.node = places[set.node];
  move_nodes(places, set.members);
  move_ports(places, set.reads);
  move_ports(places, set.writes);
  return set;
}

}  // namespace

MovedPlan moved_plan(const Plan& before, const Scene& now, std::span<const ItemEdit> edits, const Registry& registry) {
  MovedPlan moved{std::make_shared<Plan>(before), places_after(before.nodes.size(), edits)};
  Plan& plan = *moved.plan;
  const Places origins = origins_of(now.nodes.size(), edits);
  SharedItems<NodePlan>::Draft nodes(before.nodes, origins);
  if (std::find(origins.begin(), origins.end(), ItemEdit::kNone) != origins.end()) {
    std::uint32_t n = 0;
    for (const auto& [id, record] : now.nodes) {
      if (origins[n] == ItemEdit::kNone) nodes.put(n, compiled_node(before.scene, registry, id, record));
      ++n;
    }
  }
  plan.nodes = published<NodePlan>(std::move(nodes));
  plan.forms = forms_of(plan.nodes);
  plan.memo = std::make_shared<PlanMemo>();
  const auto stays = std::mismatch(moved.places.begin(), moved.places.end(), origins.begin(), origins.end());
  const auto first = static_cast<std::uint32_t>(stays.first - moved.places.begin());
  SharedItems<LinkPlan>::Draft links(before.links);
  for (std::size_t l = 0; l < before.links.size(); ++l) {
    if (!is_moved(before.links[l], first)) continue;
    LinkPlan& link = links.edit(l);
    for (auto& ends : link.nodes) move_nodes(moved.places, ends);
    for (auto& ports : link.reads) move_ports(moved.places, ports);
    move_ports(moved.places, link.targets);
  }
  plan.links = published<LinkPlan>(std::move(links));
  auto old = before.sets.begin();
  put_sets(plan, [&](std::uint32_t n, std::uint32_t t, std::uint32_t s) {
    if (origins[n] == ItemEdit::kNone) return SetPlan{n, t, s, {}, {}, {}, std::nullopt};
    while (moved.places[old->node] == ItemEdit::kNone) ++old;
    return moved_set(*old++, moved.places);
  });
  return moved;
}

}  // namespace bl
