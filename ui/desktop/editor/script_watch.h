// Lua files that people added to the open scene. They are read again whenever they are saved, while the scene runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace bl::desktop {

class Editor;

class ScriptWatch {
 public:
  /// Puts the file's text into the scene as a link kind, and watches the file from now on, even where it cannot be read yet.
  void add(Editor& editor, const std::string& path);
  /// Looks for newly saved files a few times a second of the window's clock; whether there was one.
  bool poll(Editor& editor);
  /// Forgets all files when their scene is closed.
  void clear() { files_.clear(); }
  std::size_t size() const { return files_.size(); }
  /// When poll() looks at the files again [s].
  double next_look() const { return next_look_; }

 private:
  struct File {
    std::string path;
    std::filesystem::file_time_type written{};
    std::uintmax_t size = 0;
  };
  void take(Editor& editor, const std::string& name, const File& file);

  std::map<std::string, File> files_;  ///< by the name of the script
  double next_look_ = 0;
};

}  // namespace bl::desktop
