// `open`: starts the program with the window, which lies in the same folder.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include <unistd.h>

#include "ui/cli/commands.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

// Installed: in the same folder. In a build: in the folder of the desktop.
std::string desktop_program() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& place : {folder / "behaviourlinks-desktop", folder.parent_path() / "desktop" / "behaviourlinks-desktop"})
    if (std::filesystem::exists(place, error)) return place.string();
  return "";
}

}  // namespace

int open_command(const OpenOptions& options) {
  const std::string program = desktop_program();
  if (program.empty()) {
    complain("the program with the window is not built; `./bl open SCENE` installs what it needs and builds it.");
    return kBadInput;
  }
  std::vector<std::string> words{program};
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(program.c_str(), arguments.data());
  complain(program + " could not be started: " + std::strerror(errno));
  return kBadInput;
}

}  // namespace bl::cli
