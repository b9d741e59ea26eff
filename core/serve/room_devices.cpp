// Sensors and actuators of a room: readings are entries of the log, stored before anything is sent out that follows from them.
#include <nlohmann/json.hpp>

#include "core/serve/room_host.h"

namespace bl::serve {

// Before the first tick as well, or recordings would begin in the middle.
void RoomHost::follow_devices() {
  if (!options_.live) return;
  if (!devices_) devices_ = std::make_unique<host::DeviceDoor>(*options_.live);
  if (devices_->follow(session_->said(), session_->last_seq()) && devices_->has_recordings() != session_->do_ticks_wait())
    session_->make_ticks_wait(devices_->has_recordings());
}

void RoomHost::serve_devices() {
  follow_devices();
  if (!devices_ || devices_->is_empty()) return;
  bring_readings();
  flush();
  // A machine does not act on what could still be lost.
  if (stored_seq_ == session_->last_seq() && commits_under_way_ == 0) devices_->send(*session_->moment()->state);
}

// Once for each tick, and none while the clock stands. Where recordings are played, the next tick waits for it.
void RoomHost::bring_readings() {
  std::int64_t tick = session_->moment()->ticked->tick;
  if (session_->do_ticks_wait()) {
    const auto unserved = session_->unserved_tick();
    if (!unserved) return;
    tick = *unserved;
  } else if (!session_->moment()->is_playing || tick == brought_) {
    return;
  }
  brought_ = tick;
  const std::vector<Error> refused = devices_->bring(tick, [this](Submission reading) {
    Result<void> done;
    say([&](room::Now now) { done = room_->submit_device(reading, now); });
    return done;
  });
  session_->serve(tick);
  const std::string trouble = refused.empty() ? std::string() : refused.front().text();
  if (trouble.empty() || trouble == std::exchange(device_trouble_, trouble)) return;
  const auto notice =
      std::make_shared<const std::string>(wire::write_message(wire::Say{"device", JsonValue::of({{"why", trouble}})}));
  for (auto& [key, visitor] : visitors_)
    if (const room::Seat* seat = room_->state().seat(visitor.seat); seat != nullptr && seat->role == Role::facilitator)
      visitor.guest->send(notice);
  return;
}

}  // namespace bl::serve
