// The list is read when a folder is entered; what cannot be read says so instead of staying empty.
#include "ui/desktop/panels/file_chooser.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include <imgui_stdlib.h>

#include "ui/desktop/document/document.h"
#include "ui/desktop/look/buttons.h"

namespace bl::desktop {

namespace {

namespace files = std::filesystem;

}  // namespace

void FileChooser::open(Purpose purpose, std::string title, std::vector<std::string> endings, const std::string& start) {
  purpose_ = purpose;
  title_ = std::move(title);
  endings_ = std::move(endings);
  is_open_ = is_fresh_ = true;
  asked_.clear();
  message_.clear();
  name_.clear();
  std::error_code error;
  files::path at = files::absolute(start.empty() ? "." : start, error);
  if (!files::is_directory(at, error)) {
    if (purpose == Purpose::save_file) name_ = at.filename().string();
    at = at.parent_path();
  }
  go(at.string());
}

bool FileChooser::is_listed(const std::string& name) const {
  if (purpose_ == Purpose::choose_folder) return false;
  return endings_.empty() ||
         std::any_of(endings_.begin(), endings_.end(), [&](const std::string& ending) { return name.ends_with(ending); });
}

void FileChooser::go(const std::string& folder) {
  std::error_code error;
  const files::path real = files::weakly_canonical(folder, error);
  files::directory_iterator entries(real, files::directory_options::skip_permission_denied, error);
  if (error) {
    message_ = folder + " cannot be read: " + error.message();
    return;
  }
  message_.clear();
  folder_ = typed_folder_ = real.string();
  items_.clear();
  for (const auto& entry : entries) {
    std::error_code ignored;
    const std::string name = entry.path().filename().string();
    if (name.starts_with(".")) continue;
    if (entry.is_directory(ignored)) items_.push_back({name, true});
    else if (is_listed(name)) items_.push_back({name, false});
  }
  std::sort(items_.begin(), items_.end(),
            [](const Item& a, const Item& b) { return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name; });
}

void FileChooser::draw_places(Workbench& editor) {
  const char* home = std::getenv("HOME");
  std::vector<std::pair<std::string, std::string>> places;
  if (home != nullptr && *home == '/') places.emplace_back("Home", home);
  places.emplace_back("Here", ".");
  places.emplace_back("Shipped scenes", shipped_folder());
  for (const std::string& recent : editor.person.recent) {
    const std::string folder = files::path(recent).parent_path().string();
    if (places.size() < 9 && !folder.empty() &&
        std::none_of(places.begin(), places.end(), [&](const auto& p) { return p.second == folder; }))
      places.emplace_back(files::path(folder).filename().string(), folder);
  }
  for (std::size_t k = 0; k < places.size(); ++k) {
    ImGui::PushID(static_cast<int>(k));
    const std::string label = std::string(k == 0 ? icon::kHome : icon::kFolder) + "  " + places[k].first;
    if (ImGui::Selectable(label.c_str(), files::path(places[k].second) == files::path(folder_))) go(places[k].second);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", places[k].second.c_str());
    ImGui::PopID();
  }
}

std::optional<std::string> FileChooser::draw_list() {
  std::optional<std::string> chosen;
  std::string enter;
  if (files::path(folder_).has_parent_path() && folder_ != "/" &&
      ImGui::Selectable((std::string(icon::kUp) + "  ..").c_str(), false, ImGuiSelectableFlags_DontClosePopups))
    enter = files::path(folder_).parent_path().string();
  for (const Item& item : items_) {
    const std::string label = std::string(item.is_folder ? icon::kFolder : icon::kFile) + "  " + item.name;
    constexpr auto kFlags = ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups;
    if (!ImGui::Selectable(label.c_str(), !item.is_folder && item.name == name_, kFlags)) continue;
    if (item.is_folder) {
      enter = folder_ + "/" + item.name;
    } else {
      name_ = item.name;
      if (ImGui::IsMouseDoubleClicked(0)) chosen = accept();
    }
  }
  if (items_.empty()) ImGui::TextDisabled("Nothing here that fits.");
  if (!enter.empty()) go(enter);
  return chosen;
}

// The typed or chosen name as a path; nothing where something has to be said or asked first.
std::optional<std::string> FileChooser::accept() {
  std::error_code error;
  if (purpose_ == Purpose::choose_folder) return folder_ + (name_.empty() ? "" : "/" + name_);
  if (name_.empty()) {
    message_ = "Choose a file, or type a name.";
    return std::nullopt;
  }
  std::string path = name_.starts_with("/") ? name_ : folder_ + "/" + name_;
  if (files::is_directory(path, error)) {
    go(path);
    name_.clear();
    return std::nullopt;
  }
  if (purpose_ == Purpose::open_file) {
    if (files::exists(path, error)) return path;
    message_ = "There is no file " + path + ".";
    return std::nullopt;
  }
  if (!endings_.empty() && !is_listed(path)) path += endings_.front();
  if (files::exists(path, error) && asked_ != path) {
    asked_ = path;
    message_ = files::path(path).filename().string() + " exists already. Press again to replace it.";
    return std::nullopt;
  }
  return path;
}

void FileChooser::complain(const std::string& text) {
  is_open_ = is_fresh_ = true;
  asked_.clear();
  message_ = text;
}

std::optional<std::string> FileChooser::draw(Workbench& editor) {
  if (!is_open_) return std::nullopt;
  const Theme& theme = editor.theme;
  const std::string id = title_ + "##chooser";
  if (is_fresh_) ImGui::OpenPopup(id.c_str());
  ImGui::SetNextWindowSize({theme.px(720), theme.px(480)}, ImGuiCond_Appearing);
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  std::optional<std::string> chosen;
  bool stays = true;
  if (!ImGui::BeginPopupModal(id.c_str(), &stays, ImGuiWindowFlags_NoSavedSettings)) {
    is_open_ = is_fresh_;
    return std::nullopt;
  }
  ImGui::SetNextItemWidth(-1);
  if (ImGui::InputText("##folder", &typed_folder_, ImGuiInputTextFlags_EnterReturnsTrue)) go(typed_folder_);
  const float foot = theme.px(86);
  ImGui::BeginChild("places", {theme.px(170), -foot});
  draw_places(editor);
  ImGui::EndChild();
  ImGui::SameLine();
  ImGui::BeginChild("list", {0, -foot}, true);
  chosen = draw_list();
  ImGui::EndChild();
  if (std::exchange(is_fresh_, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const char* hint = purpose_ == Purpose::choose_folder ? "name of a new folder in here, or nothing" : "name of the file";
  const std::string before = name_;
  const bool is_entered = ImGui::InputTextWithHint("##name", hint, &name_, ImGuiInputTextFlags_EnterReturnsTrue);
  // Another name is another question.
  if (name_ != before) asked_.clear(), message_.clear();
  if (is_entered) {
    chosen = accept();
    is_fresh_ = !chosen;  // typing goes on
  }
  const char* verb = purpose_ == Purpose::open_file ? "Open" : purpose_ == Purpose::save_file ? "Save" : "Choose";
  if (chief_button(theme, asked_.empty() ? verb : "Replace", {theme.px(110), 0})) chosen = accept();
  ImGui::SameLine();
  if (ImGui::Button("Cancel", {theme.px(110), 0}) || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) stays = false;
  ImGui::SameLine();
  ImGui::PushStyleColor(ImGuiCol_Text, theme.colours().warning);
  ImGui::TextUnformatted(message_.c_str());
  ImGui::PopStyleColor();
  if (chosen || !stays) {
    is_open_ = false;
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
  return chosen;
}

}  // namespace bl::desktop
