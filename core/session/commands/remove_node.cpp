// Removes a node, also from the links and sets that name it; links with an empty end are removed as well.
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/session/support.h"

namespace bl {

void RemoveNode::declare(CommandBuilder<RemoveNode>& c) {
  c.id("remove_node").label("Remove node").doc("Removes a node, and the links that would have an empty end without it.");
  c.argument(&In::id, "id").required().doc("Id of the node.");
}

namespace {

// Takes the node out of all links; says how to bring them back.
void leave_links(SceneEdit& edit, const std::string& id, std::vector<Command>& inverse) {
  const auto& links = edit.scene().links;
  for (const std::string& name : edit.namers().links_to(id)) {
    const auto it = links.find(name);
    if (it == links.end()) continue;
    LinkRecord link = it->second;
    Selection from = link.from, to = link.to;
    const bool is_from = drop(from, id), is_to = drop(to, id);
    if ((is_from && from.is_empty()) || (is_to && to.is_empty())) {
      inverse.push_back(command<AddLink>({name, JsonValue::of(link_to_json(link, edit.registry()))}));
      edit.remove_link(name);
    } else if (is_from || is_to) {
      inverse.push_back(command<SetLinkEnds>({name, link.from, link.to}));
      link.from = std::move(from);
      link.to = std::move(to);
      edit.change_link(name, std::move(link));
    }
  }
}

// Takes the node out of the sets that another node names in its settings.
void leave_sets_of(SceneEdit& edit, const std::string& other, const std::string& id, std::vector<Command>& inverse) {
  const auto node = edit.scene().nodes.find(other);
  if (node == edit.scene().nodes.end()) return;
  for (const auto& [type_id, values] : node->second.types) {
    const TypificationDefinition& type = *edit.registry().typification(type_id);
    for (const PortDefinition& port : type.ports) {
      const auto it = values.find(port.id);
      if (it == values.end() || port.kind != ValueKind::selection) continue;
      Selection selection = *std::get<Shared<Selection>>(it->second);
      if (!drop(selection, id)) continue;
      inverse.push_back(command<SetPort>({other, {type_id + "." + port.id}, json_of(it->second, port)}));
      edit.set_value(other, type_id, port, Shared<Selection>(std::move(selection)));
    }
  }
}

}  // namespace

Inverse RemoveNode::apply(SceneEdit& edit, const In& in) {
  auto node = edit.node(in.id);
  if (!node) return node.error();
  std::vector<Command> inverse{command<AddNode>({in.id, JsonValue::of(node_to_json(**node, edit.registry()))})};
  edit.remove_node(in.id);
  leave_links(edit, in.id, inverse);
  for (const std::string& other : edit.namers().nodes_to(in.id)) leave_sets_of(edit, other, in.id, inverse);
  return inverse;
}

}  // namespace bl

BL_COMMAND(remove_node, RemoveNode)
