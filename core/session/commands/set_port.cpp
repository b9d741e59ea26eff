// Sets one setting of a node.
#include "core/session/support.h"

namespace bl {

void SetPort::declare(CommandBuilder<SetPort>& c) {
  c.id("set_port")
      .label("Set value")
      .doc("Sets a value of a node. A position that links move starts again from the value that is set.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which value, written `typification.port`.");
  c.argument(&In::value, "value").doc("The new value as in a scene file; null for the default.");
}

Inverse SetPort::apply(SceneEdit& edit, const In& in) {
  // Older logs set at a node what now is said once for the scene.
  if (const auto path = parse_port_path(in.port.path))
    if (const auto port = edit.registry().port(*path); port && (*port)->of_scene == OfScene::always && edit.node(in.node))
      return SetSetting::apply(edit, {path->port, in.value});
  const auto site = find_setting(edit, in.node, in.port);
  if (!site) return site.error();
  const std::string path = site->type->id + "." + site->port->id,
                    place = "nodes/" + in.node + "/" + site->type->id + "/" + site->port->id;
  auto value = argument_value(*site->type, site->port->id, in.value, place);
  if (!value) return value.error();
  if (auto known = check_references(edit, *site->type, {{site->port->id, *value}}, "", "nodes/" + in.node + "/" + site->type->id);
      !known)
    return known.error();
  const PortValues& values = site->node->types.at(site->type->id);
  std::vector inverse{command<SetPort>({in.node, {path}, current_value(values, *site->port)})};
  if (in.value.is_null()) edit.erase_value(in.node, site->type->id, *site->port);  // the scene's, where the port follows it
  else edit.set_value(in.node, site->type->id, *site->port, *value);
  edit.place(in.node, path);
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_port, SetPort)
