// What a fit has to say, in the names that people gave to the sites.
#pragma once

#include <span>
#include <string>

#include "core/geometry/demand_fit.h"

namespace bl::geometry {

/// "site 3" in a sentence of this folder replaced by the name of site 3 in backquotes.
std::string with_names(std::string sentence, std::span<const std::string> names);

/// Who goes without, and by how much, greatest loss first; empty where nobody does.
std::string losses_text(std::span<const DemandLoss> losses, double total_demand, std::span<const std::string> names);

/// Such a sentence with what is missing now in place of what the fit can grant at best: while volumes still change, the two
/// differ, and people read the one beside the other.
std::string with_losses(std::string sentence, std::span<const DemandLoss> losses, std::span<const std::string> names);

}  // namespace bl::geometry
