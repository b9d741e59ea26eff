// Sites at one position: who lives, and who is named coincident with whom.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// Per site: the index of the living site within `tolerance` [m], or 0xffffffff where the site itself lives.
/// Decided in order of weight (heavier first, on equal weight the lower index), so the order of the sites does not matter.
void find_coincident(std::span<const PowerSite> sites, double tolerance, std::vector<std::uint32_t>& twin);

}  // namespace bl::geometry
