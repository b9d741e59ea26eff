// A draft that the holder of a window works in: the room's scene with the draft's steps, and ticks of its own beside the room's.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/define/payload.h"
#include "core/guest/fold.h"
#include "core/guest/follower.h"

namespace bl::guest {

class DraftWork {
 public:
  /// `run`: under which what is said here is counted.
  DraftWork(const Registry& registry, std::string run, std::string id, std::string title);

  const std::string& id() const { return id_; }
  const std::string& title() const { return title_; }
  /// The scene of the room with the steps; and on top of it what has no answer yet, and the gesture under way.
  Fold& fold() { return fold_; }
  const Fold& fold() const { return fold_; }
  /// Steps of it, also those without an answer.
  std::size_t step_count() const;
  /// Everything that its steps and gestures have set to a place.
  Fold::Placed placed() const;

  /// The room's scene after the entry `seq`, and what its view `draft_steps` says; null where it has said nothing on this
  /// connection yet. Steps that do not fit are left out, as the room does.
  void follow(const Scene& head, std::int64_t seq, const std::map<std::string, JsonValue>* view);
  /// What others have moved in the room's scene: the ticks are to put it to its place once.
  void note_moved(Fold::Placed placed) { moved_.merge(std::move(placed)); }
  /// A step that is said; an error where it does not fit what is shown. And one that could not be said.
  Result<void> say(std::int64_t operation, Command command);
  void unsay(std::int64_t operation);
  /// Is it among those that were said here, or has the room's view taken it into account?
  bool has(std::int64_t operation) const { return operation <= taken_ || own_.contains(operation); }
  /// The operation was answered; `is_stored`: it is a step now. Answers may come in any order. False where it is none of this
  /// draft, or where the room's view has told already what became of it.
  bool answered(std::int64_t operation, bool is_stored);
  /// The room has taken the last step before this operation back.
  void took_back(std::int64_t operation);

  /// Begins ticks of its own; `wake` is called on their thread after each.
  void begin_ticks(const State& state, int threads, host::Clock& clock, std::function<void()> wake);
  void end_ticks() { ticks_.reset(); }
  bool has_ticks() const { return ticks_ != nullptr; }
  Follower* ticks() const { return ticks_.get(); }
  /// Ticks as fast as the room does. When the next one is due [s].
  double keep_ticking(double now, double rate, bool is_playing);
  /// Lets the ticks know what has changed.
  void show();

 private:
  struct Step {
    JsonValue content;  ///< the command as the room writes it
    Command command;
    Fold::Placed placed = {};
    bool is_stored = false, is_taken_back = false;  ///< of an own one
  };
  void follow_steps(const std::map<std::string, JsonValue>& view);
  void make_base();

  const Registry* registry_;
  std::string run_, id_, title_;
  Fold fold_;
  Scene head_;
  std::int64_t seq_ = 0, taken_ = 0;    // the last entry of the room, and the last operation of the run, that are in the base
  std::map<std::int64_t, Step> steps_;  // that the room has told, by number
  std::map<std::int64_t, Step> own_;    // that were said here and are not told yet, by operation; some have an answer
  Fold::Placed moved_;                  // what the ticks are to put to its place once
  std::unique_ptr<Follower> ticks_;
  std::int64_t marked_ = 0;
  double due_ = 0;
};

}  // namespace bl::guest
