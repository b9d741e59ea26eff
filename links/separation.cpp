// Pushes two volumes apart until they share no facet, or until there is a gap between them.
#include <algorithm>
#include <numbers>
#include <optional>
#include <string>

#include "core/base/direction.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Separation {
  struct In {
    double gap = 0, stiffness = 0.2;
  };
  struct Ends {
    Shared<Table> neighbours;
    std::string from_id, to_id;
    Point3 from, to;
    double from_radius = 0, to_radius = 0;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<Separation>& l) {
    l.family(LinkFamily::separation);
    l.id("separation")
        .label("Separation")
        .doc(
            "Pushes two volumes apart until they share no facet. With a gap, it also pushes until the clear distance between "
            "their bounding balls is that large. Volumes that a boundary cuts may then stand further apart than their shapes "
            "need.");
    l.param(&In::gap, "gap")
        .unit(Unit::metre)
        .min(0)
        .soft(0, 30)
        .doc("The clear distance between the bounding balls of the two volumes; at 0 it is enough that they share no facet.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("Share of the estimated missing distance that is closed in one tick; each volume moves half of it.");
    l.reads(&Ends::neighbours, End::from, "smart_volume.neighbours");
    l.reads(&Ends::from_id, End::from, "node.id").reads(&Ends::to_id, End::to, "node.id");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.reads(&Ends::from_radius, End::from, "smart_volume.radius", Unit::metre);
    l.reads(&Ends::to_radius, End::to, "smart_volume.radius", Unit::metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Vector3 between = ends.to - ends.from;
    const double length = norm(between), radii = ends.from_radius + ends.to_radius,
                 area = ends.neighbours->number(ends.neighbours->row_of("node", ends.to_id), "area");
    const bool is_together = length <= 1e-9;
    double way = 0;
    // The facet of two equal balls shrinks by pi/2 · distance for each metre; a little more makes it vanish.
    if (area > 0) way = std::min(2 * area / (std::numbers::pi * std::max(length, 1.0)), std::max(radii, 1.0)) + 0.05;
    if (in.gap > 0 && radii > 0) way = std::max(way, radii + in.gap - length);
    if (is_together) way = std::max(way, 1.0);
    if (!(way > 0)) return Out{};
    const Vector3 direction = is_together ? direction_by_name(ends.from_id, ends.to_id) : between / length;
    const Vector3 move = direction * (0.5 * in.stiffness * way);
    return Out{-move, move};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(separation, Separation)
