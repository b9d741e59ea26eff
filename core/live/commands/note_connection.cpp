// Notes at a sensor what its connection says: why there is none, or that all is well.
#include "core/live/commands.h"
#include "core/session/support.h"

namespace bl::live {

void NoteConnection::declare(CommandBuilder<NoteConnection>& c) {
  c.id("note_connection").label("Note connection").doc("Notes at a sensor why its device cannot be reached, or that it can.");
  c.argument(&In::node, "node").required().doc("Id of the sensor.");
  c.argument(&In::sentence, "sentence").doc("What is wrong with the connection; empty where all is well.");
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
