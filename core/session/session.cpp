// A ledger and a simulation, one after the other on one thread.
#include "core/session/session.h"

#include <algorithm>

#include "core/base/text.h"

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
  if (!simulation_.step()) {
    simulation_.put_back(before);
    return false;
  }
  (void)ledger_.take_changes();
  return true;
}

namespace {

// Compares the checks of a log as the run comes to them; they ascend.
class Comparison {
 public:
  Comparison(const LogFile& log, ReplayReport& report) : checks_(log.checks), report_(report) {}

  void at(const State& state) {
    for (; next_ < checks_.size() && checks_[next_].tick <= state.tick; ++next_) {
      if (checks_[next_].tick < state.tick) continue;
      ++report_.checks;
      if (checks_[next_].hash != hex_digits(state.hash) && !report_.first_mismatch) report_.first_mismatch = checks_[next_];
    }
  }

 private:
  const std::vector<LogCheck>& checks_;
  ReplayReport& report_;
  std::size_t next_ = 0;
};

}  // namespace

Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads) {
  SceneReading reading = read_scene(log.scene, registry);
  if (!reading.is_usable()) return reading.first_error().within("scene");
  auto session = Session::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) return session.error();
  ReplayReport report;
  Comparison comparison(log, report);
  comparison.at(*(*session)->state());
  for (const LogEntry& entry : log.entries) {
    while ((*session)->state()->tick < entry.tick) {
      (*session)->tick();
      comparison.at(*(*session)->state());
    }
    if (auto done = (*session)->replay(entry); !done) return done.error().within("entry " + std::to_string(entry.seq));
    ++report.entries;
  }
  while ((*session)->state()->tick < log.last_tick) {
    (*session)->tick();
    comparison.at(*(*session)->state());
  }
  report.ticks = (*session)->state()->tick;
  report.hash = hex_digits((*session)->state()->hash);
  return report;
}

}  // namespace bl
