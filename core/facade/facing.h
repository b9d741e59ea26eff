// What a piece of a shape's surface counts as: façade towards an orientation, roof, or underside.
#pragma once

#include <cstdint>

#include "core/base/vector.h"
#include "core/facade/orientation.h"

namespace bl::facade {

/// What is steeper than 45 degrees is façade; `orientation` is where façade looks to.
struct Facing {
  enum class Side : std::uint8_t { facade, roof, underside } side = Side::facade;
  Orientation orientation = Orientation::north;
};

/// Steeper than 45 degrees: |n.z| <= cos 45°.
inline constexpr double kSteep = 0.70710678118654757;

/// Of a piece with this outward normal, which has length one.
inline Facing facing_of(const Vector3& normal, const Compass& compass) {
  if (normal.z > kSteep) return {Facing::Side::roof};
  if (normal.z < -kSteep) return {Facing::Side::underside};
  return {Facing::Side::facade, compass.of(normal)};
}

}  // namespace bl::facade
