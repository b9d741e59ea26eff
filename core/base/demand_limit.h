// How links that hold back a demand go on from what its limit grants now.
#pragma once

#include <algorithm>
#include <optional>

namespace bl {

/// Never quite nothing is granted, so that a demand can grow again by shares of itself.
inline constexpr double kLeastGranted = 1e-6;

/// The share of a demand that its limit leaves now, at most 1.
inline double granted_share(double demand, double limit) {
  return demand > 0 ? std::clamp(limit / demand, kLeastGranted, 1.0) : kLeastGranted;
}

/// The limit that grants a share of a demand. Nothing where all of it is granted: a limit above the demand would hold back nobody,
/// and would still be there when the demand grows.
inline std::optional<double> limit_that_grants(double demand, double share) {
  if (share >= 1) return std::nullopt;
  return demand * std::max(kLeastGranted, share);
}

}  // namespace bl
