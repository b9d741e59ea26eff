// Silences a link without switching it off.
#include "core/session/support.h"

namespace bl {

void MuteLink::declare(CommandBuilder<MuteLink>& c) {
  c.id("mute_link").label("Mute").doc("Mutes a link: it is evaluated and shown, but its proposals do not count.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
  c.argument(&In::muted, "muted").doc("Whether the link is muted.");
}

Inverse MuteLink::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  if (!(*link)->ghost.empty())
    return Error{ErrorCode::conflict, "links/" + in.id, "the link is of an unknown kind and kept as it is"};
  std::vector inverse{command<MuteLink>({in.id, (*link)->is_muted})};
  LinkRecord changed = **link;
  changed.is_muted = in.muted;
  edit.change_link(in.id, std::move(changed));
  return inverse;
}

}  // namespace bl

BL_COMMAND(mute_link, MuteLink)
