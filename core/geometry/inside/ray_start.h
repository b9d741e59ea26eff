// Better weights for a Newton fit to start from: cells looked at along a few rays, and a few steps made with what that tells.
#pragma once

#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/geometry/domain.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Weights [m²] that come nearer to the demands [m³], one per site, than the given ones, which `initial_weights` has made. Each
/// cell is measured along fifty fixed rays, some tenths off at worst; three steps with that take less time than one exact
/// evaluation. What it is no good for comes back as it is: solids of several pieces, nearly full ones, few sites, sites without a
/// demand or with next to none, sites that crowd. It promises no cell to any site: who uses the weights has to look. Depends on
/// the arguments alone, of which the pool is none.
std::vector<double> weights_by_rays(const Domain& domain, std::span<const PowerSite> sites, std::vector<double> weights,
                                    std::span<const double> demands, ThreadPool* pool = nullptr);

}  // namespace bl::geometry
