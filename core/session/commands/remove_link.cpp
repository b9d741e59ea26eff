// Removes a link.
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/session/support.h"

namespace bl {

void RemoveLink::declare(CommandBuilder<RemoveLink>& c) {
  c.id("remove_link").label("Remove link").doc("Removes a link.");
  c.argument(&In::id, "id").required().doc("Id of the link.");
}

Inverse RemoveLink::apply(SceneEdit& edit, const In& in) {
  auto link = edit.link(in.id);
  if (!link) return link.error();
  std::vector inverse{command<AddLink>({in.id, JsonValue::of(link_to_json(**link, edit.registry())), !(*link)->ghost.empty()})};
  edit.remove_link(in.id);
  return inverse;
}

}  // namespace bl

BL_COMMAND(remove_link, RemoveLink)
