// The boundary of a site: a plan with holes, steps with heights of their own, and solids that are excluded.
#pragma once

#include <vector>

#include "core/geometry/domain_makers.h"

namespace bl::geometry {

/// A plan polygon, convex or not, between two heights [m].
struct PlanSolid {
  std::vector<Point3> ring;
  double bottom = 0, top = 0;
};

/// A plan with holes between two heights, together with all steps, less all exclusions. Steps and exclusions may overlap
/// anything.
struct SitePlan {
  std::vector<Point3> plan;
  std::vector<std::vector<Point3>> holes;
  double bottom = 0, top = 0;
  std::vector<PlanSolid> steps, exclusions;
};

/// All rings cut the plan at once, and what lies over each place is one stack of heights, so that pieces are few whatever the
/// rings look like. Sides: those of `extrude_plan`; then, for each step and then for each exclusion, bottom, top and walls.
/// Places of errors: `plan`, `holes/k`, `steps/k`, `exclusions/k`.
Result<Domain> site_domain(const SitePlan& site);

/// `exclude` for solids that are given as plans. Places of errors: `exclusions/k`.
Result<Domain> without_solids(const Domain& domain, const std::vector<PlanSolid>& exclusions);

}  // namespace bl::geometry
