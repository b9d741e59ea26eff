// A running scene with its journal on the disk and the history of its holder's steps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/host/history.h"
#include "core/host/journal.h"
#include "core/host/live_session.h"

namespace bl::host {

class Host {
 public:
  /// The scene must be usable. Each entry goes to the journal from begin_journal() on.
  static Result<std::unique_ptr<Host>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                             LiveSessionOptions options);

  LiveSession& session() { return *session_; }
  const LiveSession& session() const { return *session_; }
  const History& history() const { return history_; }

  /// Submits commands of the holder as one step; several become one batch. `label`: the name of the step, where its commands
  /// alone do not say what was meant.
  Result<void> submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "");
  /// The same, as one frame of a gesture (`LiveSession::show`).
  Result<void> show(const std::vector<Command>& commands, std::int64_t gesture);

  /// From now on a crash loses nothing: the journal holds this text and all later entries. Where no journal can be started,
  /// everything else works, and journal_problem() says why. `scene_path` is the path of the scene's file; it may be empty.
  void begin_journal(const std::string& scene_path, const std::string& scene_text);
  /// Why a crash would lose unsaved changes; empty where it would not.
  std::string journal_problem() const { return journal_.problem(); }
  /// Applies the entries of a journal; entries that do not fit are left out and reported. Its ticks and rewinds are not repeated.
  std::vector<Error> recover(const std::vector<LogEntry>& entries);

  /// The log since the session began, for `replay`.
  std::string log_text() const;

 private:
  Host(const Registry& registry, std::string start, std::unique_ptr<LiveSession> session);

  const Registry* registry_;
  std::string start_;  // text of the scene with which the session began
  Journal journal_;
  History history_;
  std::unique_ptr<LiveSession> session_;
};

}  // namespace bl::host
