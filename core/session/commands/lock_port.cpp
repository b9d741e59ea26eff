// Locks a value: links cannot change it any more; their proposals are still shown.
#include "core/session/support.h"

namespace bl {

void LockPort::declare(CommandBuilder<LockPort>& c) {
  c.id("lock_port").label("Lock").doc("Locks a value of a node against links. People can still set it.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which value, written `typification.port`.");
}

Inverse LockPort::apply(SceneEdit& edit, const In& in) {
  const auto site = find_setting(edit, in.node, in.port);
  if (!site) return site.error();
  const std::string path = site->type->id + "." + site->port->id;
  if (!edit.set_locked(in.node, path, true))
    return Error{ErrorCode::conflict, "nodes/" + in.node, "`" + path + "` is locked already"};
  return std::vector{command<UnlockPort>({in.node, {path}})};
}

}  // namespace bl

BL_COMMAND(lock_port, LockPort)
