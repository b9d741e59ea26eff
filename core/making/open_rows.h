// The rows of a programme that ask for open space, and what `new` has laid for them.
#pragma once

#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/making/site.h"

namespace bl::making {

struct OpenRow {
  std::string use;   ///< as its row spells it
  std::string said;  ///< why this one, or that no row asks for it; empty where there is nothing to say
};

/// What the ground of a new garden counts for: the row with the use that is wanted, in small or large letters. Where none is
/// wanted, the only row that is open space, or the one called `garden`.
OpenRow open_row_for(const Scene& scene, const Registry& registry, const std::string& wanted);

/// The name of the exclusion that `new` has laid for this use, which is known by that name: of several the one that has most of
/// the ground within these corners, else the first. Empty where there is none.
std::string laid_by_new(const Scene& scene, const Site& site, const std::string& use, const std::vector<Point3>& corners);

}  // namespace bl::making
