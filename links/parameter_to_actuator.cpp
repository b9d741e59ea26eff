// Carries a number of the scene to an actuator, which sends it to a device.
#include <cmath>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct ParameterToActuator {
  struct In {
    PortChoice source{"smart_volume.volume"}, target{"actuator.value"};
    bool rescale = false;
    double gain = 1, base = 0;
  };
  struct Ends {
    double value = 0;
    std::string address;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<ParameterToActuator>& l) {
    l.id("parameter_to_actuator").label("Parameter to actuator");
    l.doc(
        "Carries a number from any port of a node to an actuator. Of several nodes, the actuator gets the mean. How often it "
        "sends is a setting of the actuator.");
    l.family(LinkFamily::data);
    l.param(&In::source, "source").doc("The port that is read, written `typification.port`.");
    l.param(&In::target, "target").doc("The port of the actuator that the number is proposed to, written `typification.port`.");
    l.param(&In::rescale, "rescale").doc("When on, the actuator gets `base + gain x number`; its unit may then be another one.");
    l.param(&In::gain, "gain").doc("The factor that the number is multiplied with; used with rescale only.");
    l.param(&In::base, "base")
        .unit_from("target")
        .doc("The value that the actuator gets for a number of 0; used with rescale only.");
    l.reads_chosen(&Ends::value, End::from, "source");
    l.reads(&Ends::address, End::to, "actuator.address");
    l.proposes_chosen(&Out::value, End::to, "target");
    l.same_units("source", "target", "rescale");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (ends.address.empty())
      return Error{ErrorCode::missing, "to", "the actuator has no address: give it one such as `mqtt://host:1883/topic`"};
    const double value = in.rescale ? in.base + in.gain * ends.value : ends.value;
    if (!std::isfinite(value))
      return Error{ErrorCode::not_finite, "gain", "the rescaled number is too large; make the gain smaller"};
    return Out{value};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(parameter_to_actuator, ParameterToActuator)
