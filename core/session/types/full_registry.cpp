// The registry of all types, made when it is first asked for: those built in, then those of plugins.
#include <cstdlib>

#include "core/session/types/plugins.h"

namespace bl {

namespace {

std::vector<std::string>& chosen_folders() {
  static std::vector<std::string> folders;
  return folders;
}

std::vector<PluginReport>& reports() {
  static std::vector<PluginReport> all;
  return all;
}

// Only folders that people have named: a scene that somebody sent must not bring code along.
std::vector<std::string> plugin_folders() {
  std::vector<std::string> folders = chosen_folders();
  const char* named = std::getenv("BEHAVIOURLINKS_PLUGINS");
  std::string rest = named != nullptr ? named : "";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    if (end != 0) folders.push_back(rest.substr(0, end));
    rest = end == std::string::npos ? "" : rest.substr(end + 1);
  }
  return folders;
}

}  // namespace

void use_plugins(std::vector<std::string> folders) { chosen_folders() = std::move(folders); }

const std::vector<PluginReport>& plugin_reports() {
  (void)full_registry();
  return reports();
}

const Registry& full_registry() {
  static const Registry kRegistry = [] {
    Registry registry;
    register_base_node(registry);
    register_typifications(registry);
    register_links(registry);
    register_commands(registry);
    register_live_commands(registry);
    for (const std::string& folder : plugin_folders())
      for (PluginReport& report : load_plugins(registry, folder)) reports().push_back(std::move(report));
    return registry;
  }();
  return kRegistry;
}

}  // namespace bl
