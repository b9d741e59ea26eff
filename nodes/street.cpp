// A street between two junctions: lanes, speed and who may pass, and the traffic on it.
#include "core/define/registry.h"
#include "core/define/typification_builder.h"

namespace bl {

namespace {

struct Street {
  struct In {
    Selection start, end;
    std::vector<Point3> course;
    double lanes = 1, capacity_per_lane = 800, speed = 50 / 3.6, length = 0, open = 1, toll = 0;
    bool one_way = false, for_cars = true;
  };
  struct Out {
    double flow_forth = 0, flow_back = 0, time_forth = 0, time_back = 0, delay = 0, volume_over_capacity = 0, used_length = 0;
    std::string reason = "no traffic network takes care of it, or its network fails";
  };

  static void declare(TypificationBuilder<Street>& t) {
    t.id("street").label("Street segment");
    t.doc("A street from one junction to another. A traffic network assigns trips to it; its travel time grows with its flow.");
    t.in(&In::start, "start").doc("The junction where it begins; exactly one.");
    t.in(&In::end, "end").doc("The junction where it ends; exactly one.");
    t.in(&In::course, "course")
        .unit(Unit::metre)
        .doc(
            "The points between its ends, in order; empty for a straight street. They stay where they are when a junction moves. "
            "Their heights are ignored: a street rises evenly from end to end.");
    t.in(&In::lanes, "lanes")
        .unit(Unit::count)
        .range(0, 20)
        .soft(0, 6)
        .combine(CombineRule::blend)
        .doc(
            "Lanes in each direction; 0 closes the street. Links propose to it, and a part of a lane counts as part of its "
            "capacity.");
    t.in(&In::capacity_per_lane, "capacity_per_lane")
        .unit(Unit::per_hour)
        .range(1e-9, 10000)
        .soft(200, 2200)
        .doc("Vehicles per hour at which one lane is fully used: 600 to 900 in town, up to 2200 on a motorway.");
    t.in(&In::speed, "speed")
        .unit(Unit::metre_per_second)
        .range(0.1, 100)
        .soft(2, 40)
        .combine(CombineRule::blend)
        .doc("Speed without traffic: 13.9 m/s are 50 km/h.");
    t.in(&In::length, "length")
        .unit(Unit::metre)
        .range(0, 1e6)
        .soft(0, 1000)
        .doc("Length; 0 takes the length of its line from end to end, along its course.");
    t.in(&In::open, "open")
        .unit(Unit::ratio)
        .range(0, 1)
        .combine(CombineRule::min)
        .doc("Share of its capacity that is open: 1 for all of it, 0 closes the street. The lowest of all proposals applies.");
    t.in(&In::one_way, "one_way").doc("Leads from start to end only.");
    t.in(&In::for_cars, "for_cars").doc("When off, only people on foot may use it, and no car trip passes.");
    t.in(&In::toll, "toll")
        .unit(Unit::euro)
        .range(0, 1e6)
        .soft(0, 10)
        .doc("Toll for one passage; the network converts it to time.");
    declare_traffic(t);
  }

  static void declare_traffic(TypificationBuilder<Street>& t) {
    t.out(&Out::flow_forth, "flow_forth").unit(Unit::per_hour).doc("Vehicles per hour from start to end.");
    t.out(&Out::flow_back, "flow_back").unit(Unit::per_hour).doc("Vehicles per hour from end to start.");
    t.out(&Out::time_forth, "time_forth").unit(Unit::second).doc("Time from start to end at this flow.");
    t.out(&Out::time_back, "time_back").unit(Unit::second).doc("Time from end to start at this flow.");
    t.out(&Out::delay, "delay")
        .unit(Unit::second)
        .doc("Time that each trip loses here against an empty street; the larger of both directions.");
    t.out(&Out::volume_over_capacity, "volume_over_capacity")
        .unit(Unit::ratio)
        .doc("Flow over open capacity, the larger of both directions; above 1 the street is overloaded.");
    t.out(&Out::used_length, "used_length").unit(Unit::metre).doc("The length that is used: the set one, or that of its line.");
    t.out(&Out::reason, "reason").doc("Why no car can drive here, as a sentence; empty where cars can.");
  }
};

}  // namespace

}  // namespace bl

BL_TYPIFICATION(street, Street)
