// The boundary of a site as people give it: a plan with holes and steps, setback planes, and solids that stay.
#pragma once

#include <span>
#include <vector>

#include "core/geometry/domain_makers.h"

namespace bl {

/// A plan polygon, convex or not, between two heights [m].
struct PlanSolid {
  std::vector<Point3> ring;
  double bottom = 0, top = 0;
};

/// A plan with holes, and parts with heights of their own: all of it together is the site. A step covers what it covers, holes
/// among it.
struct SitePlan {
  std::vector<Point3> plan;
  std::vector<std::vector<Point3>> holes;
  double bottom = 0, top = 0;
  std::vector<PlanSolid> steps;
};

/// Sides: those of `extrude_plan`, then those of the steps in their order. Places of errors: `plan`, `holes/k`, `steps/k`.
Result<Domain> site_domain(const SitePlan& site);

/// What setback planes and the solids that stay leave of a domain; their sides follow its own in this order, planes first.
/// Places of errors: `setbacks/k`, `exclusions/k`.
Result<Domain> restricted_domain(const Domain& domain, std::span<const Plane> setbacks, std::span<const PlanSolid> exclusions);

}  // namespace bl
