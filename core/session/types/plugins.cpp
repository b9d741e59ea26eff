// Reading the ABI text, opening the library, and trying its types in a registry of its own first.
#include "core/session/types/plugins.h"

#include <algorithm>
#include <filesystem>

#include <dlfcn.h>

#include "core/file/file_io.h"

namespace bl {

namespace {

// Taken apart, so that the program itself does not hold what is searched for.
const std::string kMark = std::string("BEHAVIOURLINKS-PLUGIN-") + "ABI:";

Error refused(ErrorCode code, const std::string& file, std::string why) { return {code, file, std::move(why)}; }

// The types that a library registers, one by one into the program's registry; nothing where one of them is taken.
void add_types(Registry& registry, const Registry& fresh, PluginReport& report) {
  std::vector<std::string> taken;
  for (const auto& [id, type] : fresh.typifications()) taken.push_back(registry.taken(type));
  for (const auto& [id, kind] : fresh.links()) taken.push_back(registry.taken(kind));
  std::erase(taken, "");
  if (!taken.empty()) {
    report.error = refused(ErrorCode::duplicate, report.file,
                           "the plugin brings `" + taken.front() + "`, which is there already; give its type another id");
    return;
  }
  for (const auto& [id, type] : fresh.typifications()) {
    registry.add(type);
    report.types.push_back(id);
  }
  for (const auto& [id, kind] : fresh.links()) {
    registry.add(kind);
    report.types.push_back(id);
  }
  if (report.types.empty()) report.error = refused(ErrorCode::missing, report.file, "the plugin brings no type");
}

}  // namespace

const char* plugin_abi() { return BL_PLUGIN_ABI; }

Result<std::string> read_plugin_abi(const std::string& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const std::size_t at = bytes->find(kMark);
  if (at == std::string::npos)
    return refused(ErrorCode::parse, file,
                   "this is no plugin of BehaviourLinks: it carries no ABI text; build it with bl_plugin()");
  const std::size_t begin = at + kMark.size(), end = bytes->find('\0', begin);
  return bytes->substr(begin, std::min(end - begin, std::size_t{500}));
}

PluginReport load_plugin(Registry& registry, const std::string& file) {
  PluginReport report{file, {}, std::nullopt};
  const auto abi = read_plugin_abi(file);
  if (!abi) {
    report.error = abi.error();
    return report;
  }
  if (*abi != plugin_abi()) {
    report.error = refused(ErrorCode::version, file,
                           "the plugin was built for another program (" + *abi + "), this one is " + plugin_abi() +
                               "; build it again from this checkout");
    return report;
  }
  // Never closed: definitions hold code of the library for as long as the program runs.
  void* library = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    report.error =
        refused(ErrorCode::io, file, std::string("the plugin cannot be opened: ") + (why != nullptr ? why : "unknown"));
    return report;
  }
  using Register = void (*)(Registry&);
  const auto enter = reinterpret_cast<Register>(::dlsym(library, "behaviourlinks_register"));
  if (enter == nullptr) {
    report.error =
        refused(ErrorCode::missing, file, "the plugin has no function `behaviourlinks_register`; build it with bl_plugin()");
    return report;
  }
  Registry fresh;
  enter(fresh);
  add_types(registry, fresh, report);
  return report;
}

std::vector<PluginReport> load_plugins(Registry& registry, const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  if (error) return {{folder, {}, refused(ErrorCode::io, folder, "there is no folder of plugins here: " + error.message())}};
  std::sort(files.begin(), files.end());
  std::vector<PluginReport> reports;
  for (const std::string& file : files) reports.push_back(load_plugin(registry, file));
  return reports;
}

}  // namespace bl
