// Several commands as one: all of them, or none.
#include <algorithm>
#include <iterator>

#include "core/base/stop_check.h"
#include "core/session/support.h"

namespace bl {

void Batch::declare(CommandBuilder<Batch>& c) {
  c.id("batch").label("Batch").doc("Applies several commands as one step: all of them, or none.");
  c.argument(&In::commands, "commands").required().doc("A list of commands, each {\"command\": ..., \"arguments\": {...}}.");
}

namespace {

// Appends the commands that undo one step from the last to the first: the whole list is turned once, so that a long batch costs
// no more for each step than a short one.
void append_backwards(std::vector<Command>& list, std::vector<Command>& step) {
  list.insert(list.end(), std::make_move_iterator(step.rbegin()), std::make_move_iterator(step.rend()));
}

}  // namespace

Inverse Batch::apply(SceneEdit& edit, const In& in) {
  if (in.commands->empty()) return Error{ErrorCode::missing, "commands", "an empty batch changes nothing"};
  std::vector<Command> backwards;
  for (std::size_t i = 0; i < in.commands->size(); ++i) {
    Inverse undo = bl::apply(edit, (*in.commands)[i]);
    if (!undo) undo = undo.error().within("commands/" + std::to_string(i));
    if (undo && i % 256 == 0 && is_stop_wished()) {
      append_backwards(backwards, *undo);
      undo = Error{ErrorCode::cancelled, "commands", "This was stopped; nothing was changed."};
    }
    if (!undo) {
      // The steps so far are taken back; each inverse was made for exactly this scene, so it fits.
      std::for_each(backwards.rbegin(), backwards.rend(), [&edit](const Command& back) { (void)bl::apply(edit, back); });
      return undo.error();
    }
    append_backwards(backwards, *undo);
  }
  std::reverse(backwards.begin(), backwards.end());
  return backwards;
}

}  // namespace bl

BL_COMMAND(batch, Batch)
