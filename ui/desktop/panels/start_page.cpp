// Beginnings at the left, pictures at the right.
#include "ui/desktop/panels/start_page.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/reading/figures.h"
#include "ui/desktop/document/document.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop {

namespace {

namespace files = std::filesystem;

constexpr double kPicturesSeconds = 0.2;  // between two looks at what pictures there are

// What shows most of the program comes first; the others follow by name.
int rank_of(const files::path& scene) {
  constexpr std::array<const char*, 3> kFirst = {"urban_mode", "sixty_volumes", "thousand_volumes"};
  return static_cast<int>(std::find(kFirst.begin(), kFirst.end(), scene.stem().string()) - kFirst.begin());
}

std::vector<std::string> shipped_scenes() {
  std::vector<std::string> paths;
  for (const char* folder : {"start", "studies"}) {
    std::vector<std::string> here;
    std::error_code error;
    for (const auto& entry : files::directory_iterator(files::path(shipped_folder()) / folder, error))
      if (entry.path().extension() == ".json") here.push_back(entry.path().string());
    std::sort(here.begin(), here.end(),
              [](const std::string& a, const std::string& b) { return std::pair(rank_of(a), a) < std::pair(rank_of(b), b); });
    paths.insert(paths.end(), here.begin(), here.end());
  }
  return paths;
}

// One line of the list of beginnings; a whole row that can be pressed.
bool row(const Theme& theme, const char* sign, const std::string& text, const std::string& note) {
  ImGui::PushID(text.c_str());
  ImGui::PushID(note.c_str());
  const bool is_hit = ImGui::Selectable("##row", false, 0, {0, theme.px(note.empty() ? 28.0f : 42.0f)});
  const ImVec2 at = ImGui::GetItemRectMin();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Colours& c = theme.colours();
  list.AddText({at.x + theme.px(6), at.y + theme.px(6)}, c.accent, sign);
  list.AddText({at.x + theme.px(34), at.y + theme.px(6)}, c.text, text.c_str());
  if (!note.empty())
    list.AddText(theme.fonts().small, theme.fonts().small->FontSize, {at.x + theme.px(34), at.y + theme.px(24)}, c.text_faint,
                 note.c_str());
  ImGui::PopID();
  ImGui::PopID();
  return is_hit;
}

}  // namespace

void StartPage::draw() {
  if (!pictures_) pictures_ = std::make_unique<ScenePictures>(editor_->program, shipped_scenes());
  if (!pictures_->is_done()) editor_->wake_at(editor_->now + kPicturesSeconds);
  const Theme& theme = editor_->theme;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float margin = theme.px(48), left = theme.px(380);
  ImGui::SetCursorPos({margin, margin});
  ImGui::BeginChild("beginnings", {left, room.y - 2 * margin});
  draw_beginnings(left);
  ImGui::EndChild();
  ImGui::SetCursorPos({margin + left + margin, margin});
  ImGui::BeginChild("shipped", {room.x - left - 2.5f * margin, room.y - 1.5f * margin});
  draw_shipped();
  ImGui::EndChild();
}

void StartPage::draw_beginnings(float width) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImGui::PushFont(theme.fonts().display);
  ImGui::TextUnformatted("BehaviourLinks");
  ImGui::PopFont();
  ImGui::PushStyleColor(ImGuiCol_Text, c.text_soft);
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(
      "Volumes ask for space, and links relate them to each other. They negotiate in every tick. Open a scene and take part.");
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::Dummy({0, theme.px(20)});
  if (row(theme, icon::kPlus, "New from boundary and programme", "a site as GeoJSON, demands as CSV"))
    editor_->dialogs->show_new_scene();
  if (row(theme, icon::kFolder, "Open a scene", "or drop a file onto this window")) editor_->dialogs->ask_open();
  if (row(theme, icon::kLink, "Join a room", "an address such as room://192.168.1.20:8080/BKRT")) editor_->dialogs->ask_join();
  if (row(theme, icon::kHome, "Host a session", "people take part by their phones, in this network"))
    editor_->dialogs->show_host();
  ImGui::Dummy({0, theme.px(16)});
  if (!editor_->problems.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, c.bad);
    ImGui::TextUnformatted((std::string(icon::kError) + "  " + editor_->problem_file + " could not be opened:").c_str());
    ImGui::PopStyleColor();
    ImGui::PushTextWrapPos(width);
    for (const Problem& problem : editor_->problems)
      if (problem.is_error) ImGui::TextUnformatted(problem.error.text().c_str());
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, theme.px(16)});
  }
  const std::vector<std::string> recent = editor_->person.recent;
  if (recent.empty()) return;
  ImGui::PushFont(theme.fonts().strong);
  ImGui::TextUnformatted("Recent");
  ImGui::PopFont();
  for (const std::string& path : recent)
    if (row(theme, icon::kFile, files::path(path).filename().string(), files::path(path).parent_path().string()))
      editor_->open(path, true);
}

void StartPage::draw_shipped() {
  const Theme& theme = editor_->theme;
  ImGui::PushFont(theme.fonts().title);
  ImGui::TextUnformatted("Scenes to start from");
  ImGui::PopFont();
  ImGui::Dummy({0, theme.px(8)});
  const float room = ImGui::GetContentRegionAvail().x, gap = theme.px(20);
  const int columns = std::max(1, static_cast<int>((room + gap) / (theme.px(300) + gap)));
  const float width = (room - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns);
  int k = 0;
  std::string chosen;
  for (const auto& picture : pictures_->pictures()) {
    if (k % columns != 0) ImGui::SameLine(0, gap);
    else if (k > 0) ImGui::Dummy({0, gap - ImGui::GetStyle().ItemSpacing.y});
    if (draw_card(*picture, width)) chosen = picture->path;
    ++k;
  }
  if (!chosen.empty()) editor_->open(chosen, true);
}

bool StartPage::draw_card(const ScenePicture& picture, float width) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const float height = 0.62f * width, foot = theme.px(90);
  ImGui::PushID(picture.path.c_str());
  const bool is_hit = press_area("card", {width, height + foot});
  const bool is_hot = ImGui::IsItemHovered();
  const ImVec2 at = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, end, c.panel, theme.px(8));
  list.AddRectFilled(at, {end.x, at.y + height}, c.sky, theme.px(8), ImDrawFlags_RoundCornersTop);
  list.AddRect(at, end, is_hot ? c.accent : c.line, theme.px(8), 0, is_hot ? 2.0f : 1.0f);
  const float side = 0.94f * std::min(width / 1.0f, height / 0.62f);
  const ImVec2 corner{at.x + 0.5f * (width - side), at.y + 0.5f * (height - side)};
  list.PushClipRect(at, {end.x, at.y + height}, true);
  for (const auto& ground : picture.grounds) {
    std::vector<ImVec2> line;
    for (const auto& [x, y] : ground) line.push_back({corner.x + x * side, corner.y + y * side});
    list.AddPolyline(line.data(), static_cast<int>(line.size()), c.text_faint, ImDrawFlags_Closed, 1.0f);
  }
  for (const auto& street : picture.streets) {
    std::vector<ImVec2> line;
    for (const auto& [x, y] : street) line.push_back({corner.x + x * side, corner.y + y * side});
    list.AddPolyline(line.data(), static_cast<int>(line.size()), mixed(c.text_faint, c.accent, 0.5f), 0, 2.0f);
  }
  const ImDrawListFlags flags = list.Flags;
  list.Flags &= ~ImDrawListFlags_AntiAliasedFill;  // soft edges would leave seams between neighbours
  for (const PictureTriangle& t : picture.triangles) {
    const ImU32 tone = colour_of_use(theme, t.colour);
    const ImU32 colour = mixed(mixed(tone, IM_COL32(20, 24, 34, 255), 0.55f), tone, std::clamp(t.shade, 0.0f, 1.0f));
    list.AddTriangleFilled({corner.x + t.x[0] * side, corner.y + t.y[0] * side},
                           {corner.x + t.x[1] * side, corner.y + t.y[1] * side},
                           {corner.x + t.x[2] * side, corner.y + t.y[2] * side}, colour);
  }
  list.Flags = flags;
  list.PopClipRect();
  const std::string name = files::path(picture.path).stem().string();
  const std::string title = picture.title.empty() ? name : picture.title;
  if (!picture.is_ready) list.AddText({at.x + theme.px(14), at.y + theme.px(12)}, c.text_faint, "drawing ...");
  list.AddText(theme.fonts().strong, theme.fonts().strong->FontSize, {at.x + theme.px(14), at.y + height + theme.px(10)}, c.text,
               title.c_str());
  const std::string count = picture.volumes > 0 ? reading::counted(picture.volumes, "volume") + ". " : std::string();
  const std::string note = picture.is_ready ? count + picture.about : picture.path;
  const ImVec4 clip{at.x, at.y, end.x - theme.px(12), end.y - theme.px(10)};
  list.AddText(theme.fonts().small, theme.fonts().small->FontSize, {at.x + theme.px(14), at.y + height + theme.px(32)},
               c.text_soft, note.c_str(), nullptr, width - theme.px(28), &clip);
  if (is_hot) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  ImGui::PopID();
  return is_hit;
}

}  // namespace bl::desktop
