// Makes a number follow the time of day by a curve over the hours.
#include "core/define/curve.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Schedule {
  enum class Shape { linear, steps };
  struct In {
    PortChoice target{"smart_volume.demand"};
    Table curve{{"time", "value"}, {{0.0, 0.0}, {43200.0, 1.0}}};
    Shape shape = Shape::linear;
  };
  struct Ends {
    double time = 0;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<Schedule>& l) {
    l.family(LinkFamily::numbers);
    l.id("schedule")
        .label("Schedule")
        .doc(
            "Makes a number follow a clock: how much a use demands at noon, how much traffic a street has at eight. The curve is "
            "that "
            "of one day and repeats itself every day.");
    l.param(&In::target, "target").doc("The port that the number is proposed to, written `typification.port`.");
    l.param(&In::curve, "curve")
        .column({.id = "time",
                 .is_required = true,
                 .unit = Unit::second,
                 .minimum = 0,
                 .maximum = kDay,
                 .doc = "The time of day, since midnight."})
        .column({.id = "value", .is_required = true, .doc = "The number from then on, in the unit of the target."})
        .doc("Points with ascending times.");
    l.param(&In::shape, "shape",
            {{Shape::linear, "linear", "The number changes evenly from one point to the next, also across midnight."},
             {Shape::steps, "steps", "The number of a point holds until the next one."}})
        .doc("What happens between two points.");
    l.reads(&Ends::time, End::from, "clock.time_of_day", Unit::second);
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Curve curve{in.curve, "time", "value"};
    if (auto sound = check_curve(curve, "curve"); !sound) return sound.error();
    return Out{in.shape == Shape::steps ? step_on_cycle(curve, ends.time) : value_on_cycle(curve, ends.time, kDay)};
  }

 private:
  static constexpr double kDay = 86400;  // [s]
};

}  // namespace

}  // namespace bl

BL_LINK(schedule, Schedule)
