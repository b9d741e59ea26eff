// Opening, saving and recovering a scene; its history as steps with names.
#include "ui/desktop/document/document.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/file/file_io.h"
#include "core/reading/figures.h"
#include "ui/desktop/app/step_labels.h"
#include "ui/desktop/document/named_files.h"

namespace bl::desktop {

Document::Document(const Registry& registry, std::string path) : registry_(&registry) {
  (is_shipped(path) ? origin_ : path_) = std::move(path);
  static std::uint64_t made = 0;
  id_ = ++made;
}

bool is_shipped(const std::string& path) {
  namespace files = std::filesystem;
  std::error_code error;
  static const files::path shipped = files::weakly_canonical(BL_SCENES_DIR, error);
  // Links lead to what they point at: another name of the same file is no copy of it.
  const files::path real = files::weakly_canonical(path, error);
  if (path.empty() || error) return false;
  const files::path inside = real.lexically_relative(shipped);
  return !inside.empty() && *inside.begin() != "..";
}

std::unique_ptr<Document> Document::open(const Registry& registry, const std::string& path, int threads,
                                         std::vector<Problem>& problems) {
  auto text = read_file(path);
  if (!text) {
    problems.push_back({true, text.error()});
    return nullptr;
  }
  return from_text(registry, *text, path, threads, problems);
}

std::unique_ptr<Document> Document::from_text(const Registry& registry, const std::string& text, const std::string& path,
                                              int threads, std::vector<Problem>& problems) {
  SceneReading reading = read_scene(text, registry);
  problems.insert(problems.end(), reading.problems.begin(), reading.problems.end());
  if (!reading.is_usable()) return nullptr;
  auto session = LiveSession::start(registry, reading.scene, reading.state ? &*reading.state : nullptr, threads);
  if (!session) {
    problems.push_back({true, session.error().within("state")});
    return nullptr;
  }
  std::unique_ptr<Document> document(new Document(registry, path));
  document->session_ = std::move(*session);
  document->log_start_ = write_scene(reading.scene, registry, reading.state ? &*reading.state : nullptr);
  if (!path.empty()) document->saved_ = std::move(reading.scene);  // without a file there is nothing that holds it
  document->read_imports(problems);
  document->begin_journal();
  return document;
}

std::unique_ptr<Document> Document::recover(const Registry& registry, const Journal::Remains& remains, int threads,
                                            std::vector<Problem>& problems) {
  auto document = from_text(registry, remains.log.scene, remains.scene_path, threads, problems);
  if (!document) return nullptr;
  for (const LogEntry& entry : remains.log.entries)
    if (auto done = document->session_->replay(entry); !done)
      problems.push_back({false, done.error().within("journal entry " + std::to_string(entry.seq))});
  document->saved_.reset();  // whatever the file holds, it does not hold this
  return document;
}

// Every entry goes to the disk at once; after a rewind the log starts again from the state that was returned to.
void Document::begin_journal() {
  (void)journal_.begin(source(), log_start_, 0);  // without it everything else works; journal_problem() tells people
  session_->on_entry([this](const LogEntry& entry) { journal_.add(entry, *registry_); });
  session_->on_rewind([this] {
    const SavedState state = bl::save(*session_->take_on_changes());
    begin_log(write_scene(scene(), *registry_, &state));
  });
}

// From here on the log starts from this scene, and so does what a crash would leave.
void Document::begin_log(const std::string& scene_text) {
  log_start_ = scene_text;
  log_begin_ = session_->log().size();
  (void)journal_.begin(source(), log_start_, base_of_log());
}

std::string Document::name() const {
  if (!path_.empty()) return std::filesystem::path(path_).filename().string();
  return origin_.empty() ? "Untitled scene" : std::filesystem::path(origin_).stem().string() + " (copy, not saved yet)";
}

std::string Document::folder() const { return std::filesystem::path(source()).parent_path().string(); }

// As a step of its own, because ticks and undo have to see it too: its gesture, or 0 where all files are found as they are.
std::int64_t Document::name_files_from(const NamedFiles& named) {
  const auto note = [this](const std::string& sentence) { save_note_ += (save_note_.empty() ? "" : " ") + sentence; };
  if (!named.secrets.empty()) {
    std::string names;
    for (const std::string& name : named.secrets) names += (names.empty() ? "" : ", ") + name;
    note("Passwords and certificates were not copied: put " + names + " beside the new file.");
  }
  if (named.commands.empty()) return 0;
  const std::int64_t gesture = session_->new_gesture();
  if (auto done = submit(named.commands, gesture); !done)
    return 0;  // somebody has taken the node away: then it names no file any more
  name_step(gesture, "Name files from the new folder");
  if (!named.copies.empty())
    note(report::counted(named.copies.size(), "recorded table") +
         " copied into the scene's new folder, where recordings are played from.");
  if (const std::size_t rest = named.commands.size() - named.copies.size(); rest > 0)
    note(report::counted(rest, "file") + " that the scene names stayed in place; the scene names them from its new folder.");
  return gesture;
}

namespace {

Result<void> copy_all(const std::vector<std::pair<std::string, std::string>>& copies) {
  for (const auto& [from, to] : copies) {
    const auto text = read_file(from);
    if (!text) return text.error();
    if (auto written = write_file(to, *text); !written) return written;
  }
  return {};
}

}  // namespace

Result<void> Document::save(const std::string& path) {
  if (is_shipped(path))
    return Error{ErrorCode::conflict, path,
                 "The scenes of this folder come with the program and stay as they are: choose another folder."};
  save_note_.clear();
  const NamedFiles named = files_named_from(scene(), folder(), std::filesystem::path(path).parent_path().string());
  const std::int64_t gesture = name_files_from(named);
  // Scene and running state of one and the same moment.
  const auto text_to_save = [this] {
    const SavedState state = bl::save(*session_->take_on_changes());
    return write_scene(scene(), *registry_, state.tick > 0 ? &state : nullptr);
  };
  std::string text = text_to_save();
  const auto copied = copy_all(named.copies);
  const auto written = copied ? write_file(path, text) : copied;
  if (written) {
    path_ = path;
    origin_.clear();
    saved_ = scene();
    is_unsaved_ = false;
    compared_size_ = session_->log().size();
    write_imports(path);
  } else if (gesture != 0) {
    save_note_.clear();
    abandon(gesture);
    text = text_to_save();
  }
  // Also where the file cannot be written: the simulation has taken on what was said, which no tick of the old log has.
  begin_log(text);
  return written;
}

std::string Document::imports_path(const std::string& scene_path) {
  return std::filesystem::path(scene_path).replace_extension(".import.csv").string();
}

void Document::add_imports(const ImportReports& reports) {
  imports_.insert(imports_.end(), reports.begin(), reports.end());
  ++imports_revision_;
}

void Document::read_imports(std::vector<Problem>& problems) {
  if (source().empty()) return;
  const std::string path = imports_path(source());
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  const auto text = read_file(path);
  auto reports = text ? read_import_csv(*text) : Result<ImportReports>(text.error());
  if (!reports)
    problems.push_back({false, {reports.error().code, path, reports.error().text() + " The scene is not touched by it."}});
  else add_imports(*reports);
}

void Document::write_imports(const std::string& scene_path) {
  if (imports_.empty()) return;
  const std::string path = imports_path(scene_path);
  if (auto written = write_file(path, import_csv(imports_)); !written)
    save_note_ += (save_note_.empty() ? "" : " ") + ("The import report could not be written: " + written.error().text());
}

// What devices have said since the file was written is no change of anybody's: it is taken on in what is compared with, too.
bool Document::is_unsaved() {
  if (!saved_) return true;
  const auto& log = session_->log();
  bool has_persons = false;
  for (; compared_size_ < log.size(); ++compared_size_) {
    const LogEntry& entry = log[compared_size_];
    if (entry.author == LiveSession::kAuthor) {
      has_persons = true;
      continue;
    }
    SceneEdit edit(*saved_, *registry_);
    (void)bl::apply(edit, entry.command);  // of a node that the file does not have, it says nothing
  }
  // Undone changes leave nothing to save: what counts is what people have said, not that it ran on.
  if (has_persons) is_unsaved_ = !(*saved_ == scene());
  return is_unsaved_;
}

std::int64_t Document::base_of_log() const { return log_begin_ == 0 ? 0 : session_->log()[log_begin_ - 1].seq; }

Result<void> Document::save_log(const std::string& path) const {
  std::string text = log_header(log_start_, base_of_log());
  const auto& log = session_->log();
  Gestures gestures;
  for (std::size_t i = log_begin_; i < log.size(); ++i) {
    const LogEntry entry = gestures.fitted(log[i]);
    gestures.take(entry);
    text += log_line(entry, *registry_);
  }
  // A replay compares before it applies what was said in that tick: as the tick itself has left it.
  const State& state = *session_->moment()->ticked;
  text += log_line(LogCheck{state.tick, hex_digits(state.hash), true});
  return write_file(path, text);
}

void Document::name_step(std::int64_t gesture, std::string label) {
  for (HistoryStep& step : history_)
    if (step.gesture == gesture) step.label = label;
  named_[gesture] = std::move(label);
}

const std::vector<HistoryStep>& Document::history() {
  const auto& log = session_->log();
  for (; history_size_ < log.size(); ++history_size_) {
    const LogEntry& entry = log[history_size_];
    if (entry.author != LiveSession::kAuthor) continue;  // readings of sensors are nobody's steps
    const std::int64_t shown = entry.undoes != 0 ? entry.undoes : entry.redoes != 0 ? entry.redoes : entry.gesture;
    auto step = std::find_if(history_.begin(), history_.end(), [&](const HistoryStep& s) { return s.gesture == shown; });
    if (entry.undoes != 0 || entry.redoes != 0) {
      if (step == history_.end()) continue;
      if (abandoned_.contains(shown)) {
        history_.erase(step);
        continue;
      }
      // The gesture that took it back is the one that a redo, or a further undo, will name.
      step->is_undone = entry.undoes != 0;
      step->gesture = entry.gesture;
      continue;
    }
    if (step == history_.end()) {
      // A new step ends what was undone before it.
      std::erase_if(history_, [](const HistoryStep& s) { return s.is_undone; });
      const auto named = named_.find(entry.gesture);
      const std::string label = named != named_.end() ? named->second : label_of_step(*registry_, entry.command, scene());
      history_.push_back({entry.gesture, entry.tick, label, false, 0});
      step = history_.end() - 1;
    }
    ++step->entries;
  }
  return history_;
}

std::int64_t Document::last_step() const {
  const auto& log = session_->log();
  const auto last = std::find_if(log.rbegin(), log.rend(), [](const LogEntry& e) { return e.author == LiveSession::kAuthor; });
  return last == log.rend() || last->undoes != 0 || last->redoes != 0 ? 0 : last->gesture;
}

void Document::abandon(std::int64_t gesture) {
  const auto& log = session_->log();
  const auto last = std::find_if(log.rbegin(), log.rend(), [](const LogEntry& e) { return e.author == LiveSession::kAuthor; });
  if (gesture == 0 || last == log.rend() || last->gesture != gesture || last->undoes != 0) return;
  abandoned_.insert(gesture);
  // The ticks have seen it, so that the log keeps it and what takes it back; the history does not.
  (void)session_->undo(gesture);
}

bool Document::has_redo() {
  const auto& steps = history();
  return std::any_of(steps.begin(), steps.end(), [](const HistoryStep& step) { return step.is_undone; });
}

Result<void> Document::submit(const std::vector<Command>& commands, std::int64_t gesture) {
  if (commands.empty()) return {};
  if (commands.size() == 1) return session_->submit(commands.front(), gesture);
  return session_->submit(bl::command<Batch>({commands}), gesture);
}

}  // namespace bl::desktop
