// Pulls volumes into the catchment of a stop, the weaker the farther away they are.
#include "core/base/mathematics.h"
#include "core/define/link_builder.h"
#include "core/define/registry.h"

namespace bl {

namespace {

struct TransitPull {
  struct In {
    double gain = 0.1, fade = 200;
  };
  struct Ends {
    Point3 stop, volume;
    double radius = 0;
    double demand = 0;  // only volumes have this port
  };
  struct Out {
    Vector3 volume;
  };

  static void declare(LinkBuilder<TransitPull>& l) {
    l.id("transit_pull").label("Transit pull");
    l.doc(
        "Pulls a volume towards a stop until it stands in its catchment. The pull is weak far away and zero inside the "
        "catchment. Distances are measured in plan.");
    l.family(LinkFamily::traffic);
    l.param(&In::gain, "gain")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.01, 0.5)
        .doc("Share of the distance to the catchment that is closed in one tick, at its edge.");
    l.param(&In::fade, "fade")
        .unit(Unit::metre)
        .range(1, 1e5)
        .soft(50, 1000)
        .doc("The distance outside the catchment at which the pull falls to a third (1/e).");
    l.reads(&Ends::stop, End::from, "node.position", Unit::metre)
        .reads(&Ends::radius, End::from, "transit_stop.radius", Unit::metre);
    l.reads(&Ends::volume, End::to, "node.position", Unit::metre)
        .reads(&Ends::demand, End::to, "smart_volume.demand", Unit::cubic_metre);
    l.proposes(&Out::volume, End::to, "node.position", Unit::metre);
  }

  static Result<Out> evaluate(const In& in, const Ends& ends, const Tick&) {
    Vector3 way = ends.stop - ends.volume;
    way.z = 0;
    const double outside = norm(way) - ends.radius;
    if (!(outside > 0)) return Out{};
    return Out{way * (in.gain * mathematics::exponential(-outside / in.fade) * outside / norm(way))};
  }
};

}  // namespace

}  // namespace bl

BL_LINK(transit_pull, TransitPull)
