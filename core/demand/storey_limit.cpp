// Moves height limits by steps that storeys and studies can follow.
#include "core/demand/storey_limit.h"

#include <algorithm>
#include <cmath>

#include "core/base/plural.h"
#include "core/base/text.h"

namespace bl::demand {

namespace {

constexpr double kWhole = 1e-9;  // a hair less than whole storeys is whole storeys

// Storeys that the limit in force leaves room for, and not more than one beyond those that stand: a limit far above has no
// effect, and a rule begins where it has.
double room_of(const StandingVolume& volume) { return std::min(volume.limit / volume.storey_height, volume.built + 1.0); }

std::optional<double> limit_for(const StandingVolume& volume, double storeys) {
  if (storeys >= volume.wished + kStoreyPlay) return std::nullopt;
  return storeys * volume.storey_height;
}

}  // namespace

double least_storeys(const StandingVolume& volume, double share) {
  return std::max({1.0, static_cast<double>(volume.least), std::ceil(share * volume.wished - kWhole)});
}

bool is_at_least(const StandingVolume& volume, double share) {
  const double least = least_storeys(volume, share);
  return volume.is_locked || (volume.built <= least && volume.limit <= least * volume.storey_height * (1 + kWhole));
}

bool takes_storeys(const StandingVolume& volume, double limit) {
  const double storeys = limit / volume.storey_height + kWhole;
  return volume.built < volume.wished ? storeys < volume.wished + kStoreyPlay : std::floor(storeys) < volume.wished;
}

bool is_in_force(const StandingVolume& volume, double limit) { return limit <= volume.limit * (1 + kWhole); }

std::optional<double> lower_limit(const StandingVolume& volume, double storeys, double share) {
  if (volume.built < 1) return kept_limit(volume);  // no solver has seen it yet
  return std::max(least_storeys(volume, share), room_of(volume) - storeys) * volume.storey_height;
}

std::optional<double> higher_limit(const StandingVolume& volume) {
  if (volume.limit >= (volume.wished + kStoreyPlay) * volume.storey_height) return std::nullopt;
  // Beyond its return nothing is needed of the next storey, before this one is measured.
  return limit_for(volume, std::min(volume.limit / volume.storey_height + kStoreyPace, volume.built + 1 + kStoreyPlay));
}

std::optional<double> kept_limit(const StandingVolume& volume) {
  if (!takes_storeys(volume, volume.limit)) return higher_limit(volume);
  return limit_for(volume, volume.limit / volume.storey_height);
}

std::optional<double> limit_at(const StandingVolume& volume, double height, double share) {
  return limit_for(volume, std::max(least_storeys(volume, share), height / volume.storey_height));
}

std::string storeys_left(const StandingVolume& volume, double limit) {
  const std::string words = std::to_string(volume.built) + " of " + std::to_string(volume.wished) +
                            " storeys, because it may be no higher than " + fixed(limit, 2) + " m";
  // A storey that has gone with a limit that trembles does not come back with it.
  if (volume.built >= volume.wished || limit < (volume.built + 1 - kWhole) * volume.storey_height) return words;
  return words + " (one more comes back from " + fixed((volume.built + 1 + kStoreyPlay) * volume.storey_height, 2) + " m on)";
}

std::string held_at_least(const std::string& id, const StandingVolume& volume, double share) {
  if (volume.is_locked) return "held by `" + id + "` (its height limit is locked)";
  const double least = least_storeys(volume, share);
  // Who asks for so many is no secret of the rule.
  const bool by_share = least > std::max(1, volume.least);
  // Where others leave it fewer already, it keeps what there is.
  const auto had = static_cast<std::size_t>(std::max(0, volume.built));
  const std::string keeps = had > 0 && static_cast<double>(had) < least
                                ? "has " + how_many(had, "storey") + (had == 1 ? ", which is not" : ", none of which is") +
                                      " taken, because it may keep " + shortest(least)
                                : "keeps at least " + shortest(least) + (least == 1 ? " storey" : " storeys");
  return "held by `" + id + "`, which " + keeps +
         (by_share ? " (`least`: " + shortest(std::round(1000 * share) / 10) + " % of " + std::to_string(volume.wished) + ")"
          : volume.least > 1 ? " (`storeys_min`)"
                             : "");
}

std::string way_to_fewer(const StandingVolume& volume, double share) {
  if (volume.is_locked) return "unlock the height limit";
  const double least = least_storeys(volume, share);
  if (least <= 1) return "lower `storey_height`";
  const bool is_fewer = volume.built < least;  // fewer that are wished would do
  const bool by_people = volume.least >= least, by_share = std::ceil(share * volume.wished - kWhole) >= least;
  return by_people && by_share ? "lower `storeys_min` and `least`"
         : by_people           ? "lower `storeys_min`"
         : is_fewer            ? "lower `storeys` or `least`"
                               : "lower `least`";
}

}  // namespace bl::demand
