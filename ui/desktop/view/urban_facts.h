// What the 3D view shows of a city around the volumes: streets, buildings, ground, sun maps, shadows, data, plots.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/graph/state.h"
#include "core/sun/sun_place.h"

namespace bl::desktop {

struct StreetFacts {
  std::uint32_t node = 0, start = 0, end = 0;  ///< indices in the state
  std::string id;
  double flow = 0, load = 0;  ///< [1/h] both ways; volume over capacity
  bool is_open = true, is_for_cars = true;
  std::vector<Point3> course;  ///< between its ends, in plan
  std::vector<Point3> line;    ///< from end to end, as it is drawn
};

/// A building that stands already.
struct BodyFacts {
  std::uint32_t node = 0;
  std::string id, name;
  MeshPointer mesh, cell;  ///< as the state has it; the same as a cell that no ball cuts, for the renderer and for picking
  std::vector<std::pair<Point3, Point3>> edges;
  bool is_assumed = false;  ///< nobody measured its height
};

/// Sun per day on a grid of points, as squares of equal steps.
struct SunMapFacts {
  std::uint32_t node = 0;
  std::string id;
  double highest = 0;                ///< [s] that step `kSunSteps` stands for
  const Table* source = nullptr;     ///< what the squares were made of; only compared
  std::map<int, MeshPointer> steps;  ///< the squares of each step from 0 to kSunSteps
};
inline constexpr int kSunSteps = 12;

/// Values on points of the ground.
struct DataFacts {
  std::uint32_t node = 0;
  std::string id, quantity, unit;
  double low = 0, high = 0;
  std::vector<std::pair<Point3, double>> values;
};

/// A ring of points: a plot, or a shadow on the ground.
struct RingFacts {
  std::uint32_t node = 0;
  std::string id;
  std::vector<Point3> ring;
  bool is_overshot = false;  ///< of plots: more is built than its rules allow
};

/// A moment by the clock of a place.
struct SunClock {
  sun::DayNumber day = 0;
  double seconds = 0;  ///< after midnight
  bool operator==(const SunClock&) const = default;
};

/// The sun over a place, as the settings say now: also where no tick has followed them yet.
struct SunFacts {
  std::uint32_t node = 0;
  std::string id;
  sun::SunPlace place;
  SunClock clock;
  double added_days = 0;  ///< what the node adds to its date
  Vector3 toward;         ///< unit vector to the sun at that moment; below the horizon it points downwards
  bool is_ahead = false;  ///< the state's results are of an earlier sun
};
Vector3 direction_to_sun(const sun::SunPlace& place, const SunClock& clock);

/// A node with a shape that takes sun from others.
struct CasterFacts {
  std::uint32_t node = 0;
  std::string id;
  MeshPointer mesh;
  double ground = 0;  ///< of the study that it belongs to, where its shadow falls [m]
};

struct UrbanFacts {
  std::vector<StreetFacts> streets;
  std::vector<BodyFacts> bodies;
  std::vector<SunMapFacts> sun_maps;
  std::vector<DataFacts> layers;
  std::vector<RingFacts> plots, shadows;
  std::vector<std::pair<std::uint32_t, MeshPointer>> grounds;
  std::vector<SunFacts> suns;
  std::vector<CasterFacts> casters;
  Vector3 sun;               ///< towards the first; 0 where there is none, or it is below the horizon
  std::int64_t sun_age = 0;  ///< ticks since the data that the sun maps fit; -1: there is no result yet
  double most_flow = 0;      ///< [1/h]
  /// Flow by street of the trips that begin at a zone: what "its routes" are; by node index of the zone.
  std::map<std::uint32_t, std::map<std::uint32_t, double>> routes;

  bool is_empty() const { return streets.empty() && bodies.empty() && sun_maps.empty() && layers.empty() && grounds.empty(); }
};

/// `last`: those of an earlier state, of which meshes that have not changed are taken over; may be null.
UrbanFacts read_urban(const State& state, const UrbanFacts* last);

/// The node of that typification which has the node among its members, such as the traffic network of a street; nodes.size()
/// where there is none.
std::uint32_t keeper_of(const Plan& plan, std::uint32_t node, std::string_view type);

}  // namespace bl::desktop
