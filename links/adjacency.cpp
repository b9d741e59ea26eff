// Draws two volumes together until they share a facet of a wanted size.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct Adjacency {
  struct In {
    double area = 50, stiffness = 0.1;
  };
  struct Ends {
    Shared<Table> neighbours;
    std::string to_id;
    Point3 from, to;
    double from_radius = 0, to_radius = 0;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<Adjacency>& l) {
    l.id("adjacency")
        .label("Adjacency")
        .doc(
            "Draws two volumes together until the facet that they share has the wanted area. Volumes that share enough are left "
            "alone; "
            "other volumes in between have to give way or stay between them.");
    l.param(&In::area, "area")
        .unit(Unit::square_metre)
        .min(0)
        .soft(0, 500)
        .doc("The area of the shared facet that is wanted at least.");
    l.param(&In::stiffness, "stiffness")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0, 0.5)
        .doc("How much of the way that seems to be missing is gone in one tick; each volume goes half of it.");
    l.reads(&Ends::neighbours, End::from, "smart_volume.neighbours").reads(&Ends::to_id, End::to, "node.id");
    l.reads(&Ends::from, End::from, "node.position", Unit::metre).reads(&Ends::to, End::to, "node.position", Unit::metre);
    l.reads(&Ends::from_radius, End::from, "smart_volume.radius", Unit::metre);
    l.reads(&Ends::to_radius, End::to, "smart_volume.radius", Unit::metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    const Vector3 between = ends.to - ends.from;
    const double length = norm(between),
                 missing = in.area - ends.neighbours->number(ends.neighbours->row_of("node", ends.to_id), "area");
    if (!(missing > 0) || !(length > 1e-9)) return Out{};
    // The clear distance, and a way that grows with the missing area. A facet grows by about one and a half times its distance
    // for each metre that the volumes come nearer, so that a small area calls for a short way only.
    const double clear = std::max(0.0, length - ends.from_radius - ends.to_radius);
    const double reach = std::min(std::sqrt(in.area), 0.5 * in.area / (length * std::max(in.stiffness, 0.01)));
    const double way = std::min(length, clear + reach * (missing / in.area));
    const Vector3 move = between * (0.5 * in.stiffness * way / length);
    return Out{move, -move};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(adjacency, Adjacency)
