// What the colours of the 3D view mean: along its bottom, over a third of a narrow one at the most; the rest waits behind a
// button.
#include <algorithm>
#include <string>

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/view/urban_picture.h"

namespace bl::desktop {

namespace {

// Of what is free above the sun's strip, so much may be covered in a narrow view; in a wide one there is room beside.
constexpr float kMostCovered = 1.0f / 3, kMostOfWide = 0.5f;
// All in points: around and between legends; below this width isochrones have no corner of their own; what scale and north take.
constexpr float kLegendMargin = 14, kLargeMargin = 28, kNarrow = 700, kScaleWidth = 190, kScaleHeight = 50, kButtonHeight = 24;

// As many rows as have room below the title, with one that says how many there are more.
std::size_t rows_in(const Legend& legend, float room, float line) {
  const auto fits = [&](std::size_t rows) { return line * (1.5f + static_cast<float>(rows)) <= room; };
  if (fits(legend.rows.size())) return legend.rows.size();
  std::size_t rows = legend.rows.size();
  while (rows > 1 && !fits(rows + 1)) --rows;
  return rows;
}

}  // namespace

// The one that somebody has asked for first, then what is drawn where that is not the scene as it is, then what the volumes'
// colours say; last what comes and goes with the mouse, so that it moves no other.
std::vector<Legend> SceneView::legends() const {
  std::vector<Legend> all = urban_legends(*facts_, choices_, editor_->theme, [this](const char* layer) { return shows(layer); });
  all.insert(all.begin(), colours_.last().legend);
  // Colours stand for figures of the scene, also where other shapes are drawn.
  if (!drawn_.legend().title.empty() && !all.front().ramp.empty()) all.front().title += " (figures of the scene)";
  all.insert(all.begin(), drawn_.legend());
  if (width() < editor_->theme.px(kNarrow)) all.push_back(isochrone_legend(*facts_, choices_.isochrones.get(), editor_->theme));
  std::erase_if(all, [](const Legend& legend) { return legend.rows.empty() && legend.ramp.empty(); });
  const auto wanted = std::find_if(all.begin(), all.end(), [this](const Legend& l) { return l.title == wanted_legend_; });
  if (wanted != all.end()) std::rotate(all.begin(), wanted, wanted + 1);
  return all;
}

// From the left and the bottom on; a list that is too long is cut, and what finds no room beside or above is folded.
LegendPlaces SceneView::place_legends(std::vector<Legend> all, bool is_large, float lift) {
  const Theme& theme = editor_->theme;
  const float margin = theme.px(is_large ? kLargeMargin : kLegendMargin), free = height() - strip_height();
  const float line = (is_large ? theme.fonts().body : theme.fonts().small)->FontSize * 1.35f;
  const float share = width() < theme.px(kNarrow) ? kMostCovered : kMostOfWide;
  const float highest = at_.y + (1 - share) * free, left = at_.x + margin;
  LegendPlaces places;
  places.legends = std::move(all);
  ImVec2 corner{left, at_.y + free - margin - lift};
  places.top = corner.y;
  // Scale and north stand at the right of the lowest row, or below all of them.
  float right = at_.x + width() - (lift < theme.px(kScaleHeight) ? theme.px(kScaleWidth) : margin);
  for (std::size_t k = 0; k < places.legends.size(); ++k) {
    const Legend& legend = places.legends[k];
    ImVec2 size = draw_legend(legend, corner, is_large, corner.y - highest, nullptr);
    ImVec2 place = corner;
    if (place.x > left && place.x + size.x > right) {
      place = {left, places.top - margin};
      size = draw_legend(legend, place, is_large, place.y - highest, nullptr);
    }
    const std::size_t rows = rows_in(legend, place.y - highest, line);
    const bool is_cut = rows < legend.rows.size();
    // A title and two lines are the least that helps.
    const bool fits = place.y - size.y >= highest - 1 && (!is_cut || rows > 1);
    if (!fits || is_cut) places.folded.push_back(k);
    if (!fits) continue;
    if (place.y < corner.y) right = at_.x + width() - margin;
    places.shown.push_back({k, place});
    places.top = std::min(places.top, place.y - size.y);
    corner = {place.x + size.x + 2 * margin, place.y};
  }
  places.highest = highest;
  return places;
}

void SceneView::draw_legends(bool is_large) {
  const Theme& theme = editor_->theme;
  std::vector<Legend> all = legends();
  legend_places_ = {};
  if (!all.empty()) {
    const float margin = theme.px(is_large ? kLargeMargin : kLegendMargin);
    const float wide = draw_legend(all.front(), at_, is_large, height(), nullptr).x;
    float lift = wide + margin > width() - theme.px(kScaleWidth) ? theme.px(kScaleHeight) : 0;
    legend_places_ = place_legends(all, is_large, lift);
    if (!legend_places_.folded.empty()) {
      lift = std::max(lift, theme.px(kButtonHeight + 8));
      legend_places_ = place_legends(std::move(all), is_large, lift);
      draw_folded({at_.x + margin - theme.px(7), at_.y + height() - strip_height() - margin - theme.px(kButtonHeight - 7)});
    }
    for (const LegendPlaces::Shown& shown : legend_places_.shown)
      draw_legend(legend_places_.legends[shown.legend], shown.corner, is_large, shown.corner.y - legend_places_.highest,
                  ImGui::GetWindowDrawList());
  }
  if (width() < theme.px(kNarrow)) return;
  const Legend reach = isochrone_legend(*facts_, choices_.isochrones.get(), theme);
  if (reach.rows.empty()) return;
  const float margin = theme.px(is_large ? kLargeMargin : kLegendMargin);
  const ImVec2 size = draw_legend(reach, at_, is_large, height(), nullptr);
  const ImVec2 place{at_.x + width() - size.x - margin, at_.y + theme.px(is_large ? 64 : 52) + size.y};
  draw_legend(reach, place, is_large, height(), ImGui::GetWindowDrawList());
}

// The button, and behind it all that is folded or cut, whole; a press on one of them brings it into the view.
void SceneView::draw_folded(const ImVec2& corner) {
  const Theme& theme = editor_->theme;
  const std::size_t count = legend_places_.folded.size();
  const bool is_cut_only = count == 1 && legend_places_.shown.size() == legend_places_.legends.size();
  const std::string label = is_cut_only ? "All of the legend"
                            : legend_places_.shown.empty()
                                ? std::to_string(count) + (count == 1 ? " legend" : " legends")
                                : std::to_string(count) + (count == 1 ? " more legend" : " more legends");
  ImGui::SetCursorScreenPos(corner);
  ImGui::PushFont(theme.fonts().small);
  ImGui::PushStyleColor(ImGuiCol_Button, faded(theme.colours().raised, 0.9f));
  if (ImGui::Button((label + "##legends").c_str(), {0, theme.px(kButtonHeight)})) ImGui::OpenPopup("legends");
  ImGui::PopStyleColor();
  ImGui::PopFont();
  note_place(*editor_, "view/legends");
  ImGui::SetNextWindowSizeConstraints({0, 0}, {1e4f, 0.8f * ImGui::GetIO().DisplaySize.y});
  if (!ImGui::BeginPopup("legends")) return;
  for (const std::size_t k : legend_places_.folded) {
    const Legend& legend = legend_places_.legends[k];
    const ImVec2 at = ImGui::GetCursorScreenPos(), size = draw_legend(legend, at, false, 1e5f, nullptr);
    ImGui::PushID(static_cast<int>(k));
    if (press_area("legend", {size.x + theme.px(14), size.y + theme.px(10)})) {
      wanted_legend_ = legend.title;
      ImGui::CloseCurrentPopup();
    }
    note_place(*editor_, "view/legends/" + legend.title);
    if (ImGui::IsItemHovered())
      ImGui::GetWindowDrawList()->AddRectFilled(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), theme.colours().accent_soft,
                                                theme.px(5));
    ImGui::PopID();
    draw_legend(legend, {at.x + theme.px(7), at.y + size.y}, false, 1e5f, ImGui::GetWindowDrawList());
  }
  ImGui::EndPopup();
}

// With its lower left corner there, no taller than `room`; returns its size. Without a list it only measures.
ImVec2 SceneView::draw_legend(const Legend& legend, const ImVec2& corner, bool is_large, float room, ImDrawList* drawn_to) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImFont* font = is_large ? theme.fonts().body : theme.fonts().small;
  const float line = font->FontSize * 1.35f, swatch = font->FontSize * 0.8f;
  const std::size_t rows = rows_in(legend, room, line);
  const float most = width() - 2 * theme.px(is_large ? kLargeMargin : kLegendMargin) - swatch;
  const float x = corner.x;
  float y = corner.y - line * (legend.ramp.empty() ? static_cast<float>(rows + (rows < legend.rows.size() ? 1 : 0)) : 2.4f);
  float widest = legend.ramp.empty() ? 0 : theme.px(is_large ? 300 : 190);
  const auto count_width = [&](const std::string& text, float before) {
    widest = std::min(most, std::max(widest, before + font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str()).x));
  };
  count_width(legend.title, 0);
  for (std::size_t k = 0; k < rows; ++k) count_width(legend.rows[k].label, swatch * 1.6f);
  // Volumes may stand behind it.
  const float pad = theme.px(7);
  const ImVec2 size{widest + pad, corner.y - y + line + pad};
  if (drawn_to == nullptr) return size;
  ImDrawList& list = *drawn_to;
  const ImVec4 clip{x, y - line, x + widest + pad, corner.y + pad};
  const auto write = [&](ImFont* face, const ImVec2& at, ImU32 colour, const std::string& text) {
    list.AddText(face, font->FontSize, at, colour, text.c_str(), nullptr, 0, &clip);
  };
  list.AddRectFilled({x - pad, y - line - pad}, {x + widest + pad, corner.y + pad}, faded(c.sky, 0.9f), theme.px(5));
  write(theme.fonts().strong, {x, y - line}, c.text, legend.title);
  for (std::size_t k = 0; k < rows; ++k, y += line) {
    const float top = y + (line - swatch) / 2 - font->FontSize * 0.14f;
    list.AddRectFilled({x, top}, {x + swatch, top + swatch}, legend.rows[k].colour, theme.px(2));
    write(font, {x + swatch * 1.6f, y}, c.text_soft, legend.rows[k].label);
  }
  if (rows < legend.rows.size())
    write(font, {x + swatch * 1.6f, y}, c.text_faint, "and " + std::to_string(legend.rows.size() - rows) + " more");
  if (legend.ramp.empty()) return size;
  const float length = theme.px(is_large ? 300 : 190), step = length / static_cast<float>(legend.ramp.size() - 1);
  for (std::size_t k = 0; k + 1 < legend.ramp.size(); ++k) {
    const float left = x + step * static_cast<float>(k);
    list.AddRectFilledMultiColor({left, y + theme.px(4)}, {left + step + 0.5f, y + theme.px(4) + swatch}, legend.ramp[k],
                                 legend.ramp[k + 1], legend.ramp[k + 1], legend.ramp[k]);
  }
  const auto put = [&](const std::string& text, float share) {
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str());
    list.AddText(font, font->FontSize, {x + share * (length - extent.x), y + theme.px(8) + swatch}, c.text_soft, text.c_str());
  };
  put(legend.low, 0);
  put(legend.middle, 0.5f);
  put(legend.high, 1);
  return size;
}

}  // namespace bl::desktop
