// Changes a number little by little until an indicator meets its goal.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct GoalPressure {
  struct In {
    PortChoice target{"smart_volume.demand"};
    double gain = 0.1, scale = 0, lowest = 0, highest = 20000;
  };
  struct Ends {
    double pressure = 0, value = 0;
    std::string indicator;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<GoalPressure>& l) {
    l.family(LinkFamily::numbers);
    l.id("goal_pressure")
        .label("Goal pressure")
        .doc(
            "Changes a number in small steps until an indicator meets its goal, and then leaves it alone. It finds no best "
            "solution; "
            "it pushes, as people do, and everything else in the scene answers. Where people have set the number too, the "
            "outcome "
            "lies between their value and the goal.");
    l.param(&In::target, "target")
        .doc("The port that is changed, written `typification.port`; not one that adds up amounts, as what is spent does.");
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(-1, 1)
        .soft(-0.5, 0.5)
        .doc(
            "By what share of itself the number changes in one tick while the indicator is as far from its goal as its `span`. "
            "Negative where the number has to fall for the indicator to grow.");
    l.param(&In::scale, "scale")
        .unit_from("target")
        .min(0)
        .doc("A number smaller than this changes by a share of this, so that it can leave 0.");
    l.param(&In::lowest, "lowest").unit_from("target").doc("The link asks for no less than this.");
    l.param(&In::highest, "highest").unit_from("target").doc("The link asks for no more than this.");
    l.reads(&Ends::pressure, End::from, "indicator.pressure", Unit::ratio);
    l.reads(&Ends::indicator, End::from, "node.id");
    l.reads_chosen(&Ends::value, End::to, "target");
    l.proposes_chosen(&Out::value, End::to, "target");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    if (!(in.lowest < in.highest))
      return Error{ErrorCode::out_of_range, "highest",
                   "the highest value (" + shortest(in.highest) + ") has to lie above the lowest (" + shortest(in.lowest) + ")"};
    const double step = in.gain * ends.pressure * std::max(std::abs(ends.value), in.scale);
    const double wanted = ends.value + step, value = std::clamp(wanted, in.lowest, in.highest);
    if (ends.pressure != 0) tell(in, ends, step, tick);
    return Out{value};
  }

 private:
  // A limit counts as the obstacle only where the link pushes towards it.
  static void tell(const In& in, const Ends& ends, double step, const Tick& tick) {
    const std::string goal = "the goal of `" + ends.indicator + "` is not met";
    const double wanted = ends.value + step;
    if (step == 0)
      return remark(tick, LinkRemark::short_of,
                    {ErrorCode::infeasible, in.gain == 0 ? "gain" : "scale",
                     goal + ", and the link changes nothing: " +
                         (in.gain == 0 ? "give it a `gain`" : "the number is 0, so that it needs a `scale` to grow by")});
    const bool is_low = step < 0 && wanted <= in.lowest, is_high = step > 0 && wanted >= in.highest;
    if (!is_low && !is_high) return remark(tick, LinkRemark::at_work, {ErrorCode::infeasible, "", goal});
    remark(tick, LinkRemark::short_of,
           {ErrorCode::infeasible, is_low ? "lowest" : "highest",
            goal + ", and the link may ask for no " + (is_low ? "less" : "more") + " than " +
                shortest(is_low ? in.lowest : in.highest) + ": change that limit, or the goal"});
  }
};

}  // namespace

}  // namespace bl

BL_LINK(goal_pressure, GoalPressure)
