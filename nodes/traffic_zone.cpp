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
        "A place where trips begin and end, such as a volume with its floor area. Its trips walk to the junctions of its access. "
        "A node that is a junction itself needs no other access.");
    t.in(&In::trips_out, "trips_out")
        .unit(Unit::per_hour)
        .range(0, 1e7)
        .soft(0, 1000)
        .combine(CombineRule::blend)
        .doc(
            "Trips that leave in the hour studied. The proposals of links are averaged with the value that people set, and not "
            "added up: put trips that add up into one link.");
    t.in(&In::trips_in, "trips_in")
        .unit(Unit::per_hour)
        .range(0, 1e7)
        .soft(0, 1000)
        .combine(CombineRule::blend)
        .doc("Trips that should end here: the attraction of the zone.");
    t.in(&In::access, "access")
        .collect()
        .doc("Ids of the junctions where trips enter and leave. Links add to them. When empty, the node itself is the junction.");
    t.in(&In::list_reach, "list_reach")
        .doc("When on, the times to all junctions by car and on foot are listed. Isochrones are drawn from them.");
    t.out(&Out::trips_served, "trips_served").unit(Unit::per_hour).doc("Trips that leave and are on the streets.");
    t.out(&Out::trips_lost, "trips_lost").unit(Unit::per_hour).doc("Trips that should leave and have no route.");
    t.out(&Out::trips_ending, "trips_ending")
        .unit(Unit::per_hour)
        .doc("Trips that end here. Where they should equal `trips_in` and do not, the network's table `arrivals` says why.");
    t.out(&Out::mean_travel_time, "mean_travel_time")
        .unit(Unit::second)
        .doc("Mean time of the trips that leave, on their routes and with the walk at both ends; without tolls and distance.");
    t.out(&Out::accessibility, "accessibility")
        .unit(Unit::per_hour)
        .doc("Accessibility: the trips that end in other zones, each weighted less, the longer its cheapest route takes.");
    t.out(&Out::reach, "reach")
        .column({.id = "junction", .is_text = true, .default_value = std::string(), .doc = "Id of the junction."})
        .column({.id = "driving",
                 .unit = Unit::second,
                 .doc = "Time by car on the cheapest route at the flows of this tick; -1 where there is no route."})
        .column({.id = "walking", .unit = Unit::second, .doc = "Time on foot along the streets; -1 where there is no route."})
        .doc("Times to the junctions that can be reached, in ascending id; empty where `list_reach` is off.");
    t.out(&Out::reason, "reason")
        .doc("Why trips are lost or the zone is not attached, as a sentence; empty where there is no problem.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(traffic_zone, TrafficZone)
