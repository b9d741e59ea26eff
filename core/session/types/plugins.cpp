// Reads the ABI text, opens the library, and tests its types in a separate registry first.
#include "core/session/types/plugins.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

#include <dlfcn.h>

#include "core/file/file_io.h"

namespace bl {

namespace {

// Taken apart, so that the program itself does not hold what is searched for.
const std::string kMark = std::string("BEHAVIOURLINKS-PLUGIN-") + "ABI:";

Error refused(ErrorCode code, const std::string& file, std::string why) { return {code, file, std::move(why)}; }

// What an evaluation of a plugin throws would end the program. It becomes an error of the one link or role that it is thrown in:
// what was proposed last stays in force, and everything else goes on.
template <class Call>
Result<void> guarded(const std::string& who, const Call& call) {
  try {
    return call();
  } catch (const std::exception& thrown) {
    return Error{ErrorCode::conflict, "", who + " threw: " + thrown.what()};
  } catch (...) { return Error{ErrorCode::conflict, "", who + " threw something that is no std::exception"}; }
}

void guard(LinkDefinition& kind, const std::string& library) {
  kind.evaluate = [who = "`" + kind.id + "` of " + library, evaluate = std::move(kind.evaluate)](
                      const void* parameters, const LinkReads& reads, LinkWrites& writes, const Tick& tick) {
    return guarded(who, [&] { return evaluate(parameters, reads, writes, tick); });
  };
}

void guard(TypificationDefinition& type, const std::string& library) {
  if (!type.evaluate) return;
  type.evaluate = [who = "`" + type.id + "` of " + library, evaluate = std::move(type.evaluate)](
                      std::span<Value> values, std::span<SetValues> sets, const Tick& tick) {
    return guarded(who, [&] { return evaluate(values, sets, tick); });
  };
}

// Ports of types that nobody has brought yet are left to the scene: their plugin may come later.
std::string misspelt_port(const Registry& types, const std::string& id, const PortPath& path, bool is_proposed) {
  if (!path.chosen_by.empty() || (path.typification == kBaseNode && path.port == "id")) return "";
  const auto port = types.port(path);
  if (!port && port.error().code == ErrorCode::unknown_type) return "";
  if (!port) return "`" + id + "`: " + port.error().message;
  if (is_proposed && (*port)->rule == CombineRule::none)
    return "`" + id + "` proposes to `" + path.typification + "." + path.port +
           "`, which links cannot change: it has no combine rule";
  return "";
}

// Why the types cannot be used: a sentence, or nothing. `files`: the stems of its source files, each ended by a blank.
std::string fault_of(const Registry& registry, const Registry& fresh, std::string_view files) {
  for (const auto& [id, type] : fresh.typifications())
    if (const std::string taken = registry.taken(type); !taken.empty())
      return "the plugin brings `" + taken + "`, which exists already; give its type another id";
  for (const auto& [id, kind] : fresh.links())
    if (const std::string taken = registry.taken(kind); !taken.empty())
      return "the plugin brings `" + taken + "`, which exists already; give its type another id";
  while (!files.empty()) {
    const std::string stem(files.substr(0, files.find(' ')));
    files.remove_prefix(stem.size() + 1);
    if (fresh.link(stem) == nullptr && fresh.typification(stem) == nullptr)
      return "the file " + stem + ".cpp brings no type `" + stem + "`: its id must be the name of the file";
  }
  Registry all = registry;
  for (const auto& [id, type] : fresh.typifications()) all.add(type);
  for (const auto& [id, kind] : fresh.links()) {
    if (kind.proposes.empty()) return "`" + id + "` proposes nothing: declare with l.proposes(...) what the link changes";
    for (const LinkRead& read : kind.reads)
      if (const std::string fault = misspelt_port(all, id, read.path, false); !fault.empty()) return fault;
    for (const LinkWrite& write : kind.proposes)
      if (const std::string fault = misspelt_port(all, id, write.path, true); !fault.empty()) return fault;
  }
  return fresh.typifications().empty() && fresh.links().empty() ? "the plugin brings no type" : "";
}

void add_types(Registry& registry, const Registry& fresh, PluginReport& report) {
  const std::string library = std::filesystem::path(report.file).filename().string();
  for (const auto& [id, type] : fresh.typifications()) {
    TypificationDefinition guarded_type = type;
    guard(guarded_type, library);
    registry.add(std::move(guarded_type));
    report.types.push_back(id);
  }
  for (const auto& [id, kind] : fresh.links()) {
    LinkDefinition guarded_kind = kind;
    guard(guarded_kind, library);
    registry.add(std::move(guarded_kind));
    report.types.push_back(id);
  }
}

// A folder without libraries is named by mistake: mostly it is the one above, or the one with the sources.
Error nothing_in(const std::string& folder) {
  std::string inside;
  std::error_code error;
  std::vector<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.is_directory(error)) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  for (const auto& below : folders)
    for (const auto& entry : std::filesystem::directory_iterator(below, error))
      if (entry.path().extension() == ".so" && inside.empty()) inside = below.string();
  const bool has_sources = std::filesystem::exists(folder + "/CMakeLists.txt", error);
  return refused(
      ErrorCode::missing, folder,
      std::string("there is no plugin (.so) in this folder") +
          (!inside.empty() ? "; " + inside + " has one"
           : has_sources   ? "; these are sources: build them by `./bl plugin '" + folder + "'`, which says where the library is"
                           : "; build one by `./bl plugin FOLDER`, which says where it is"));
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
  const auto* files = static_cast<const char*>(::dlsym(library, "behaviourlinks_files"));
  Registry fresh;
  const auto declared = guarded("its declaration", [&]() -> Result<void> {
    enter(fresh);
    return {};
  });
  const std::string fault =
      declared ? fault_of(registry, fresh, files != nullptr ? files : "")
               : declared.error().message + "; look at the paths of ports, which are written \"typification.port\"";
  if (!fault.empty()) report.error = refused(ErrorCode::conflict, file, fault);
  else add_types(registry, fresh, report);
  return report;
}

std::vector<PluginReport> load_plugins(Registry& registry, const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".so") files.push_back(entry.path().string());
  if (error) return {{folder, {}, refused(ErrorCode::io, folder, "there is no folder of plugins here: " + error.message())}};
  if (files.empty()) return {{folder, {}, nothing_in(folder)}};
  std::sort(files.begin(), files.end());
  std::vector<PluginReport> reports;
  for (const std::string& file : files) reports.push_back(load_plugin(registry, file));
  return reports;
}

}  // namespace bl
