// Lua files on disk as scripts of a scene: their names, and the command that takes them in.
#pragma once

#include <string>

#include "core/session/commands.h"

namespace bl::making {

/// What a script of this file is called in a scene: the file's name without .lua, as an id.
std::string script_name(const std::string& file);
/// The command that puts the file's text into a scene.
Result<Command> script_command(const std::string& file);

}  // namespace bl::making
