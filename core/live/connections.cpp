// Compares what the scene wants with what there is, and carries readings and messages between the two.
#include "core/live/connections.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "core/address/live_address.h"
#include "core/base/text.h"
#include "core/file/file_io.h"
#include "core/live/commands.h"
#include "core/live/recording.h"

namespace bl::live {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uintmax_t kLongestRecording = 64u << 20;  // [bytes]
constexpr double kOldest = 1e12;                         // [ticks] that a message can have waited
constexpr std::int64_t kNeverMeasured = -1;              // of a sensor that has no reading
constexpr std::string_view kPlainMessage = "{value}";    // the number alone

// Links of the file system are followed first, so that none of them leads out of the folder.
bool is_below(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code none;
  const auto whole = std::filesystem::weakly_canonical(file, none),
             top = std::filesystem::weakly_canonical(folder.empty() ? "." : folder, none);
  const auto [end, rest] = std::mismatch(top.begin(), top.end(), whole.begin(), whole.end());
  return end == top.end() || (end->empty() && std::next(end) == top.end());
}

Result<std::string> text_of_table(const LiveOptions& options, const address::LiveAddress& address) {
  const std::filesystem::path path = std::filesystem::path(options.folder) / address.path;
  if (!options.reads_anywhere && !is_below(options.folder, path))
    return Error{
        ErrorCode::io, "",
        "it does not lie in the folder of the scene: put it there, or run with --recordings-anywhere if you trust the scene"};
  return read_plain_file(path.string(), kLongestRecording);
}

Result<Recording> read_table(const LiveOptions& options, const address::LiveAddress& address) {
  const auto text = text_of_table(options, address);
  return text ? read_recording(*text, address) : Result<Recording>(text.error());
}

// Outputs of one address are one endpoint's, and so are inputs; MQTT has both on one connection.
std::string key_of(const address::LiveAddress& address, const std::string& node, bool is_sensor) {
  const std::string place = address.host + ":" + std::to_string(address.port);
  if (address.scheme == address::LiveAddress::Scheme::mqtt) return "mqtt " + place;
  if (address.scheme == address::LiveAddress::Scheme::osc) return (is_sensor ? "osc from " : "osc to ") + place;
  return "http " + node;
}

}  // namespace

struct Connections::Sensor {
  std::string address;                 // another one is another connection
  double period = 0, tick_length = 0;  // [s]

  address::LiveAddress parsed;
  std::shared_ptr<Station> station;
  std::string known_line;  // as the scene has it
  Recording recording;
  std::size_t next = 0;         // of the recording
  std::int64_t last_tick = -1;  // that was asked for
};

// A row that has come, and the tick that it belongs to.
struct RecordedArrival {
  Arrival arrival;
  std::int64_t tick = 0;
};

struct Connections::Actuator {
  std::string address;
  address::LiveAddress parsed;
  std::shared_ptr<Station> station;
  double interval = 0, change = 0;
  bool is_on = false, is_plain = false;
  std::optional<std::string> sent;  // the last message
  double sent_value = 0;
  Clock::time_point due{};
};

Connections::Connections(LiveOptions options) : options_(std::move(options)) {}

Connections::~Connections() {
  for (auto& [key, endpoint] : endpoints_) endpoint->ask_to_end();
}

void Connections::begin_recording(Sensor& sensor) {
  auto recording = read_table(options_, sensor.parsed);
  if (recording) sensor.recording = std::move(*recording);
  sensor.station->line(recording ? "" : "the recording cannot be played: " + recording.error().text());
}

bool Connections::follow_sensor(const std::string& id, const reading::SensorFigures& wanted) {
  const std::string &address = wanted.address, &known_line = wanted.connection;
  // What is wrong with an address, the sensor itself says.
  const auto parsed = address::parse_live_address(address);
  const bool is_wanted = parsed && (options_.opens_network || parsed->scheme == address::LiveAddress::Scheme::replay);
  if (!is_wanted) {
    // What a scene was saved with is of a connection that is no more.
    if (!known_line.empty()) forgotten_[id] = address;
    return sensors_.erase(id) > 0;
  }
  auto& slot = sensors_[id];
  const bool is_new = !slot || slot->address != address;
  if (is_new) {
    slot = std::make_unique<Sensor>();
    slot->address = address;
    slot->parsed = *parsed;
    slot->station = std::make_shared<Station>("");
    if (parsed->scheme == address::LiveAddress::Scheme::replay) begin_recording(*slot);
  }
  // What changes below leaves the connection alone.
  slot->station->set_field(wanted.field);
  const bool is_changed = is_new || slot->period != wanted.period;
  if (slot->tick_length != wanted.tick_length)
    slot->last_tick = std::numeric_limits<std::int64_t>::max();  // its rows lie elsewhere now
  slot->period = wanted.period;
  slot->tick_length = wanted.tick_length;
  slot->known_line = known_line;
  return is_changed;
}

bool Connections::follow_actuator(const std::string& id, const reading::ActuatorFigures& wanted) {
  const std::string& address = wanted.address;
  const auto parsed = address::parse_live_address(address);
  const bool is_wanted =
      options_.opens_network && parsed &&
      (parsed->scheme == address::LiveAddress::Scheme::mqtt || parsed->scheme == address::LiveAddress::Scheme::osc);
  if (!is_wanted) return actuators_.erase(id) > 0;
  auto& slot = actuators_[id];
  const bool is_new = !slot || slot->address != address;
  if (is_new) {
    slot = std::make_unique<Actuator>();
    slot->address = address;
    slot->parsed = *parsed;
    slot->station = std::make_shared<Station>("");
  }
  slot->interval = wanted.interval;
  slot->change = wanted.change;
  slot->is_on = wanted.is_on;
  slot->is_plain = wanted.format == kPlainMessage;
  return is_new;
}

void Connections::follow(const Scene& scene) {
  auto accesses = accesses_of(scene, options_.folder);
  bool is_changed = accesses != accesses_;
  accesses_ = std::move(accesses);
  forgotten_.clear();
  std::set<std::string> sensors, actuators;
  for (const auto& [id, node] : scene.nodes) {
    if (const auto sensor = reading::settings_of<reading::SensorFigures>(scene, full_registry(), node)) {
      sensors.insert(id);
      is_changed |= follow_sensor(id, *sensor);
    }
    if (const auto actuator = reading::settings_of<reading::ActuatorFigures>(scene, full_registry(), node)) {
      actuators.insert(id);
      is_changed |= follow_actuator(id, *actuator);
    }
  }
  is_changed |= std::erase_if(sensors_, [&](const auto& entry) { return !sensors.contains(entry.first); }) > 0;
  is_changed |= std::erase_if(actuators_, [&](const auto& entry) { return !actuators.contains(entry.first); }) > 0;
  follow_crowds(scene);
  if (is_changed) follow_endpoints();
}

void Connections::follow_crowds(const Scene& scene) {
  std::set<std::string> there;
  for (const auto& [id, node] : scene.nodes) {
    const auto wanted = reading::settings_of<reading::PeopleFigures>(scene, full_registry(), node);
    const auto parsed = wanted ? address::parse_live_address(wanted->address) : Result<address::LiveAddress>(Error{});
    if (!parsed || parsed->scheme != address::LiveAddress::Scheme::replay) continue;
    there.insert(id);
    Crowd& crowd = crowds_[id];
    const bool is_new = crowd.address != wanted->address;
    crowd.follow(id, *wanted, scene);
    if (!is_new) continue;
    const auto text = text_of_table(options_, *parsed);
    crowd.set_walk(text ? read_walk(*text, *parsed) : Result<std::vector<WalkStep>>(text.error()));
  }
  std::erase_if(crowds_, [&](const auto& one) { return !there.contains(one.first); });
}

void Connections::follow_endpoints() {
  struct Wanted {
    Endpoint::Body body = nullptr;
    address::LiveAddress address;
    std::vector<Subscriber> subscribers;
    Access access;
  };
  std::map<std::string, Wanted> wanted;
  for (const auto& [id, sensor] : sensors_) {
    const address::LiveAddress& address = sensor->parsed;
    if (address.scheme == address::LiveAddress::Scheme::replay) continue;
    Wanted& endpoint = wanted[key_of(address, id, true)];
    endpoint.address = address;
    endpoint.body = address.scheme == address::LiveAddress::Scheme::mqtt  ? run_mqtt
                    : address.scheme == address::LiveAddress::Scheme::osc ? run_osc_input
                                                                          : run_http;
    endpoint.subscribers.push_back({address.path, sensor->period, sensor->station});
  }
  for (const auto& [id, actuator] : actuators_) {
    const address::LiveAddress& address = actuator->parsed;
    Wanted& endpoint = wanted[key_of(address, id, false)];
    endpoint.address = address;
    endpoint.body = address.scheme == address::LiveAddress::Scheme::mqtt ? run_mqtt : run_osc_output;
  }
  for (auto& [key, endpoint] : wanted)
    if (endpoint.body == run_mqtt)
      if (const auto access = accesses_.find(endpoint.address.host + ":" + std::to_string(endpoint.address.port));
          access != accesses_.end())
        endpoint.access = access->second;
  const auto is_gone = [&](const auto& entry) {
    const auto found = wanted.find(entry.first);
    if (found == wanted.end() || found->second.access != entry.second->access()) return true;
    return entry.first.starts_with("http ") && found->second.subscribers.front().path != entry.second->subscribers().front().path;
  };
  for (const auto& entry : endpoints_)
    if (is_gone(entry)) entry.second->ask_to_end();
  std::erase_if(endpoints_, is_gone);
  // What waited at a connection that has been replaced is sent again by the new one.
  for (auto& [id, actuator] : actuators_)
    if (!endpoints_.contains(key_of(actuator->parsed, id, false))) actuator->sent.reset();
  for (auto& [key, endpoint] : wanted)
    if (const auto found = endpoints_.find(key); found != endpoints_.end()) {
      if (found->second->subscribers() != endpoint.subscribers) found->second->serve(std::move(endpoint.subscribers));
    } else {
      endpoints_[key] = std::make_unique<Endpoint>(endpoint.body, endpoint.address.host, endpoint.address.port,
                                                   std::move(endpoint.subscribers), options_.pauses, std::move(endpoint.access));
    }
}

bool Connections::has_recordings() const {
  const bool has_walks = std::any_of(crowds_.begin(), crowds_.end(), [](const auto& one) { return one.second.rows() > 0; });
  return has_walks || std::any_of(sensors_.begin(), sensors_.end(),
                                  [](const auto& entry) { return !entry.second->recording.readings.empty(); });
}

// The newest row up to the tick after `tick`. After the clock was set back, that is the row which holds there, once more.
std::optional<RecordedArrival> Connections::play(Sensor& sensor, std::int64_t tick) {
  const auto& rows = sensor.recording.readings;
  const auto tick_of_row = [&](const RecordedReading& row) { return tick_of(sensor.recording, row, sensor.tick_length); };
  if (tick < sensor.last_tick) {
    const auto later = std::partition_point(rows.begin(), rows.end(), [&](const auto& row) { return tick_of_row(row) <= tick; });
    sensor.next = static_cast<std::size_t>(later - rows.begin());
    if (sensor.next > 0) --sensor.next;
  }
  sensor.last_tick = tick;
  std::optional<RecordedArrival> newest;
  for (; sensor.next < rows.size() && tick_of_row(rows[sensor.next]) <= tick + 1; ++sensor.next) {
    const RecordedReading& row = rows[sensor.next];
    sensor.station->count(&Traffic::received);
    if (newest) sensor.station->count(&Traffic::skipped);
    newest = RecordedArrival{{row.value, row.problem, row.time, {}}, tick_of_row(row)};
  }
  return newest;
}

std::vector<Report> Connections::collect(std::int64_t tick) {
  std::vector<Report> reports;
  for (const auto& [id, address] : forgotten_)
    reports.push_back({{address, AuthorKind::device}, command<NoteConnection>({id, ""})});
  const Clock::time_point now = Clock::now();
  for (auto& [id, sensor] : sensors_) {
    const Station::Taken taken = sensor->station->collect();
    if (taken.line && *taken.line != sensor->known_line)
      reports.push_back({{sensor->address, AuthorKind::device}, command<NoteConnection>({id, *taken.line})});
    std::optional<Arrival> newest = taken.newest;
    std::int64_t measured = tick + 1;
    if (newest) {
      // A message that has waited, because the clock stood or was late, is as old as it is.
      const double waited = std::chrono::duration<double>(now - newest->came).count();
      measured -= static_cast<std::int64_t>(std::clamp(waited / sensor->tick_length, 0.0, kOldest));
      if (measured == kNeverMeasured) --measured;
    } else if (const auto row = play(*sensor, tick)) {
      newest = row->arrival;
      measured = row->tick;
    }
    if (newest)
      reports.push_back({{sensor->address, AuthorKind::device},
                         command<Receive>({id, newest->value, newest->time, newest->problem, measured})});
  }
  crowd_tick_ = tick;
  for (const auto& [id, crowd] : crowds_)
    if (auto step = crowd.step(tick)) reports.push_back({{crowd.address, AuthorKind::device}, std::move(*step)});
  return reports;
}

namespace {

// Does any link say, or has it last said, what a port should be?
bool is_steered(const State& state, PortRef port) {
  return std::any_of(state.links.begin(), state.links.end(), [port](const LinkState& link) {
    return std::any_of(link.voices.begin(), link.voices.end(), [port](const Voice& voice) { return voice.target == port; });
  });
}

}  // namespace

void Connections::send(const State& state) {
  const Clock::time_point now = Clock::now();
  for (auto& [id, actuator] : actuators_) {
    const std::uint32_t node = state.plan->node_index(id);
    if (!actuator->is_on || now < actuator->due || node == state.nodes.size()) continue;
    using reading::ActuatorFigures;
    const auto message = reading::port_of<&ActuatorFigures::message>(*state.plan, node),
               value = reading::port_of<&ActuatorFigures::value>(*state.plan, node);
    if (!message || !value) continue;
    // A default that nobody has chosen is no order to a machine.
    const bool is_set = state.plan->nodes[node].types[value->type].is_set[value->port];
    if (!is_set && !is_steered(state, *value)) continue;
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
    all.push_back({id, sensor->address, true, sensor->station->line(), sensor->station->traffic(),
                   sensor->parsed.scheme == address::LiveAddress::Scheme::replay, sensor->recording.readings.size(), sensor->next,
                   sensor->recording.empty, sensor->recording.filtered});
  for (const auto& [id, crowd] : crowds_)
    all.push_back({id, crowd.address, true, crowd.line, {}, true, crowd.rows(), crowd.played(crowd_tick_ + 1), 0, 0});
  for (const auto& [id, actuator] : actuators_)
    all.push_back({id, actuator->address, false, actuator->station->line(), actuator->station->traffic(), false, 0, 0, 0, 0});
  return all;
}

}  // namespace bl::live
