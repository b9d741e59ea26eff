// A ledger and a simulation, one after the other on one thread.
#include "core/session/session.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/graph/sums_of_now.h"

namespace bl {

Session::Session(const Registry& registry, const Scene& scene, int threads, double (*now)())
    : ledger_(registry, scene), simulation_(registry, threads, now) {
  simulation_.set_scene(ledger_.scene());
}

Result<std::unique_ptr<Session>> Session::start(const Registry& registry, const Scene& scene, const SavedState* state,
                                                int threads, double (*now)()) {
  std::unique_ptr<Session> session(new Session(registry, scene, threads, now));
  if (state != nullptr)
    if (auto restored = session->simulation_.restore_state(*state); !restored) return restored.error();
  return session;
}

std::shared_ptr<const State> Session::coming_state() const {
  const Ledger::Changes changes = ledger_.changes();
  return changes.is_logic_changed ? simulation_.with_scene(ledger_.scene(), changes.placed) : simulation_.state();
}

bool Session::tick() {
  const std::shared_ptr<const State> before = simulation_.state();
  // Taken only once they have really taken part: a replay meets the last state without them.
  if (const Ledger::Changes changes = ledger_.changes(); changes.is_logic_changed)
    simulation_.set_scene(ledger_.scene(), changes.placed);
  if (kept_ticks_.contains(before->tick)) kept_[before->tick] = simulation_.state();
  if (!simulation_.step()) {
    simulation_.put_back(before);
    return false;
  }
  (void)ledger_.take_changes();
  return true;
}

std::shared_ptr<const State> Session::look() {
  const std::shared_ptr<const State> shown = simulation_.shown(simulation_.state());
  if (shown->tick == 0 || !tick()) return shown;
  return std::make_shared<const State>(with_links_of(*shown, *simulation_.state()));
}

Result<void> Session::replay(const LogEntry& entry) {
  if (entry.restarts_from) return restart(entry);
  if (!entry.rewinds_to) return ledger_.replay(entry);
  const auto kept = kept_.find(*entry.rewinds_to);
  if (kept == kept_.end() || kept->first >= state()->tick)
    return Error{ErrorCode::not_found, "rewind", "the state of tick " + std::to_string(*entry.rewinds_to) + " is not kept"};
  if (auto done = ledger_.replay(entry); !done) return done;
  simulation_.return_to(kept->second);
  return {};
}

// The scene first, so that nothing of the state is lost on the way through a scene that has other nodes.
Result<void> Session::restart(const LogEntry& entry) {
  const auto kept = moments_.find(*entry.restarts_from);
  if (kept == moments_.end())
    return Error{ErrorCode::not_found, "restart", "the state of entry " + std::to_string(*entry.restarts_from) + " is not kept"};
  if (const std::string hash = hex_digits(kept->second->hash); !entry.state_hash.empty() && hash != entry.state_hash)
    return Error{ErrorCode::conflict, "restart",
                 "the state of entry " + std::to_string(*entry.restarts_from) + " has the hash " + hash +
                     ", and the entry names " + entry.state_hash};
  if (auto done = ledger_.replay(entry); !done) return done;
  const Ledger::Changes changes = ledger_.take_changes();
  if (changes.is_logic_changed) simulation_.set_scene(ledger_.scene(), changes.placed);
  simulation_.return_to(kept->second);
  return {};
}

Result<void> Session::rewind(std::int64_t tick, const Author& author) {
  LogEntry entry{.tick = state()->tick, .gesture = new_gesture()};
  entry.author = author;
  entry.rewinds_to = tick;
  return replay(entry);
}

namespace {

// Runs a session along a log, and compares its checks as the run comes to them. Between two rewinds they ascend.
class Replaying {
 public:
  Replaying(const LogFile& log, Session& session, ReplayReport& report) : log_(log), session_(session), report_(report) {
    std::set<std::int64_t> targets;
    for (const LogEntry& entry : log.entries) {
      if (entry.rewinds_to) targets.insert(*entry.rewinds_to);
      if (entry.restarts_from) moments_.insert(*entry.restarts_from);
    }
    session.keep_states(std::move(targets));
    begin_stretch(0);
  }

  Result<void> take(std::size_t index) {
    LogEntry entry = log_.entries[index];
    if (log_.hash_scheme != kHashScheme) entry.state_hash.clear();  // it says nothing about the states of this program
    run_to(entry.tick);
    if (auto done = session_.replay(entry); !done) return done.error().within("entry " + std::to_string(entry.seq));
    if (moments_.contains(entry.seq)) session_.keep_moment(entry.seq);
    if (entry.is_return()) begin_stretch(index + 1);
    ++report_.entries;
    return {};
  }

  void run_to(std::int64_t tick) {
    while (session_.state()->tick < tick) {
      session_.tick();
      compare();
    }
  }

 private:
  // The entries from here to the next rewind, and the checks among them.
  void begin_stretch(std::size_t first) {
    while (next_ < log_.checks.size() && log_.checks[next_].entries < first) ++next_;
    end_ = first;
    while (end_ < log_.entries.size() && !log_.entries[end_].is_return()) ++end_;
    compare();
  }

  void compare() {
    const State& state = *session_.state();
    for (; next_ < log_.checks.size() && log_.checks[next_].entries <= end_; ++next_) {
      const LogCheck& check = log_.checks[next_];
      if (check.tick > state.tick) return;
      if (check.tick < state.tick) continue;
      ++report_.checks;
      if (log_.hash_scheme != kHashScheme) ++report_.incomparable;
      else if (check.hash != hex_digits(state.hash) && !report_.first_mismatch) report_.first_mismatch = check;
    }
  }

  const LogFile& log_;
  Session& session_;
  ReplayReport& report_;
  std::set<std::int64_t> moments_;  // entries to which restarts go back
  std::size_t next_ = 0;            // check
  std::size_t end_ = 0;             // of the stretch: the rewind, or the end of the log
};

}  // namespace

Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads) {
  SceneReading reading = read_scene(log.scene, registry);
  if (!reading.is_usable()) return reading.first_error().within("scene");
  auto session = Session::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) return session.error();
  ReplayReport report;
  Replaying replaying(log, **session, report);
  for (std::size_t i = 0; i < log.entries.size(); ++i)
    if (auto taken = replaying.take(i); !taken) return taken.error();
  replaying.run_to(log.last_tick);
  report.ticks = (*session)->state()->tick;
  report.hash = hex_digits((*session)->state()->hash);
  return report;
}

}  // namespace bl
