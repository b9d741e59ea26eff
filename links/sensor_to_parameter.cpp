// Carries the reading of a sensor to a number of other nodes, as long as the reading is good.
#include <cmath>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct SensorToParameter {
  enum class WhenStale { hold, fallback };
  struct In {
    PortChoice source{"sensor.value"}, target{"smart_volume.demand"};
    bool rescale = false;
    double gain = 1, base = 0, max_age = 0;
    WhenStale when_stale = WhenStale::hold;
    double fallback = 0;
  };
  struct Ends {
    double value = 0, age = 0;
    bool is_good = false;
    std::string message, id;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<SensorToParameter>& l) {
    l.id("sensor_to_parameter").label("Sensor to parameter");
    l.doc(
        "Carries the reading of a sensor to any number that links may change. A stale or invalid reading changes nothing by "
        "itself: the last proposal stays in force, and the link shows why.");
    l.family(LinkFamily::data);
    l.param(&In::source, "source").doc("The port of the sensor that is read, written `typification.port`.");
    l.param(&In::target, "target").doc("The port that the number is proposed to, written `typification.port`.");
    l.param(&In::rescale, "rescale").doc("When on, the target gets `base + gain x reading`; its unit may then be another one.");
    l.param(&In::gain, "gain").doc("The factor that the reading is multiplied with; used with rescale only.");
    l.param(&In::base, "base")
        .unit_from("target")
        .doc("The value that the target gets for a reading of 0; used with rescale only.");
    l.param(&In::max_age, "max_age")
        .unit(Unit::second)
        .min(0)
        .soft(0, 3600)
        .doc(
            "The greatest age of a reading that counts here, even where the sensor allows older ones. 0: the sensor's own "
            "limit.");
    l.param(&In::when_stale, "when_stale",
            {{WhenStale::hold, "hold", "The last proposal stays in force, and the link shows why."},
             {WhenStale::fallback, "fallback", "The fallback is proposed."}})
        .doc("What the link does while there is no good reading.");
    l.param(&In::fallback, "fallback").unit_from("target").doc("The value that is proposed instead, where `fallback` is chosen.");
    l.reads_chosen(&Ends::value, End::from, "source");
    l.reads(&Ends::age, End::from, "sensor.age", Unit::second);
    l.reads(&Ends::is_good, End::from, "sensor.is_good");
    l.reads(&Ends::message, End::from, "sensor.message");
    l.reads(&Ends::id, End::from, "node.id");
    l.proposes_chosen(&Out::value, End::to, "target");
    l.same_units("source", "target", "rescale");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const bool is_too_old = in.max_age > 0 && ends.age > in.max_age;
    if (!ends.is_good || is_too_old) {
      if (in.when_stale == WhenStale::fallback) return Out{in.fallback};
      const std::string reason = !ends.is_good ? ends.message : "the last reading is older than " + shortest(in.max_age) + " s";
      return Error{ErrorCode::missing, "",
                   "the sensor `" + ends.id + "` has no good reading: " + reason + ". What was proposed last stays in force"};
    }
    const double value = in.rescale ? in.base + in.gain * ends.value : ends.value;
    if (!std::isfinite(value))
      return Error{ErrorCode::not_finite, "gain", "the rescaled reading is too large; make the gain smaller"};
    return Out{value};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(sensor_to_parameter, SensorToParameter)
