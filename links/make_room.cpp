// Moves volumes that press on each other apart: each moves towards the centre of gravity of its own body.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/direction.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"
#include "core/geometry/touching_balls.h"

namespace bl {

namespace {

struct MakeRoom {
  struct In {
    double stiffness = 0.3, play = 0.12;
  };
  struct Ends {
    std::int64_t count = 0;
    std::string id, standing;
    Point3 position, centroid;
    double volume = 0, drop = 0;
  };
  struct Out {
    std::optional<Vector3> move;
  };

  static void declare(LinkBuilder<MakeRoom>& l) {
    l.id("make_room")
        .label("Make room")
        .doc(
            "Moves volumes that press on each other apart. Where neighbours or the boundary cut a body, its centre of gravity is "
            "away from its position. The position follows the centre until the bodies have room. A volume with a round body "
            "stays where it is. A volume that must stand on the ground and does not yet moves sideways where others press it "
            "up.");
    l.family(LinkFamily::separation);
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("The share of the deviation that is corrected in one tick.");
    l.param(&In::play, "play")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.3)
        .doc(
            "How far the position may be from the centre of gravity before it follows, as a share of the radius of a ball of "
            "that volume. The tolerance leaves neighbours alone that should share a facet, and lets pulls that cannot be "
            "satisfied come to rest.");
    l.reads(&Ends::count, End::from, "smart_volumes_solver.count");
    l.reads(&Ends::id, End::to, "node.id").reads(&Ends::standing, End::to, "smart_volume.standing");
    l.reads(&Ends::drop, End::to, "smart_volume.drop", Unit::metre);
    l.reads(&Ends::position, End::to, "node.position", Unit::metre);
    l.reads(&Ends::centroid, End::to, "smart_volume.centroid", Unit::metre);
    l.reads(&Ends::volume, End::to, "smart_volume.volume", Unit::cubic_metre);
    l.proposes(&Out::move, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Vector3 off = ends.centroid - ends.position;
    const double length = norm(off), beyond = length - in.play * geometry::ball_radius(ends.volume);
    // Where the solver has given no member a volume, there are no bodies to follow.
    if (ends.count == 0 || !(ends.volume > 0) || !(beyond > 0)) return Out{};
    const Vector3 straight = off * (in.stiffness * beyond / length);
    const double aside = off.z > 0 ? share_aside(ends) : 0;
    if (!(aside > 0)) return Out{straight};
    return Out{straight * (1 - aside) + level_way(off, ends.id) * (aside * in.stiffness * beyond)};
  }

 private:
  static constexpr double kFooting = 0.1;  // of a radius; `stand` lets down a little further
  static constexpr double kTurn = 0.25;

  // The share of an upward move that is suppressed. A volume that must come down to the ground would otherwise be lifted by those
  // below it and let down again without end. The share goes to 0 as the volume reaches its footing.
  static double share_aside(const Ends& ends) {
    if (ends.standing != "ground") return 0;
    return std::clamp(1 + ends.drop / (kFooting * geometry::ball_radius(ends.volume)), 0.0, 1.0);
  }

  // The id turns the direction a little: volumes in one plane, or one straight above another, would otherwise never leave it.
  static Vector3 level_way(const Vector3& off, const std::string& id) {
    const Vector3 by_name = direction_by_name(id, ""), level = Vector3{off.x, off.y, 0} / norm(off) + by_name * kTurn;
    const double length = norm(level);
    return length > 1e-9 ? level / length : by_name;
  }
};

}  // namespace

}  // namespace bl

BL_LINK(make_room, MakeRoom)
