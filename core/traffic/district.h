// One step of a district's traffic: streets, junctions and zones by id in, flows and times out, and what the next step needs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"
#include "core/traffic/trip_distribution.h"

namespace bl::traffic {

struct DistrictJunction {
  std::string id;
  Point3 position;
  double delay = 0;  ///< [s] that everybody loses who arrives
  bool operator==(const DistrictJunction&) const = default;
};

struct DistrictStreet {
  std::string id, start, end;                                   ///< ids of junctions
  double length = 0, speed = 0, capacity = 0, toll = 0;         ///< [m] (0: as its line runs), [m/s], [1/h], of each direction
  bool is_one_way = false, is_open = true, is_for_cars = true;  ///< who may pass
  std::vector<Point3> course = {};                              ///< points between its ends, in plan; none: it runs straight
  bool operator==(const DistrictStreet&) const = default;
};

/// `no` forbids to go on from one street by the other one, `only` forbids all else. Both the same: turning round.
struct DistrictTurn {
  std::string from, to, rule = "no";  ///< ids of two streets
  bool operator==(const DistrictTurn&) const = default;
};
struct DistrictRules {
  std::string junction;  ///< id of the junction where they meet
  std::vector<DistrictTurn> turns;
  bool operator==(const DistrictRules&) const = default;
};

struct DistrictZone {
  std::string id;
  Point3 position;
  double leaving = 0, arriving = 0;  ///< trips [1/h]
  std::vector<std::string> access;   ///< ids of junctions; empty: the junction of the zone's own id, where there is one
  bool wants_reach = false;          ///< lists its times to all junctions
  bool operator==(const DistrictZone&) const = default;
};

struct DistrictSettings {
  double alpha = 0.15, beta = 4;
  double toll_factor = 0, distance_factor = 0;  ///< [s per unit of toll], [s/m]
  double walking_speed = 1.34;                  ///< [m/s], between a zone and its junctions
  double fade = 600;                            ///< [s] of the gravity model
  TripConstraint constraint = TripConstraint::origins;
  double gap = 1e-4;
  int steps = 2;       ///< iterations of one step at most
  double haste = 0.5;  ///< share of the change of trips that one step makes
  bool operator==(const DistrictSettings&) const = default;
};

/// All that a step depends on besides the last one.
struct DistrictParts {
  std::vector<DistrictJunction> junctions;
  std::vector<DistrictStreet> streets;
  std::vector<DistrictRules> rules;
  std::vector<DistrictZone> zones;
  DistrictSettings settings;
  bool operator==(const DistrictParts&) const = default;
};

/// What the next step starts from. What speaks of a zone or a link that is gone is passed over.
struct DistrictState {
  struct Zone {
    std::string id;
    std::vector<std::uint32_t> used;  ///< of `links`: those that its trips are on, each once
    std::vector<double> flows;        ///< [1/h], as `used`
    std::vector<double> trips;        ///< [1/h], to each of `zones`
    bool operator==(const Zone&) const = default;
  };
  std::vector<std::string> links;  ///< ids
  std::vector<Zone> zones;

  /// Trips from one zone to another [1/h].
  double trips(const std::string& origin, const std::string& destination) const;
  bool operator==(const DistrictState&) const = default;
};

struct DistrictResult {
  struct Street {
    double flow_forth = 0, flow_back = 0, time_forth = 0, time_back = 0;  ///< [1/h], [s]
    double delay = 0, load = 0, length = 0;                               ///< the larger of both directions; [m]
    std::string reason;                                                   ///< why no car can drive here; empty where cars can
  };
  struct Rules {
    int forbidden = 0;   ///< turns that could be taken without them
    std::string reason;  ///< those without effect, with place ("turns/1/from") and reason; empty where all apply
  };
  struct Junction {
    int streets = 0;
    double flow = 0, load = 0;  ///< what arrives by streets; the largest volume over capacity of its streets
  };
  /// Times from a zone to a junction [s]; below 0 where there is no way. By car along the cheapest way.
  struct Reach {
    std::string junction;
    double driving = -1, walking = -1;
  };
  struct Zone {
    double served = 0, lost = 0;  ///< trips that leave, and that would [1/h]
    double ending = 0;            ///< trips that end here [1/h]
    double mean_time = 0;         ///< of the trips that leave, on the ways that they use [s]
    double accessibility = 0;     ///< trips that end elsewhere, faded by the time that the cheapest way there takes [1/h]
    std::string reason;           ///< why trips are lost; empty where none are
    std::vector<Reach> reach;     ///< to junctions that can be reached, as they are given; only where it is wanted
  };
  /// A zone where the number of trips that end differs from the wanted one, although it should be kept.
  struct Arrival {
    std::size_t zone = 0;  ///< as given
    double missing = 0;    ///< of the wanted ones [1/h]; below 0 where more end there
    std::string reason;
  };
  std::vector<Arrival> arrivals;  ///< ascending zone; empty where what ends in zones follows attraction alone
  double missing = 0;             ///< of all zones that get too few [1/h]
  std::vector<Street> streets;    ///< as given, and so below
  std::vector<Rules> rules;
  std::vector<Junction> junctions;
  std::vector<Zone> zones;
  double gap = 0, restlessness = 0;  ///< the latter: share of the trips that wants to go elsewhere than it does
  double trips = 0, lost = 0;        ///< [1/h]
  double total_time = 0;             ///< vehicle seconds in an hour
  double objective = 0;              ///< Beckmann's, of costs
  int iterations = 0;
  bool is_at_rest = false;  ///< neither trips nor routes have changed: `state` is the last one, bit for bit
  DistrictState state;
};

/// What a step has worked out and the next one can use again: the network, and the shortest ways. It saves work and never changes
/// a bit of what comes out.
class DistrictMemo {
 public:
  DistrictMemo();
  DistrictMemo(DistrictMemo&&) noexcept;
  DistrictMemo& operator=(DistrictMemo&&) noexcept;
  ~DistrictMemo();

  struct Content;
  std::unique_ptr<Content> held;  ///< nullptr before the first step
};

/// Ways and destinations are chosen by generalised cost: time, with tolls and distance as time. What is told of them is time
/// alone. Distributes the trips by the costs of the last step, puts them on the streets and goes `steps` iterations on, from the
/// last flows. A pure function of its arguments. An error's place is the id of what is wrong. Turns hold for cars, not on foot.
Result<DistrictResult> step_district(const DistrictParts& parts, const DistrictState& last, DistrictMemo* memo = nullptr);

}  // namespace bl::traffic
