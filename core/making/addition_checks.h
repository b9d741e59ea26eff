// Sentences about additions that can be made and do not come to what people mean: rules that nothing can keep, gardens far away.
#pragma once

#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/making/scene_additions.h"

namespace bl::making {

/// Rules that no volume that stands can keep, or that leave nothing of the plot.
std::vector<std::string> rule_warnings(const Scene& scene, const Registry& registry, const RuleAddition& rules,
                                       const std::string& plot, const std::vector<Point3>& polygon);

/// A garden outside of all boundaries: where it lies, and whether shadows of volumes reach so far. Nothing where it lies in one,
/// or the scene has none.
std::vector<std::string> garden_warnings(const Scene& scene, const Registry& registry, const std::vector<Point3>& corners);

}  // namespace bl::making
