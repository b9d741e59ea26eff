// Finding the scenes on disk.
#include "tests/support/scene_files.h"
#include "tests/support/place/source_folder.h"

#include <algorithm>
#include <filesystem>

namespace bl {

namespace {

constexpr const char* kLarge = "scenes/large/";

std::vector<std::string> all_scenes() {
  const std::filesystem::path root(test::source_folder());
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "scenes"))
    if (entry.path().extension() == ".json") paths.push_back(std::filesystem::relative(entry.path(), root).string());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> paths = all_scenes();
  std::erase_if(paths, [](const std::string& path) { return path.starts_with(kLarge); });
  return paths;
}

std::vector<std::string> large_scenes() {
  std::vector<std::string> paths = all_scenes();
  std::erase_if(paths, [](const std::string& path) { return !path.starts_with(kLarge); });
  return paths;
}

std::vector<std::string> small_scenes() {
  std::vector<std::string> paths = shipped_scenes();
  std::erase_if(paths, [](const std::string& path) { return path.starts_with("scenes/studies/"); });
  return paths;
}

}  // namespace bl
