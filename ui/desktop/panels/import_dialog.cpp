// The import of surroundings into the open scene: the files, their options, and the progress.
#include "ui/desktop/panels/dialogs.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <filesystem>

#include <imgui_stdlib.h>

#include "core/making/site_grounds.h"
#include "core/reading/figures.h"
#include "ui/desktop/document/import_task.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr float kLabelAt = 250;
constexpr double kProgressSeconds = 1.0 / 30;  // between two frames of a running import

std::string name_of_file(const std::string& path) { return std::filesystem::path(path).filename().string(); }

// The place of an option is written as the command line calls it: "--storey-height".
std::string sentence_of(const std::string& file, Error error) {
  if (error.place.starts_with("--")) {
    error.place.erase(0, 2);
    std::replace(error.place.begin(), error.place.end(), '-', ' ');
  }
  return (file.empty() ? "" : name_of_file(file) + ": ") + error.text();
}

void label(const Theme& theme, const char* text, const char* doc) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", doc);
  ImGui::SameLine(theme.px(kLabelAt));
}

void number_field(const Theme& theme, const char* text, const char* doc, double& value, const char* format) {
  label(theme, text, doc);
  ImGui::SetNextItemWidth(theme.px(150));
  ImGui::InputDouble((std::string("##") + text).c_str(), &value, 0, 0, format);
}

void text_field(const Theme& theme, const char* text, const char* doc, std::string& value, const char* hint, float width = 250) {
  label(theme, text, doc);
  ImGui::SetNextItemWidth(theme.px(width));
  ImGui::InputTextWithHint((std::string("##") + text).c_str(), hint, &value);
}

// "966 existing buildings, 781 junctions"
std::string made_text(const making::ImportedScene& imported, const Registry& types) {
  std::string text;
  for (const auto& [type, count] : imported.nodes) {
    const TypificationDefinition* known = types.typification(type);
    text += (text.empty() ? "" : ", ") + reading::grouped(static_cast<double>(count)) + " \xc3\x97 " +
            (known == nullptr ? type : known->label);
  }
  return text.empty() ? "no new nodes" : text;
}

}  // namespace

void Dialogs::show_import(const std::vector<std::string>& files) {
  if (import_task_) return editor_->notify(NoticeKind::told, "An import is running: wait for its end, or stop it.");
  if (kind_ != Kind::import) import_.files.clear();  // what was given up is not offered again
  for (const std::string& file : files)
    if (std::find(import_.files.begin(), import_.files.end(), file) == import_.files.end()) import_.files.push_back(file);
  told_.clear();
  show(Kind::import);
}

void Dialogs::draw_import_files() {
  const Theme& theme = editor_->theme;
  ImGui::BeginChild("files", {0, theme.px(96)}, true);
  std::size_t removed = import_.files.size();
  for (std::size_t k = 0; k < import_.files.size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::SmallButton(icon::kClose)) removed = k;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Leave this file out");
    ImGui::SameLine();
    ImGui::TextUnformatted(name_of_file(import_.files[k]).c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%s", std::filesystem::path(import_.files[k]).parent_path().string().c_str());
    ImGui::PopID();
  }
  if (removed < import_.files.size()) import_.files.erase(import_.files.begin() + static_cast<std::ptrdiff_t>(removed));
  if (import_.files.empty()) ImGui::TextDisabled("No file yet: choose one, or drop files onto the window.");
  ImGui::EndChild();
  if (ImGui::Button("Add a file ...")) {
    chooser_.open(FileChooser::Purpose::open_file, "Import surroundings from", making::context_endings(),
                  import_.files.empty() ? "." : import_.files.back());
    chosen_ = [this](const std::string& path) { import_.files.push_back(path); };
  }
  note_place(*editor_, "import/add");
  ImGui::SameLine();
  ImGui::TextDisabled("%s", (std::string(making::kContextFormats) + "; most of them also as .gz").c_str());
}

void Dialogs::draw_import_options() {
  const Theme& theme = editor_->theme;
  importing::ContextOptions& context = import_.context;
  const char* as_the_file_says = "as the file says";
  const auto& kinds = making::kImportKinds;
  const auto chosen = std::find_if(kinds.begin(), kinds.end(), [&](const making::ImportKind& k) { return import_.kind == k.id; });
  label(theme, "What is in the files", "Kind of the polygons, lines or cells, where the file does not give it.");
  ImGui::SetNextItemWidth(theme.px(250));
  if (ImGui::BeginCombo("##kind", chosen == kinds.end() ? as_the_file_says : chosen->label)) {
    if (ImGui::Selectable(as_the_file_says, import_.kind.empty())) import_.kind.clear();
    for (const making::ImportKind& kind : kinds)
      if (ImGui::Selectable(kind.label, import_.kind == kind.id)) import_.kind = kind.id;
    ImGui::EndCombo();
  }
  text_field(theme, "Coordinates are in", "A CRS in place of the one in the files.", context.crs,
             "as the file says, or EPSG:28992");
  const Settings settings = editor_->document ? settings_of(editor_->scene()) : Settings();
  const std::string& crs = settings.coordinate_system;
  if (crs.empty() && settings.latitude == 0 && settings.longitude == 0) {
    text_field(theme, "Origin of the scene (X,Y)", "In the CRS of the first file; later files land in the same frame.",
               import_.origin, "the middle of the first file");
  } else {
    import_.origin.clear();
    label(theme, "Origin of the scene", "Set by the first imported file, or by the plan that the scene was made from.");
    ImGui::TextDisabled("stays where it is, %s%s", crs.empty() ? "by the latitude and longitude of the scene" : "in ",
                        crs.starts_with("+") ? "a projection made for the site" : crs.c_str());
  }
  number_field(theme, "Radius around the origin", "Elements that begin farther away are skipped, and reported. 0: no limit.",
               context.radius, "%.5g m");
  number_field(theme, "Finest level of detail", "The finest level of detail that is taken from city models, such as 1.2 or 2.2.",
               context.level_of_detail, "%.3g");
  number_field(theme, "Storey height", "Used where only the number of storeys is known.", context.storey_height, "%.4g m");
  number_field(theme, "Height of unknown buildings",
               "Used where neither the file nor three neighbours give a height. The height is marked as assumed.",
               context.default_height, "%.4g m");
  text_field(theme, "Column with the values", "For a data layer.", import_.value, "the only one with numbers");
  text_field(theme, "Unit, licence of the values", "For a data layer: its unit, such as dB, and its licence.", import_.unit,
             "unit", 90);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(theme.px(152));
  ImGui::InputTextWithHint("##licence", "licence", &import_.licence);
  draw_kept_clear();
  ImGui::Checkbox("Footpaths, cycleways and steps too", &import_.takes_all_streets);
  ImGui::SameLine(theme.px(330));
  ImGui::Checkbox("Buildings from outline and height only", &import_.is_extruded);
}

// `--keep-clear` and `--least-green` of the command line.
void Dialogs::draw_kept_clear() {
  label(editor_->theme, "Keep clear of volumes", making::kKeepClearDoc);
  std::vector<std::string> kept;
  for (const char* ground : making::kClearGrounds) {
    bool is_kept = std::find(import_.keep_clear.begin(), import_.keep_clear.end(), ground) != import_.keep_clear.end();
    ImGui::Checkbox(ground, &is_kept);
    note_place(*editor_, std::string("import/clear/") + ground);
    ImGui::SameLine();
    if (is_kept) kept.emplace_back(ground);
  }
  ImGui::SetNextItemWidth(editor_->theme.px(110));
  ImGui::InputDouble("##least green", &import_.least_green, 0, 0, "from %.4g m\xc2\xb2");
  note_place(*editor_, "import/least green");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", making::kLeastGreenDoc);
  import_.keep_clear = std::move(kept);
}

void Dialogs::draw_import_progress() {
  const Theme& theme = editor_->theme;
  const importing::ImportWatch& watch = import_task_->watch();
  editor_->wake_at(editor_->now + kProgressSeconds);
  const std::size_t file = std::min<std::size_t>(watch.file, import_.files.size() - 1), done = watch.done, total = watch.total;
  const std::string name = name_of_file(import_.files[file]);
  ImGui::Dummy({0, theme.px(30)});
  ImGui::PushFont(theme.fonts().strong);
  ImGui::TextUnformatted(
      import_.files.size() > 1
          ? (name + ", file " + std::to_string(file + 1) + " of " + std::to_string(import_.files.size())).c_str()
          : name.c_str());
  ImGui::PopFont();
  ImGui::Dummy({0, theme.px(6)});
  // Where nobody knows how much there is, the bar goes to and fro.
  const double swing = 0.5 - 0.5 * std::cos(2.2 * editor_->now);
  const float share =
      total > 0 ? static_cast<float>(static_cast<double>(done) / static_cast<double>(total)) : static_cast<float>(swing);
  const std::string count =
      total > 0  ? reading::grouped(static_cast<double>(done)) + " of " + reading::grouped(static_cast<double>(total))
      : done > 0 ? reading::grouped(static_cast<double>(done))
                 : std::string();
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, theme.colours().accent);
  ImGui::ProgressBar(share, {-FLT_MIN, theme.px(8)}, "");
  ImGui::PopStyleColor();
  ImGui::TextDisabled("%s %s", watch.step.load(), count.c_str());
  ImGui::Dummy({0, theme.px(10)});
  ImGui::TextDisabled("The scene keeps running. Nothing is added before all files are read.");
  ImGui::Dummy({0, theme.px(10)});
  if (ImGui::Button("Stop", {theme.px(110), 0})) stop_import();
  note_place(*editor_, "import/stop");
}

void Dialogs::stop_import() {
  if (!import_task_) return;
  import_task_->stop();
  ending_.push_back(std::move(import_task_));
  told_ = {"The import was stopped; nothing was added."};
  is_told_error_ = false;
}

void Dialogs::draw_import() {
  if (!begin("Import surroundings", 780, 625)) {
    if (kind_ != Kind::import) stop_import();  // closed by Esc or its cross
    return;
  }
  if (import_task_) {
    draw_import_progress();
    if (import_task_ && import_task_->is_done()) {
      const std::unique_ptr<ImportTask> task = std::move(import_task_);
      task->wait();
      if (take_import(task->result())) close();
    }
    return ImGui::EndPopup();
  }
  draw_import_files();
  ImGui::Dummy({0, editor_->theme.px(4)});
  draw_import_options();
  if (draw_foot("Import", "import/begin", import_.files.empty() ? "Choose a file first." : "")) begin_import();
  ImGui::EndPopup();
}

void Dialogs::begin_import() {
  told_.clear();
  import_task_ = std::make_unique<ImportTask>(editor_->document ? editor_->scene() : Scene(), import_, editor_->program);
}

void Dialogs::wait_for_import() {
  if (import_task_) import_task_->wait();
}

// Where none is open, a new one without a file begins. Whether there is one now.
bool Dialogs::prepare_scene_for_import() {
  if (editor_->document) return true;
  std::vector<Problem> problems;
  auto document = Document::from_text(editor_->program, write_scene(Scene(), editor_->program), "", kTickThreads, problems);
  if (!document) return false;
  editor_->list_problems("", std::move(problems));
  editor_->take(std::move(document));
  editor_->document->running().play(true);
  return true;
}

bool Dialogs::take_import(making::ImportedScene& imported) {
  told_.clear();
  is_told_error_ = true;
  for (const auto& [file, error] : imported.errors) told_.push_back(sentence_of(file, error));
  if (!imported.scene || !prepare_scene_for_import()) {
    told_.push_back("Nothing was added to the scene.");
    return false;
  }
  Document& document = *editor_->document;
  std::string names;
  for (auto& [file, report] : imported.reports) {
    file = name_of_file(file);  // the folders of one person say nothing to another
    names += (names.empty() ? "" : ", ") + file;
  }
  // What was imported before and has not changed leaves nothing to do.
  const bool has_changes = !imported.command.id.empty();
  if (auto done =
          has_changes ? document.submit({imported.command}, editor_->new_gesture(), "Import \xc2\xb7 " + names) : Result<void>();
      !done) {
    told_ = {done.error().text(), "Nothing was added to the scene: it has changed since the import began. Import again."};
    return false;
  }
  document.add_imports(imported.reports);
  std::vector<Problem> problems = editor_->problems;
  for (const std::vector<std::string>* notes : {&imported.notes, &imported.warnings})
    for (const std::string& note : *notes) problems.push_back({false, {ErrorCode::missing, "import", note}});
  if (!imported.notes.empty() || !imported.warnings.empty())
    editor_->list_problems(editor_->problem_file.empty() ? names : editor_->problem_file, std::move(problems));
  std::size_t skipped = 0, repaired = 0;
  for (const auto& [file, report] : imported.reports) {
    skipped += report.count(importing::ImportOutcome::skipped);
    repaired += report.count(importing::ImportOutcome::repaired);
  }
  editor_->notify(NoticeKind::told,
                  "Imported " + names + ": " + made_text(imported, editor_->program) + ". " +
                      (repaired == 0 ? "" : reading::counted(repaired, "element") + " repaired, ") +
                      (skipped == 0 ? (repaired == 0 ? "Nothing was skipped." : "none skipped; the tab Import lists the repairs.")
                                    : (repaired == 0 ? reading::counted(skipped, "element")
                                                     : reading::grouped(static_cast<double>(skipped))) +
                                          " skipped; the tab Import lists the reasons."));
  editor_->person.shows_bottom = true;
  memory_of(*editor_).wanted_tab = "Import";
  const auto& [low, high] = imported.bounds;
  if (low.x <= high.x) editor_->view->fit_to(low, high);
  import_.files.clear();
  return true;
}

}  // namespace bl::desktop
