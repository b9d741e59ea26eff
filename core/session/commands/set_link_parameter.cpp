// Sets one parameter of a link.
#include "core/session/support.h"

namespace bl {

void SetLinkParameter::declare(CommandBuilder<SetLinkParameter>& c) {
  c.id("set_link_parameter").label("Set parameter").doc("Sets a parameter of a link.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
  c.argument(&In::parameter, "parameter").required().doc("Id of the parameter.");
  c.argument(&In::value, "value").doc("The new value as in a scene file; null for the default.");
}

Inverse SetLinkParameter::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  const std::string place = "links/" + in.id + "/" + in.parameter;
  const LinkDefinition* kind = (*link)->ghost.empty() ? edit.registry().link((*link)->kind) : nullptr;
  if (kind == nullptr) return Error{ErrorCode::conflict, place, "the link is of an unknown kind and kept as it is"};
  auto value = argument_value(*kind, in.parameter, in.value, place);
  if (!value) return value.error();
  const PortDefinition& port = *kind->find_port(in.parameter);
  if (auto known = check_references(edit, *kind, {{port.id, *value}}, "", "links/" + in.id); !known) return known.error();
  std::vector inverse{command<SetLinkParameter>({in.id, in.parameter, current_value((*link)->parameters, port)})};
  LinkRecord changed = **link;
  assign(changed.parameters, port, *value);
  edit.change_link(in.id, std::move(changed));
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_link_parameter, SetLinkParameter)
