// The traffic network: assigns the trips of its zones to its streets, tick by tick, towards user equilibrium.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/define/registry.h"
#include "core/define/typification_builder.h"
#include "core/traffic/district.h"
#include "core/traffic/trip_flows.h"

namespace bl {
namespace {

struct TrafficNetworkNode {
  // The start of the next tick: the routes and destinations of the trips of each zone, and the names of the links.
  struct Memory {
    Shared<Table> links{Table{{"link"}, {}}}, ways{Table{{"zone", "links", "flows", "trips"}, {}}};
    bool operator==(const Memory&) const = default;
  };
  struct In {
    Selection streets{{}, "street", {}}, junctions{{}, "junction", {}}, zones{{}, "traffic_zone", {}};
    double alpha = 0.15, beta = 4, peak_share = 0.1, toll_factor = 180, distance_factor = 0, walking_speed = 1.34;
    traffic::TripConstraint distribution = traffic::TripConstraint::origins;
    double fade = 600, haste = 0.5, gap = 1e-4, isochrone_step = 300;
    int steps = 4, isochrone_bands = 3;
    Memory last;
  };
  struct Street {
    std::string id;
    Selection start, end;
    double lanes = 0, capacity_per_lane = 0, speed = 0, length = 0, open = 0, toll = 0;
    bool one_way = false, for_cars = true;
    std::vector<Point3> course;
  };
  struct Rules {
    std::string id;
    Table turns;
  };
  struct Sets {
    std::vector<Street> streets;
    std::vector<traffic::DistrictJunction> junctions;
    std::vector<Rules> rules;
    std::vector<traffic::DistrictZone> zones;
  };
  struct ZoneReply {
    double served = 0, lost = 0, ending = 0, mean_time = 0, accessibility = 0;
    std::string reason;
    Table reach{{"junction", "driving", "walking"}, {}};
  };
  struct Out {
    double relative_gap = 1, unrest = 1, trips = 0, trips_lost = 0, trips_missing = 0, mean_travel_time = 0, total_time = 0,
           objective = 0;
    double largest_load = 0;
    std::string message;
    Table loads{{"junction", "volume_over_capacity"}, {}}, arrivals{{"zone", "wanted", "missing", "reason"}, {}};
    Memory memory;
    std::vector<traffic::DistrictResult::Street> streets;
    std::vector<traffic::DistrictResult::Junction> junctions;
    std::vector<traffic::DistrictResult::Rules> rules;
    std::vector<ZoneReply> zones;
  };
  using Builder = TypificationBuilder<TrafficNetworkNode>;

  static void declare(Builder& t) {
    t.id("traffic_network").label("Traffic network");
    t.doc(
        "Streets, junctions and zones as one network. In every tick it distributes the trips over destinations by travel time, "
        "and shifts them between routes towards user equilibrium, where no trip has a cheaper route. Cost is time plus tolls and "
        "distance, converted by their factors. Figures called time contain time alone.");
    t.in(&In::streets, "streets").doc("The streets of this network; a street belongs to one network only.");
    t.in(&In::junctions, "junctions").doc("The junctions of these streets.");
    t.in(&In::zones, "zones").doc("The zones whose trips use the network.");
    declare_settings(t);
    declare_results(t);
    declare_sets(t);
  }

  static void declare_settings(Builder& t) {
    t.in(&In::alpha, "alpha")
        .unit(Unit::ratio)
        .range(0, 100)
        .soft(0.05, 1)
        .doc("Share by which the travel time of a street grows when its flow equals its capacity (Bureau of Public Roads).");
    t.in(&In::beta, "beta").range(0, 20).soft(1, 8).doc("Exponent of volume over capacity: how steeply the travel time grows.");
    t.in(&In::peak_share, "peak_share")
        .unit(Unit::ratio)
        .range(0, 1)
        .soft(0.05, 0.2)
        .doc("Share of a day's trips in the hour studied. Links of the kind `request_traffic` use it.");
    t.in(&In::toll_factor, "toll_factor")
        .range(0, 1e6)
        .soft(0, 600)
        .doc("Seconds of driving that are worth one euro. It affects routes and destinations; reported times are without it.");
    t.in(&In::distance_factor, "distance_factor")
        .range(0, 1e3)
        .soft(0, 0.5)
        .doc("Seconds that one metre costs besides its time. It affects routes and destinations; reported times are without it.");
    t.in(&In::walking_speed, "walking_speed")
        .unit(Unit::metre_per_second)
        .range(0.1, 10)
        .soft(0.8, 2)
        .doc("Speed on foot: between a zone and the junctions of its access, and along streets.");
    t.in(&In::isochrone_step, "isochrone_step")
        .unit(Unit::second)
        .range(10, 36000)
        .soft(60, 900)
        .doc("Time from one isochrone to the next.");
    t.in(&In::isochrone_bands, "isochrone_bands").range(1, 6).doc("Number of isochrones that are drawn around a selected node.");
    t.in(&In::distribution, "distribution",
         {{traffic::TripConstraint::origins, "singly",
           "The trips that leave each zone are kept; their destinations follow from attraction and time."},
          {traffic::TripConstraint::both, "doubly",
           "The trips that end in each zone are kept as well, in proportion; the table `arrivals` lists what cannot be met."}})
        .doc("Which sums of trips are kept.");
    t.in(&In::fade, "fade")
        .unit(Unit::second)
        .range(1, 1e6)
        .soft(60, 3600)
        .doc("Additional travel time at which a zone attracts only a third as much (1/e). Accessibility uses it as well.");
    t.in(&In::haste, "haste")
        .unit(Unit::ratio)
        .range(0.01, 1)
        .doc("Share of the trips with another best destination that change to it in one tick; less is slower and calmer.");
    t.in(&In::gap, "gap")
        .unit(Unit::ratio)
        .range(1e-12, 0.1)
        .soft(1e-6, 1e-2)
        .doc("Relative gap at which the assignment stops: the share of cost saved if every trip took its cheapest route.");
    t.in(&In::steps, "steps").range(1, 100).soft(1, 20).doc("Largest number of iterations of the assignment in one tick.");
  }

  static void declare_results(Builder& t) {
    t.out(&Out::relative_gap, "relative_gap").means().unit(Unit::ratio).doc("The relative gap that was reached.");
    t.out(&Out::unrest, "unrest")
        .unit(Unit::ratio)
        .residual()
        .doc("The gap while it is above the wanted one, or the share of trips with another best destination, if that is larger.");
    t.out(&Out::trips, "trips").unit(Unit::per_hour).doc("Trips on the streets.");
    t.out(&Out::trips_lost, "trips_lost").unit(Unit::per_hour).doc("Trips that have no route; their zones say why.");
    t.out(&Out::trips_missing, "trips_missing")
        .unit(Unit::per_hour)
        .doc("Trips that should end in zones and do not, where the trips that end in each zone are kept; `arrivals` says why.");
    t.out(&Out::mean_travel_time, "mean_travel_time")
        .unit(Unit::second)
        .doc("Mean time of all trips, with the walk at both ends, without tolls and distance.");
    t.out(&Out::total_time, "total_time")
        .unit(Unit::second)
        .doc("Total time of all trips of one hour, without tolls and distance.");
    t.out(&Out::objective, "objective")
        .doc("Beckmann's objective: the sum of the areas under the curves of time over flow. User equilibrium is its minimum.");
    t.out(&Out::largest_load, "largest_load").unit(Unit::ratio).doc("The largest volume over capacity of all streets.");
    t.out(&Out::message, "message").doc("Streets, zones and turn rules that are left out, and why; empty where none are.");
    t.out(&Out::loads, "loads")
        .column({.id = "junction", .is_text = true, .default_value = std::string(), .doc = "Id of the junction."})
        .column({.id = "volume_over_capacity", .unit = Unit::ratio, .doc = "Largest volume over capacity of the streets there."})
        .doc("Load of the streets at each junction, in ascending id.");
    t.out(&Out::arrivals, "arrivals")
        .column({.id = "zone", .is_text = true, .default_value = std::string(), .doc = "Id of the zone."})
        .column({.id = "wanted", .unit = Unit::per_hour, .doc = "Trips that should end there."})
        .column({.id = "missing", .unit = Unit::per_hour, .doc = "Number of these that do not; below 0 where more end."})
        .column({.id = "reason", .is_text = true, .default_value = std::string(), .doc = "Why, as a sentence."})
        .doc("Zones with another number of trips than should end there, in ascending id, where the trips that end are kept.");
    t.memory(&Out::memory, &In::last, &Memory::links, "links")
        .column({.id = "link",
                 .is_text = true,
                 .default_value = std::string(),
                 .doc = "Street and direction, zone and access, or turn."})
        .doc("The links of the network in ascending id; `ways` refers to their row numbers, counted from 0.");
    t.memory(&Out::memory, &In::last, &Memory::ways, "ways")
        .column({.id = "zone", .is_text = true, .default_value = std::string(), .doc = "The zone that the trips come from."})
        .column({.id = "links",
                 .list = ListOf::indices,
                 .default_value = Indices(),
                 .doc = "The links that its trips use, as row numbers of `links`."})
        .column(
            {.id = "flows", .list = ListOf::numbers, .default_value = Numbers(), .doc = "Trips per hour on each of these links."})
        .column({.id = "trips",
                 .list = ListOf::numbers,
                 .default_value = Numbers(),
                 .doc = "Trips per hour to each zone, in the order of these rows."})
        .doc("Flows of the trips of each zone, and how many go to each other zone: the start of the next tick.");
    t.made("trip_flows", {"links", "ways"}, &traffic::read_flows<Shared<Table>>)
        .doc("The flows of the trips of each zone, for views and exporters.");
  }

  static void declare_sets(Builder& t) {
    auto streets = t.set("streets", &Sets::streets, &Out::streets);
    streets.reads(&Street::id, "node.id").reads(&Street::start, "street.start").reads(&Street::end, "street.end");
    streets.reads(&Street::lanes, "street.lanes").reads(&Street::capacity_per_lane, "street.capacity_per_lane");
    streets.reads(&Street::speed, "street.speed").reads(&Street::length, "street.length").reads(&Street::open, "street.open");
    streets.reads(&Street::toll, "street.toll")
        .reads(&Street::one_way, "street.one_way")
        .reads(&Street::for_cars, "street.for_cars")
        .reads(&Street::course, "street.course", Unit::metre);
    using StreetReply = traffic::DistrictResult::Street;
    streets.writes(&StreetReply::flow_forth, "street.flow_forth").writes(&StreetReply::flow_back, "street.flow_back");
    streets.writes(&StreetReply::time_forth, "street.time_forth").writes(&StreetReply::time_back, "street.time_back");
    streets.writes(&StreetReply::delay, "street.delay").writes(&StreetReply::load, "street.volume_over_capacity");
    streets.writes(&StreetReply::length, "street.used_length").writes(&StreetReply::reason, "street.reason");
    auto junctions = t.set("junctions", &Sets::junctions, &Out::junctions);
    junctions.reads(&traffic::DistrictJunction::id, "node.id")
        .reads(&traffic::DistrictJunction::position, "node.position", Unit::metre);
    using Crossing = traffic::DistrictResult::Junction;
    junctions.reads(&traffic::DistrictJunction::delay, "junction.delay").writes(&Crossing::streets, "junction.streets");
    junctions.writes(&Crossing::flow, "junction.flow").writes(&Crossing::load, "junction.volume_over_capacity");
    auto rules = t.set("junctions", &Sets::rules, &Out::rules);  // those of the junctions that have any
    rules.reads(&Rules::id, "node.id").reads(&Rules::turns, "turn_rules.turns");
    rules.writes(&traffic::DistrictResult::Rules::forbidden, "turn_rules.forbidden");
    rules.writes(&traffic::DistrictResult::Rules::reason, "turn_rules.reason");
    auto zones = t.set("zones", &Sets::zones, &Out::zones);
    using Zone = traffic::DistrictZone;
    zones.reads(&Zone::id, "node.id").reads(&Zone::position, "node.position", Unit::metre);
    zones.reads(&Zone::leaving, "traffic_zone.trips_out").reads(&Zone::arriving, "traffic_zone.trips_in");
    zones.reads(&Zone::access, "traffic_zone.access").reads(&Zone::wants_reach, "traffic_zone.list_reach");
    zones.writes(&ZoneReply::reach, "traffic_zone.reach");
    zones.writes(&ZoneReply::served, "traffic_zone.trips_served").writes(&ZoneReply::lost, "traffic_zone.trips_lost");
    zones.writes(&ZoneReply::ending, "traffic_zone.trips_ending");
    zones.writes(&ZoneReply::mean_time, "traffic_zone.mean_travel_time");
    zones.writes(&ZoneReply::accessibility, "traffic_zone.accessibility").writes(&ZoneReply::reason, "traffic_zone.reason");
  }

  static std::string one_of(const Selection& selection) { return selection.ids.size() == 1 ? selection.ids.front() : ""; }

  // Larger ones come from a damaged file: the list is dropped, and its zone starts anew.
  static std::vector<double> recalled(const Numbers& numbers) {
    constexpr double kLargest = 1e15;
    const bool is_sound = std::all_of(numbers->begin(), numbers->end(), [](double x) { return std::abs(x) <= kLargest; });
    return is_sound ? *numbers : std::vector<double>();
  }

  static traffic::DistrictState recalled(const Memory& last) {
    traffic::DistrictState state;
    for (std::size_t r = 0; r < last.links->rows.size(); ++r) state.links.push_back(last.links->text(r, "link"));
    for (std::size_t r = 0; r < last.ways->rows.size(); ++r)
      state.zones.push_back({last.ways->text(r, "zone"), *last.ways->indices(r, "links"),
                             recalled(last.ways->numbers(r, "flows")), recalled(last.ways->numbers(r, "trips"))});
    return state;
  }

  // The names of links are those of the last tick, unless streets have changed.
  static Memory remembered(const traffic::DistrictState& state, const Memory& last, bool has_last_links) {
    Memory memory = last;
    if (!has_last_links) {
      Table links = *Memory().links;
      for (const std::string& link : state.links) links.rows.push_back({link});
      memory.links = std::move(links);
    }
    Table ways = *Memory().ways;
    for (const traffic::DistrictState::Zone& zone : state.zones)
      ways.rows.push_back({zone.id, Indices(zone.used), Numbers(zone.flows), Numbers(zone.trips)});
    memory.ways = std::move(ways);
    return memory;
  }

  static std::vector<traffic::DistrictRules> rules_of(const Sets& sets) {
    std::vector<traffic::DistrictRules> all;
    for (const Rules& rules : sets.rules) {
      all.push_back({rules.id, {}});
      for (std::size_t r = 0; r < rules.turns.rows.size(); ++r)
        all.back().turns.push_back({rules.turns.text(r, "from"), rules.turns.text(r, "to"), rules.turns.text(r, "rule")});
    }
    return all;
  }

  // All that a step depends on.
  struct Step {
    traffic::DistrictParts parts;
    Memory last;
    bool operator==(const Step&) const = default;
  };
  // A network at rest has the same input in every tick, and a moving one starts from its last result.
  struct Cache {
    Step step;
    std::optional<Out> out;  // of that step, where it ended at rest
    Memory memory;           // the last one, and the same as numbers
    traffic::DistrictState state;
    traffic::DistrictMemo memo;
  };

  static Step step_of(const In& in, const Sets& sets) {
    std::vector<traffic::DistrictStreet> streets;
    for (const Street& s : sets.streets) {
      const double capacity = s.lanes * s.capacity_per_lane * s.open;
      streets.push_back({s.id, one_of(s.start), one_of(s.end), s.length, s.speed, capacity, s.toll, s.one_way, capacity > 0,
                         s.for_cars, s.course});
    }
    const traffic::DistrictSettings settings{in.alpha, in.beta,         in.toll_factor, in.distance_factor, in.walking_speed,
                                             in.fade,  in.distribution, in.gap,         in.steps,           in.haste};
    return {{sets.junctions, std::move(streets), rules_of(sets), sets.zones, settings}, in.last};
  }

  static Result<Out> evaluate(const In& in, const Sets& sets, const Tick& tick) {
    Cache own;
    Cache& kept = tick.memo != nullptr ? tick.memo->of<Cache>() : own;
    Step step = step_of(in, sets);
    if (kept.out && kept.step == step) return *kept.out;
    if (kept.memory != in.last) kept.state = recalled(in.last);
    auto out = worked_out(in, sets, step, kept);
    kept.step = std::move(step);
    kept.out.reset();
    if (out && out->memory == in.last) kept.out = *out;
    kept.memory = out ? out->memory : in.last;
    return out;
  }

  static Result<Out> worked_out(const In& in, const Sets& sets, const Step& step, Cache& kept) {
    auto result = step_district(step.parts, kept.state, &kept.memo);
    if (!result) return Error{result.error().code, "streets", "`" + result.error().place + "`: " + result.error().message};
    Out out;
    out.relative_gap = result->gap;
    out.unrest = std::max(result->gap > in.gap ? result->gap : 0, result->restlessness);
    out.trips = result->trips;
    out.trips_lost = result->lost;
    out.trips_missing = result->missing;
    for (const traffic::DistrictResult::Arrival& row : result->arrivals)
      out.arrivals.rows.push_back({sets.zones[row.zone].id, sets.zones[row.zone].arriving, row.missing, row.reason});
    out.mean_travel_time = result->trips > 0 ? result->total_time / result->trips : 0;
    out.total_time = result->total_time;
    out.objective = result->objective;
    auto left_out = [&](const std::string& id, const std::string& reason) {
      if (!reason.empty()) out.message += (out.message.empty() ? "`" : "; `") + id + "`: " + reason;
    };
    for (std::size_t s = 0; s < result->streets.size(); ++s) {
      out.largest_load = std::max(out.largest_load, result->streets[s].load);
      left_out(sets.streets[s].id, result->streets[s].reason);
    }
    out.rules = std::move(result->rules);
    for (std::size_t j = 0; j < out.rules.size(); ++j) left_out(sets.rules[j].id, out.rules[j].reason);
    for (std::size_t z = 0; z < result->zones.size(); ++z) left_out(sets.zones[z].id, result->zones[z].reason);
    for (std::size_t j = 0; j < result->junctions.size(); ++j)
      out.loads.rows.push_back({sets.junctions[j].id, result->junctions[j].load});
    out.junctions = std::move(result->junctions);
    out.memory = result->is_at_rest ? in.last : remembered(result->state, in.last, result->state.links == kept.state.links);
    kept.state = std::move(result->state);
    out.streets = std::move(result->streets);
    for (const traffic::DistrictResult::Zone& zone : result->zones) {
      ZoneReply& reply = out.zones.emplace_back(ZoneReply{zone.served,
                                                          zone.lost,
                                                          zone.ending,
                                                          zone.mean_time,
                                                          zone.accessibility,
                                                          zone.reason,
                                                          {{"junction", "driving", "walking"}, {}}});
      for (const traffic::DistrictResult::Reach& row : zone.reach)
        reply.reach.rows.push_back({row.junction, row.driving, row.walking});
    }
    return out;
  }
};

}  // namespace
}  // namespace bl

BL_TYPIFICATION(traffic_network, TrafficNetworkNode)
