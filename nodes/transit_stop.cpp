// A stop of public transport: its headway, and the radius of its catchment.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct TransitStop {
  struct In {
    double headway = 600, radius = 400;
  };
  struct Out {
    double departures = 6, mean_wait = 300;
  };

  static void declare(TypificationBuilder<TransitStop>& t) {
    t.id("transit_stop").label("Transit stop");
    t.doc("A stop of bus, tram or train. Links pull volumes into its catchment, the circle from which people walk to it.");
    t.in(&In::headway, "headway")
        .unit(Unit::second)
        .range(30, 86400)
        .soft(120, 3600)
        .combine(CombineRule::blend)
        .doc("Headway: time from one departure to the next.");
    t.in(&In::radius, "radius")
        .unit(Unit::metre)
        .range(0, 10000)
        .soft(100, 1500)
        .combine(CombineRule::blend)
        .doc("Radius of the catchment: 400 m for a bus, 800 m for a train.");
    t.out(&Out::departures, "departures").unit(Unit::per_hour).doc("Departures per hour.");
    t.out(&Out::mean_wait, "mean_wait")
        .unit(Unit::second)
        .doc("Mean wait of people who arrive at random times: half the headway.");
  }

  static Result<Out> evaluate(const In& in, const Tick&) { return Out{3600 / in.headway, in.headway / 2}; }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(transit_stop, TransitStop)
