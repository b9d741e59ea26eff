// A compass of eight sectors.
#include "core/facade/orientation.h"

#include <array>
#include <cmath>
#include <numbers>

#include "core/base/mathematics.h"

namespace bl::facade {

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
  const double bearing = mathematics::arc_tangent(normal.x, normal.y) * 180 / std::numbers::pi - true_north;
  // A hair of help to the clockwise side, so that walls on a border do not change with their rounding.
  const double turns = (bearing + 22.5 + 1e-9) / 45, sector = std::floor(turns);
  const double rest = sector - 8 * std::floor(sector / 8);
  return static_cast<Orientation>(static_cast<int>(rest) & 7);
}

Compass::Compass(double true_north)
    : true_north_(true_north),
      sine_(mathematics::sine(true_north * std::numbers::pi / 180)),
      cosine_(mathematics::cosine(true_north * std::numbers::pi / 180)) {}

Orientation Compass::of(const Vector3& normal) const {
  const auto quick = of_about(normal);
  return quick ? *quick : orientation_of(normal, true_north_);
}

std::optional<Orientation> Compass::of_about(const Vector3& normal) const {
  const double east = normal.x * cosine_ - normal.y * sine_, north = normal.y * cosine_ + normal.x * sine_;
  const double across = std::abs(east), along = std::abs(north);
  constexpr double kBorder = 0.41421356237309503;  // tan 22.5°
  // So near a border the angle decides: there rounding, and the hair of help, could tell another side.
  const double doubtful = 1e-8 * (across + along), from_north = across - kBorder * along, from_east = along - kBorder * across;
  if (!(std::abs(from_north) > doubtful) || !(std::abs(from_east) > doubtful)) return std::nullopt;
  if (from_north < 0) return north > 0 ? Orientation::north : Orientation::south;
  if (from_east < 0) return east > 0 ? Orientation::east : Orientation::west;
  if (north > 0) return east > 0 ? Orientation::north_east : Orientation::north_west;
  return east > 0 ? Orientation::south_east : Orientation::south_west;
}

}  // namespace bl::facade
