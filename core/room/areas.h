// Which parts of a scene lie in which areas of a room.
#pragma once

#include <set>
#include <string>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/room/room_state.h"

namespace bl::room {

/// Does a node of the scene lie in the area? An outline holds the nodes whose set position is inside it in plan.
bool lies_in(const Area& area, const Registry& registry, const std::string& id, const NodeRecord& node);

/// Whether somebody may change a node because of their areas.
struct AreaAnswer {
  bool is_granted = false;
  std::string held;         ///< the own area whose pen somebody else has, where that is why not
  std::int64_t holder = 0;  ///< that somebody
};
AreaAnswer may_change(const RoomState& state, const Registry& registry, std::int64_t seat, const std::string& id,
                      const NodeRecord& node);
/// The same for a link: all nodes at the ends to which its kind proposes count.
AreaAnswer may_change(const RoomState& state, const Registry& registry, std::int64_t seat, const Scene& scene,
                      const LinkRecord& link);

}  // namespace bl::room
