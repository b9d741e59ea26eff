// `script`: puts link kinds written in Lua into a scene, lists them, takes them out as files.
#include <filesystem>

#include "core/file/file_io.h"
#include "core/making/script_file.h"
#include "core/session/session.h"
#include "ui/cli/commands.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

void list(const Scripts& scripts) {
  for (const auto& [name, text] : scripts.texts()) {
    const auto kind = scripts.kinds().find(name);
    print_line(name + ".lua: " + (kind == scripts.kinds().end() ? "cannot be read" : "link kind `" + kind->second + "`"));
  }
  if (scripts.texts().empty()) print_line("the scene has no scripts");
}

std::string extracted(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / (name + ".lua")).string();
}

// What somebody has changed in a file that was extracted before would be lost.
bool may_extract(const Scripts& scripts, const std::string& folder) {
  bool may = true;
  for (const auto& [name, text] : scripts.texts()) {
    const std::string file = extracted(folder, name);
    std::error_code none;
    if (!std::filesystem::exists(file, none)) continue;
    if (const auto there = read_file(file); there && *there == text) continue;
    print_error(
        file,
        {ErrorCode::conflict, "",
         "exists and differs from the script in the scene: put it into the scene first, choose another folder, or use --force"});
    may = false;
  }
  return may;
}

bool extract(const Scripts& scripts, const std::string& folder) {
  std::error_code none;
  std::filesystem::create_directories(folder, none);
  for (const auto& [name, text] : scripts.texts()) {
    const std::string file = extracted(folder, name);
    if (auto written = write_file(file, text); !written) {
      print_error(file, written.error());
      return false;
    }
    print_line("wrote " + file);
  }
  return true;
}

}  // namespace

int script_command(const ScriptOptions& options) {
  auto reading = load_scene(options.scene, !options.files.empty());
  if (!reading) return kBadInput;
  SceneEdit edit(reading->scene, full_registry());
  for (const std::string& file : options.files) {
    auto command = making::script_command(file);
    if (!command) {
      print_error(file, command.error());
      return kBadInput;
    }
    if (auto done = apply(edit, *command); !done) {
      print_error(file, done.error());
      return kBadInput;
    }
  }
  for (const std::string& name : options.removed)
    if (auto done = apply(edit, command<RemoveScript>({name})); !done) {
      print_error(options.scene, done.error());
      return kBadInput;
    }
  if (!options.files.empty()) {
    const std::vector<Problem> unfit = unfit_links(reading->scene, full_registry());
    print_problems(options.scene, unfit.empty() ? check_scene(reading->scene, full_registry()) : unfit);
    if (!unfit.empty()) return kBadInput;
  }
  const bool is_safe = options.extract.empty() || options.is_forced || may_extract(reading->scene.scripts, options.extract);
  if (!is_safe) return kBadInput;
  if (!options.extract.empty() && !extract(reading->scene.scripts, options.extract)) return kBadInput;
  if (!options.out.empty()) {
    if (!may_write(options.out, options.scene, options.is_forced)) return kBadInput;
    const std::string text = write_scene(reading->scene, full_registry(), reading->state ? &*reading->state : nullptr);
    if (auto written = write_file(options.out, text); !written) {
      print_error(options.out, written.error());
      return kBadInput;
    }
  } else if (!options.files.empty() || !options.removed.empty()) {
    complain("nothing was written: name the file for the changed scene with --out");
    return kBadInput;
  }
  list(reading->scene.scripts);
  return kDone;
}

}  // namespace bl::cli
