// What a room does beside its ticks: it tries drafts, keeps the running states of scenarios, and goes back to them.
#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/serve/room_host.h"

namespace bl::serve {

namespace {

// Events for which it matters with which state the coming tick begins.
bool is_about_state(const room::Operation& operation) {
  if (operation.kind != room::OperationKind::event) return false;
  const auto content = operation.content.read();
  if (!content || !(**content).is_object()) return false;
  const Json event = (**content).value("event", Json());
  return event == "save_scenario" || event == "restart";
}

}  // namespace

void RoomHost::try_drafts() {
  std::map<std::int64_t, std::set<std::string>> looked_at;
  for (const auto& [key, visitor] : visitors_) looked_at[visitor.seat].insert(visitor.looks_at.begin(), visitor.looks_at.end());
  trials_.follow(*room_, looked_at, [this] { return session_->coming_state(); });
  is_changed_ = trials_.has_news() || is_changed_;
}

room::Answer RoomHost::ask(std::int64_t seat, const room::Operation& operation) {
  room::Answer answer;
  if (!is_about_state(operation)) {
    say([&](room::Now now) { answer = room_->submit(seat, operation, now); });
    follow_renewals();
    return answer;
  }
  session_->say_between_ticks([&](Ledger&, const std::shared_ptr<const State>& coming) -> std::shared_ptr<const State> {
    const auto known = room_->state().scenarios;
    answer = room_->submit(seat, operation, {coming->tick, options_.wall_time()});
    for (const auto& [id, scenario] : room_->state().scenarios) {
      if (known.contains(id)) continue;
      kept_[id] = coming;
      unstored_[id] = {scenario.seq, room_->scene(), coming};
    }
    const std::string back = room_->take_restart();
    if (back.empty()) return nullptr;
    last_hash_tick_ = kept_.at(back)->tick;
    begin_windows_anew();
    return kept_.at(back);
  });
  is_changed_ = true;
  return answer;
}

Result<std::shared_ptr<const State>> RoomHost::state_of(const journal::Snapshot& snapshot) {
  const auto text = journal::unpack(snapshot.scene);
  if (!text) return text.error();
  const SceneReading reading = read_scene(*text, full_registry());
  if (!reading.is_usable()) return reading.first_error();
  Simulation simulation(full_registry(), 1);
  simulation.set_scene(reading.scene);
  if (!reading.state) return Error{ErrorCode::missing, "state", "the snapshot has no running state"};
  if (auto restored = simulation.restore_state(*reading.state); !restored) return restored.error();
  return simulation.state();
}

// From memory, or from the file.
std::optional<room::KeptState> RoomHost::kept_state(const std::string& scenario) {
  if (const auto stored = stored_.find(scenario); stored != stored_.end() && !kept_.contains(scenario)) {
    auto state = state_of(stored->second);
    if (!state) return std::nullopt;
    kept_[scenario] = std::move(*state);
  }
  const auto kept = kept_.find(scenario);
  if (kept == kept_.end()) return std::nullopt;
  return room::KeptState{kept->second->tick, hex_digits(kept->second->hash)};
}

// After the entries that lead to them: a file never has a snapshot of what it does not know.
void RoomHost::store_scenarios() {
  for (auto one = unstored_.begin(); one != unstored_.end();) {
    if (one->second.seq > stored_seq_) {
      ++one;
      continue;
    }
    writer_->perform(
        [id = one->first, what = std::move(one->second), epoch = room_->state().epoch](journal::Journal& journal) {
          const SavedState saved = save(*what.state);
          const std::string text = write_scene(what.scene, full_registry(), &saved);
          return journal.add_snapshot(
              {.seq = what.seq, .tick = what.state->tick, .epoch = epoch, .hash = {}, .name = id, .scene = journal::pack(text)});
        },
        [](const Result<void>&) {});
    one = unstored_.erase(one);
  }
}

}  // namespace bl::serve
