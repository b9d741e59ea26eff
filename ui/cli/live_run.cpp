// Keeps a run and its connections in step, and reports them to people.
#include "ui/cli/live_run.h"

#include <filesystem>
#include <utility>

#include "core/base/text.h"
#include "core/live/unusable_sensors.h"
#include "core/reading/views/stream.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

constexpr double kBetweenReadings = 1;  // [s]

std::string call(const live::ConnectionStatus& status) { return (status.is_sensor ? "sensor " : "actuator ") + status.node; }

// "3.2 m, good", or why not.
std::string reading_of(const State& state, const std::string& node) {
  const std::uint32_t index = state.plan->node_index(node);
  if (index >= state.nodes.size()) return "it is no longer in the scene";
  const auto sensor = reading::row_of<reading::SensorFigures>(state, index).value_or(reading::SensorFigures{});
  return shortest(sensor.value) + (sensor.unit.empty() ? "" : " " + sensor.unit) + ", " + sensor.quality +
         (sensor.message.empty() ? "" : " (" + sensor.message + ")");
}

// Rows that were not played are told of, since a scene may settle before a recording ends.
std::string rows_of(const live::ConnectionStatus& status) {
  std::string text = "; " + std::to_string(status.played) + " of " + std::to_string(status.rows) + " rows played";
  if (status.played < status.rows) text += ", " + std::to_string(status.rows - status.played) + " come after the end of the run";
  if (status.empty > 0) text += ", besides " + std::to_string(status.empty) + " without a reading";
  if (status.filtered > 0) text += (status.empty > 0 ? " and " : ", besides ") + std::to_string(status.filtered) + " of others";
  return text;
}

}  // namespace

LiveRun::LiveRun(const std::string& scene_file, bool is_live, double rate, bool reads_anywhere, host::Clock& clock)
    : is_live_(is_live),
      rate_(rate),
      devices_({std::filesystem::path(scene_file).parent_path().string(), is_live, {}, reads_anywhere}),
      clock_(&clock),
      told_readings_(clock.now() - kBetweenReadings),
      pace_(clock) {}

void LiveRun::before_tick(Session& session) {
  devices_.follow(session.scene(), session.ledger().last_seq());
  if (is_live_) tell_unusable(session.scene());
  for (const Error& refused :
       devices_.bring(session.state()->tick, [&](Submission said) { return session.submit(std::move(said)); }))
    print_error("", refused);
}

// Once for each fault: an address may be set while the scene runs.
void LiveRun::tell_unusable(const Scene& scene) {
  for (const Error& error : live::unusable_sensors(scene))
    if (unusable_.insert(error.text()).second) print_error("", error);
}

void LiveRun::after_tick(const Session& session) {
  if (devices_.is_empty()) return;
  devices_.send(*session.state());
  tell();
  if (is_live_ && clock_->now() >= told_readings_ + kBetweenReadings) tell_readings(*session.state());
}

// Only what is new: a sensor that stands still needs no lines.
void LiveRun::tell_readings(const State& state) {
  told_readings_ = clock_->now();
  for (const live::ConnectionStatus& status : devices_.status()) {
    if (!status.is_sensor) continue;
    const std::string reading = reading_of(state, status.node);
    std::string& last = read_[status.node];
    if (last != reading) print_line(call(status) + ": " + reading);
    last = reading;
  }
}

void LiveRun::tell() {
  for (const live::ConnectionStatus& status : devices_.status()) {
    std::string& told = told_[call(status)];
    if (told == status.line) continue;
    told = status.line;
    print_error(call(status), {ErrorCode::io, status.address, status.line.empty() ? "is connected" : status.line});
  }
}

std::int64_t LiveRun::wait_for_ticks(const Session& session, std::int64_t ticks) {
  if (!is_live_) return 0;
  return pace_.wait(rate_ > 0 ? 1 / rate_ : host::tick_length(session.scene(), full_registry()), is_interrupted, ticks);
}

std::int64_t LiveRun::rest(Session& session, std::int64_t most) {
  if (!can_rest(session)) return 0;
  if (!std::exchange(has_told_rest_, true))
    print_line("at rest since tick " + std::to_string(session.state()->tick) + "; the clock counts on");
  const std::int64_t passed = wait_for_ticks(session, most);
  session.pass(passed);
  return passed;
}

void LiveRun::sum_up(const State& state) const {
  for (const live::ConnectionStatus& status : devices_.status()) {
    const live::Traffic& t = status.traffic;
    std::string text = call(status) + ": ";
    if (status.is_sensor)
      text += counted(static_cast<std::size_t>(t.received), "message") + ", " + std::to_string(t.skipped) + " of them skipped" +
              (status.is_recording && status.rows > 0 ? rows_of(status) : "") + "; at the end " + reading_of(state, status.node);
    else
      text += counted(static_cast<std::size_t>(t.sent), "message") + " sent, " + std::to_string(t.acknowledged) +
              " acknowledged, " + std::to_string(t.replaced) + " replaced by newer ones";
    print_line(text);
  }
}

}  // namespace bl::cli
