// An open scene that runs, as a window sees it: here, or in a room of a server.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/host/history.h"
#include "core/host/live_session.h"

namespace bl::host {

/// All of it belongs to the holder's thread.
class Running {
 public:
  virtual ~Running() = default;

  // The scene, and the ways to change it.
  /// The scene as its holder sees it: with gestures in progress, and in a room with what nobody has answered yet. A returned
  /// scene can be read until keep_up() is called.
  virtual const Scene& scene() const = 0;
  /// It grows with each change of scene(); it begins anew, shorter, where everything may have changed.
  virtual const std::vector<LogEntry>& log() const = 0;
  virtual const std::vector<HistoryStep>& history() const = 0;
  /// The gesture of the holder's last step, which can still be extended; 0 where there is none.
  virtual std::int64_t last_step() const = 0;
  virtual std::int64_t new_gesture() = 0;
  /// Submits commands of the holder as one step; several become one batch. `label`: the name of the step, where its commands
  /// alone do not say what was meant.
  virtual Result<void> submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "") = 0;
  /// The same, as one frame of a gesture: it is shown at once, and said at most ten times a second.
  virtual Result<void> show(const std::vector<Command>& commands, std::int64_t gesture) = 0;
  virtual Result<void> end_gesture(std::int64_t gesture) = 0;
  /// Undoes the holder's gesture in progress for good.
  virtual void abandon(std::int64_t gesture) = 0;
  virtual Result<TakenBack> undo() = 0;
  virtual Result<TakenBack> redo() = 0;
  /// Says what is due, and hears what has come. Call it often, such as at the beginning of each frame of a window.
  virtual Result<void> keep_up() = 0;
  /// Will keep_up() have values of gestures to say?
  virtual bool has_waiting_values() const = 0;

  // The clock.
  virtual std::shared_ptr<const Moment> moment() const = 0;
  /// As LiveSession's: the listener is called on any thread, must return soon, and must not call back.
  virtual std::size_t subscribe_moments(std::function<void(const std::shared_ptr<const Moment>&)> listener) = 0;
  virtual void unsubscribe_moments(std::size_t number) = 0;
  /// Is there something that keep_up() will hear, or a tick that waits for its devices?
  virtual bool has_news() const = 0;
  /// Why the holder may not set the clock; empty where they may.
  virtual std::string why_no_clock() const = 0;
  virtual void play(bool is_playing) = 0;
  virtual void set_rate(double ticks_per_second) = 0;
  virtual void step(int ticks) = 0;
  virtual bool can_rewind() const = 0;
  virtual void rewind(std::int64_t ticks) = 0;
  virtual void let_rest(bool may_rest) = 0;
  virtual void watch_times(bool is_watched) = 0;
  /// The state with which the next tick will begin. It belongs to `scene()`, where nothing of that waits for an answer.
  virtual std::shared_ptr<const State> coming_state() = 0;
};

}  // namespace bl::host
