// Several commands as one: all of them, or none.
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/support.h"

namespace bl {

void Batch::declare(CommandBuilder<Batch>& c) {
  c.keeps_logic();
  c.id("batch").label("Batch").doc("Applies several commands as one step: all of them, or none.");
  c.argument(&In::commands, "commands").required().doc("A list of commands, each {\"command\": ..., \"arguments\": {...}}.");
}

Inverse Batch::apply(SceneEdit& edit, const In& in) {
  auto list = parse_json(in.commands.text);
  if (!list) return list.error().within("commands");
  if (!list->is_array()) return Error{ErrorCode::wrong_kind, "commands", "expects a list of commands"};
  if (list->empty()) return Error{ErrorCode::missing, "commands", "an empty batch changes nothing"};
  std::vector<Command> inverse;
  for (std::size_t i = 0; i < list->size(); ++i) {
    auto step = command_from_json(edit.registry(), (*list)[i], "commands/" + std::to_string(i));
    Inverse undo = step ? bl::apply(edit, *step) : Inverse(step.error());
    if (!undo) {
      // The steps so far are taken back; each inverse was made for exactly this scene, so it fits.
      for (const Command& back : inverse) (void)bl::apply(edit, back);
      return undo.error();
    }
    inverse.insert(inverse.begin(), undo->begin(), undo->end());
  }
  return inverse;
}

}  // namespace bl

BL_COMMAND(batch, Batch)
