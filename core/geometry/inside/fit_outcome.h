// What the exact and the sampled fit have in common: floor areas by way of volumes, and reasons where demands are missed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/geometry/volume_fit.h"

namespace bl::geometry {

/// Replaces demands on floor areas by demands on volumes, one storey high; false where there are none.
bool ask_for_volumes(FitProblem& problem);

/// Per site: of its demand's storeys, or the domain's height where it has no demand on a floor area [m].
std::vector<double> storey_heights_of(const Domain& domain, const FitProblem& problem);

/// Asks for other volumes where floor areas miss their demand by more than a share `tolerance`; `asked` is the problem as it was
/// put, `problem` the one in volumes. True where all are met, or nothing can be bettered.
bool correct_floors(const FitProblem& asked, std::span<const CellMeasure> cells, double tolerance, FitProblem& problem);

/// What the sites of a demand have together, in its own unit.
double had(const VolumeDemand& demand, std::span<const CellMeasure> cells);

/// "site 3", or "the group of sites 3, 4, 5".
std::string sites_text(const VolumeDemand& demand);

/// Adds to `fit.reasons` the sites that share a position, and each loss with what its cell says; so many, and a count of more.
void explain_losses(const FitProblem& problem, std::span<const CellMeasure> cells, VolumeFit& fit);

}  // namespace bl::geometry
