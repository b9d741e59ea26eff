// Lowers volumes until they stand on the ground, or on volumes below them.
#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/touching_balls.h"

namespace bl {

namespace {

struct Stand {
  struct In {
    double stiffness = 0.8, footing = 0.2, play = 0.05;
  };
  struct Ends {
    std::int64_t count = 0;
    double drop = 0, volume = 0;
  };
  struct Out {
    std::optional<Vector3> move;
  };

  static void declare(LinkBuilder<Stand>& l) {
    l.id("stand").label("Stand").doc(
        "Lowers volumes until they stand on what their `standing` allows: the ground of the boundary, or a volume below. It "
        "never lifts a volume.");
    l.family(LinkFamily::ground);
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 1)
        .doc(
            "The share of the way down that is gone in one tick, but at most half a radius. Pulls of other links do not hold a "
            "volume up.");
    l.param(&In::footing, "footing")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc(
            "How deep a ball sinks into what carries it, as a share of the radius of a ball of that volume. A ball that only "
            "touches the ground would have no floor area there.");
    l.param(&In::play, "play")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.2)
        .doc("How much of that depth may be missing, as a share of the radius, before the volume is lowered again.");
    l.reads(&Ends::count, End::from, "smart_volumes_solver.count");
    l.reads(&Ends::drop, End::to, "smart_volume.drop", Unit::metre);
    l.reads(&Ends::volume, End::to, "smart_volume.volume", Unit::cubic_metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const double radius = geometry::ball_radius(ends.volume), way = ends.drop + (in.footing - in.play) * radius;
    if (ends.count == 0 || !(ends.volume > 0) || !(way > 0)) return Out{};
    // A volume that falls by more than its own size in one tick would pass through others.
    return Out{Vector3{0, 0, -std::min(in.stiffness * way, 0.5 * radius)}};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(stand, Stand)
