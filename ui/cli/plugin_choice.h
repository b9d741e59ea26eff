// Plugins as both programs load them: folders from the command line, refusals told.
#pragma once

#include <string>
#include <vector>

namespace bl::cli {

/// Looks into these folders (and those of BEHAVIOURLINKS_PLUGINS) and says on stderr which plugins are refused, and why.
void load_chosen_plugins(std::vector<std::string> folders);

}  // namespace bl::cli
