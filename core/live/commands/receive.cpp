// Gives a sensor a reading, or the reason why a message holds none.
#include "core/live/commands.h"
#include "core/session/support.h"

namespace bl::live {

namespace {

constexpr std::size_t kLongestText = 500;

}  // namespace

void Receive::declare(CommandBuilder<Receive>& c) {
  c.id("receive").label("Receive").doc(
      "Gives a sensor a reading. Devices and people can submit it. It is part of the log, so that a replay needs no device.");
  c.argument(&In::node, "node").required().doc("Id of the sensor.");
  c.argument(&In::value, "value").doc("The received number, before scale and offset.");
  c.argument(&In::time, "time").doc("Time of the measurement or its arrival, as a text for people.");
  c.argument(&In::problem, "problem")
      .doc("Why the message holds no number, as a sentence. The last reading then stays, and its age grows.");
  c.argument(&In::tick, "tick")
      .min(-1e15)
      .doc("The tick of the measurement, from which its age counts. -1: no measurement; below -1: before the clock began.");
  c.argument(&In::whole, "whole").doc("When on, all arguments are stored unchanged, as an undo needs it.");
}

Inverse Receive::apply(SceneEdit& edit, const In& in) {
  const std::string place = "nodes/" + in.node + "/sensor/";
  for (const auto& [name, text] : {std::pair{"time", &in.time}, {"problem", &in.problem}})
    if (text->size() > kLongestText)
      return Error{ErrorCode::out_of_range, place + name, "is longer than " + std::to_string(kLongestText) + " characters"};
  const auto value = find_setting(edit, in.node, {"sensor.reading"});
  if (!value) return value.error();
  const TypificationDefinition& type = *value->type;
  const auto now = [&](const char* port) { return set_value(edit.scene(), *value->node, type, *type.find_port(port)); };
  const auto put = [&](const char* port, const Value& content) {
    edit.set_value(in.node, type.id, *type.find_port(port), content);
  };
  const std::vector inverse{
      command<Receive>({in.node, as_number(now("reading")), std::get<std::string>(now("reading_time")),
                        std::get<std::string>(now("reading_problem")), std::get<std::int64_t>(now("reading_tick")), true})};
  put("reading_problem", in.problem);
  if (in.problem.empty() || in.whole) {
    put("reading", in.value);
    put("reading_time", in.time);
    put("reading_tick", in.tick);
  }
  return inverse;
}

}  // namespace bl::live

BL_COMMAND(receive, live::Receive)
