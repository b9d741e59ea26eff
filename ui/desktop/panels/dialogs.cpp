// Which dialog is open, and the small ones: questions about unsaved changes and recovery.
#include "ui/desktop/panels/dialogs.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "core/file/file_io.h"
#include "core/report/report.h"
#include "ui/desktop/document/import_task.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/export_dialog.h"
#include "ui/desktop/panels/host_dialog.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

namespace {

std::string folder_of(const Workbench& editor) {
  return editor.document && !editor.document->path().empty() ? editor.document->path() : ".";
}

// "New town, north" as new_town_north.json.
std::string file_name_of(const std::string& title) {
  std::string name;
  for (const char c : title) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter >= 0x80) name += c;
    else if (std::isalnum(letter) != 0) name += static_cast<char>(std::tolower(letter));
    else if (!name.empty() && name.back() != '_') name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return (name.empty() ? "scene" : name) + ".json";
}

void tell_saved(Workbench& editor, const std::string& what) {
  editor.notify(NoticeKind::told, "Saved " + what + ".");
  if (const std::string& note = editor.document->save_note(); !note.empty()) editor.notify(NoticeKind::warning, note);
}

}  // namespace

std::string place_to_save(const Workbench& editor) {
  const Document& document = *editor.document;
  if (!document.path().empty()) return document.path();
  const std::string name = document.source().empty() ? file_name_of(editor.state().plan->settings.title)
                                                     : std::filesystem::path(document.source()).filename().string();
  std::error_code error;
  const char* home = std::getenv("HOME");
  const std::filesystem::path here = std::filesystem::current_path(error);
  const bool is_free = !error && !is_shipped((here / name).string());
  return (is_free || home == nullptr ? here / name : std::filesystem::path(home) / name).string();
}

Dialogs::Dialogs(Workbench& editor)
    : editor_(&editor), host_(std::make_unique<HostDialog>(editor)), export_(std::make_unique<ExportDialog>(editor)) {}
Dialogs::~Dialogs() = default;

void Dialogs::show(Kind kind) {
  kind_ = kind;
  is_fresh_ = true;
  query_.clear();
  marked_ = 0;
}

void Dialogs::close() {
  kind_ = Kind::none;
  ImGui::CloseCurrentPopup();
}

// A modal window in the middle; call EndPopup where it returns true.
bool Dialogs::begin(const char* title, float width, float height) {
  const Theme& theme = editor_->theme;
  if (is_fresh_) ImGui::OpenPopup(title);
  ImGui::SetNextWindowSize({theme.px(width), theme.px(height)}, ImGuiCond_Appearing);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  bool stays = true;
  if (ImGui::BeginPopupModal(title, &stays, ImGuiWindowFlags_NoSavedSettings)) {
    // Who types into a field leaves the field by Esc.
    const bool is_typing = !memory_of(*editor_).typing.key.empty();
    const bool is_escaped = !chooser_.is_open() && !is_typing && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (stays && !is_escaped) return true;
    then_ = nullptr;
    close();
    ImGui::EndPopup();
    return false;
  }
  if (!is_fresh_) kind_ = Kind::none, then_ = nullptr;
  return false;
}

bool Dialogs::draw_foot(const char* action, const char* place, const std::string& missing) {
  const Theme& theme = editor_->theme;
  ImGui::Dummy({0, theme.px(4)});
  ImGui::BeginDisabled(!missing.empty());
  const bool is_entered = !is_fresh_ && !chooser_.is_open() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  const bool is_wanted = chief_button(theme, action, {theme.px(150), 0}) || (missing.empty() && is_entered);
  note_place(*editor_, place);
  ImGui::EndDisabled();
  if (!missing.empty() && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", missing.c_str());
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {theme.px(110), 0})) close();
  ImGui::PushStyleColor(ImGuiCol_Text, is_told_error_ ? theme.colours().bad : theme.colours().text_soft);
  ImGui::PushTextWrapPos(0);
  for (const std::string& line : told_) ImGui::TextUnformatted(line.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  if (const auto path = chooser_.draw(*editor_)) chosen_(*path);
  return is_wanted;
}

void Dialogs::draw() {
  watch_hosting(*editor_);
  const Kind drawn = kind_;
  if (kind_ == Kind::palette) draw_palette();
  else if (kind_ == Kind::keys) draw_keys();
  else if (kind_ == Kind::fresh) draw_new_scene();
  else if (kind_ == Kind::unsaved) draw_unsaved();
  else if (kind_ == Kind::recovery) draw_recovery();
  else if (kind_ == Kind::import) draw_import();
  else if (kind_ == Kind::join) draw_join();
  else if (kind_ == Kind::host) draw_host();
  else if (kind_ == Kind::leave) draw_leave();
  else if (kind_ == Kind::exporting) draw_export();
  std::erase_if(ending_, [](const std::unique_ptr<ImportTask>& task) { return task->is_done(); });
  // What one dialog has opened in its place comes in the next frame, and is fresh then.
  if (kind_ == drawn) is_fresh_ = false;
  if (kind_ == Kind::fresh || kind_ == Kind::import || kind_ == Kind::join || kind_ == Kind::host || kind_ == Kind::exporting)
    return;  // their choosers are drawn inside them
  if (const auto path = chooser_.draw(*editor_)) {
    const auto chosen = chosen_;  // may open the chooser for something else
    chosen(*path);
  }
}

void Dialogs::ask_open() {
  guard([this] { choose_scene(); });
}

void Dialogs::choose(FileChooser::Purpose purpose, const std::string& title, std::vector<std::string> endings,
                     const std::string& start, std::function<void(const std::string&)> chosen) {
  chooser_.open(purpose, title, std::move(endings), start);
  chosen_ = std::move(chosen);
}

void Dialogs::choose_scene() {
  choose(FileChooser::Purpose::open_file, "Open a scene", {".json"}, folder_of(*editor_),
         [this](const std::string& path) { editor_->open(path, true); });
}

void Dialogs::ask_script() {
  chooser_.open(FileChooser::Purpose::open_file, "Add a link script", {".lua"}, folder_of(*editor_));
  chosen_ = [this](const std::string& path) { editor_->script_watch.add(*editor_, path); };
}

void Dialogs::ask_save_as(std::function<void()> then) {
  chooser_.open(FileChooser::Purpose::save_file, "Save the scene", {".json"}, place_to_save(*editor_));
  chosen_ = [this, then = std::move(then)](const std::string& chosen) {
    if (auto saved = editor_->save(chosen); !saved) return chooser_.complain(saved.error().text());
    editor_->person.remember(editor_->person.recent, chosen);
    tell_saved(*editor_, chosen);
    if (then) then();
  };
}

void Dialogs::save(std::function<void()> then) {
  Document& document = *editor_->document;
  if (document.path().empty()) return ask_save_as(std::move(then));
  if (auto saved = editor_->save(document.path()); !saved) return editor_->notify(NoticeKind::error, saved.error().text());
  tell_saved(*editor_, document.name());
  if (then) then();
}

void Dialogs::ask_report() {
  const std::string& source = editor_->document->source();
  const std::string stem = std::filesystem::path(source.empty() ? editor_->document->name() : source).stem().string();
  chooser_.open(FileChooser::Purpose::choose_folder, "Write the report into a folder", {}, folder_of(*editor_));
  chosen_ = [this, stem](const std::string& folder) {
    report::ReportData data;
    data.state = &editor_->state();
    data.history = memory_of(*editor_).record->errors();
    data.scene_path = editor_->document->source().empty() ? stem : editor_->document->source();
    data.outcome = editor_->state().is_settled() ? "settled" : "still negotiating";
    data.outcome += " at tick " + std::to_string(editor_->state().tick);
    if (auto written = write_report(folder, data); !written) return chooser_.complain(written.error().text());
    editor_->notify(NoticeKind::told, "Wrote report.html, volumes.csv and volumes.obj into " + folder + ".");
  };
}

void Dialogs::ask_log() {
  chooser_.open(FileChooser::Purpose::save_file, "Save the log for replay", {".log"}, folder_of(*editor_));
  chosen_ = [this](const std::string& path) {
    if (auto written = editor_->document->save_log(path); !written) return chooser_.complain(written.error().text());
    editor_->notify(NoticeKind::told, "Saved the log " + path + "; `behaviourlinks replay` runs it again.");
  };
}

void Dialogs::ask_import_report() {
  const std::string& source = editor_->document->source();
  const std::string beside = Document::imports_path(source.empty() ? "scene.json" : source);
  const bool is_free = !source.empty() && !is_shipped(beside);
  chooser_.open(FileChooser::Purpose::save_file, "Write the import report", {".csv"},
                is_free ? beside : std::filesystem::path(beside).filename().string());
  chosen_ = [this](const std::string& path) {
    if (auto written = write_file(path, import_csv(editor_->document->imports())); !written)
      return chooser_.complain(written.error().text());
    editor_->notify(NoticeKind::told, "Wrote the import report " + path + ".");
  };
}

void Dialogs::guard(std::function<void()> then) {
  stop_import();  // it was made for the scene that may go
  if (editor_->hosting) then = [this, then = std::move(then)] { ask_leave(then); };
  if (!editor_->document || !editor_->document->is_unsaved()) return then();
  then_ = std::move(then);
  show(Kind::unsaved);
}

void Dialogs::draw_unsaved() {
  if (!begin("Unsaved changes", 460, 150)) return;
  const Theme& theme = editor_->theme;
  ImGui::PushTextWrapPos(0);
  const bool is_room = editor_->document->room() != nullptr;
  ImGui::TextUnformatted(
      (editor_->document->name() +
       (is_room ? " has not answered all of your changes. This program keeps them, and sends them when you join the room again."
                : " has changes that are not saved."))
          .c_str());
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, theme.px(10)});
  const ImVec2 size{theme.px(130), 0};
  const bool is_entered = !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  if (chief_button(theme, "Save", size) || is_entered) {
    close();
    save(std::exchange(then_, nullptr));
  }
  ImGui::SameLine();
  if (ImGui::Button(is_room ? "Leave" : "Discard", size)) {
    close();
    if (auto then = std::exchange(then_, nullptr)) then();
  }
  ImGui::SameLine();
  if (ImGui::Button("Cancel", size)) {
    then_ = nullptr;
    close();
  }
  ImGui::EndPopup();
}

void Dialogs::offer_recovery(std::vector<host::Journal::UnsavedJournal> remains) {
  remains_ = std::move(remains);
  if (!remains_.empty()) show(Kind::recovery);
}

Dialogs::Recovered Dialogs::recover(const host::Journal::UnsavedJournal& remains) {
  std::vector<Problem> problems;
  auto document = Document::recover(editor_->program, remains, kTickThreads, problems);
  editor_->list_problems(remains.path, std::move(problems));
  if (!document) {
    editor_->notify(NoticeKind::error, std::string("The journal's scene could not be opened; the ") +
                                           (editor_->document ? "problems list" : "start page") +
                                           " says why. The journal is kept.");
    return Recovered::nothing;
  }
  editor_->take(std::move(document));
  if (editor_->problems.empty()) {
    editor_->notify(NoticeKind::told, "Recovered. Save it to keep it.");
    return Recovered::all;
  }
  editor_->notify(NoticeKind::warning, "Recovered in part: the problems list says what is missing. The journal is kept.");
  return Recovered::in_part;
}

void Dialogs::draw_recovery() {
  if (!begin("Recover unsaved work", 620, 300)) return;
  const Theme& theme = editor_->theme;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted("A window was not closed properly. Its changes are kept in its journal:");
  ImGui::PopTextWrapPos();
  ImGui::Dummy({0, theme.px(6)});
  for (std::size_t k = 0; k < remains_.size(); ++k) {
    const host::Journal::UnsavedJournal& one = remains_[k];
    ImGui::PushID(static_cast<int>(k));
    const bool recovers = ImGui::Button("Recover", {theme.px(90), 0});
    ImGui::SameLine();
    const bool discards = ImGui::Button("Discard", {theme.px(90), 0});
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%s, %zu changes", one.scene_path.empty() ? "a scene without a file" : one.scene_path.c_str(),
                one.log.entries.size());
    ImGui::PopID();
    if (!recovers && !discards) continue;
    const Recovered result = recovers ? recover(one) : Recovered::all;
    if (result == Recovered::nothing) break;
    // The journal is the only copy of what could not be recovered from it.
    if (result == Recovered::all) host::Journal::discard(one);
    remains_.erase(remains_.begin() + static_cast<std::ptrdiff_t>(k));
    if (remains_.empty() || recovers) close();
    break;
  }
  ImGui::EndPopup();
}

}  // namespace bl::desktop
