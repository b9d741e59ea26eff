// A traffic zone: where trips begin and end; a second role of a volume.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct TrafficZone {
  struct In {
    double trips_out = 0, trips_in = 0;
    std::vector<std::string> access;
    bool list_reach = false;
  };
  struct Out {
    double trips_served = 0, trips_lost = 0, trips_ending = 0, mean_travel_time = 0, accessibility = 0;
    Table reach{{"junction", "driving", "walking"}, {}};
    std::string reason = "no traffic network takes care of it, or its network fails";
  };

  static void declare(TypificationBuilder<TrafficZone>& t) {
    t.id("traffic_zone").label("Traffic zone");
    t.doc(
        "A place where trips begin and end, such as a volume with its floor area. It reaches the streets on foot, through the "
        "junctions of its access; a node that is a junction itself needs no other.");
    t.in(&In::trips_out, "trips_out")
        .unit(Unit::per_hour)
        .range(0, 1e7)
        .soft(0, 1000)
        .combine(CombineRule::blend)
        .doc(
            "Trips that leave in the hour looked at. What links propose is averaged, also with what people set: trips that add "
            "up "
            "belong into one link.");
    t.in(&In::trips_in, "trips_in")
        .unit(Unit::per_hour)
        .range(0, 1e7)
        .soft(0, 1000)
        .combine(CombineRule::blend)
        .doc("Trips that would end here: how strongly the zone attracts.");
    t.in(&In::access, "access")
        .collect()
        .doc(
            "Ids of the junctions by which trips enter and leave. Links add to them; when empty, the junction of the node "
            "itself.");
    t.in(&In::list_reach, "list_reach")
        .doc("Lists the times to all junctions, by car and on foot: what isochrones are drawn from.");
    t.out(&Out::trips_served, "trips_served").unit(Unit::per_hour).doc("Trips that leave and are on the streets.");
    t.out(&Out::trips_lost, "trips_lost").unit(Unit::per_hour).doc("Trips that would leave and have no way to go.");
    t.out(&Out::trips_ending, "trips_ending")
        .unit(Unit::per_hour)
        .doc("Trips that end here. Where that should be `trips_in` and is not, the network's table `arrivals` says why.");
    t.out(&Out::mean_travel_time, "mean_travel_time")
        .unit(Unit::second)
        .doc(
            "Mean time of the trips that leave on the ways that they use, with the walk at both ends; tolls and distance are not "
            "in it.");
    t.out(&Out::accessibility, "accessibility")
        .unit(Unit::per_hour)
        .doc("Trips that end in other zones, each the less the longer the cheapest way there takes.");
    t.out(&Out::reach, "reach")
        .column({.id = "junction", .is_text = true, .default_value = std::string(), .doc = "Id of the junction."})
        .column({.id = "driving",
                 .unit = Unit::second,
                 .doc = "Time by car on the cheapest way at the flows of this tick; -1 where no way leads."})
        .column({.id = "walking", .unit = Unit::second, .doc = "Time on foot along the streets; -1 where no way leads."})
        .doc("Times to the junctions that can be reached, in ascending id; empty where they are not wanted.");
    t.out(&Out::reason, "reason").doc("Why trips are lost or the zone is not attached, as a sentence; empty where all is well.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(traffic_zone, TrafficZone)
