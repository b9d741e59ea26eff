// Files that people ask a room for, such as its minutes: made beside it, one at a time.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/journal/writer.h"

namespace bl::serve {

/// Belongs to the thread of the room.
class Errands {
 public:
  struct Made {
    std::string name, content;
    std::vector<std::string> notes = {};  ///< sentences for whoever gets it: what the file cannot hold
  };
  using OnOwnThread = std::function<void(std::function<void()>)>;
  using Read = std::function<Result<void>(journal::Journal&)>;
  using Work = std::function<Result<Made>()>;
  using Done = std::function<void(const Result<Made>&)>;
  Errands(journal::Writer& writer, OnOwnThread on_own_thread);
  /// Waits for what is being made.
  ~Errands();
  Errands(const Errands&) = delete;
  Errands& operator=(const Errands&) = delete;

  /// When everything that was said before is stored, `read` gets the session file on the thread of the disk; commits wait for it,
  /// as they do for a copy. `work` then runs on a thread of its own, beside them. `done` is told on the thread of the room; at
  /// once where something is being made already (ErrorCode::conflict). What has a `name` waits for its turn instead, and is made
  /// once for all who ask for that name meanwhile.
  void begin(const std::string& name, Read read, Work work, Done done);

 private:
  struct Errand {
    std::string name;
    Read read;
    Work work;
    std::vector<Done> done;
  };
  void start();
  void work_beside();
  void end(const Result<Made>& made);

  journal::Writer* writer_;
  OnOwnThread on_own_thread_;
  std::deque<Errand> line_;  // the first one is being made
  std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);
  std::thread thread_;
};

}  // namespace bl::serve
