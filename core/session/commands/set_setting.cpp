// Sets a setting of the whole scene.
#include "core/session/support.h"

namespace bl {

void SetSetting::declare(CommandBuilder<SetSetting>& c) {
  c.id("set_setting").label("Set setting").doc("Sets a setting of the whole scene.");
  c.argument(&In::setting, "setting").required().doc("Id of the setting.");
  c.argument(&In::value, "value").doc("The new value as in a scene file; null for the default.");
}

Inverse SetSetting::apply(SceneEdit& edit, const In& in) {
  auto value = argument_value(settings_type(), in.setting, in.value, "settings/" + in.setting);
  if (!value) return value.error();
  const PortDefinition& port = *settings_type().find_port(in.setting);
  std::vector inverse{command<SetSetting>({in.setting, current_value(edit.scene().settings, port)})};
  if (in.value.is_null()) edit.erase_setting(port.id);
  else edit.set_setting(port, *value);
  return inverse;
}

}  // namespace bl

BL_COMMAND(set_setting, SetSetting)
