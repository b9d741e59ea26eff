// Carries a number from a port of one node to a port of another, as it is or from one range to another.
#include <algorithm>
#include <cmath>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct MapValue {
  struct In {
    PortChoice source{"control.output"}, target{"smart_volume.demand"};
    bool rescale = false;
    double in_min = 0, in_max = 1, out_min = 0, out_max = 1;
    bool clamp = true;
  };
  struct Ends {
    double value = 0;
  };
  struct Out {
    double value = 0;
  };

  static void declare(LinkBuilder<MapValue>& l) {
    l.family(LinkFamily::numbers);
    l.id("map_value")
        .label("Map value")
        .doc(
            "Carries a number from any port of one node to any port of another that links may change. Between ports of one unit "
            "the number is unchanged. With `rescale` it is mapped from one range to another, between ports of any units.");
    l.param(&In::source, "source").doc("The port that is read, written `typification.port`.");
    l.param(&In::target, "target").doc("The port that the number is proposed to, written `typification.port`.");
    l.param(&In::rescale, "rescale")
        .doc("When on, the number is rescaled from the range of the input to the range of the output.");
    l.param(&In::in_min, "in_min").unit_from("source").soft(0, 100).doc("The number at the source that becomes `out_min`.");
    l.param(&In::in_max, "in_max").unit_from("source").soft(0, 100).doc("The number at the source that becomes `out_max`.");
    l.param(&In::out_min, "out_min").unit_from("target").soft(0, 100).doc("The number that the target gets for `in_min`.");
    l.param(&In::out_max, "out_max")
        .unit_from("target")
        .soft(0, 100)
        .doc("The number that the target gets for `in_max`; it may be smaller than `out_min`.");
    l.param(&In::clamp, "clamp")
        .doc("When on, numbers outside the range of the input count as its nearer limit; used with rescale only.");
    l.reads_chosen(&Ends::value, End::from, "source");
    l.proposes_chosen(&Out::value, End::to, "target");
    l.same_units("source", "target", "rescale");
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (!in.rescale) return Out{ends.value};
    if (in.in_min == in.in_max)
      return Error{ErrorCode::out_of_range, "in_max",
                   "the range of the input is empty; give `in_min` and `in_max` different values"};
    double share = (ends.value - in.in_min) / (in.in_max - in.in_min);
    if (in.clamp) share = std::clamp(share, 0.0, 1.0);
    const double value = in.out_min * (1 - share) + in.out_max * share;
    if (!std::isfinite(value))
      return Error{ErrorCode::not_finite, "",
                   "the rescaled number is too large; widen the range of the input or turn `clamp` on"};
    return Out{value};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(map_value, MapValue)
