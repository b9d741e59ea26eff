// Pushes two nodes apart while they are within reach of each other; the push falls off linearly.
#include <optional>
#include <string>

#include "core/base/direction.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Repel {
  struct In {
    double reach = 20, stiffness = 0.1;
    bool in_plan = false;
  };
  struct Ends {
    std::string from_id, to_id;
    Point3 from, to;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<Repel>& l) {
    l.family(LinkFamily::separation);
    l.id("repel").label("Repel").doc(
        "Pushes two nodes apart while they are nearer than the reach. The push is strongest where the nodes coincide and falls "
        "off "
        "linearly to nothing at the reach. Between sets, every pair repels.");
    l.param(&In::reach, "reach")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 100)
        .doc("The distance between the two positions at which the push ends.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the distance missing to the reach that is added in one tick; each end moves half of it.");
    l.param(&In::in_plan, "in_plan")
        .doc("When on, the distance is measured in plan and the heights of both nodes stay as they are.");
    l.reads(&Ends::from_id, End::from, "node.id").reads(&Ends::to_id, End::to, "node.id");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
    l.silent_at([](const In& in) { return SilentBand{.least = in.reach, .in_plan = in.in_plan}; });
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Vector3 between = ends.to - ends.from;
    if (in.in_plan) between.z = 0;
    const double length = norm(between), missing = in.reach - length;
    if (!(missing > 0)) return Out{};
    const Vector3 direction = length > 1e-9 ? between / length : direction_by_name(ends.from_id, ends.to_id);
    const Vector3 move = direction * (0.5 * in.stiffness * missing);
    return Out{-move, move};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(repel, Repel)
