// Nodes inside outlines, and the pens of areas.
#include "core/room/areas.h"

#include "core/geometry/plan_ring.h"

namespace bl::room {

bool lies_in(const Area& area, const Registry& registry, const std::string& id, const NodeRecord& node) {
  if (!area.nodes.is_empty() && selects(registry, area.nodes, id, node)) return true;
  if (area.outline.size() < 3) return false;
  const TypificationDefinition& base = *registry.typification(kBaseNode);
  const PortDefinition& position = *base.find_port("position");
  const auto values = node.types.find(std::string(kBaseNode));
  if (values == node.types.end()) return geometry::ring_contains(area.outline, std::get<Vector3>(position.default_value));
  const auto set = values->second.find(position.id);
  return geometry::ring_contains(area.outline,
                                 std::get<Vector3>(set == values->second.end() ? position.default_value : set->second));
}

AreaAnswer may_change(const RoomState& state, const Registry& registry, std::int64_t seat, const std::string& id,
                      const NodeRecord& node) {
  AreaAnswer answer;
  const Seat* asking = state.seat(seat);
  if (asking == nullptr) return answer;
  for (const std::string& name : asking->areas) {
    const auto area = state.areas.find(name);
    if (area == state.areas.end() || !lies_in(area->second, registry, id, node)) continue;
    if (area->second.pen == 0 || area->second.pen == seat) return {.is_granted = true, .held = {}, .holder = 0};
    answer.held = name;
    answer.holder = area->second.pen;
  }
  return answer;
}

AreaAnswer may_change(const RoomState& state, const Registry& registry, std::int64_t seat, const Scene& scene,
                      const LinkRecord& link) {
  const LinkDefinition* kind = scene.scripts.types(registry).link(link.kind);
  if (kind == nullptr) return {};  // nobody knows what a ghost proposes
  std::set<End> ends;
  for (const LinkWrite& write : kind->proposes) ends.insert(write.end);
  AreaAnswer last;
  for (const End end : ends)
    for (const std::string& id : resolve(scene, registry, end == End::from ? link.from : link.to)) {
      last = may_change(state, registry, seat, id, scene.nodes.at(id));
      if (!last.is_granted) return last;
    }
  return last;  // a link that proposes to nothing lies in no area
}

}  // namespace bl::room
