// Lets links change a value again.
#include "core/session/support.h"

namespace bl {

void UnlockPort::declare(CommandBuilder<UnlockPort>& c) {
  c.id("unlock_port").label("Unlock").doc("Lets links change a value of a node again.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which value, written `typification.port`.");
}

Inverse UnlockPort::apply(SceneEdit& edit, const In& in) {
  auto node = edit.node(in.node);
  if (!node) return node.error();
  if (!edit.set_locked(in.node, in.port.path, false))
    return Error{ErrorCode::conflict, "nodes/" + in.node, "`" + in.port.path + "` is not locked"};
  return std::vector{command<LockPort>({in.node, in.port})};
}

}  // namespace bl

BL_COMMAND(unlock_port, UnlockPort)
