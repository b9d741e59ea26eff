// The minutes of a room that runs: read by the thread of its disk, and made by a thread of their own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "core/journal/writer.h"

namespace bl::serve {

struct StoredSession;

/// Belongs to the thread of the room. While the file is read, commits wait, as they do for a copy of it. All else is done beside
/// them: it takes as long as all entries take to be folded again.
class MinutesMaker {
 public:
  using OnOwnThread = std::function<void(std::function<void()>)>;
  using Done = std::function<void(const Result<std::string>&)>;
  MinutesMaker(journal::Writer& writer, OnOwnThread on_own_thread);
  /// Waits for what is being made.
  ~MinutesMaker();
  MinutesMaker(const MinutesMaker&) = delete;
  MinutesMaker& operator=(const MinutesMaker&) = delete;

  /// One file of the minutes of all that is stored by now, such as `minutes.html`. `done` is told on the thread of the room, at
  /// once where something is being made already. `zone`: of its times, so far ahead of UTC [min].
  void make(const std::string& file, int zone, Done done);

 private:
  struct Wish {
    std::string file;
    int zone = 0;
  };
  void begin(const Wish& wish, const Done& done, const std::shared_ptr<const Result<StoredSession>>& stored);
  void end(const Done& done, const Result<std::string>& made);

  journal::Writer* writer_;
  OnOwnThread on_own_thread_;
  bool is_busy_ = false;
  std::shared_ptr<bool> is_alive_ = std::make_shared<bool>(true);
  std::thread thread_;
};

}  // namespace bl::serve
