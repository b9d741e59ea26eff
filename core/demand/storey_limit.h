// How rules that limit heights take storeys from volumes that stand, and give them back.
#pragma once

#include <optional>
#include <string>

#include "core/base/storey_play.h"

namespace bl::demand {

/// The storeys that one tick takes or gives back, at most. What a storey has changed is measured some ticks later: at a faster
/// pace the next storey would go before it is known what the last one was worth.
inline constexpr double kStoreyPace = 0.1;
/// What a rule knows of a volume that stands.
struct StandingVolume {
  int built = 0, wished = 0;  ///< storeys
  int least = 1;              ///< storeys that are insisted on
  double storey_height = 3;   ///< [m]
  double limit = 0;           ///< the height limit in force [m]
  bool is_locked = false;     ///< people have locked that limit
};

/// The storeys below which a rule does not go that leaves this share of them.
double least_storeys(const StandingVolume& volume, double share);
/// Can the rule take no further storey? The limit is down to the least ones, or is locked, and the volume has followed.
bool is_at_least(const StandingVolume& volume, double share);
/// Does this limit [m] take storeys that are wished?
bool takes_storeys(const StandingVolume& volume, double limit);

/// Is this limit [m] of a rule the one in force, and not a tighter one of others? Then the rule holds the volume.
bool is_in_force(const StandingVolume& volume, double limit);

/// The limits [m] of the next tick; but for the first, nothing where all storeys are granted with room for their return, because
/// a limit above them has no effect and would still be in force when more are wished. Lower by so many storeys, from one above
/// those that stand, and never below `share` of them:
std::optional<double> lower_limit(const StandingVolume& volume, double storeys, double share);
/// Higher by one step of the pace.
std::optional<double> higher_limit(const StandingVolume& volume);
/// As it is, where it takes storeys; else a step higher, so that a limit without effect goes away.
std::optional<double> kept_limit(const StandingVolume& volume);

/// One that follows from a height up to which the volume may reach [m]; never below `share` of the storeys.
std::optional<double> limit_at(const StandingVolume& volume, double height, double share);

/// "6 of 8 storeys, because it may be no higher than 19.90 m"; where the limit leaves room for another storey, at which height it
/// comes back at the latest.
std::string storeys_left(const StandingVolume& volume, double limit);
/// "held by `tower`, which keeps at least 3 storeys", or that its limit is locked; or how many it has, where these are fewer.
std::string held_at_least(const std::string& id, const StandingVolume& volume, double share);
/// What would let it have fewer or lower storeys: "lower `storeys_min`", where that is what insists on them.
std::string way_to_fewer(const StandingVolume& volume, double share);

}  // namespace bl::demand
