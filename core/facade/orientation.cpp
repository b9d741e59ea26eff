// A compass of eight sectors.
#include "core/facade/orientation.h"

#include <array>
#include <cmath>
#include <numbers>

namespace bl {

namespace {

constexpr std::array<std::string_view, kOrientations> kNames{"north", "north_east", "east", "south_east",
                                                             "south", "south_west", "west", "north_west"};

}  // namespace

std::string_view name_of(Orientation orientation) { return kNames[static_cast<std::size_t>(orientation)]; }

std::optional<Orientation> orientation_named(std::string_view name) {
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (kNames[k] == name) return static_cast<Orientation>(k);
  return std::nullopt;
}

Orientation orientation_of(const Vector3& normal, double true_north) {
  if (normal.x == 0 && normal.y == 0) return Orientation::north;
  const double bearing = std::atan2(normal.x, normal.y) * 180 / std::numbers::pi - true_north;
  // A hair of help to the clockwise side, so that walls on a border do not change with their rounding.
  const double turns = (bearing + 22.5 + 1e-9) / 45, sector = std::floor(turns);
  const double rest = sector - 8 * std::floor(sector / 8);
  return static_cast<Orientation>(static_cast<int>(rest) & 7);
}

}  // namespace bl
