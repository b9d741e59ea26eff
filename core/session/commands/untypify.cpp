// Removes a role from a node, with its values and locks.
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/support.h"

namespace bl {

void Untypify::declare(CommandBuilder<Untypify>& c) {
  c.id("untypify").label("Untypify").doc("Removes a role from a node. Links that need it stay, and report that it is missing.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::typification, "typification").required().doc("Id of the role.");
}

Inverse Untypify::apply(SceneEdit& edit, const In& in) {
  auto node = edit.node(in.node);
  if (!node) return node.error();
  const std::string place = "nodes/" + in.node + "/" + in.typification;
  const TypificationDefinition* type = edit.registry().typification(in.typification);
  if (type == nullptr || !(*node)->types.contains(type->id))
    return Error{ErrorCode::not_found, place, "the node is no `" + in.typification + "`"};
  if (type->id == kBaseNode) return Error{ErrorCode::conflict, place, "every node is a `node`; remove the node instead"};
  std::vector<Command> inverse{
      command<Typify>({in.node, type->id, JsonValue::of(ports_to_json(*type, (*node)->types.at(type->id)))})};
  for (const std::string& path : std::set<std::string>((*node)->locked)) {
    if (!path.starts_with(type->id + ".")) continue;
    inverse.push_back(command<LockPort>({in.node, {path}}));
    edit.set_locked(in.node, path, false);
  }
  edit.remove_type(in.node, type->id);
  return inverse;
}

}  // namespace bl

BL_COMMAND(untypify, Untypify)
