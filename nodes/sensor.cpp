// A sensor: the last reading of a device, with its age and whether it can be relied on.
#include <algorithm>
#include <cmath>

#include "core/address/live_address.h"
#include "core/base/mathematics.h"
#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

constexpr std::int64_t kNever = -1;  // the tick of a reading that has not come

struct Sensor {
  enum class WhenStale { hold, fallback };
  enum class Quality { never, good, stale, invalid };
  // The last good value after the low-pass filter; a reading that is out of range must not change it.
  struct Memory {
    double held = 0;
    bool is_held = false;
  };
  struct In {
    std::string address, field, unit;
    double scale = 1, offset = 0;
    bool has_range = false;
    double lowest = 0, highest = 100, smoothing = 0, timeout = 60, tick_length = 0.05, period = 10;
    WhenStale when_stale = WhenStale::hold;
    double fallback = 0, reading = 0;
    std::string reading_time, reading_problem, connection;
    std::int64_t reading_tick = kNever;
    Memory last;
  };
  struct Out {
    double value = 0, age = 0;
    Quality quality = Quality::never;
    bool is_good = false;
    std::string message;
    Memory kept;
  };

  static void declare(TypificationBuilder<Sensor>& t) {
    t.reads_time().id("sensor").label("Sensor");
    t.doc(
        "The last reading of a device: by MQTT, OSC or HTTP while the scene runs live, or from a recorded CSV table. Readings "
        "are entries of the log, so that a replay gives the same result without the device.");
    t.in(&In::address, "address")
        .shown_first()
        .reaches_out()
        .doc(
            "Address of the readings: `mqtt://host:1883/topic`, `osc://9000/path`, `http://host/page`, or "
            "`replay:table.csv#column`, where `replay:table.csv?site=7&time=date+hour#count` takes the rows of site 7 only.");
    t.in(&In::field, "field")
        .doc(
            "The part of a message that holds the number: a name, a JSON pointer such as `/main/temp`, or the index of an OSC "
            "argument, from 0; empty where the whole message is a number.");
    t.in(&In::unit, "unit").doc("Unit of the scaled number as a symbol such as `m`, `cm` or `dB`; empty for a plain number.");
    t.in(&In::scale, "scale").doc("Factor that the received number is multiplied with.");
    t.in(&In::offset, "offset").doc("Number that is added afterwards, in the unit given.");
    t.in(&In::has_range, "has_range").doc("When on, readings outside the range are invalid.");
    t.in(&In::lowest, "lowest").unit_from("unit").doc("Lower end of the plausible range.");
    t.in(&In::highest, "highest").unit_from("unit").doc("Upper end of the plausible range.");
    t.in(&In::smoothing, "smoothing")
        .unit(Unit::second)
        .min(0)
        .soft(0, 600)
        .doc("Time constant of the low-pass filter, after which the value has followed 63 % of a step. 0: not filtered.");
    t.in(&In::timeout, "timeout")
        .unit(Unit::second)
        .min(0)
        .soft(0, 3600)
        .doc("Age beyond which readings are stale. 0: they never become stale.");
    t.in(&In::tick_length, "tick_length")
        .unit(Unit::second)
        .min(0.001)
        .soft(0.01, 3600)
        .doc("Duration of one tick. Live, it sets the pace; in a recording it assigns rows to ticks.");
    t.in(&In::period, "period").unit(Unit::second).min(0.1).soft(0.5, 600).doc("Time between two requests to an HTTP server.");
    t.in(&In::when_stale, "when_stale",
         {{WhenStale::hold, "hold", "The last good value stays."}, {WhenStale::fallback, "fallback", "The fallback is used."}})
        .doc("The value while there is no good reading.");
    t.in(&In::fallback, "fallback")
        .unit_from("unit")
        .doc("The value before the first reading. Where chosen, it is also the value while readings are stale.");
    t.in(&In::reading, "reading").doc("The last received number, not scaled.");
    t.in(&In::reading_time, "reading_time").doc("Time of the last reading, as a text.");
    t.in(&In::reading_problem, "reading_problem").doc("Why the last message holds no number; empty where it does.");
    t.in(&In::connection, "connection").doc("What is wrong with the connection; empty where no fault is known.");
    t.in(&In::reading_tick, "reading_tick")
        .min(-1e15)
        .doc("The tick of the last reading; -1 before the first one, and below it where it was measured before the clock began.");
    declare_results(t);
  }

  static void declare_results(TypificationBuilder<Sensor>& t) {
    t.out(&Out::value, "value").traced().unit_from("unit").doc("The last good reading, scaled and filtered, or the fallback.");
    t.out(&Out::age, "age").unit(Unit::second).doc("Time since the last reading; 0 before the first one.");
    t.out(&Out::quality, "quality",
          {{Quality::never, "never", "Nothing has come yet."},
           {Quality::good, "good", "The reading can be relied on."},
           {Quality::stale, "stale", "The reading is older than allowed."},
           {Quality::invalid, "invalid", "The last message is no number, or one outside the plausible range."}})
        .doc("Quality of the reading.");
    t.out(&Out::is_good, "is_good").doc("On where the quality is `good`.");
    t.out(&Out::message, "message").doc("What is wrong, as a sentence; empty where nothing is.");
    t.memory(&Out::kept, &In::last, &Memory::held, "held").unit_from("unit").doc("The last good value after the filter.");
    t.memory(&Out::kept, &In::last, &Memory::is_held, "is_held").doc("On after the first good reading.");
  }

  // With both ends weighted, numbers at the ends of what a double holds cannot overflow.
  static Memory filtered(const In& in, double value) {
    if (!in.last.is_held || !(in.smoothing > 0)) return {value, true};
    const double share = 1 - mathematics::exponential(-in.tick_length / in.smoothing);
    return {(1 - share) * in.last.held + share * value, true};
  }

  static std::string problem_of(const In& in, double value) {
    if (!in.address.empty())
      if (const auto address = address::parse_live_address(in.address); !address)
        return "the address cannot be used: " + address.error().message;
    if (!in.reading_problem.empty()) return in.reading_problem;
    if (in.reading_tick == kNever) return "";
    if (!std::isfinite(value)) return "the scaled reading is too large for a number";
    if (in.has_range && (value < in.lowest || value > in.highest))
      return "the reading " + shortest(value) + " lies outside " + shortest(in.lowest) + " to " + shortest(in.highest);
    return "";
  }

  static Result<Out> evaluate(const In& in, const Tick& tick) {
    Out out;
    const UnitInfo* unit = find_unit(in.unit);
    const double value = (in.reading * in.scale + in.offset) * (unit != nullptr ? unit->scale : 1);
    const std::string problem = problem_of(in, value);
    const bool has_reading = in.reading_tick != kNever;
    // After the clock was set back, readings may lie in its future: their age counts as 0.
    if (has_reading) out.age = static_cast<double>(std::max<std::int64_t>(0, tick.index - in.reading_tick)) * in.tick_length;
    const bool is_stale = has_reading && in.timeout > 0 && out.age > in.timeout;
    out.quality = !problem.empty() ? Quality::invalid : !has_reading ? Quality::never : is_stale ? Quality::stale : Quality::good;
    out.is_good = out.quality == Quality::good;
    out.message = problem;
    if (out.quality == Quality::never) out.message = "no reading has come yet";
    if (out.quality == Quality::stale) out.message = "the last reading is older than " + shortest(in.timeout) + " s";
    if (!in.connection.empty()) out.message += (out.message.empty() ? "" : "; ") + in.connection;
    out.kept = out.is_good ? filtered(in, value) : in.last;
    const bool falls_back = !out.kept.is_held || (!out.is_good && in.when_stale == WhenStale::fallback);
    out.value = falls_back ? in.fallback : out.kept.held;
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(sensor, Sensor)
