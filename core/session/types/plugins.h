// Loads types from shared libraries in folders into the registry, and refuses libraries that were built for another program.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/define/registry.h"

namespace bl {

/// The result for one file.
struct PluginReport {
  std::string file;
  std::vector<std::string> types;  ///< ids that it added
  std::optional<Error> error;      ///< why it was refused; then it added nothing
};

/// The ABI text of this program; a plugin must carry the same.
const char* plugin_abi();
/// The ABI text in a library, read from its bytes: no code of a library of another program is ever run.
Result<std::string> read_plugin_abi(const std::string& file);
/// Adds the types of one library. Refused as a whole where the ABI differs or an id is taken.
PluginReport load_plugin(Registry& registry, const std::string& file);
/// All .so files of a folder, in ascending name.
std::vector<PluginReport> load_plugins(Registry& registry, const std::string& folder);

/// Folders that full_registry() looks into besides those of the variable BEHAVIOURLINKS_PLUGINS (separated by `:`). Call this
/// before the first use of the registry.
void use_plugins(std::vector<std::string> folders);
/// The results for all plugins of full_registry().
const std::vector<PluginReport>& plugin_reports();

}  // namespace bl
