// Chooses how many whole storeys a volume has and where its lowest floor lies, and compares what it got with what it wants.
#include <algorithm>
#include <cmath>

#include "core/geometry/standing_tick.h"

namespace bl::geometry {

Storeys storeys_of(const StandingWish& wish, double highest) {
  // A hair less than whole storeys is whole storeys: heights are sums of decimal fractions.
  const auto whole = [&wish](double height, double play) {
    return static_cast<int>(std::floor(std::clamp(height / wish.site.storey_height - play, 0.0, kMostStoreys) + 1e-9));
  };
  const int wished = std::min(wish.storeys, whole(highest, 0));
  int allowed = whole(wish.height_limit, 0);
  if (wish.was_limited && wish.built > 0 && allowed > wish.built)
    allowed = std::max(wish.built, whole(wish.height_limit, kStoreyPlay));
  return {std::max({1, wish.least, std::min(wished, allowed)}), allowed < wished};
}

double floor_of(const StandingWish& wish, double underside, double top) {
  return std::max(underside, std::min(wish.ground, top - wish.site.storey_height));
}

Storeys storeys_of(StandingWish wish, std::span<const BuildingShare> shares, double highest, double& storey_height) {
  const auto at = [&] {
    storey_height = wish.site.storey_height = mean_storey_height(shares, wish.storeys);
    return storeys_of(wish, highest);
  };
  Storeys storeys = at();
  const bool is_limited = storeys.is_limited;
  while (storeys.count < wish.storeys) {
    wish.storeys = storeys.count;
    storeys = at();
  }
  return {storeys.count, is_limited};
}

double fitted_volume(const StandingWish& wish, const StandingResult& result) {
  return result.is_shared ? result.floor_area * wish.site.storey_height : result.volume;
}

double error_of(const StandingWish& wish, const StandingResult& result) {
  return wish.volume > 0 ? std::abs(fitted_volume(wish, result) - wish.volume) / wish.volume : 0;
}

}  // namespace bl::geometry
