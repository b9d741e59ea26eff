// Chooses how many whole storeys a volume has and where its lowest floor lies, and compares what it got with what it wants.
#include <algorithm>
#include <cmath>

#include "core/base/storey_play.h"
#include "core/geometry/standing_tick.h"

namespace bl::geometry {

namespace {

// Of the boundary and the limit, in storeys of this height [m].
double room_for(const StandingWish& wish, double highest, double storey_height) {
  return std::clamp(std::min(wish.height_limit, highest) / storey_height, 0.0, static_cast<double>(kMostStoreys));
}

// What the next tick has to know of the room that there was.
double room_to_keep(const StandingWish& wish, int wished, int count, double room) {
  if (count >= wished) return 0;
  return count == wish.built && wish.least_room > 0 ? std::min(wish.least_room, room) : room;
}

}  // namespace

Storeys storeys_of(const StandingWish& wish, double highest) {
  // A hair less than whole storeys is whole storeys: heights are sums of decimal fractions.
  constexpr double kHair = 1e-9;
  const auto whole = [](double room) { return static_cast<int>(std::floor(std::max(0.0, room) + kHair)); };
  const double room = room_for(wish, highest, wish.site.storey_height);
  int allowed = whole(room);
  const bool trembles = wish.built > 0 && wish.least_room > 0 && room + kHair < wish.least_room + kStoreyPlay;
  if (trembles && allowed > wish.built) allowed = std::max(wish.built, whole(room - kStoreyPlay));
  Storeys storeys{std::max({1, wish.least, std::min(wish.storeys, allowed)})};
  storeys.is_limited = wish.height_limit < highest && allowed < std::min(wish.storeys, whole(highest / wish.site.storey_height));
  storeys.least_room = room_to_keep(wish, wish.storeys, storeys.count, room);
  return storeys;
}

double floor_of(const StandingWish& wish, double underside, double top) {
  return std::max(underside, std::min(wish.ground, top - wish.site.storey_height));
}

Storeys storeys_of(StandingWish wish, std::span<const BuildingShare> shares, double highest, double& storey_height) {
  // What is kept of the room is in storeys of the building that is wished.
  const int wished = wish.storeys;
  const double wished_height = mean_storey_height(shares, wished), kept = wish.least_room;
  const auto at = [&] {
    storey_height = wish.site.storey_height = mean_storey_height(shares, wish.storeys);
    wish.least_room = kept * wished_height / storey_height;
    return storeys_of(wish, highest);
  };
  Storeys storeys = at();
  const bool is_limited = storeys.is_limited;
  while (storeys.count < wish.storeys) {
    wish.storeys = storeys.count;
    storeys = at();
  }
  wish.least_room = kept;
  return {storeys.count, is_limited, room_to_keep(wish, wished, storeys.count, room_for(wish, highest, wished_height))};
}

double fitted_volume(const StandingWish& wish, const StandingResult& result) {
  return result.is_shared ? result.floor_area * wish.site.storey_height : result.volume;
}

double error_of(const StandingWish& wish, const StandingResult& result) {
  return wish.volume > 0 ? std::abs(fitted_volume(wish, result) - wish.volume) / wish.volume : 0;
}

}  // namespace bl::geometry
