// Files that a scene names relative to its own: pictures of media, and recorded tables of sensors.
#pragma once

#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::desktop {

/// What has to be said so that a scene which moves from one folder to another still names the same files. Files below the new
/// folder are named relative to it, all others by their full path, which holds wherever the scene goes next. Nothing is said
/// of files that are not there. An empty folder is the one where the program was started.
std::vector<Command> commands_naming_files_from(const Scene& scene, const std::string& folder, const std::string& target);

}  // namespace bl::desktop
