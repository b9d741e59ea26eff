// Files that a scene names relative to its own: pictures, recorded tables of sensors, passwords and certificates of brokers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/define/command_builder.h"
#include "core/graph/scene.h"

namespace bl::desktop {

struct NamedFiles {
  std::vector<Command> commands;  ///< that name them from the new folder
  std::vector<std::pair<std::string, std::string>>
      copies;                        ///< tables to copy, from and to: they are played from the scene's folder only
  std::vector<std::string> secrets;  ///< names of files with passwords and certificates, which are not copied
};

/// The commands and copies that a scene needs to find its files after moving from one folder to another. Files below the new
/// folder are named relative to it; pictures elsewhere by their full path; tables elsewhere are copied beside the scene. Missing
/// files are ignored. An empty folder is the one where the program was started.
NamedFiles files_named_from(const Scene& scene, const std::string& folder, const std::string& target);

}  // namespace bl::desktop
