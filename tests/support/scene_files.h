// All shipped scenes, for the laws that hold for each of them.
#pragma once

#include <string>
#include <vector>

namespace bl {

/// Paths from the root of the project of every scene below scenes/, sorted; frozen files of old versions are among them.
std::vector<std::string> shipped_scenes();
/// Without the large studies: what can be run hundreds of ticks in a test, sanitizers on.
std::vector<std::string> small_scenes();

}  // namespace bl
