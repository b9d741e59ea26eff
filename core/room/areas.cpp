// Nodes inside outlines, and the pens of areas.
#include "core/room/areas.h"

#include <algorithm>

namespace bl::room {

namespace {

// Even-odd rule: a ray to the east crosses the outline of a place inside an odd number of times.
bool is_inside(const std::vector<Point3>& outline, const Vector3& place) {
  bool is_odd = false;
  for (std::size_t k = 0, before = outline.size() - 1; k < outline.size(); before = k++) {
    const Point3 &a = outline[before], &b = outline[k];
    const double cross = (b.x - a.x) * (place.y - a.y) - (b.y - a.y) * (place.x - a.x);
    const bool is_on_edge = cross == 0 && place.x >= std::min(a.x, b.x) && place.x <= std::max(a.x, b.x) &&
                            place.y >= std::min(a.y, b.y) && place.y <= std::max(a.y, b.y);
    if (is_on_edge) return true;
    if ((a.y > place.y) == (b.y > place.y)) continue;
    // Left of the edge, seen upwards.
    if ((b.y > a.y) == (cross > 0)) is_odd = !is_odd;
  }
  return is_odd;
}

}  // namespace

bool lies_in(const Area& area, const Registry& registry, const std::string& id, const NodeRecord& node) {
  if (!area.nodes.is_empty() && selects(registry, area.nodes, id, node)) return true;
  if (area.outline.size() < 3) return false;
  const TypificationDefinition& base = *registry.typification(kBaseNode);
  const PortDefinition& position = *base.find_port("position");
  const auto values = node.types.find(std::string(kBaseNode));
  if (values == node.types.end()) return is_inside(area.outline, std::get<Vector3>(position.default_value));
  const auto set = values->second.find(position.id);
  return is_inside(area.outline, std::get<Vector3>(set == values->second.end() ? position.default_value : set->second));
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
