// Choosing a file or a folder inside the window: folders and fitting files as a list, places at the side, a name to type.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

class FileChooser {
 public:
  enum class Purpose { open_file, save_file, choose_folder };

  /// `endings` such as {".json"}: other files are not listed; empty: all are. `start`: a file or folder to begin at.
  void open(Purpose purpose, std::string title, std::vector<std::string> endings, const std::string& start);
  bool is_open() const { return is_open_; }
  /// What was chosen did not do: it is open again, with the name as it was, and says why.
  void complain(const std::string& text);
  /// The modal window; the path once it was chosen.
  std::optional<std::string> draw(Workbench& editor);

 private:
  struct Item {
    std::string name;
    bool is_folder = false;
  };
  void go(const std::string& folder);
  void draw_places(Workbench& editor);
  std::optional<std::string> draw_list();
  std::optional<std::string> accept();
  bool is_listed(const std::string& name) const;

  Purpose purpose_ = Purpose::open_file;
  std::string title_, folder_, name_, typed_folder_, message_;
  std::string asked_;  ///< the file that a person was asked about: whether to replace it
  std::vector<std::string> endings_;
  std::vector<Item> items_;
  bool is_open_ = false, is_fresh_ = false;
};

}  // namespace bl::desktop
