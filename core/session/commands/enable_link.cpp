// Switches a link on or off.
#include "core/session/support.h"

namespace bl {

void EnableLink::declare(CommandBuilder<EnableLink>& c) {
  c.id("enable_link").label("Enable").doc("Switches a link on or off; off means that it is not evaluated.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
  c.argument(&In::enabled, "enabled").doc("Whether the link runs.");
}

Inverse EnableLink::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  if (!(*link)->ghost.empty())
    return Error{ErrorCode::conflict, "links/" + in.id, "the link is of an unknown kind and kept as it is"};
  std::vector inverse{command<EnableLink>({in.id, (*link)->is_enabled})};
  LinkRecord changed = **link;
  changed.is_enabled = in.enabled;
  edit.change_link(in.id, std::move(changed));
  return inverse;
}

}  // namespace bl

BL_COMMAND(enable_link, EnableLink)
