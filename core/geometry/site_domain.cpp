// Puts the makers of domains together in the one order that sides are named in.
#include "core/geometry/site_domain.h"

#include <string>

namespace bl {

namespace {

Result<Domain> solid_domain(const PlanSolid& solid, const std::string& place) {
  auto domain = extrude_plan(solid.ring, {}, solid.bottom, solid.top);
  if (domain) return domain;
  Error error = domain.error();
  error.place = place;  // instead of `plan`: the ring is the only one there is
  return error;
}

}  // namespace

Result<Domain> site_domain(const SitePlan& site) {
  auto base = extrude_plan(site.plan, site.holes, site.bottom, site.top);
  if (!base || site.steps.empty()) return base;
  std::vector<Domain> parts{std::move(*base)};
  for (std::size_t k = 0; k < site.steps.size(); ++k) {
    auto step = solid_domain(site.steps[k], "steps/" + std::to_string(k));
    if (!step) return step;
    parts.push_back(std::move(*step));
  }
  auto all = unite(parts);
  return all ? all : Result<Domain>(all.error().within("steps"));
}

Result<Domain> restricted_domain(const Domain& domain, std::span<const Plane> setbacks, std::span<const PlanSolid> exclusions) {
  Domain rest = domain;
  if (!setbacks.empty()) {
    auto cut = cut_domain(rest, setbacks);
    if (!cut) return cut.error().within("setbacks");
    rest = std::move(*cut);
  }
  if (exclusions.empty()) return rest;
  std::vector<Domain> solids;
  for (std::size_t k = 0; k < exclusions.size(); ++k) {
    auto solid = solid_domain(exclusions[k], "exclusions/" + std::to_string(k));
    if (!solid) return solid;
    solids.push_back(std::move(*solid));
  }
  auto left = exclude(rest, solids);
  return left ? left : Result<Domain>(left.error().within("exclusions"));
}

}  // namespace bl
