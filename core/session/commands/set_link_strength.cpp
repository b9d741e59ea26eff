// Sets how much the proposals of a link count.
#include "core/session/support.h"

namespace bl {

void SetLinkStrength::declare(CommandBuilder<SetLinkStrength>& c) {
  c.id("set_link_strength").label("Set strength").doc("Sets how much the proposals of a link count.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
  c.argument(&In::strength, "strength").unit(Unit::ratio).range(0, 1).doc("Strength as a share of full strength, 0 to 1.");
}

Inverse SetLinkStrength::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  if (!(*link)->ghost.empty())
    return Error{ErrorCode::conflict, "links/" + in.id, "the link is of an unknown kind and kept as it is"};
  std::vector inverse{command<SetLinkStrength>({in.id, (*link)->strength})};
  LinkRecord changed = **link;
  changed.strength = in.strength;
  edit.change_link(in.id, std::move(changed));
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_link_strength, SetLinkStrength)
