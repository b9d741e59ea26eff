// What the tests of session files share: a room, its scene, and a folder that is gone with its owner.
#pragma once

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "core/journal/journal.h"
#include "tests/support/world.h"

namespace bl::journal::test {

class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "behaviourlinks-journal-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

inline RoomRow a_room() {
  return {.code = "BRKT",
          .title = "Quarter",
          .build = "test",
          .registry = "none",
          .base = 0,
          .scene = project_file("scenes/start/quarter.json"),
          .created = 1700000000000,
          .erase_on = 1800000000000};
}

inline const Scene& its_scene() {
  static const Scene kScene = read_scene(a_room().scene, full_registry()).scene;
  return kScene;
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// "" or the error's text.
template <class T>
std::string why(const Result<T>& result) {
  return result ? "" : result.error().text();
}

}  // namespace bl::journal::test
