// Draws two volumes together until they share a facet of a wanted size.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/base/text.h"
#include "core/define/link_builder.h"
#include "core/define/link_remark.h"
#include "core/define/registry.h"
#include "core/geometry/touching_balls.h"

namespace bl {

namespace {

struct Adjacency {
  struct In {
    double area = 50, stiffness = 0.1;
  };
  struct Ends {
    Shared<Table> neighbours;
    std::string from_id, to_id;
    Point3 from, to, from_centroid, to_centroid;
    double from_radius = 0, to_radius = 0, from_wanted = 0, to_wanted = 0;
  };
  struct Out {
    std::optional<Vector3> from, to;
  };

  static void declare(LinkBuilder<Adjacency>& l) {
    l.family(LinkFamily::nearness);
    l.id("adjacency")
        .label("Adjacency")
        .doc(
            "Draws two volumes together until the facet that they share has the wanted area. Volumes that share enough are left "
            "alone. A volume that is pressed against others is pulled no further: volumes in between give way (see `make_room`) "
            "or stay there. Pulls go in a straight line, not around courts or corners. The link names volumes that do not "
            "touch.");
    l.param(&In::area, "area")
        .unit(Unit::square_metre)
        .min(0)
        .soft(0, 500)
        .doc("The least area that the shared facet should have.");
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
    l.reads(&Ends::from_centroid, End::from, "smart_volume.centroid", Unit::metre);
    l.reads(&Ends::to_centroid, End::to, "smart_volume.centroid", Unit::metre);
    l.reads(&Ends::from_wanted, End::from, "smart_volume.wanted", Unit::cubic_metre);
    l.reads(&Ends::to_wanted, End::to, "smart_volume.wanted", Unit::cubic_metre);
    l.proposes(&Out::from, End::from, "node.position", Unit::metre).proposes(&Out::to, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick& tick) {
    const Vector3 between = ends.to - ends.from;
    const double length = norm(between), shared = ends.neighbours->number(ends.neighbours->row_of("node", ends.to_id), "area"),
                 missing = in.area - shared;
    if (!(missing > 0) || !(length > 1e-9)) return Out{};
    // The clear distance plus a distance that grows with the missing area. For each metre that the volumes come nearer, a facet
    // grows by about one and a half times their distance, so that a small missing area needs a short move only.
    const double clear = std::max(0.0, length - ends.from_radius - ends.to_radius);
    if (!(shared > 0)) tell(ends, clear, tick);
    const double reach = std::min(std::sqrt(in.area), 0.5 * in.area / (length * std::max(in.stiffness, 0.01)));
    // Others may cut into the facet, so that it takes a little less distance than two bodies alone would need: that at which
    // these would share twice the area.
    const double nearest = geometry::touching_distance(ends.from_wanted, ends.to_wanted, 2 * in.area);
    const double way = std::min(length - nearest, clear + reach * (missing / in.area));
    if (!(way > 0)) return Out{};
    const Vector3 direction = between / length;
    const double pull = 0.5 * in.stiffness * way;
    const double from_pull = std::min(pull, room_for(dot(ends.from - ends.from_centroid, direction), ends.from_wanted));
    const double to_pull = std::min(pull, room_for(dot(ends.to_centroid - ends.to, direction), ends.to_wanted));
    Out out;
    if (from_pull > 0) out.from = direction * from_pull;
    if (to_pull > 0) out.to = direction * -to_pull;
    return out;
  }

 private:
  static constexpr double kLeastClear = 0.05;  // [m] what is less reads as nothing

  // An unmet wish does not keep the scene from settling, but the pair is named. A volume without a body is reported elsewhere.
  static void tell(const Ends& ends, double clear, const Tick& tick) {
    if (!(ends.from_radius > 0) || !(ends.to_radius > 0) || !(ends.from_wanted > 0) || !(ends.to_wanted > 0)) return;
    const std::string between =
        clear < kLeastClear ? "other volumes or the boundary lie between them" : fixed(clear, 1) + " m are between them";
    remark(tick, LinkRemark::short_of,
           {ErrorCode::infeasible, "",
            "`" + ends.from_id + "` and `" + ends.to_id + "` do not touch: " + between +
                "; move one of them, or what lies between them"});
  }

  // Where neighbours hold a body back, its centre of gravity stays behind its position. The pull fades out as that lag grows to
  // this many radii of the body. The limit is below the tolerance of `make_room`, so that a pull that cannot be satisfied ends
  // before volumes give way to each other without end. For a ball that is cut in half, the lag is 3/8 of the radius.
  static constexpr double kPressed = 0.08, kShareOfRoom = 0.25;
  static double room_for(double ahead, double volume) {
    // A volume without a body is not held back.
    if (!(volume > 0)) return std::numeric_limits<double>::infinity();
    return kShareOfRoom * (kPressed * geometry::ball_radius(volume) - ahead);
  }
};

}  // namespace

}  // namespace bl

BL_LINK(adjacency, Adjacency)
