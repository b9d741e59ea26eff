// Sites on the ground of a terrain that an import has brought: their heights, and the link by which volumes stand on it.
#pragma once

#include <string>
#include <vector>

#include "core/define/command_builder.h"
#include "core/define/registry.h"
#include "core/graph/scene.h"

namespace bl::making {

/// What brings sites and volumes onto a terrain; nothing where they are there already.
struct SitesOnGround {
  std::vector<Command> commands;             ///< on top of the scene after the import
  std::vector<std::string> notes, warnings;  ///< warnings: what stands apart from the ground, and stays there
};

/// `before`, `after`: the scene without and with the import. A terrain that is new gives its ground to each site that lies above
/// or below it: one whose `bottom` nobody has set begins at the lowest ground inside it and keeps its height, and all that counts
/// from its underside goes with it. One link `terrain_follow` tells all footprints the ground. A terrain of an import before
/// changes nothing: what people have made of it since is theirs.
SitesOnGround sites_on_ground(const Scene& before, const Scene& after, const Registry& registry);

}  // namespace bl::making
