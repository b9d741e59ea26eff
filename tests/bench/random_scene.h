// A scene of random volumes in a box: what the bench runs where it is given no scene.
#pragma once

#include <string>
#include <vector>

#include "core/graph/scene.h"

namespace bl::cli::bench {

/// `count` SmartVolumes at random places in a box, with random demands that fill a share of it; always the same for a count.
/// Made by commands through a session. Each volume has a cube of 10 m to a side, so that the density does not depend on the
/// count.
Result<Scene> random_scene(int count, const Registry& registry, double fill = 0.5);

/// As many that stand at random places of a square plot: round ones of two to seven storeys, a set-back at the top, footprints
/// over a factor of 8 that would cover half of the plot.
Result<Scene> standing_scene(int count, const Registry& registry);

/// The same volumes, kept inside of their box and held to a sum, of which every twentieth keeps its distance from the others of
/// its kind: three links to sets.
Result<Scene> linked_scene(int count, double fill);

/// The same, and a script moves every volume by up to half a metre along each axis in every tick.
Result<Scene> restless_scene(int count, double fill);

/// Up to `count` volumes of a scene, at equal distances in the order of their ids. To drag one alone says little: it may have few
/// neighbours, or room that nobody disputes.
std::vector<std::string> some_volumes(const Scene& scene, std::size_t count);

}  // namespace bl::cli::bench
