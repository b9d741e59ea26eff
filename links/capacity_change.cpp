// Lets a control change a street: its lanes, its speed, or whether it is open.
#include <optional>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct CapacityChange {
  enum class Target { lanes, speed, open };
  struct In {
    Target target = Target::open;
  };
  struct Ends {
    double value = 0;
  };
  struct Out {
    std::optional<double> lanes, speed, open;
  };

  static void declare(LinkBuilder<CapacityChange>& l) {
    l.id("capacity_change").label("Capacity change");
    l.doc("Sets the lanes, the speed or the opening of streets to the value of a control, to test a change of the network.");
    l.family(LinkFamily::traffic);
    l.param(&In::target, "target",
            {{Target::lanes, "lanes", "The value is the number of lanes in each direction."},
             {Target::speed, "speed", "The value is the speed without traffic, in metres per second."},
             {Target::open, "open", "The value is the share of the capacity that is open: 0 closes the street, 1 opens it."}})
        .doc("Which property of the street the control changes.");
    l.reads(&Ends::value, End::from, "control.output");
    l.proposes(&Out::lanes, End::to, "street.lanes", Unit::count);
    l.proposes(&Out::speed, End::to, "street.speed", Unit::metre_per_second);
    l.proposes(&Out::open, End::to, "street.open", Unit::ratio);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Out out;
    if (in.target == Target::speed && !(ends.value > 0))
      return Error{ErrorCode::out_of_range, "target", "a speed has to be above 0; close the street by `open` instead"};
    (in.target == Target::lanes ? out.lanes : in.target == Target::speed ? out.speed : out.open) = ends.value;
    return out;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(capacity_change, CapacityChange)
