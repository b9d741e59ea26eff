// Sentences about a fit, with people's names of the sites.
#pragma once

#include <span>
#include <string>

#include "core/geometry/demand_fit.h"

namespace bl::geometry {

/// "site 3" in a sentence of this folder replaced by the name of site 3 in backquotes.
std::string with_names(std::string sentence, std::span<const std::string> names);

/// The sites that get too little, with their losses, greatest first; empty where there are none.
std::string losses_text(std::span<const DemandLoss> losses, double total_demand, std::span<const std::string> names);

/// Such a sentence with the amount missing now, instead of the amount missing at best: while volumes still change the two differ,
/// and the present volumes are shown beside it.
std::string with_losses(std::string sentence, std::span<const DemandLoss> losses, std::span<const std::string> names);

}  // namespace bl::geometry
