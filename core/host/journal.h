// The log of an open scene, written to the disk line by line, so that a crash loses nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/file/log_writer.h"
#include "core/session/gestures.h"
#include "core/session/log.h"

namespace bl::host {

class Journal {
 public:
  Journal() = default;
  ~Journal() { end(); }
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Starts a new log in the person's own folder, in place of the one before; `scene_path` may be empty. Where it cannot be
  /// started, the one before continues, because it still leads to the same scene. `base`: the number of the last entry that the
  /// scene contains already.
  Result<void> begin(const std::string& scene_path, const std::string& scene_text, std::int64_t base);
  void add(const LogEntry& entry, const Registry& registry);
  /// Removes the journal: the scene is saved elsewhere, or discarded on purpose.
  void end();
  /// Why a crash would lose something now; empty where it would not.
  std::string problem() const;

  /// The journal of a window that crashed.
  struct UnsavedJournal {
    std::string path, scene_path;
    LogFile log;
  };
  /// Journals with changes whose window has ended. Empty ones are removed. Those that cannot be read are kept under another name;
  /// `unreadable` then gives the reason and the path of each.
  static std::vector<UnsavedJournal> find(const Registry& registry, std::vector<std::string>* unreadable = nullptr);
  static void discard(const UnsavedJournal& remains);

 private:
  std::unique_ptr<LogWriter> writer_;  // none where there is no journal
  std::string path_, problem_;
  std::int64_t last_tick_ = 0;
  Gestures gestures_;  // that are in it
};

/// The person's folder for journals, settings and pictures, made where it is missing: XDG_STATE_HOME or ~/.local/state.
std::string person_folder();

}  // namespace bl::host
