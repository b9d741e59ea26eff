// Keeps the distance between two nodes within a range.
#include <optional>
#include <string>

#include "core/base/direction.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct KeepDistance {
  struct In {
    double minimum = 10, maximum = 50, stiffness = 0.2;
    bool in_plan = false;
  };
  struct Ends {
    std::string from_id, to_id;
    Point3 from, to;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<KeepDistance>& l) {
    l.family(LinkFamily::distance);
    l.id("keep_distance")
        .label("Keep distance")
        .doc(
            "Keeps the distance between two nodes within a range. Inside the range it does nothing; outside it, both nodes move "
            "towards "
            "the nearer limit. Between sets, every pair keeps the distance.");
    l.param(&In::minimum, "minimum")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 100)
        .doc("The smallest distance between the two positions.");
    l.param(&In::maximum, "maximum")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 200)
        .doc("The largest distance between the two positions; it must not be smaller than the minimum.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the violation that is corrected in one tick; each end moves half of it.");
    l.param(&In::in_plan, "in_plan")
        .doc("When on, the distance is measured in plan and the heights of both nodes stay as they are.");
    l.reads(&Ends::from_id, End::from, "node.id").reads(&Ends::to_id, End::to, "node.id");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
    l.silent_at([](const In& in) { return SilentBand{.least = in.minimum, .most = in.maximum, .in_plan = in.in_plan}; });
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    if (in.minimum > in.maximum)
      return Error{ErrorCode::out_of_range, "minimum", "the minimum is larger than the maximum; swap them or widen the range"};
    Vector3 between = ends.to - ends.from;
    if (in.in_plan) between.z = 0;
    const double length = norm(between);
    const double missing = length < in.minimum ? in.minimum - length : length > in.maximum ? in.maximum - length : 0;
    if (missing == 0) return Out{};
    const Vector3 direction = length > 1e-9 ? between / length : direction_by_name(ends.from_id, ends.to_id);
    const Vector3 move = direction * (0.5 * in.stiffness * missing);
    return Out{-move, move};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(keep_distance, KeepDistance)
