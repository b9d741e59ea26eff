// One open scene: its file, the host that runs it, and its saved state.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/file/scene_file.h"
#include "core/guest/guest_fwd.h"
#include "core/host/host.h"
#include "core/host/running.h"
#include "core/import/import_report.h"
#include "ui/desktop/document/named_files.h"
#include "ui/desktop/document/person_settings.h"

namespace bl::desktop {

/// The folder of the scenes that come with the program.
const std::string& shipped_folder();
/// Does the file lie among the scenes that come with the program? Those are never written over.
bool is_shipped(const std::string& path);

/// Ticks run on one thread; the other cores are left to the window.
inline constexpr int kTickThreads = 1;

class Document {
 public:
  /// Reads a scene; `problems` gets warnings and errors. Returns nothing where there are errors.
  static std::unique_ptr<Document> open(const Registry& registry, const std::string& path, int threads,
                                        std::vector<Problem>& problems);
  /// A scene that has no file yet (path empty), or one that was recovered. A scene that comes with the program opens as a copy
  /// without a file.
  static std::unique_ptr<Document> from_text(const Registry& registry, const std::string& text, const std::string& path,
                                             int threads, std::vector<Problem>& problems);
  /// From the journal of a window that crashed; the commands in it are applied again.
  static std::unique_ptr<Document> recover(const Registry& registry, const host::Journal::UnsavedJournal& remains, int threads,
                                           std::vector<Problem>& problems);

  /// The scene of a room, by its address. The seat that it gives is kept among the person's settings, which must outlive the
  /// document. An error only where the address is none: who cannot connect goes on trying.
  static Result<std::unique_ptr<Document>> join(const Registry& registry, const std::string& address, int threads,
                                                PersonSettings& person);

  ~Document();

  /// Unique among all documents that this window has opened; addresses may be reused.
  std::uint64_t id() const { return id_; }
  /// The scene as it runs, here or in a room.
  host::Running& running() { return *running_; }
  const host::Running& running() const { return *running_; }
  /// The session of a scene that runs in this window; there is none for a scene of a room.
  host::LiveSession* local() { return host_ ? &host_->session() : nullptr; }
  /// The room that the scene runs in; there is none for a scene of this window.
  guest::RoomGuest* room() const { return guest_.get(); }
  /// The same, where the scene is known to run here.
  host::LiveSession& session() { return host_->session(); }
  const Scene& scene() const { return running_->scene(); }
  /// The path that Save writes to; empty where it has to ask.
  const std::string& path() const { return path_; }
  /// The file that the scene was read from, or written to last: that of a copy is its original. Empty where there is none.
  const std::string& source() const { return path_.empty() ? origin_ : path_; }
  /// The folder in which the scene's pictures and tables are found. Empty: the folder where the program was started.
  std::string folder() const;
  /// The file's name, or a title for a scene without a file.
  std::string name() const;

  /// Writes the scene with its running state, so that it opens as it was left, and adopts the path. Relative names of files are
  /// adapted to the new folder. Nothing is written into the folder of shipped scenes.
  Result<void> save(const std::string& path);
  /// Notices about the last successful save; empty where there are none.
  const std::string& save_note() const { return save_note_; }

  /// The import reports, with the result for every element. They are kept in a file beside the scene's file, and read from there.
  const importing::ImportReports& imports() const { return imports_; }
  /// A number that grows with each change of the reports.
  std::uint64_t imports_revision() const { return imports_revision_; }
  void add_imports(const importing::ImportReports& reports);
  /// Where the reports of a scene file are kept: quarter.import.csv beside quarter.json.
  static std::string imports_path(const std::string& scene_path);
  /// Why a crash would lose unsaved changes; empty where it would not.
  std::string journal_problem() const { return host_ ? host_->journal_problem() : std::string(); }
  /// Does the scene differ from its file? Compared again only after changes.
  bool is_unsaved();
  /// Writes the log since the scene was opened, for `replay`.
  Result<void> save_log(const std::string& path) const;
  /// Steps, oldest first.
  const std::vector<host::HistoryStep>& history() const { return running_->history(); }
  std::int64_t last_step() const { return running_->last_step(); }

  /// Submits commands as one step. `label`: the name of the step, where the commands alone do not say what was meant: "Solo ·
  /// Hotel".
  Result<void> submit(const std::vector<Command>& commands, std::int64_t gesture = 0, const std::string& label = "") {
    return running_->submit(commands, gesture, label);
  }
  /// One frame of a gesture that is under way.
  Result<void> show(const std::vector<Command>& commands, std::int64_t gesture) { return running_->show(commands, gesture); }

 private:
  Document(const Registry& registry, std::string path);
  std::int64_t name_files_from(const NamedFiles& named);
  void read_imports(std::vector<Problem>& problems);
  void write_imports(const std::string& scene_path);

  std::uint64_t id_;
  const Registry* registry_;
  std::string path_, origin_, save_note_;
  importing::ImportReports imports_;
  std::uint64_t imports_revision_ = 0;
  std::optional<Scene> saved_;  ///< the content of the file; none where there is no file, or another content
  std::unique_ptr<guest::RoomGuest> guest_;
  std::unique_ptr<host::Host> host_;  ///< none where the scene runs in a room
  host::Running* running_ = nullptr;  ///< what runs the scene
  std::size_t compared_size_ = 0;     ///< of the log
  bool is_unsaved_ = false;
};

}  // namespace bl::desktop
