// Reads a scene file for a command, and prints all of its problems.
#pragma once

#include <optional>
#include <string>

#include "core/file/scene_file.h"

namespace bl::cli {

/// The scene, or nothing after all of its problems were printed. Warnings are printed and do not stop it. With `gets_scripts`
/// they are left to the caller, who adds link kinds first.
std::optional<SceneReading> load_scene(const std::string& file, bool gets_scripts = false);

/// May a changed scene be written to `out`? An existing file other than the scene it came from is replaced only with --force;
/// else an error is printed.
bool may_write(const std::string& out, const std::string& scene, bool is_forced);

/// "1 node", "3 nodes".
std::string counted(std::size_t number, const std::string& noun);

}  // namespace bl::cli
