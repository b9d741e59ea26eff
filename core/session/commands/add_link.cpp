// Adds a link between nodes or sets of nodes.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/file/scene_file.h"
#include "core/session/support.h"

namespace bl {

void AddLink::declare(CommandBuilder<AddLink>& c) {
  c.id("add_link").label("Add link").doc("Adds a link between two nodes or sets of nodes.");
  c.argument(&In::id, "id").required().doc("Id of the new link; must not be taken.");
  c.argument(&In::link, "link").required().doc("The link as it stands in a scene file, without its id.");
  c.argument(&In::is_resting, "is_resting")
      .doc("When on, the link is kept unchanged and does not run, like links of unknown kinds.");
}

Inverse AddLink::apply(SceneEdit& edit, const In& in) {
  if (auto id = check_new_id(in.id, edit.scene().links.contains(in.id), "links"); !id) return id.error();
  const std::string place = "links/" + in.id;
  const auto json = in.link.read();
  if (!json) return json.error().within(place);
  // Where no kind is known, all links are ghosts.
  auto link = link_from_json(**json, in.is_resting ? Registry() : edit.registry(), place);
  if (!link) return link.error();
  if (link->ghost.empty()) {
    if (auto from = check_selection(edit.scene(), link->from, place + "/from"); !from) return from.error();
    if (auto to = check_selection(edit.scene(), link->to, place + "/to"); !to) return to.error();
  }
  edit.add_link(in.id, std::move(*link));
  return std::vector{command<RemoveLink>({in.id})};
}

}  // namespace bl

BL_COMMAND(add_link, AddLink)
