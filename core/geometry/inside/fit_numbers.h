// Conversions between weights, radii and volumes, from correctly rounded operations only: the same bits everywhere.
#pragma once

#include <cmath>
#include <numbers>

namespace bl::geometry {

/// Cube root by Newton's steps from a power of two; 0 for what is not positive.
inline double cube_root(double x) {
  if (!(x > 0)) return 0;
  int exponent = 0;
  (void)std::frexp(x, &exponent);
  double root = std::ldexp(1.0, exponent / 3 + (exponent > 0 ? 1 : 0));
  for (int i = 0; i < 8; ++i) root -= (root * root * root - x) / (3 * root * root);
  return root;
}

/// r³ [m³] of a weight r² [m²], and back.
inline double cube_of_radius(double weight) { return weight * std::sqrt(weight); }
inline double weight_of_cube(double cube) {
  const double radius = cube_root(cube);
  return radius * radius;
}
/// The weight [m²] whose whole ball has this volume [m³].
inline double weight_of_volume(double volume) { return weight_of_cube(volume / (4 * std::numbers::pi / 3)); }

}  // namespace bl::geometry
