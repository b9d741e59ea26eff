// Writes the status of its connection to a sensor.
#include "core/live/commands.h"
#include "core/session/support.h"

namespace bl::live {

void NoteConnection::declare(CommandBuilder<NoteConnection>& c) {
  c.id("note_connection").label("Note connection").doc("Writes to a sensor whether its device can be reached, and if not, why.");
  c.argument(&In::node, "node").required().doc("Id of the sensor.");
  c.argument(&In::sentence, "sentence").doc("What is wrong with the connection; empty where it works.");
}

Inverse NoteConnection::apply(SceneEdit& edit, const In& in) {
  const auto site = find_setting(edit, in.node, {"sensor.connection"});
  if (!site) return site.error();
  const std::string before = std::get<std::string>(set_value(edit.scene(), *site->node, *site->type, *site->port));
  edit.set_value(in.node, site->type->id, *site->port, in.sentence.substr(0, 500));
  return std::vector{command<NoteConnection>({in.node, before})};
}

}  // namespace bl::live

BL_COMMAND(note_connection, live::NoteConnection)
