// Pulls two nodes together until they are no further apart than a rest distance.
#include <optional>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Attract {
  struct In {
    double rest = 20, stiffness = 0.1;
    bool in_plan = false;
  };
  struct Ends {
    Point3 from, to;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<Attract>& l) {
    l.family(LinkFamily::nearness);
    l.id("attract").label("Attract").doc(
        "Pulls two nodes together until they are no further apart than the rest distance. Nearer nodes are left alone. Between "
        "sets every pair is pulled; lower the stiffness where one node has very many partners.");
    l.param(&In::rest, "rest")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 100)
        .doc("The distance between the two positions at which the pull ends.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the distance beyond the rest distance that is closed in one tick; each end moves half of it.");
    l.param(&In::in_plan, "in_plan")
        .doc("When on, the distance is measured in plan and the heights of both nodes stay as they are.");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
    l.silent_at([](const In& in) { return SilentBand{.most = in.rest, .in_plan = in.in_plan}; });
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Vector3 between = ends.to - ends.from;
    if (in.in_plan) between.z = 0;
    const double length = norm(between), excess = length - in.rest;
    if (!(excess > 0)) return Out{};
    const Vector3 move = between * (0.5 * in.stiffness * excess / length);
    return Out{move, -move};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(attract, Attract)
