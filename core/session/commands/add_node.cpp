// Adds a node, with its content where it is pasted or restored.
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/session/support.h"

namespace bl {

void AddNode::declare(CommandBuilder<AddNode>& c) {
  c.id("add_node").label("Add node").doc("Adds a node to the scene.");
  c.argument(&In::id, "id").required().doc("Id of the new node; must not be taken.");
  c.argument(&In::node, "node").doc("The node as it stands in a scene file, without its id.");
}

Inverse AddNode::apply(SceneEdit& edit, const In& in) {
  if (auto id = check_new_id(in.id, edit.scene().nodes.contains(in.id), "nodes"); !id) return id.error();
  const auto json = in.node.read();
  if (!json) return json.error().within("nodes/" + in.id);
  auto node = node_from_json(**json, edit.registry(), "nodes/" + in.id);
  if (!node) return node.error();
  for (const auto& [type, values] : node->types)
    if (auto known = check_references(edit, *edit.registry().typification(type), values, in.id, "nodes/" + in.id + "/" + type);
        !known)
      return known.error();
  for (const std::string& path : node->locked) {
    const auto parsed = parse_port_path(path);
    const bool is_there = parsed && (node->ghosts.contains(parsed->typification) ||
                                     (node->types.contains(parsed->typification) && edit.registry().port(*parsed).ok()));
    if (!is_there) return Error{ErrorCode::not_found, "nodes/" + in.id + "/locked", "the node has no port `" + path + "`"};
  }
  edit.add_node(in.id, std::move(*node));
  return std::vector{command<RemoveNode>({in.id})};
}

}  // namespace bl

BL_COMMAND(add_node, AddNode)
