// Between the devices of a scene and its session: readings go into the log as the devices' own entries, values go out.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/live/connections.h"
#include "core/session/ledger.h"

namespace bl::host {

/// The shortest tick that a sensor of the scene stands for [s]; a twentieth of a second where there is none.
double tick_length(const Scene& scene, const Registry& registry);
/// Does a sensor of the scene play a recorded table?
bool has_recordings(const Scene& scene, const Registry& registry);

class DeviceDoor {
 public:
  explicit DeviceDoor(live::LiveOptions options) : connections_(std::move(options)) {}

  /// Starts, changes and ends connections where entries have come since the last call. Whether that was so.
  bool follow(const Scene& scene, std::int64_t last_seq);
  /// Hands over what has come for the tick after `tick`, and returns what was refused of it, each under its device.
  std::vector<Error> bring(std::int64_t tick, const std::function<Result<void>(Submission)>& submit);
  /// Sends what has changed since the last time.
  void send(const State& state) { connections_.send(state); }

  std::vector<live::ConnectionStatus> status() const { return connections_.status(); }
  bool is_empty() const { return connections_.is_empty(); }
  bool has_recordings() const { return connections_.has_recordings(); }

 private:
  live::Connections connections_;
  std::optional<std::int64_t> followed_;  // the last entry
};

}  // namespace bl::host
