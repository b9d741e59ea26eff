// What the dialog of exports asks for: formats with their options, and where their files go.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/export/write_files.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

class ExportDialog {
 public:
  explicit ExportDialog(Workbench& editor) : editor_(&editor) {}

  /// For the scene that is open now. `beside`: the scene's file, or the one that it would be saved as.
  /// With a `section`, drawings show it, until the dialog is opened without one.
  void begin(const std::string& beside, const std::string& section);
  /// The list, the options of the format that is looked at, folder and name.
  void draw();
  /// What is missing, as a sentence; empty: it can be written.
  std::string missing() const;
  /// Writes all chosen formats. Nothing where something has to be asked or mended first: then `told` says what.
  std::optional<std::vector<std::string>> write(std::vector<std::string>& told);

 private:
  void draw_formats();
  void draw_all_formats();
  void draw_options();
  void draw_place();
  std::string path_of(const exporting::FormatDefinition& format) const;
  std::vector<exporting::Order> orders() const;
  std::vector<Value>& values_of(const exporting::FormatDefinition& format);

  Workbench* editor_;
  std::string scene_, folder_, name_;
  std::set<std::string> chosen_, in_folders_;          ///< formats; those of which several files are wanted
  std::string looked_at_;                              ///< the format whose options are shown
  std::map<std::string, std::vector<Value>> options_;  ///< by format, in the order of its options
  /// What was chosen before the section was.
  struct Chosen {
    std::set<std::string> formats;
    std::string looked_at;
    std::map<std::string, std::vector<Value>> options;
  };
  std::optional<Chosen> before_section_;
  void follow_form();
  void choose_section(const std::string& section);
  std::vector<std::string> asked_;  ///< the files that a person was asked about: whether to replace them
};

}  // namespace bl::desktop
