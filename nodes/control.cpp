// A control for people: a slider with a range and steps, or a switch.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Control {
  struct In {
    double value = 0;
    std::string unit;
    double minimum = 0, maximum = 100, step = 0;
    bool is_switch = false;
  };
  struct Out {
    double output = 0;
  };

  static void declare(TypificationBuilder<Control>& t) {
    t.id("control").label("Control");
    t.column(CanvasColumn::first).icon(Icon::plus);
    t.doc("A number that people set by a slider or a switch, and that links carry to other nodes.");
    t.in(&In::value, "value").unit_from("unit").doc("The value that people have set. No link changes it.");
    t.in(&In::unit, "unit")
        .doc("Unit of the value as a symbol, such as `m`, `m2`, `m3`, `deg`, `s` or `EUR`; empty for a plain number.");
    t.in(&In::minimum, "minimum").unit_from("unit").doc("Lower end of the slider.");
    t.in(&In::maximum, "maximum").unit_from("unit").doc("Upper end of the slider; above the lower end.");
    t.in(&In::step, "step")
        .unit_from("unit")
        .min(0)
        .doc("Step of the slider, counted from the lower end; 0 for a slider without steps.");
    t.in(&In::is_switch, "is_switch")
        .doc("Makes it a switch: the output is 1 where the value is 0.5 or more, and 0 elsewhere. Range and step are ignored.");
    t.out(&Out::output, "output").shown_first().unit_from("unit").doc("The value inside the range, rounded to the nearest step.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) {
    if (const auto unit = stored_unit(in.unit); !unit) return unit.error().within("unit");
    if (in.is_switch) return Out{in.value >= 0.5 ? 1.0 : 0.0};
    const double range = in.maximum - in.minimum;
    if (!(range > 0))
      return Error{ErrorCode::out_of_range, "maximum",
                   "the maximum (" + shortest(in.maximum) + ") has to lie above the minimum (" + shortest(in.minimum) + ")"};
    if (in.step > range)
      return Error{ErrorCode::out_of_range, "step",
                   "the step (" + shortest(in.step) + ") is larger than the range (" + shortest(range) +
                       "): make it smaller, or 0 for none"};
    const double value = std::clamp(in.value, in.minimum, in.maximum);
    if (!(in.step > 0)) return Out{value};
    // The last step may lie below the maximum; the margin keeps a range that is a whole number of steps up to rounding.
    const double last = std::floor(range / in.step * (1 + 1e-12));
    const double notch = std::min(std::floor((value - in.minimum) / in.step + 0.5), last);
    return Out{std::min(in.minimum + notch * in.step, in.maximum)};
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(control, Control)
