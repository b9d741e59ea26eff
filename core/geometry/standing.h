// What volumes stand on: the ground of their boundary, each other, or nothing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// What a volume may stand on.
enum class Standing : std::uint8_t {
  ground,  ///< on the ground only
  stack,   ///< on the ground, or on a volume below it that stands
  bridge,  ///< also held between two or more volumes that stand
};

/// How one volume stands.
struct Stance {
  static constexpr std::int32_t kNothing = -1, kGround = -2;

  std::int32_t stands_on = kNothing;  ///< the site below it that carries it, kGround or kNothing
  double hang = 0;  ///< height of its lowest point above the ground [m] where it stands on nothing that it may stand on; else 0
  double drop = 0;  ///< how far its ball must sink to touch what it may stand on [m]; negative: sunk in by that much
  bool operator==(const Stance&) const = default;
};

/// A volume counts as below another one where the line between them has at least this slope: the sine of 30°.
inline constexpr double kLeastSteepness = 0.5;
/// A lowest point within this distance of the ground [m] is on it.
inline constexpr double kGroundReach = 0.05;

/// Height [m] of the ground under a point: the underside of that part of the domain, straight above or below the point, that
/// holds it or is nearest to it; the domain's lowest level where there is none.
double ground_under(const Domain& domain, const Point3& point);

/// A stance for each site; `rules` and `cells` are in the order of `sites`. A volume stands on the ground where it touches an
/// underside of the domain, and on another standing volume where both share a facet. Sites without volume count as standing.
std::vector<Stance> stances_of(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                               std::span<const Standing> rules);

}  // namespace bl::geometry
