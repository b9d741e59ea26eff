// Connects a link to other nodes.
#include "core/session/support.h"

namespace bl {

void SetLinkEnds::declare(CommandBuilder<SetLinkEnds>& c) {
  c.id("set_link_ends").label("Reconnect link").doc("Connects a link to other nodes or sets of nodes.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
  c.argument(&In::from, "from").required().doc("Where the link starts.");
  c.argument(&In::to, "to").required().doc("Where it ends.");
}

Inverse SetLinkEnds::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  const std::string place = "links/" + in.id;
  if (!(*link)->ghost.empty()) return Error{ErrorCode::conflict, place, "the link is of an unknown kind and kept as it is"};
  if (auto from = check_selection(edit.scene(), in.from, place + "/from"); !from) return from.error();
  if (auto to = check_selection(edit.scene(), in.to, place + "/to"); !to) return to.error();
  std::vector inverse{command<SetLinkEnds>({in.id, (*link)->from, (*link)->to})};
  LinkRecord changed = **link;
  changed.from = in.from;
  changed.to = in.to;
  edit.change_link(in.id, std::move(changed));
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_link_ends, SetLinkEnds)
