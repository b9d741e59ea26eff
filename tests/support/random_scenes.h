// Whole scenes at random, of all registered types, in which much goes wrong: for the laws of saving and of files.
#pragma once

#include <cstdint>
#include <string>

namespace bl {

/// The text of a scene that can be read: formulas that are none, shapes without size, sets that name nobody or the wrong nodes,
/// ranges that clash, locks, links to all of them. The same number gives the same scene.
std::string random_scene(std::uint64_t seed);

}  // namespace bl
