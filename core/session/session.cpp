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

bool Session::tick() {
  if (const Ledger::Changes changes = ledger_.take_changes(); changes.is_logic_changed)
    simulation_.set_scene(ledger_.scene(), changes.placed);
  return simulation_.step();
}

namespace {

// Compares all checks that stand at the tick now reached.
void compare(const LogFile& log, const State& state, ReplayReport& report) {
  for (const LogCheck& check : log.checks) {
    if (check.tick != state.tick) continue;
    ++report.checks;
    if (check.hash != hex_digits(state.hash) && !report.first_mismatch) report.first_mismatch = check;
  }
}

}  // namespace

Result<ReplayReport> replay(const LogFile& log, const Registry& registry, int threads) {
  SceneReading reading = read_scene(log.scene, registry);
  if (!reading.is_usable()) return reading.first_error().within("scene");
  auto session = Session::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) return session.error();
  ReplayReport report;
  compare(log, *(*session)->state(), report);
  std::int64_t last = (*session)->state()->tick;
  for (const LogEntry& entry : log.entries) last = std::max(last, entry.tick);
  for (const LogCheck& check : log.checks) last = std::max(last, check.tick);
  for (const LogEntry& entry : log.entries) {
    while ((*session)->state()->tick < entry.tick) {
      (*session)->tick();
      compare(log, *(*session)->state(), report);
    }
    if (auto done = (*session)->replay(entry); !done) return done.error().within("entry " + std::to_string(entry.seq));
    ++report.entries;
  }
  while ((*session)->state()->tick < last) {
    (*session)->tick();
    compare(log, *(*session)->state(), report);
  }
  report.ticks = (*session)->state()->tick;
  report.hash = hex_digits((*session)->state()->hash);
  return report;
}

}  // namespace bl
