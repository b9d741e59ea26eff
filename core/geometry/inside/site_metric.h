// Distances by which weighted sites divide space: the power distance, and those that add or multiply by the radius.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/base/vector.h"

namespace bl::geometry {

/// With d = |x - p| and the radius r = sqrt(weight) a point belongs to the site of least d² - r², d - r, or d / r. In all three
/// the ball d <= r is where the site is "nearer than nothing", so shapes are shrink-wrapped by the same balls.
///
/// All three are c(d) - ψ with a potential ψ that belongs to the site: c = d² and ψ = r², c = d and ψ = r, c = log d and
/// ψ = log r. Finding weights that meet demands is therefore the same problem in all three, semi-discrete partial optimal
/// transport with the cost c (maths, 4): it has one solution, and a symmetric response dV_i/dψ_j, the integral of
/// 1 / |∇c_i - ∇c_j| over the facet between i and j.
enum class Metric : std::uint8_t { power, additive, multiplicative };

/// What sites are compared by: the distance of the metric, but squared where it is multiplicative.
template <Metric M>
double closeness(double squared_distance, double weight, double radius) {
  if constexpr (M == Metric::power) return squared_distance - weight;
  if constexpr (M == Metric::additive) return std::sqrt(squared_distance) - radius;
  return squared_distance / weight;
}

/// ∇c at a place `from` away from the site.
template <Metric M>
Vector3 cost_gradient(const Vector3& from) {
  if constexpr (M == Metric::power) return 2 * from;
  if constexpr (M == Metric::additive) return from / norm(from);
  return from / squared_norm(from);
}

/// Change of radius per change of ψ.
inline double radius_by_potential(Metric metric, double radius) {
  return metric == Metric::power ? 1 / (2 * radius) : metric == Metric::additive ? 1.0 : radius;
}

}  // namespace bl::geometry
