// Removes a link kind written in Lua from the scene; its links stay as ghosts.
#include "core/base/text.h"
#include "core/session/support.h"

namespace bl {

void RemoveScript::declare(CommandBuilder<RemoveScript>& c) {
  c.id("remove_script")
      .label("Remove script")
      .doc("Removes a link kind that is written in Lua. Its links stay in the scene unchanged, and do not run.");
  c.argument(&In::id, "id").required().doc("The name of the script.");
}

Inverse RemoveScript::apply(SceneEdit& edit, const In& in) {
  const Scripts before = edit.scene().scripts;
  auto texts = before.texts();
  const auto old = texts.find(in.id);
  if (old == texts.end())
    return Error{ErrorCode::not_found, "scripts/" + in.id,
                 "there is no script `" + in.id + "`" + did_you_mean(in.id, keys_of(texts))};
  std::vector back{command<SetScript>({in.id, old->second, before.errors().contains(in.id)})};
  texts.erase(old);
  return exchange_scripts(edit, Scripts::read(std::move(texts), edit.program()), std::move(back));
}

}  // namespace bl

BL_COMMAND(remove_script, RemoveScript)
