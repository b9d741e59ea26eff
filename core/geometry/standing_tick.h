// One tick of a solver of standing volumes: whole storeys first, then weights, then plates and what people read of them; level by
// level where volumes stand on the roofs of others.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/boundary_reach.h"
#include "core/geometry/footprint_fit.h"
#include "core/geometry/plates.h"
#include "core/geometry/shared_building.h"

namespace bl::geometry {

/// What one volume asks for.
struct StandingWish {
  static constexpr std::int32_t kGround = -1;

  StandingSite site;             ///< without runs; its position's height does not count
  double volume = 0;             ///< [m³]; over the storey height it is a floor area
  int storeys = 1, least = 1;    ///< wished, and insisted on
  double height_limit = 1e9;     ///< [m] above its lowest floor
  int built = 0;                 ///< storeys of the last tick; 0: none yet
  double least_room = 0;         ///< of the last tick, see Storeys
  double setback = 0;            ///< [m], of the storeys above the first `full_storeys`
  double courtyard_setback = 0;  ///< [m], of the same storeys behind the edge that a constant depth would give the courtyard
  int full_storeys = 0;
  double ground = -1e4;         ///< height of the ground where it stands, unless that is a roof [m]
  std::int32_t base = kGround;  ///< the wish on whose roof it stands
  std::int32_t host = kGround;  ///< the wish whose footprint it shares; none: it has its own
  int order = 0;                ///< among those that share a footprint, from the ground up; of equal ones the host comes first
  bool operator==(const StandingWish&) const = default;
};

struct Storeys {
  int count = 1;            ///< whole, at least 1
  bool is_limited = false;  ///< fewer than wished, by the height limit
  /// Where there are fewer than wished: the least room, in storeys, since there have been as many as now; else 0. `kStoreyPlay`
  /// says when more come back.
  double least_room = 0;
  bool operator==(const Storeys&) const = default;
};
/// `highest`: the height of the boundary above the lowest floor [m].
Storeys storeys_of(const StandingWish& wish, double highest);

/// The height of the lowest floor of a volume on the ground: never below `underside`, nor so high that no storey is left below
/// `top` [m].
double floor_of(const StandingWish& wish, double underside, double top);

/// The same of a building that several volumes share, with the mean height of its storeys [m]: fewer storeys may be higher ones.
Storeys storeys_of(StandingWish wish, std::span<const BuildingShare> shares, double highest, double& storey_height);

/// What one volume has got.
struct StandingResult {
  SiteState state = SiteState::alive;
  Storeys storeys;                                 ///< its own: those in which it has a part
  int storeys_held = 1;                            ///< those that limits of height hold: of a host those of the whole building
  bool is_shared = false;                          ///< it has a part of a building; the others have buildings of their own
  std::int32_t stands_on = StandingWish::kGround;  ///< the wish that has the storey, or the roof, below
  double weight = 0;                               ///< [m²]
  double volume = 0, floor_area = 0, footprint = 0, height = 0, bottom = 0;
  double facade_area = 0, free_facade_area = 0, roof_area = 0;  ///< [m²]; free: towards no neighbour
  Point3 centroid;
  std::vector<std::pair<std::uint32_t, double>> walls;  ///< area of the walls shared with other sites [m²]
  BoundaryReach outside;                                ///< of the boundary
  std::shared_ptr<const StandingBody> body;
  MeshPointer mesh;
};

/// What is compared with what is wanted: floor area by the volume's own storey height. In a storey that it shares, the volume may
/// be more than that [m³].
double fitted_volume(const StandingWish& wish, const StandingResult& result);
/// By how much it misses what is wanted, as a share of that; 0 where nothing is.
double error_of(const StandingWish& wish, const StandingResult& result);

/// One tick. Volumes on one roof divide its plate among themselves as those on the ground divide the plot, and never compete with
/// what carries them. A volume below does not depend on those above it, so levels are fitted one after the other, and demands are
/// met as exactly on roofs as on the ground. Of a round roof they get the chords within `kRoofTolerance`.
struct StandingTick {
  static constexpr double kRoofTolerance = 1e-4;  // [m]

  int steps = 4;  ///< at most so many steps; 0: the plates of the present weights
  double tolerance = 0.005;
  std::span<const StreetAxis> streets = {};  ///< sides of the ground along them have distances of their own
  const Domain* land = nullptr;              ///< the domain with the ground that it leaves out; nullptr: it leaves out nothing
  ThreadPool* pool = nullptr;

  /// Those who stand on the ground, or on one roof.
  struct Level {
    std::int32_t base = StandingWish::kGround;
    std::vector<std::uint32_t> members;  ///< numbers of wishes, ascending
    FootprintDiagram diagram;
    Domain domain;                              ///< of a roof, up to the height `top`
    std::shared_ptr<const StandingBody> below;  ///< whose roof `domain` is; nullptr where it has to be found
    double top = 0;                             ///< [m]
  };
  struct Cache {
    std::vector<Level> levels;                              ///< those on the ground first; each after that of its base
    std::vector<StandingResult> results;                    ///< of hosts: of the whole building; of who shares it: nothing
    std::vector<std::vector<BuildingShare>> shares;         ///< per wish: of a host, who shares its footprint; else none
    std::vector<std::vector<BuildingShare>> shares_before;  ///< of the last tick
    std::vector<SharedBuilding> buildings;                  ///< per wish: of a host
    std::vector<StandingResult> parts;                      ///< what each wish has, where somebody shares a footprint
    double plot_area = 0;                                   ///< [m²]
  };
  /// What cannot be met on one level.
  struct LevelWord {
    std::int32_t base = StandingWish::kGround;
    std::string text;
  };
  struct Outcome {
    std::span<const StandingResult> results;  ///< in the cache, valid until its next use: what each wish has
    std::vector<std::uint32_t> differing;     ///< ascending: those whose result may differ from the last one in the cache
    std::vector<FloorLoss> losses;            ///< by site
    std::string message;                      ///< a sentence where the demands on the ground cannot be met together
    std::vector<LevelWord> on_roofs;          ///< the same of roofs, by their bases, and why a roof carries nothing
    std::vector<std::uint32_t> in_circles;    ///< those that would stand upon themselves: they are put on the ground
  };
  /// Errors call wish 3 "site 3" (`with_names` of fit_text.h).
  Result<Outcome> run(const Domain& domain, std::span<const StandingWish> wishes, Cache& kept) const;

 private:
  Result<void> run_level(const Domain& ground, double bottom, std::span<const StandingWish> wishes, Level& level, Cache& kept,
                         Outcome& outcome) const;
  void share_buildings(std::span<const StandingWish> wishes, Cache& kept, Outcome& outcome) const;
  static void measure_outside(const Domain& domain, bool is_known, Cache& kept, const Outcome& outcome);
  static void split_losses(std::span<const StandingWish> wishes, const Cache& kept, Outcome& outcome);
  Result<void> run_roof(const Domain& ground, std::span<const StandingWish> wishes, Level& level, Cache& kept,
                        Outcome& outcome) const;
};

}  // namespace bl::geometry
