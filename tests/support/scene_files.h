// All shipped scenes, for the laws that hold for each of them.
#pragma once

#include <cctype>
#include <string>
#include <vector>

namespace bl {

/// Paths from the root of the project of every scene below scenes/, sorted; frozen files of old versions are among them, large
/// scenes are not.
std::vector<std::string> shipped_scenes();
/// Scenes of ten thousand volumes and more, for which only a few laws are affordable.
std::vector<std::string> large_scenes();
/// Without the large studies: what can be run hundreds of ticks in a test, sanitizers on.
std::vector<std::string> small_scenes();

/// The path of a scene as the name of a test that runs for it.
template <class ParamInfo>
std::string scene_test_name(const ParamInfo& test) {
  std::string name = test.param;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

}  // namespace bl
