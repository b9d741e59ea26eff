// Gives a node another name; its id stays.
#include "core/session/support.h"

namespace bl {

void RenameNode::declare(CommandBuilder<RenameNode>& c) {
  c.id("rename_node").label("Rename node").doc("Changes the name that people see; the id never changes.");
  c.argument(&In::id, "id").required().doc("Id of the node.");
  c.argument(&In::name, "name").doc("The new name; empty shows the id.");
}

Inverse RenameNode::apply(SceneEdit& edit, const In& in) {
  auto node = edit.node(in.id);
  if (!node) return node.error();
  std::vector inverse{command<RenameNode>({in.id, (*node)->name})};
  edit.set_name(in.id, in.name);
  return inverse;
}

}  // namespace bl

BL_COMMAND(rename_node, RenameNode)
