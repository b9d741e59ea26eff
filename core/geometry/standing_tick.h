// One tick of a solver of standing volumes: whole storeys first, then weights, then plates and what people read of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/footprint_fit.h"
#include "core/geometry/plates.h"

namespace bl::geometry {

/// What one volume asks for.
struct StandingWish {
  StandingSite site;           ///< without runs; its position's height does not count
  double volume = 0;           ///< [m³]; over the storey height it is a floor area
  int storeys = 1, least = 1;  ///< wished, and insisted on
  double height_limit = 1e9;   ///< [m] above the ground
  int built = 0;               ///< storeys of the last tick; 0: none yet
  bool was_limited = false;    ///< by the height limit, in the last tick
  double setback = 0;          ///< [m], of the storeys above the first `full_storeys`
  int full_storeys = 0;
  bool operator==(const StandingWish&) const = default;
};

/// A storey that a height limit has taken away comes back when the limit leaves room for it and this share of a storey more, so
/// that storeys do not come and go with a limit that trembles.
inline constexpr double kStoreyPlay = 0.15;

struct Storeys {
  int count = 1;            ///< whole, at least 1
  bool is_limited = false;  ///< fewer than wished, by the height limit
  bool operator==(const Storeys&) const = default;
};
/// `highest`: the height of the boundary [m].
Storeys storeys_of(const StandingWish& wish, double highest);

/// What one volume has got.
struct StandingResult {
  SiteState state = SiteState::alive;
  Storeys storeys;
  double weight = 0;  ///< [m²]
  double volume = 0, floor_area = 0, footprint = 0, height = 0, bottom = 0;
  double facade_area = 0, free_facade_area = 0, roof_area = 0;  ///< [m²]; free: towards no neighbour
  Point3 centroid;
  std::vector<std::pair<std::uint32_t, double>> walls;  ///< area of the walls shared with other sites [m²]
  std::shared_ptr<const StandingBody> body;
  MeshPointer mesh;
};

struct StandingTick {
  int steps = 4;  ///< at most so many steps; 0: the plates of the present weights
  double tolerance = 0.005;
  ThreadPool* pool = nullptr;

  struct Cache {
    FootprintDiagram diagram;
    std::vector<StandingResult> results;
  };
  struct Outcome {
    std::span<const StandingResult> results;  ///< in the cache, valid until its next use
    std::vector<std::uint32_t> differing;     ///< ascending: those whose result may differ from the last one in the cache
    std::vector<FloorLoss> losses;            ///< by site
    std::string message;                      ///< a sentence where the demands cannot be met together
  };
  Result<Outcome> run(const Domain& domain, std::span<const StandingWish> wishes, Cache& kept) const;
};

}  // namespace bl::geometry
