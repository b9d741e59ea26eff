// Adds a link kind written in Lua to the scene, or gives it a new text.
#include "core/base/text.h"
#include "core/session/support.h"

namespace bl {

void SetScript::declare(CommandBuilder<SetScript>& c) {
  c.id("set_script")
      .label("Set script")
      .doc(
          "Adds a link kind that is written in Lua, or gives it a new text. A text that cannot be read is refused, and the old "
          "one "
          "stays in force.");
  c.argument(&In::id, "id").required().doc("The name of the script: that of its file without .lua.");
  c.argument(&In::text, "text").required().doc("The whole text.");
  c.argument(&In::even_if_broken, "even_if_broken")
      .doc("When on, a text that cannot be read is stored nevertheless, and links of its kind do not run; undo needs it.");
}

// The script of the scene under another name whose kind the new text declares once more; empty where there is none.
static std::string bearer_of(const SceneEdit& edit, const Scripts& before, const SetScript::In& in) {
  const auto kind = Scripts::read({{in.id, in.text}}, edit.program()).kinds();
  if (kind.empty()) return "";
  for (const auto& [name, id] : before.kinds())
    if (name != in.id && id == kind.begin()->second) return name;
  return "";
}

Inverse SetScript::apply(SceneEdit& edit, const In& in) {
  const std::string place = "scripts/" + in.id;
  if (!is_identifier(in.id))
    return Error{ErrorCode::wrong_kind, place, "`" + in.id.substr(0, 80) + "` is no name: use 1 to 64 of a-z 0-9 _ - . #"};
  const Scripts before = edit.scene().scripts;
  auto texts = before.texts();
  texts[in.id] = in.text;
  const Scripts after = Scripts::read(std::move(texts), edit.program());
  if (!in.even_if_broken)
    if (const std::string other = bearer_of(edit, before, in); !other.empty())
      return Error{ErrorCode::duplicate, place,
                   "the scene's script `" + other + "` has this id already; name your file " + other +
                       ".lua to replace it, or choose another id"};
  if (!in.even_if_broken)
    for (const auto& [name, error] : after.errors())
      if (name == in.id || !before.errors().contains(name)) return error.within("scripts/" + name);
  const auto old = before.texts().find(in.id);
  std::vector back{old == before.texts().end() ? command<RemoveScript>({in.id})
                                               : command<SetScript>({in.id, old->second, before.errors().contains(in.id)})};
  return exchange_scripts(edit, after, std::move(back));
}

}  // namespace bl

BL_COMMAND(set_script, SetScript)
