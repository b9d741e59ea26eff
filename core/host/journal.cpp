// Journals are named after the process that writes them; a journal whose process has ended was left by a crash.
#include "core/host/journal.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <unistd.h>

#include "core/file/file_io.h"

namespace bl::host {

namespace {

namespace files = std::filesystem;

constexpr const char* kEnding = ".journal";
constexpr const char* kPathEnding = ".scene_path";
constexpr const char* kUnreadable = ".unreadable";

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

// Journals that this process writes. Process numbers come back, after a restart and in containers, so that a file with our own
// number can be what another window has left.
std::set<std::string>& written_here() {
  static std::set<std::string> paths;
  return paths;
}

// Opens a new file; never one that is there already. Its path.
Result<std::string> open_fresh(const std::string& folder, LogWriter& writer) {
  for (int count = 1;; ++count) {
    const std::string path = folder + "/" + std::to_string(getpid()) + "-" + std::to_string(count) + kEnding;
    const auto opened = writer.open(path, true);
    if (opened) return path;
    if (opened.error().code != ErrorCode::duplicate) return opened.error();
  }
}

// Out of the way of the next search; where it lies then.
std::string put_aside(const std::string& path) {
  std::error_code error;
  std::string aside = path + kUnreadable;
  for (int count = 2; files::exists(aside, error); ++count) aside = path + kUnreadable + "-" + std::to_string(count);
  files::rename(path, aside, error);
  if (error) return path;
  files::rename(path + kPathEnding, aside + kPathEnding, error);  // it may never have been written
  return aside;
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
  if (error) return "";
  files::permissions(folder, files::perms::owner_all, error);  // it holds what opens seats; file systems without rights have none
  return folder;
}

Result<void> Journal::begin(const std::string& scene_path, const std::string& scene_text, std::int64_t base) {
  const auto start = [&]() -> Result<void> {
    const std::string folder = journal_folder();
    if (folder.empty()) return Error{ErrorCode::io, "journal", "there is no folder to keep a journal in: set HOME"};
    auto writer = std::make_unique<LogWriter>();
    const auto path = open_fresh(folder, *writer);
    if (!path) return path.error();
    auto done = write_file(*path + kPathEnding, scene_path);
    if (done) writer->write(log_header(scene_text, base));
    if (done && !writer->failure().empty()) done = Error{ErrorCode::io, *path, writer->failure()};
    if (!done) {
      (void)writer->close();
      remove_both(*path);
      return done;
    }
    end();
    writer_ = std::move(writer);
    path_ = *path;
    last_tick_ = 0;
    gestures_ = {};
    written_here().insert(path_);
    return {};
  };
  auto done = start();
  problem_ = done ? std::string() : done.error().text();
  return done;
}

void Journal::add(const LogEntry& entry, const Registry& registry) {
  // A recovery wants what was said, whatever the ticks; but it wants them in order, and after a rewind they are not.
  if (!writer_ || entry.is_return()) return;
  LogEntry ordered = gestures_.fitted(entry);
  gestures_.take(ordered);
  last_tick_ = ordered.tick = std::max(entry.tick, last_tick_);
  writer_->write(log_line(ordered, registry));
}

std::string Journal::problem() const {
  return !problem_.empty() || !writer_ || writer_->failure().empty() ? problem_ : path_ + ": " + writer_->failure();
}

void Journal::end() {
  if (!writer_) return;
  (void)writer_->close();  // a journal that could not be written is no loss any more
  writer_ = nullptr;
  remove_both(path_);
  written_here().erase(path_);
  path_.clear();
}

std::vector<Journal::UnsavedJournal> Journal::find(const Registry& registry, std::vector<std::string>* unreadable) {
  std::vector<UnsavedJournal> found;
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
    if (process == getpid() ? written_here().contains(path) : is_running(process)) continue;
    auto text = read_file(path);
    // Cut off within its first line, there is no entry in it yet.
    const bool is_begun = !text || text->find('\n') != std::string::npos;
    auto log = text ? read_log(*text, registry, LogUse::recovery) : Result<LogFile>(text.error());
    if (!is_begun || (log && log->entries.empty())) {
      remove_both(path);
      continue;
    }
    if (!log) {
      const std::string aside = put_aside(path);
      if (unreadable != nullptr)
        unreadable->push_back("A journal of a crashed window cannot be read (" + log.error().text() + "). It is kept as " +
                              aside + ".");
      continue;
    }
    const auto scene_path = read_file(path + kPathEnding);
    found.push_back({path, scene_path ? *scene_path : std::string(), std::move(*log)});
  }
  return found;
}

void Journal::discard(const UnsavedJournal& remains) { remove_both(remains.path); }

}  // namespace bl::host
