// A new scene from a plan and a programme, without a console; what the files lack is said in place.
#include "ui/desktop/panels/dialogs.h"

#include <imgui_stdlib.h>

namespace bl::desktop {

namespace {

void number_field(const char* label, double& value, const char* unit) {
  ImGui::SetNextItemWidth(160);
  ImGui::InputDouble(label, &value, 0, 0, (std::string("%.4g ") + unit).c_str());
}

}  // namespace

void Dialogs::show_new_scene() {
  if (!(fresh_.height > 0)) fresh_.height = 25;
  told_.clear();
  guard([this] { show(Kind::fresh); });
}

void Dialogs::draw_file_field(const char* label, std::string& path, std::vector<std::string> endings) {
  const Theme& theme = editor_->theme;
  ImGui::PushID(label);
  ImGui::SetNextItemWidth(-theme.px(250));
  ImGui::InputText("##path", &path);
  ImGui::SameLine();
  if (ImGui::Button("Choose ...")) {
    chooser_.open(FileChooser::Purpose::open_file, label, std::move(endings), path);
    chosen_ = [&path](const std::string& chosen) { path = chosen; };
  }
  ImGui::SameLine();
  ImGui::TextUnformatted(label);
  ImGui::PopID();
}

void Dialogs::draw_new_scene() {
  if (!begin("New scene from boundary and programme", 760, 505)) return;
  const Theme& theme = editor_->theme;
  if (is_fresh_) ImGui::SetKeyboardFocusHere();
  draw_file_field("Boundary (GeoJSON)", fresh_.boundary, {".geojson", ".json"});
  draw_file_field("Programme (CSV)", fresh_.programme, {".csv", ".txt"});
  ImGui::Dummy({0, theme.px(4)});
  ImGui::TextUnformatted("Volumes are");
  for (const making::VolumeForm& form : making::kVolumeForms) {
    ImGui::SameLine(0, theme.px(16));
    if (ImGui::RadioButton(form.words, fresh_.form == form.id)) fresh_.form = form.id;
  }
  number_field("Height of the boundary", fresh_.height, "m");
  number_field("Storey height where none is given", fresh_.storey_height, "m");
  number_field("Distance of positions from the boundary", fresh_.margin, "m");
  ImGui::SetNextItemWidth(-theme.px(250));
  ImGui::InputTextWithHint("Title", "name of the programme's file", &fresh_.title);
  ImGui::SetNextItemWidth(theme.px(160));
  ImGui::InputTextWithHint("Which polygon", "the only or largest", &fresh_.feature);
  ImGui::SameLine(0, theme.px(24));
  ImGui::SetNextItemWidth(theme.px(120));
  ImGui::InputTextWithHint("CRS", "as the file says", &fresh_.crs);
  ImGui::Checkbox("Take the convex hull of a plan that is not convex", &fresh_.use_hull);
  const bool is_ready = !fresh_.boundary.empty() && !fresh_.programme.empty();
  if (draw_foot("Make the scene", "new_scene/make", is_ready ? "" : "A boundary and a programme are needed.")) make_scene();
  if (!told_.empty() && !is_told_error_) close();
  ImGui::EndPopup();
}

void Dialogs::make_scene() {
  const making::MadeScene made = making::make_scene(fresh_, editor_->program);
  told_ = made.notes;
  is_told_error_ = !made.scene;
  for (const auto& [file, warning] : made.warnings) told_.push_back(file + ": " + warning.text());
  // Errors of files that cannot be read have the file as their place.
  for (const auto& [file, error] : made.errors)
    told_.push_back((file.empty() || error.place == file ? "" : file + ": ") + error.text());
  if (!made.scene) return;
  std::vector<Problem> problems;
  const std::string text = write_scene(*made.scene, editor_->program);
  auto document = Document::from_text(editor_->program, text, "", kTickThreads, problems);
  if (!document) {
    is_told_error_ = true;
    for (const Problem& problem : problems) told_.push_back(problem.error.text());
    return editor_->list_problems("", std::move(problems));
  }
  for (const std::string& note : made.notes) problems.push_back({false, {ErrorCode::missing, "import", note}});
  for (const auto& [file, warning] : made.warnings) problems.push_back({false, warning.within("import")});
  editor_->list_problems("", std::move(problems));
  editor_->take(std::move(document));
  editor_->document->running().play(true);
  told_.push_back("done");
  if (made.fill() > 1)
    editor_->notify(NoticeKind::warning,
                    "The demands do not fit into the boundary; the problems list names the volumes that get too little.");
}

}  // namespace bl::desktop
