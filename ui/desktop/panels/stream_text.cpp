// Ages of readings come from the state, those of sent messages from the window's clock.
#include "ui/desktop/panels/stream_text.h"

#include <cmath>

#include "core/reading/figures.h"
#include "core/reading/views/stream.h"

namespace bl::desktop {

namespace {

using reading::ActuatorFigures;
using reading::SensorFigures;

constexpr double kAgeSeconds = 1;  // an age that is written in seconds is another one then

// A unit that the program does not know stands behind the number as people have written it.
std::string value_text(double value, const std::string& unit) {
  const UnitInfo* known = find_unit(unit);
  if (known != nullptr) return reading::quantity(value, known->unit);
  return reading::readable(value) + (unit.empty() ? "" : " " + unit);
}

StreamText sensor_text(const SensorFigures& sensor) {
  StreamText stream;
  const std::string& quality = sensor.quality;
  stream.value = value_text(sensor.value, sensor.unit);
  stream.message = sensor.message;
  stream.age = quality == "never" ? "no reading yet" : sensor.age < 0.5 ? "just now" : age_text(sensor.age) + " old";
  if (quality == "stale" || quality == "invalid") stream.quality = quality;
  if (!sensor.connection.empty()) stream.quality += stream.quality.empty() ? "line lost" : ", line lost";
  stream.standing = stream.quality.ends_with("lost") || quality == "invalid" ? StreamStanding::lost
                    : quality == "stale"                                     ? StreamStanding::stale
                    : quality == "never"                                     ? StreamStanding::silent
                                                                             : StreamStanding::good;
  return stream;
}

StreamText actuator_text(const Workbench& editor, const State& state, std::uint32_t node, const ActuatorFigures& actuator,
                         const std::optional<Error>& error) {
  StreamText stream;
  stream.value = value_text(actuator.value, actuator.unit);
  const auto delivery = editor.deliveries.find(state.plan->nodes[node].id);
  if (error) {
    stream.standing = StreamStanding::lost;
    stream.quality = "not sent";
    stream.message = error->text();
  } else if (!actuator.is_on) {
    stream.age = "off";
  } else if (delivery == editor.deliveries.end()) {
    stream.age = "not connected";
  } else {
    const Delivery& one = delivery->second;
    const double since = editor.now - one.sent_at;
    stream.age = one.sent_at < 0 ? "not sent yet" : since < 0.5 ? "sent just now" : "sent " + age_text(since) + " ago";
    if (one.sent_at >= 0) editor.wake_at(editor.now + kAgeSeconds);
    stream.standing = one.sent_at < 0 ? StreamStanding::stale : StreamStanding::good;
    stream.message = one.problem;
    if (!one.problem.empty()) stream.standing = StreamStanding::lost, stream.quality = "line lost";
  }
  return stream;
}

}  // namespace

std::string StreamText::text() const {
  std::string all = value;
  for (const std::string* part : {&age, &quality})
    if (!part->empty()) all += (all.empty() ? "" : ", ") + *part;
  return all;
}

std::string age_text(double seconds) {
  constexpr double kMinute = 60, kHour = 3600, kWholeDay = 86400;
  const auto whole = [](double number) { return reading::grouped(std::floor(number)); };
  if (!(seconds >= 0)) return "0 s";
  if (seconds < 2 * kMinute) return whole(seconds) + " s";
  if (seconds < 2 * kHour) return whole(seconds / kMinute) + " min";
  if (seconds < 2 * kWholeDay) return whole(seconds / kHour) + " h";
  return whole(seconds / kWholeDay) + " days";
}

bool is_stream(const TypificationDefinition& type) {
  return reading::is_a<SensorFigures>(type) || reading::is_a<ActuatorFigures>(type);
}

std::optional<StreamText> stream_of(const Workbench& editor, const State& state, std::uint32_t node, std::size_t type) {
  if (node >= state.nodes.size() || type >= state.nodes[node].types.size()) return std::nullopt;
  const TypificationDefinition& definition = *state.plan->nodes[node].types[type].definition;
  if (reading::is_a<SensorFigures>(definition)) return sensor_text(*reading::row_of<SensorFigures>(state, node));
  if (!reading::is_a<ActuatorFigures>(definition)) return std::nullopt;
  return actuator_text(editor, state, node, *reading::row_of<ActuatorFigures>(state, node), state.nodes[node].types[type].error);
}

std::optional<StreamText> stream_of(const Workbench& editor, const State& state, std::uint32_t node) {
  if (node >= state.nodes.size()) return std::nullopt;
  for (std::size_t type = 0; type < state.nodes[node].types.size(); ++type)
    if (auto found = stream_of(editor, state, node, type)) return found;
  return std::nullopt;
}

ImU32 colour_of(const Theme& theme, StreamStanding standing) {
  const Colours& c = theme.colours();
  switch (standing) {
    case StreamStanding::good: return c.good;
    case StreamStanding::stale: return c.warning;
    case StreamStanding::lost: return c.bad;
    case StreamStanding::silent: return c.text_faint;
  }
  return c.text_faint;
}

void draw_standing(ImDrawList& list, const Theme& theme, ImVec2 middle, float radius, StreamStanding standing) {
  const ImU32 colour = colour_of(theme, standing);
  const float r = radius, line = std::max(1.2f, 0.4f * radius);
  if (standing == StreamStanding::good) {
    list.AddCircleFilled(middle, r, colour, 16);
  } else if (standing == StreamStanding::stale) {
    list.AddTriangleFilled({middle.x, middle.y - 1.15f * r}, {middle.x + 1.15f * r, middle.y + r},
                           {middle.x - 1.15f * r, middle.y + r}, colour);
  } else if (standing == StreamStanding::lost) {
    list.AddLine({middle.x - r, middle.y - r}, {middle.x + r, middle.y + r}, colour, line);
    list.AddLine({middle.x - r, middle.y + r}, {middle.x + r, middle.y - r}, colour, line);
  } else {
    list.AddCircle(middle, r, colour, 16, line);
  }
}

}  // namespace bl::desktop
