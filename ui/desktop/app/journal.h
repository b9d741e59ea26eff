// The log of an open scene on the disk, line by line, so that a crash loses nothing.
#pragma once

#include <string>
#include <vector>

#include "core/file/log_writer.h"
#include "core/session/log.h"

namespace bl::desktop {

class Journal {
 public:
  Journal() = default;
  ~Journal() { end(); }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Starts a new log in the person's own folder, in place of the one before; `scene_path` may be empty.
  Result<void> begin(const std::string& scene_path, const std::string& scene_text);
  void add(const LogEntry& entry, const Registry& registry);
  /// The scene is safe elsewhere, or given up on purpose: nothing is left to recover.
  void end();
  /// Where it is being written; empty where it could not be.
  const std::string& path() const { return path_; }

  /// What a window that did not end well has left.
  struct Remains {
    std::string path, scene_path;
    LogFile log;
  };
  /// Journals whose window is gone and that hold changes; others of dead windows are cleared away.
  static std::vector<Remains> find(const Registry& registry);
  static void discard(const Remains& remains);

 private:
  LogWriter writer_;
  std::string path_;
};

/// The person's folder for journals, settings and pictures, made where it is missing: XDG_STATE_HOME or ~/.local/state.
std::string person_folder();

}  // namespace bl::desktop
