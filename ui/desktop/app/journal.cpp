// Journals are named by the process that writes them; one whose process is gone is what a crash has left.
#include "ui/desktop/app/journal.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include <unistd.h>

#include "core/file/file_io.h"

namespace bl::desktop {

namespace {

namespace files = std::filesystem;

constexpr const char* kEnding = ".journal";
constexpr const char* kPathEnding = ".scene_path";

std::string journal_folder() {
  const std::string folder = person_folder();
  if (folder.empty()) return "";
  std::error_code error;
  files::create_directories(folder + "/journals", error);
  return error ? std::string() : folder + "/journals";
}

bool is_running(long process) { return process > 0 && (kill(static_cast<pid_t>(process), 0) == 0 || errno == EPERM); }

void remove_both(const std::string& path) {
  std::error_code ignored;
  files::remove(path, ignored);
  files::remove(path + kPathEnding, ignored);
}

}  // namespace

std::string person_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  std::string folder;
  if (state != nullptr && *state == '/') folder = state;
  else if (home != nullptr && *home == '/') folder = std::string(home) + "/.local/state";
  else return "";
  folder += "/behaviourlinks";
  std::error_code error;
  files::create_directories(folder, error);
  return error ? std::string() : folder;
}

Result<void> Journal::begin(const std::string& scene_path, const std::string& scene_text) {
  end();
  const std::string folder = journal_folder();
  if (folder.empty()) return Error{ErrorCode::io, "journal", "there is no folder to keep a journal in: set HOME"};
  static int count = 0;
  const std::string path = folder + "/" + std::to_string(getpid()) + "-" + std::to_string(++count) + kEnding;
  if (auto written = write_file(path + kPathEnding, scene_path); !written) return written;
  if (auto opened = writer_.open(path); !opened) return opened;
  path_ = path;
  writer_.write(log_header(scene_text));
  return {};
}

void Journal::add(const LogEntry& entry, const Registry& registry) {
  if (!path_.empty()) writer_.write(log_line(entry, registry));
}

void Journal::end() {
  if (path_.empty()) return;
  (void)writer_.close();  // a journal that could not be written is no loss any more
  remove_both(path_);
  path_.clear();
}

std::vector<Journal::Remains> Journal::find(const Registry& registry) {
  std::vector<Remains> found;
  const std::string folder = journal_folder();
  if (folder.empty()) return found;
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& item : files::directory_iterator(folder, error))
    if (item.path().extension() == kEnding) paths.push_back(item.path().string());
  std::sort(paths.begin(), paths.end());
  for (const std::string& path : paths) {
    const std::string name = files::path(path).filename().string();
    long process = 0;
    std::from_chars(name.data(), name.data() + name.size(), process);
    if (is_running(process)) continue;
    auto text = read_file(path);
    auto log = text ? read_log(*text, registry) : Result<LogFile>(text.error());
    if (!log || log->entries.empty()) {
      remove_both(path);
      continue;
    }
    const auto scene_path = read_file(path + kPathEnding);
    found.push_back({path, scene_path ? *scene_path : std::string(), std::move(*log)});
  }
  return found;
}

void Journal::discard(const Remains& remains) { remove_both(remains.path); }

}  // namespace bl::desktop
