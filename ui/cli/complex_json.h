// The cell complex as JSON, for `cells --complex`.
#pragma once

#include <span>

#include "core/base/result.h"
#include "core/define/json_text.h"
#include "core/geometry/power_cells.h"

namespace bl::cli {

/// Vertices, edges and facets in the order of their names; the diagram was made from the sites, with outlines.
Result<Json> complex_json(const geometry::PowerDiagram& diagram, std::span<const geometry::PowerSite> sites);

}  // namespace bl::cli
