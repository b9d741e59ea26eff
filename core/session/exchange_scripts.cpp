// Replaces the scripts of a scene, and reads the links of their kinds again.
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/session/support.h"

namespace bl {

namespace {

// The link under the new types. Ghosts that do not fit stay ghosts; a link that runs must not lose anything.
Result<LinkRecord> read_again(const SceneEdit& edit, const std::string& id, const LinkRecord& link, const Json& json,
                              const Registry& types) {
  auto fresh = link_from_json(json, types, "links/" + id);
  if (!link.ghost.empty()) {
    if (!fresh || !check_selection(edit.scene(), fresh->from, "") || !check_selection(edit.scene(), fresh->to, "")) return link;
    return fresh;
  }
  if (!fresh)
    return Error{fresh.error().code, fresh.error().place,
                 fresh.error().message + "; the link sets it: reset it first, or leave it in the script"};
  return fresh;
}

}  // namespace

Inverse exchange_scripts(SceneEdit& edit, const Scripts& after, std::vector<Command> back) {
  const Scripts before = edit.scene().scripts;
  const Registry &old_types = before.types(edit.program()), &new_types = after.types(edit.program());
  std::map<std::string, LinkRecord> changed;
  for (const auto& [id, link] : edit.scene().links) {
    if (link.ghost.empty() && edit.program().link(link.kind) != nullptr) continue;
    const Json json = link_to_json(link, old_types);
    auto fresh = read_again(edit, id, link, json, new_types);
    if (!fresh) return fresh.error();
    // Also of a link that stays a ghost: once its nodes are there again, the old scripts would wake it.
    auto returned = read_again(edit, id, *fresh, link_to_json(*fresh, new_types), old_types);
    if (!returned || *returned != link) {
      back.push_back(command<RemoveLink>({id}));
      back.push_back(command<AddLink>({id, JsonValue::of(json), !link.ghost.empty()}));
    }
    if (*fresh != link) changed.emplace(id, std::move(*fresh));
  }
  for (auto& [id, link] : changed) edit.change_link(id, std::move(link));
  edit.set_scripts(after);
  return back;
}

}  // namespace bl
