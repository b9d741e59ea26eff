// Connects the devices of a scene with its session: readings become log entries of the devices, and values are sent out.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/live/connections.h"
#include "core/session/ledger.h"

namespace bl::host {

/// The shortest tick length of the scene's sensors [s]; a twentieth of a second where there is none.
double tick_length(const Scene& scene, const Registry& registry);
/// Does a sensor of the scene play a recorded table?
bool has_recordings(const Scene& scene, const Registry& registry);

class DeviceDoor {
 public:
  explicit DeviceDoor(live::LiveOptions options) : connections_(std::move(options)) {}

  /// Starts, changes and ends connections if there are new entries since the last call. Returns whether there were any.
  bool follow(const Scene& scene, std::int64_t last_seq);
  /// Submits the readings for the tick after `tick`, and returns the refused ones, each under its device.
  std::vector<Error> bring(std::int64_t tick, const std::function<Result<void>(Submission)>& submit);
  /// Sends the values that have changed since the last call.
  void send(const State& state) { connections_.send(state); }

  std::vector<live::ConnectionStatus> status() const { return connections_.status(); }
  bool is_empty() const { return connections_.is_empty(); }
  bool has_recordings() const { return connections_.has_recordings(); }

 private:
  live::Connections connections_;
  std::optional<std::int64_t> followed_;  // the last entry
};

}  // namespace bl::host
