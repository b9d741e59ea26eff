// Drafts that are tried beside a room while somebody looks at them, on a thread of their own.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/graph/state.h"
#include "core/room/room.h"
#include "core/wire/draft_trial.h"

namespace bl::serve {

/// One thread takes turns between the trials that run, so that a room takes no more than one processor for them. All functions
/// are called by the thread of the room.
class TrialRunner {
 public:
  static constexpr std::size_t kAtOnce = 2;  ///< the others wait in line

  TrialRunner() = default;
  TrialRunner(const TrialRunner&) = delete;
  TrialRunner& operator=(const TrialRunner&) = delete;
  ~TrialRunner();

  /// Begins, goes on with and ends trials as people look at drafts. `state`: that of the room's scene, for trials that begin now.
  /// A trial whose draft gets other steps begins again at once. One whose room changes ends first, and then begins again: a room
  /// in which much happens would otherwise never see the end of one.
  void follow(room::Room& room, const std::map<std::int64_t, std::set<std::string>>& looked_at,
              const std::function<std::shared_ptr<const State>()>& state);
  /// Has anything come of a trial since the last call?
  bool has_news();
  /// What people are shown.
  const wire::DraftTrials& shown() const { return shown_; }
  /// Forgets everything, as before the room is made again.
  void clear();

 private:
  struct Basis {
    std::int64_t seq = 0, revision = 0;  // of the room's scene and of the draft's steps
    bool operator==(const Basis&) const = default;
  };
  struct Job;
  struct Outcome {
    Basis basis;
    wire::DraftTrial trial;
  };
  static Basis basis_of(const room::Room& room, const room::Draft& draft) { return {room.scene_seq(), draft.revision()}; }
  std::vector<std::string> wished(const room::Room& room) const;
  void end_unwished(const room::Room& room, const std::vector<std::string>& wished);
  void begin(room::Room& room, const std::string& draft, const std::function<std::shared_ptr<const State>()>& state);
  void show(const room::Room& room);
  void work();

  wire::DraftTrials shown_;
  std::vector<std::string> line_;  // drafts that wait, the first one first
  std::mutex mutex_;
  std::condition_variable wake_;
  // Behind the mutex.
  std::map<std::string, std::shared_ptr<Job>> jobs_;  // by draft: those that run
  std::map<std::string, Outcome> outcomes_;           // by draft: the last one, also of a trial that still runs
  bool has_news_ = false, is_ending_ = false;
  std::thread thread_;
};

}  // namespace bl::serve
