// What every node is: an entity with a place.
#include "core/reading/views/node.h"

namespace bl::reading {

void NodePlace::declare(ViewBuilder<NodePlace>& v) {
  v.of("node");
  v.reads(&NodePlace::position, "node.position", Unit::metre);
  v.reads_tension(&NodePlace::tension, "node.position", Unit::metre);
}
BL_VIEW(NodePlace)

BL_VIEWS(node, NodePlace)

}  // namespace bl::reading
