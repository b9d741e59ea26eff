// Makes the proposal from a state.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/export/proposal_model.h"
#include "core/graph/state.h"

namespace bl::exporting {

/// Arcs of plates lie within this of their chords [m].
inline constexpr double kChordTolerance = 0.002;
/// The same of meshes for pages [m].
inline constexpr double kLightTolerance = 0.05;

/// `file`: the name of the scene's file. Sums over sets are read as they are in the state (see core/graph/sums_of_now.h). Fails
/// where nothing has been computed yet, or no volume has a shape: then there is nothing to hand on.
Result<Proposal> read_proposal(const State& state, const std::string& file);

/// Gives a building the storeys, the outline and the mesh of a volume that stands.
void stand(const geometry::StandingBody& body, Building& building);

/// Gives each storey its level, and the proposal its number of levels.
void number_levels(Proposal& proposal);

/// Rings that may turn either way, as faces with holes by the even-odd rule; rings of less than three corners are left out.
std::vector<geometry::PlateFace> faces_of_rings(std::vector<geometry::Ring> rings);

}  // namespace bl::exporting
