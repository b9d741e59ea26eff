// Files that a scene names relative to its own: pictures of media, recorded tables of sensors, and what a broker wants to see.
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
      copies;                        ///< tables, from where to where: they are played out of the scene's folder only
  std::vector<std::string> secrets;  ///< names of passwords and certificates, which stay behind
};

/// What has to be said and copied so that a scene which moves from one folder to another still has its files. Those below the new
/// folder are named relative to it, pictures elsewhere by their full path, and tables elsewhere are copied beside the scene.
/// Nothing is said of files that are not there. An empty folder is the one where the program was started.
NamedFiles files_named_from(const Scene& scene, const std::string& folder, const std::string& target);

}  // namespace bl::desktop
