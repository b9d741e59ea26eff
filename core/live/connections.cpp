// Compares what the scene wants with what there is, and carries readings and messages between the two.
#include "core/live/connections.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "core/base/live_address.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/live/port_values.h"
#include "core/live/recording.h"

namespace bl {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uintmax_t kLongestRecording = 64u << 20;  // [bytes]
constexpr const char *kSensor = "sensor", *kActuator = "actuator";

Result<Recording> read_table(const std::string& folder, const LiveAddress& address) {
  const std::filesystem::path path = std::filesystem::path(folder) / address.path;
  std::error_code none;
  if (std::filesystem::file_size(path, none) > kLongestRecording && !none)
    return Error{ErrorCode::io, "", "the table is longer than the 64 MiB that are read"};
  const auto text = read_file(path.string());
  if (!text) return text.error();
  return read_recording(*text, address);
}

// Outputs of one address are one endpoint's, and so are inputs; MQTT has both on one connection.
std::string key_of(const LiveAddress& address, const std::string& node, bool is_sensor) {
  const std::string place = address.host + ":" + std::to_string(address.port);
  if (address.scheme == LiveAddress::Scheme::mqtt) return "mqtt " + place;
  if (address.scheme == LiveAddress::Scheme::osc) return (is_sensor ? "osc from " : "osc to ") + place;
  return "http " + node;
}

}  // namespace

struct Connections::Sensor {
  // What the connection follows from; another one is another connection.
  std::string address, field;
  double period = 0, tick_length = 0;

  LiveAddress parsed;
  std::shared_ptr<Station> station;
  std::string known_line;  // as the scene has it
  Recording recording;
  std::size_t next = 0;  // of the recording

  bool is_like(const Sensor& other) const {
    return address == other.address && field == other.field && period == other.period && tick_length == other.tick_length;
  }
};

struct Connections::Actuator {
  std::string address;
  LiveAddress parsed;
  std::shared_ptr<Station> station;
  double interval = 1, change = 0;
  bool is_on = true, is_plain = true;
  std::optional<std::string> sent;  // the last message
  double sent_value = 0;
  Clock::time_point due{};
};

Connections::Connections(LiveOptions options) : options_(std::move(options)) {}

Connections::~Connections() {
  for (auto& [key, endpoint] : endpoints_) endpoint->ask_to_end();
}

void Connections::begin_recording(Sensor& sensor) {
  auto recording = read_table(options_.folder, sensor.parsed);
  if (recording) sensor.recording = std::move(*recording);
  sensor.station->line(recording ? "" : "the recording cannot be played: " + recording.error().text());
}

bool Connections::follow_sensor(const std::string& id, const PortValues& values) {
  auto sensor = std::make_unique<Sensor>();
  sensor->address = value_of<std::string>(values, "address", "");
  sensor->field = value_of<std::string>(values, "field", "");
  sensor->period = value_of(values, "period", 10.0);
  sensor->tick_length = value_of(values, "tick_length", 0.05);
  // What is wrong with an address, the sensor itself says.
  const auto parsed = parse_live_address(sensor->address);
  const bool is_wanted = parsed && (options_.opens_network || parsed->scheme == LiveAddress::Scheme::replay);
  if (!is_wanted) return sensors_.erase(id) > 0;
  auto& slot = sensors_[id];
  const bool is_new = !slot || !slot->is_like(*sensor);
  if (is_new) {
    sensor->parsed = *parsed;
    sensor->station = std::make_shared<Station>(sensor->field);
    if (parsed->scheme == LiveAddress::Scheme::replay) begin_recording(*sensor);
    slot = std::move(sensor);
  }
  slot->known_line = value_of<std::string>(values, "connection", "");
  return is_new;
}

bool Connections::follow_actuator(const std::string& id, const PortValues& values) {
  const std::string address = value_of<std::string>(values, "address", "");
  const auto parsed = parse_live_address(address);
  const bool is_wanted = options_.opens_network && parsed &&
                         (parsed->scheme == LiveAddress::Scheme::mqtt || parsed->scheme == LiveAddress::Scheme::osc);
  if (!is_wanted) return actuators_.erase(id) > 0;
  auto& slot = actuators_[id];
  const bool is_new = !slot || slot->address != address;
  if (is_new) {
    slot = std::make_unique<Actuator>();
    slot->address = address;
    slot->parsed = *parsed;
    slot->station = std::make_shared<Station>("");
  }
  slot->interval = value_of(values, "interval", 1.0);
  slot->change = value_of(values, "change", 0.0);
  slot->is_on = value_of(values, "is_on", true);
  slot->is_plain = value_of<std::string>(values, "format", "{value}") == "{value}";
  return is_new;
}

void Connections::follow(const Scene& scene) {
  auto accesses = accesses_of(scene, options_.folder);
  bool is_changed = accesses != accesses_;
  accesses_ = std::move(accesses);
  std::set<std::string> sensors, actuators;
  for (const auto& [id, node] : scene.nodes) {
    if (const PortValues* values = values_of(node, kSensor)) {
      sensors.insert(id);
      is_changed |= follow_sensor(id, *values);
    }
    if (const PortValues* values = values_of(node, kActuator)) {
      actuators.insert(id);
      is_changed |= follow_actuator(id, *values);
    }
  }
  is_changed |= std::erase_if(sensors_, [&](const auto& entry) { return !sensors.contains(entry.first); }) > 0;
  is_changed |= std::erase_if(actuators_, [&](const auto& entry) { return !actuators.contains(entry.first); }) > 0;
  if (is_changed) follow_endpoints();
}

void Connections::follow_endpoints() {
  struct Wanted {
    Endpoint::Body body = nullptr;
    LiveAddress address;
    std::vector<Subscriber> subscribers;
    Access access;
  };
  std::map<std::string, Wanted> wanted;
  for (const auto& [id, sensor] : sensors_) {
    const LiveAddress& address = sensor->parsed;
    if (address.scheme == LiveAddress::Scheme::replay) continue;
    Wanted& endpoint = wanted[key_of(address, id, true)];
    endpoint.address = address;
    endpoint.body = address.scheme == LiveAddress::Scheme::mqtt  ? run_mqtt
                    : address.scheme == LiveAddress::Scheme::osc ? run_osc_input
                                                                 : run_http;
    endpoint.subscribers.push_back({address.path, sensor->period, sensor->station});
  }
  for (const auto& [id, actuator] : actuators_) {
    const LiveAddress& address = actuator->parsed;
    Wanted& endpoint = wanted[key_of(address, id, false)];
    endpoint.address = address;
    endpoint.body = address.scheme == LiveAddress::Scheme::mqtt ? run_mqtt : run_osc_output;
  }
  for (auto& [key, endpoint] : wanted)
    if (endpoint.body == run_mqtt)
      if (const auto access = accesses_.find(endpoint.address.host + ":" + std::to_string(endpoint.address.port));
          access != accesses_.end())
        endpoint.access = access->second;
  const auto is_gone = [&](const auto& entry) {
    const auto found = wanted.find(entry.first);
    return found == wanted.end() || found->second.subscribers != entry.second->subscribers() ||
           found->second.access != entry.second->access();
  };
  for (const auto& entry : endpoints_)
    if (is_gone(entry)) entry.second->ask_to_end();
  std::erase_if(endpoints_, is_gone);
  // What waited at a connection that has been replaced is sent again by the new one.
  for (auto& [id, actuator] : actuators_)
    if (!endpoints_.contains(key_of(actuator->parsed, id, false))) actuator->sent.reset();
  for (auto& [key, endpoint] : wanted)
    if (!endpoints_.contains(key))
      endpoints_[key] = std::make_unique<Endpoint>(endpoint.body, endpoint.address.host, endpoint.address.port,
                                                   std::move(endpoint.subscribers), options_.pauses, std::move(endpoint.access));
}

std::vector<Report> Connections::take(std::int64_t tick) {
  std::vector<Report> reports;
  for (auto& [id, sensor] : sensors_) {
    const Station::Taken taken = sensor->station->take();
    if (taken.line && *taken.line != sensor->known_line)
      reports.push_back({sensor->address, command<NoteConnection>({id, *taken.line})});
    std::optional<Arrival> newest = taken.newest;
    std::int64_t measured = tick + 1;
    const auto& rows = sensor->recording.readings;
    for (bool is_first = true; sensor->next < rows.size(); ++sensor->next, is_first = false) {
      const RecordedReading& row = rows[sensor->next];
      const std::int64_t row_tick = tick_of(sensor->recording, row, sensor->tick_length);
      if (row_tick > tick + 1) break;
      newest = Arrival{row.value, row.problem, row.time};
      measured = row_tick;
      sensor->station->count(&Traffic::received);
      if (!is_first) sensor->station->count(&Traffic::skipped);
    }
    if (newest)
      reports.push_back({sensor->address, command<Receive>({id, newest->value, newest->time, newest->problem, measured})});
  }
  return reports;
}

void Connections::send(const State& state) {
  const Clock::time_point now = Clock::now();
  for (auto& [id, actuator] : actuators_) {
    const std::uint32_t node = state.plan->node_index(id);
    if (!actuator->is_on || now < actuator->due || node == state.nodes.size()) continue;
    const auto message = state.plan->find(node, {kActuator, "message", ""}),
               value = state.plan->find(node, {kActuator, "value", ""});
    if (!message || !value) continue;
    const TypeState& type = state.nodes[node].types[message->type];
    if (type.error || !type.is_evaluated) continue;
    const std::string& text = std::get<std::string>(type.values[message->port]);
    const double number = as_number(type.values[value->port]);
    if (actuator->sent == text || (actuator->sent && std::abs(number - actuator->sent_value) < actuator->change)) continue;
    const auto endpoint = endpoints_.find(key_of(actuator->parsed, id, false));
    if (endpoint == endpoints_.end()) continue;
    endpoint->second->send(
        {actuator->parsed.path, text, actuator->is_plain ? parse_number(text) : std::nullopt, actuator->station});
    actuator->sent = text;
    actuator->sent_value = number;
    actuator->due = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(actuator->interval));
  }
}

std::vector<ConnectionStatus> Connections::status() const {
  std::vector<ConnectionStatus> all;
  for (const auto& [id, sensor] : sensors_)
    all.push_back({id, sensor->address, true, sensor->station->line(), sensor->station->traffic()});
  for (const auto& [id, actuator] : actuators_)
    all.push_back({id, actuator->address, false, actuator->station->line(), actuator->station->traffic()});
  return all;
}

}  // namespace bl
