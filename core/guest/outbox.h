// The operations of a run that have no answer yet; where it has a file, they outlive a crash of the window.
#pragma once

#include <cstdint>
#include <cstdio>
#include <deque>
#include <memory>
#include <string>

#include "core/base/result.h"

namespace bl::guest {

/// An operation as it was said: its number, its message, and the step in words.
struct Sent {
  std::int64_t id = 0;
  std::string frame, what;
};

class Outbox {
 public:
  /// A new run, in memory alone.
  explicit Outbox(std::string run) : run_(std::move(run)) {}
  /// The outbox of a room, in a file `STEM-1.outbox`, `STEM-2.outbox`, … whose folder is made where it is missing: one that a
  /// window has left with something in it, else any that no window uses, else a new one of the run `run`. Each window has its
  /// own.
  static Result<Outbox> open(const std::string& stem, const std::string& run);
  Outbox(Outbox&&) = default;
  Outbox& operator=(Outbox&&) = default;

  const std::string& run() const { return run_; }
  /// Operations are numbered without gaps, also by the next window that has this outbox.
  std::int64_t next_id() const { return last_id_ + 1; }
  std::int64_t last_answered() const { return last_answered_; }
  std::int64_t last_gesture() const { return last_gesture_; }
  const std::deque<Sent>& waiting() const { return waiting_; }

  /// Keeps the operation with the next number, on the disk first: on an error it is not kept, and must not be sent.
  Result<void> keep(Sent sent, std::int64_t gesture);
  /// Whether it has waited.
  bool answered(std::int64_t id);
  /// The room has answered all up to `done`: later operations are numbered behind. A file that a power cut has put back by some
  /// lines would else number others as those that it has forgotten, and the room would take them for repetitions.
  void go_on_behind(std::int64_t done);
  /// Everything begins anew under another name; what has waited is handed out, because it can never be sent any more.
  std::deque<Sent> begin_anew(const std::string& run);

 private:
  /// Lines that have no answer are never rewritten; without any, a file of this length begins anew [bytes].
  static constexpr std::int64_t kLongFile = 1 << 16;
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void read(const std::string& text);
  Result<void> write(const std::string& line);
  std::string first_line() const;
  void shorten();

  std::string run_, path_;
  std::unique_ptr<std::FILE, Close> file_;  // none: in memory alone
  std::int64_t last_id_ = 0, last_answered_ = 0, last_gesture_ = 0, length_ = 0;
  std::deque<Sent> waiting_;
};

}  // namespace bl::guest
