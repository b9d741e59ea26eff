// The eight orientations of façades, by which styles and figures are told apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/vector.h"

namespace bl::facade {

/// Sectors of 45 degrees around the points of the compass, clockwise from true north.
enum class Orientation : std::uint8_t { north, north_east, east, south_east, south, south_west, west, north_west };
inline constexpr std::size_t kOrientations = 8;

std::string_view name_of(Orientation orientation);
/// The orientation of that name, or nothing.
std::optional<Orientation> orientation_named(std::string_view name);

/// Where a face with this outward normal looks to. `true_north`: where it lies, clockwise from the scene's y axis [degree]. A
/// level normal is not needed, but one that points straight up or down counts as north. On the border of two sectors the
/// clockwise one has it.
Orientation orientation_of(const Vector3& normal, double true_north);

/// The same for many normals: away from the borders of sectors two comparisons tell them apart.
class Compass {
 public:
  explicit Compass(double true_north);
  Orientation of(const Vector3& normal) const;
  /// Of a normal of any length that is known to a billionth only; nothing near the border of two sectors.
  std::optional<Orientation> of_about(const Vector3& normal) const;

 private:
  double true_north_, sine_, cosine_;
};

}  // namespace bl::facade
