// The argument of --set: NODE/TYPIFICATION.PORT=VALUE as a command.
#pragma once

#include <string>

#include "core/session/commands.h"

namespace bl::cli {

/// VALUE is JSON as in a scene file, or a quantity with its unit ("12 m", "0.4 ha"), or the plain text of a text port.
Result<Command> set_command(const Scene& scene, const Registry& registry, const std::string& argument);

}  // namespace bl::cli
