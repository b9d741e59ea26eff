// Sensors and actuators of a run: recordings are played, and with --live messages are received from and sent to the network.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "core/host/clock.h"
#include "core/host/device_door.h"
#include "core/session/session.h"

namespace bl::cli {

class LiveRun {
 public:
  /// `rate` in ticks per second; 0 for the pace that the sensors' tick lengths say.
  LiveRun(const std::string& scene_file, bool is_live, double rate, bool reads_anywhere = false,
          host::Clock& clock = host::real_clock());

  /// Gives the session the readings for its next tick.
  void before_tick(Session& session);
  /// Sends changed values, and reports changes of the connections.
  void after_tick(const Session& session);
  /// Live, waits until the next tick is due or the run is interrupted.
  void wait(const Session& session) { (void)wait_for_ticks(session, 1); }
  /// Live, is nothing connected, and would the next ticks only count on?
  bool can_rest(const Session& session) const { return is_live_ && devices_.is_empty() && session.is_idle(); }
  /// Where it can rest: waits for so many ticks, or until the run is interrupted, and counts those that have passed, at once.
  /// Returns how many.
  std::int64_t rest(Session& session, std::int64_t most);
  /// Reports the counts of every connection, and the readings of the sensors at the end.
  void sum_up(const State& state) const;

 private:
  std::int64_t wait_for_ticks(const Session& session, std::int64_t ticks);
  void tell();
  void tell_unusable(const Scene& scene);
  void tell_readings(const State& state);

  bool is_live_;
  double rate_;
  host::DeviceDoor devices_;
  std::map<std::string, std::string> told_;  // by sensor or actuator: the last sentence about its connection
  std::set<std::string> unusable_;           // sentences about sensors' addresses that were told
  std::map<std::string, std::string> read_;  // by node: the last sentence about its value
  host::Clock* clock_;
  double told_readings_;  // [s] on the clock
  host::Pace pace_;
  bool has_told_rest_ = false;
};

}  // namespace bl::cli
