// Windows over the window: files, a new scene, the command palette, the list of keys, questions before something is lost.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/making/context_import.h"
#include "core/making/scene_making.h"
#include "ui/desktop/panels/file_chooser.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

class ExportDialog;
class HostDialog;
class ImportTask;

/// Where a file of the open scene would be saved: its own file, or a name for a new one, never among the shipped scenes.
std::string place_to_save(const Workbench& editor);

class Dialogs {
 public:
  explicit Dialogs(Workbench& editor);
  ~Dialogs();
  void draw();

  void ask_open();
  /// Asks for the address of a room, and joins it.
  void ask_join();
  /// Opens a room for the open scene, page by page.
  void show_host();
  HostDialog& host() { return *host_; }
  /// Asks what becomes of the room that this window has opened; `then` follows unless people think better of it.
  void ask_leave(std::function<void()> then);
  /// A file or folder; `chosen` gets it. The dialog that asks stays open.
  void choose(FileChooser::Purpose purpose, const std::string& title, std::vector<std::string> endings, const std::string& start,
              std::function<void(const std::string&)> chosen);
  /// A scene to open, from inside another dialog.
  void choose_scene();
  void ask_save_as(std::function<void()> then = {});
  /// The proposal as it is shown, in the formats of other programs. With a `section`, as their options have it, drawings of it
  /// are what is offered first.
  void show_export(const std::string& section = "");
  ExportDialog& exports() { return *export_; }
  void ask_report();
  void ask_log();
  void ask_import_report();
  void ask_script();
  void show_new_scene();
  /// Surroundings for the open scene, or for a new one where none is open.
  void show_import(const std::vector<std::string>& files = {});
  bool is_importing() const { return import_task_ != nullptr; }
  /// Returns once the import that runs is through; the next frame takes it over. For tests.
  void wait_for_import();
  /// What is imported next, and how.
  making::ImportOptions& import_options() { return import_; }
  /// What the last try to make a scene or to import has said.
  const std::vector<std::string>& told() const { return told_; }
  void show_palette();
  void show_keys();
  /// Journals of windows that did not end well: offered once, at the start.
  void offer_recovery(std::vector<host::Journal::UnsavedJournal> remains);
  /// Saves to the document's file, or asks for one; `then` follows once it is saved, and never where people think better of it.
  void save(std::function<void()> then = {});
  /// Does `then` at once, or after people have said what becomes of unsaved changes.
  void guard(std::function<void()> then);
  bool is_choosing_file() const { return chooser_.is_open(); }

 private:
  enum class Kind { none, palette, keys, fresh, unsaved, recovery, import, join, host, leave, exporting };
  enum class Recovered { nothing, in_part, all };
  void show(Kind kind);
  bool begin(const char* title, float width, float height);
  void close();
  /// The end of a dialog that makes something of files: the button for it, Cancel, what the last try has said, and the chooser.
  /// True once it is wanted; `missing` says what is not there yet, or is empty.
  bool draw_foot(const char* action, const char* place, const std::string& missing);
  void draw_palette();
  void draw_keys();
  void draw_new_scene();
  void draw_file_field(const char* label, std::string& path, std::vector<std::string> endings);
  void draw_unsaved();
  void draw_recovery();
  void draw_join();
  // host_leaving.cpp
  void draw_host();
  void draw_leave();
  Recovered recover(const host::Journal::UnsavedJournal& remains);
  void make_scene();

  // import_dialog.cpp
  void draw_import();
  void draw_import_files();
  void draw_import_options();
  void draw_kept_clear();
  void draw_import_progress();
  void begin_import();
  bool take_import(making::ImportedScene& imported);
  bool prepare_scene_for_import();
  void draw_export();  // export_dialog.cpp

  Workbench* editor_;
  Kind kind_ = Kind::none;
  bool is_fresh_ = false;
  FileChooser chooser_;
  std::function<void(const std::string&)> chosen_;
  std::function<void()> then_;  ///< what the question about unsaved changes was asked for; gone with the question
  std::string query_, address_;
  int marked_ = 0;
  making::NewOptions fresh_;
  std::vector<std::string> told_;  ///< notes and errors of the last try to make a scene
  bool is_told_error_ = false;
  std::vector<host::Journal::UnsavedJournal> remains_;
  making::ImportOptions import_;
  std::unique_ptr<HostDialog> host_;
  std::unique_ptr<ExportDialog> export_;
  double end_asked_at_ = -1;  ///< when the room was asked to end [s]; below 0: it was not
  void stop_import();
  std::unique_ptr<ImportTask> import_task_;
  std::vector<std::unique_ptr<ImportTask>> ending_;  ///< stopped, but not through yet
};

}  // namespace bl::desktop
