// How far standing volumes reach out of a boundary whose sections differ from height to height.
#pragma once

#include "core/geometry/domain.h"
#include "core/geometry/plates.h"

namespace bl::geometry {

/// Has the domain the same section at all its heights? Then nothing reaches out of it that stands inside at its ground.
bool is_upright(const Domain& domain);

struct BoundaryReach {
  int storey = 0;     ///< the lowest storey whose plate is not inside the section of the domain at its top, from 1; 0: none
  double area = 0;    ///< of the plate that lies outside most [m²]
  double height = 0;  ///< of the top of that lowest storey [m]
  bool operator==(const BoundaryReach&) const = default;
};
/// Storeys above the whole domain do not count.
BoundaryReach reach_out_of(const Domain& domain, const StandingBody& body);

}  // namespace bl::geometry
