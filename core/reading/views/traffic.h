// Streets, junctions, zones and the network that carries their trips.
#pragma once

#include <memory>

#include "core/reading/view.h"
#include "core/traffic/trip_flows.h"

namespace bl::reading {

/// A street between two junctions, and what drives on it.
struct StreetFigures {
  Selection start;
  Selection end;
  std::vector<Point3> course;    ///< between its ends [m]
  double lanes = 0;              ///< each way
  double capacity_per_lane = 0;  ///< [1/h]
  double open = 0;               ///< share of its capacity that is open
  bool one_way = false;
  bool for_cars = false;
  double flow_forth = 0;  ///< [1/h]
  double flow_back = 0;   ///< [1/h]
  double time_forth = 0;  ///< [s]
  double time_back = 0;   ///< [s]
  double volume_over_capacity = 0;
  double used_length = 0;  ///< [m]
  std::string reason;      ///< why nobody drives here

  static void declare(ViewBuilder<StreetFigures>& v);
  static const ViewDefinition& view();
};

/// Where streets meet.
struct JunctionPlace {
  Point3 position;  ///< [m]

  static void declare(ViewBuilder<JunctionPlace>& v);
  static const ViewDefinition& view();
};

/// Which turns are forbidden at a junction.
struct TurnRules {
  Shared<Table> turns;

  static void declare(ViewBuilder<TurnRules>& v);
  static const ViewDefinition& view();
};

/// Where trips begin and end.
struct ZoneFigures {
  std::vector<std::string> access;  ///< ids of junctions
  std::string reason;               ///< why its trips have no way to go

  static void declare(ViewBuilder<ZoneFigures>& v);
  static const ViewDefinition& view();
};

/// The network: how its flows stand, and how far one walks.
struct NetworkFigures {
  Selection streets;          ///< that belong to it
  Selection junctions;        ///< where they meet
  double walking_speed = 0;   ///< [m/s]
  double isochrone_step = 0;  ///< [s]
  std::int64_t isochrone_bands = 0;
  double gap = 0;                                        ///< that is good enough
  double relative_gap = 0;                               ///< that was reached
  std::shared_ptr<const traffic::TripFlows> trip_flows;  ///< by the zone where they begin

  static void declare(ViewBuilder<NetworkFigures>& v);
  static const ViewDefinition& view();
};

}  // namespace bl::reading
