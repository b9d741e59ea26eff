// The connections of a scene: readings of its sensors become commands, and values of its actuators are sent.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/graph/scene.h"
#include "core/graph/state.h"
#include "core/live/crowd.h"
#include "core/live/endpoint.h"
#include "core/reading/views/stream.h"
#include "core/session/author.h"
#include "core/session/commands.h"

namespace bl::live {

struct LiveOptions {
  std::string folder;         ///< recordings with relative paths stand here; empty: where the program was started
  bool opens_network = true;  ///< off: recordings are played, and no connection is made
  Pauses pauses;
  /// Off: recordings must lie in the folder or below it. Otherwise a scene of somebody else could read any file of the computer
  /// and send it by an actuator.
  bool reads_anywhere = false;
};

/// A command and who gives it: a device, under its address.
struct Report {
  Author author;
  Command command;
};

/// The status of one sensor or actuator.
struct ConnectionStatus {
  std::string node, address;
  bool is_sensor = true;
  std::string line;  ///< what is wrong with the connection; empty where nothing is
  Traffic traffic;
  // Of recordings: how many of its rows have been played, and what became of the others.
  bool is_recording = false;
  std::size_t rows = 0, played = 0, empty = 0, filtered = 0;
};

struct RecordedArrival;

/// All of it is for one thread, the owner's; the connections have threads of their own. Nothing of the network reaches a state
/// but through the commands of collect().
class Connections {
 public:
  explicit Connections(LiveOptions options);
  ~Connections();
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  /// Starts, changes and ends connections as the sensors and actuators of the scene want it.
  void follow(const Scene& scene);
  /// The readings for the tick after `tick`: at most one for each sensor, in ascending node id. If the clock was set back,
  /// recordings go back with it.
  std::vector<Report> collect(std::int64_t tick);
  /// Sends the values that have changed since the last call, where the interval of the actuator allows.
  void send(const State& state);
  /// In ascending node id, sensors before actuators.
  std::vector<ConnectionStatus> status() const;
  bool is_empty() const { return sensors_.empty() && actuators_.empty() && crowds_.empty(); }
  bool has_recordings() const;

 private:
  struct Sensor;
  struct Actuator;
  // Whether something has changed that a connection follows from.
  bool follow_sensor(const std::string& id, const reading::SensorFigures& wanted);
  bool follow_actuator(const std::string& id, const reading::ActuatorFigures& wanted);
  void follow_endpoints();
  void follow_crowds(const Scene& scene);
  void begin_recording(Sensor& sensor);
  static std::optional<RecordedArrival> play(Sensor& sensor, std::int64_t tick);

  const LiveOptions options_;
  std::map<std::string, std::unique_ptr<Sensor>> sensors_;      // by node
  std::map<std::string, std::unique_ptr<Actuator>> actuators_;  // by node
  std::int64_t crowd_tick_ = -1;                                // the last one that was asked for
  std::map<std::string, Crowd> crowds_;                         // by node
  std::map<std::string, std::string> forgotten_;                // by node: addresses of sensors whose last line is out of date
  std::map<std::string, Access> accesses_;                      // of brokers, by host and port
  std::map<std::string, std::unique_ptr<Endpoint>> endpoints_;  // by what they connect to
};

}  // namespace bl::live
