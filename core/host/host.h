// A running scene with its journal on the disk and the history of its holder's steps.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/host/history.h"
#include "core/host/journal.h"
#include "core/host/live_session.h"
#include "core/host/running.h"

namespace bl::host {

class Host final : public Running {
 public:
  /// The scene must be usable. Each entry goes to the journal from begin_journal() on.
  static Result<std::unique_ptr<Host>> start(const Registry& registry, const Scene& scene, const SavedState* state,
                                             LiveSessionOptions options);

  LiveSession& session() { return *session_; }
  const LiveSession& session() const { return *session_; }
  // As Running has them.
  const Scene& scene() const override { return session_->scene(); }
  const std::vector<LogEntry>& log() const override { return session_->log(); }
  const std::vector<HistoryStep>& history() const override { return history_.steps(); }
  std::int64_t last_step() const override { return history_.last_step(); }
  std::int64_t new_gesture() override { return session_->new_gesture(); }
  Result<void> submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "") override;
  Result<void> show(const std::vector<Command>& commands, std::int64_t gesture) override;
  Result<void> end_gesture(std::int64_t gesture) override { return session_->end_gesture(gesture); }
  void abandon(std::int64_t gesture) override { session_->abandon(gesture); }
  Result<TakenBack> undo() override { return session_->undo(); }
  Result<TakenBack> redo() override { return session_->redo(); }
  Result<void> keep_up() override { return session_->keep_up(); }
  bool has_waiting_values() const override { return session_->has_waiting_values(); }
  std::shared_ptr<const Moment> moment() const override { return session_->moment(); }
  std::size_t subscribe_moments(std::function<void(const std::shared_ptr<const Moment>&)> listener) override {
    return session_->subscribe_moments(std::move(listener));
  }
  void unsubscribe_moments(std::size_t number) override { session_->unsubscribe_moments(number); }
  bool has_news() const override { return session_->unserved_tick().has_value(); }
  std::string why_no_clock() const override { return {}; }
  void play(bool is_playing) override { session_->play(is_playing); }
  void set_rate(double ticks_per_second) override { session_->set_rate(ticks_per_second); }
  void step(int ticks) override { session_->step(ticks); }
  bool can_rewind() const override;
  void rewind(std::int64_t ticks) override { session_->rewind(ticks); }
  void let_rest(bool may_rest) override { session_->let_rest(may_rest); }
  void watch_times(bool is_watched) override { session_->watch_times(is_watched); }
  std::shared_ptr<const State> coming_state() override { return session_->coming_state(); }

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
