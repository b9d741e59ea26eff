// A folder for made files, and a desktop into which they are imported as people do it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/file/file_io.h"
#include "tests/ui/desktop/null_desktop.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("bl_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string at(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    EXPECT_TRUE(write_file(at(name), text));
    return at(name);
  }

 private:
  std::filesystem::path path_;
};

class ImportDesktop : public NullDesktop {
 public:
  explicit ImportDesktop(const std::string& scene = "") : NullDesktop(scene, {1600, 1200}) {}

  bool has(const std::string& key) { return memory_of(editor()).places.contains(key); }
  ImVec2 middle(const std::string& key) {
    if (!has(key)) ADD_FAILURE() << "there is no " << key;
    const ImVec4 p = memory_of(editor()).places[key];
    return {(p.x + p.z) / 2, (p.y + p.w) / 2};
  }
  void press_on(const std::string& key) { click(middle(key)); }

  bool is_open() { return ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel); }
  /// Offers files as a drop does, and presses Import.
  void import(const std::vector<std::string>& files) {
    desktop().drop(files);
    frames(3);
    press_on("import/begin");
    finish();
  }
  /// Until the import that runs is taken over.
  void finish() {
    editor().dialogs->wait_for_import();
    frames(4);
  }
  std::string told() {
    std::string all;
    for (const std::string& line : editor().dialogs->told()) all += line + "\n";
    return all;
  }
  std::string notices() {
    std::string all;
    for (const Notice& notice : editor().notices) all += notice.text + "\n";
    return all;
  }
};

/// Two houses in Delft's coordinates, a third that crosses itself, and a feature without a geometry.
inline std::string houses_text() {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
    {"type": "Feature", "properties": {"gid": 1, "height": 12}, "geometry": {"type": "Polygon", "coordinates": [[[85000, 447000], [85020, 447000], [85020, 447010], [85000, 447010], [85000, 447000]]]}},
    {"type": "Feature", "properties": {"gid": 2, "height": 9}, "geometry": {"type": "Polygon", "coordinates": [[[85040, 447000], [85060, 447000], [85060, 447000], [85060, 447010], [85040, 447010], [85040, 447000]]]}},
    {"type": "Feature", "properties": {"gid": 3}, "geometry": {"type": "Polygon", "coordinates": [[[85030, 447100], [85040, 447110], [85040, 447100], [85030, 447110], [85030, 447100]]]}},
    {"type": "Feature", "properties": {"gid": 4}, "geometry": null}]})";
}

}  // namespace bl::desktop
