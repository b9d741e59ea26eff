// Which link kinds fit between two ends, by what they declare to read and to propose.
#pragma once

#include <optional>
#include <string>

#include "core/graph/scene.h"

namespace bl::desktop::canvas {

/// Why a link of this kind cannot be laid between the two ends; nothing where it fits.
std::optional<std::string> misfit(const Registry& registry, const Scene& scene, const LinkDefinition& kind, const Selection& from,
                                  const Selection& to);
/// The same with a node at the far end that is not there yet and will have one role.
std::optional<std::string> misfit_with_new(const Registry& registry, const Scene& scene, const LinkDefinition& kind,
                                           const Selection& from, const TypificationDefinition& role);

/// Does the kind read and change nothing at this end but who and where a node is, which every node has?
bool knows_places_only(const LinkDefinition& kind, End end);

/// Ports for the parameters that choose one, where the nodes at the ends offer any.
PortValues chosen_ports(const Registry& registry, const Scene& scene, const LinkDefinition& kind, const Selection& from,
                        const Selection& to);

}  // namespace bl::desktop::canvas
