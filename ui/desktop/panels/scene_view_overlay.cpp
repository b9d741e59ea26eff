// What is written over the picture: marks, labels, scale, north, and the small tools in the corner.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/stream_text.h"

namespace bl::desktop {

struct LabelRequest {
  const std::string* text = nullptr;
  Seen at;
  bool is_chosen = false, is_mark = false;
  double reach = 0;  ///< of a volume in the picture, from its middle [pixels]
  std::uint32_t node = 0;
  std::optional<StreamText> stream;
};

namespace {

constexpr std::size_t kMostLabels = 70, kMostSigns = 120, kMostDots = 4000;
// How wide a volume is in the picture at the least, as a share of its label.
constexpr double kLeastShareOfLabel = 0.55;
constexpr float kLeastVolumeOnScreen = 9;  // [points]: smaller ones have no label of their own

struct Rectangle {
  float left, top, right, bottom;
  bool meets(const Rectangle& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

// A wish before anybody knows whether it is among those that are written: thousands of them are looked at.
struct LabelCandidate {
  double importance = 0;
  std::size_t order = 0;  // volumes, then marks
  bool operator<(const LabelCandidate& o) const {
    return importance != o.importance ? importance > o.importance : order < o.order;
  }
};

// Of the name, and of the line below it in which a sensor says what it has measured.
ImVec2 extent_of(ImFont* font, const LabelRequest& wish) {
  ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, wish.text->c_str());
  if (!wish.stream) return extent;
  const float line = font->CalcTextSizeA(font->FontSize, 1e4f, 0, wish.stream->text().c_str()).x;
  return {std::max(extent.x, 0.95f * font->FontSize + line), extent.y + 1.15f * font->FontSize};
}

// The stream is written in the colour of how far it can be relied on, which needs the panel's ground.
void write_label(ImDrawList& list, const Theme& theme, const LabelRequest& wish, const Rectangle& place, ImVec2 corner) {
  const Colours& c = theme.colours();
  ImFont* font = theme.fonts().small;
  const float size = font->FontSize;
  list.AddRectFilled({place.left, place.top}, {place.right, place.bottom}, wish.is_chosen ? c.accent : faded(c.panel, 0.74f),
                     theme.px(4));
  list.AddText(font, size, corner, wish.is_chosen ? c.on_accent : c.text, wish.text->c_str());
  if (!wish.stream) return;
  const float top = corner.y + 1.15f * size;
  if (wish.is_chosen)
    list.AddRectFilled({place.left, top - theme.px(1)}, {place.right, place.bottom}, c.panel, theme.px(4),
                       ImDrawFlags_RoundCornersBottom);
  const StreamStanding standing = wish.stream->standing;
  draw_standing(list, theme, {corner.x + 0.4f * size, top + 0.52f * size}, 0.27f * size, standing);
  list.AddText(font, size, {corner.x + 0.95f * size, top}, standing == StreamStanding::good ? c.text : colour_of(theme, standing),
               wish.stream->text().c_str());
}

}  // namespace

// Nodes without a shape: small round marks with a sign of their role. A volume that has none yet is one of them.
void SceneView::draw_marks() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  std::size_t drawn = 0;
  const auto draw = [&](std::uint32_t node, const std::string& id, Icon icon, ImU32 tone) {
    const Seen at = seen(place_of(node));
    const bool is_inside = at.x > -20 && at.y > -20 && at.x < width() + 20 && at.y < height() + 20;
    if (!at.is_in_front || !is_inside || hides(choices_.section, place_of(node))) return;
    const ImVec2 p = on_screen(at);
    const bool is_chosen = editor_->picks.nodes.contains(id), is_hovered = editor_->picks.hovered_node == id;
    // A draw list has room for so many corners; a crowd of marks is read as dots anyway.
    if (++drawn > kMostSigns && !is_chosen && !is_hovered) {
      if (drawn < kMostDots)
        list.AddRectFilled({p.x - theme.px(2), p.y - theme.px(2)}, {p.x + theme.px(2), p.y + theme.px(2)}, tone);
      return;
    }
    if (drawn > kMostDots) return;
    const float r = theme.px(is_hovered ? 11 : 9.5f);
    list.AddCircleFilled(p, r, is_chosen ? c.accent : faded(c.raised, 0.92f), 24);
    list.AddCircle(p, r, is_chosen || is_hovered ? c.accent : tone, 24, theme.px(is_hovered ? 2.0f : 1.2f));
    const char* sign = sign_of(icon);
    ImFont* font = theme.fonts().small;
    const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, sign);
    list.AddText(font, font->FontSize, {std::round(p.x - extent.x / 2), std::round(p.y - extent.y / 2)},
                 is_chosen ? c.on_accent : c.text_soft, sign);
  };
  if (shows("marks"))
    for (const MarkFacts& mark : facts_->marks) draw(mark.node, mark.id, mark.icon, c.line);
  for (std::size_t k = 0; k < facts_->volumes.size(); ++k) {
    const std::uint32_t node = facts_->columns.node[k];
    const bool has_shape = facts_->balls.squared_radius[k] >= 0, is_held = choices_.held.contains(node);
    if (!has_shape || is_held) draw(node, id_of(node), Icon::cube, colours_.last().colours[k]);
  }
}

// Where a volume can be spoken of: its middle, or its upper part where others stand before it; nowhere where it is hidden.
Seen SceneView::visible_anchor(std::uint32_t node, const Seen& middle) const {
  const VolumeFacts* volume = facts_->volume_of(node);
  if (volume == nullptr || !volume->cell) return middle;
  const Point3 p = volume->figures.position;
  const double top = volume->figures.height > 0 ? volume->figures.bottom + 0.93 * volume->figures.height : p.z;
  // Of a volume that is cut, or drawn as another shape, the middle of what is seen.
  const Seen shown = volume->is_drawn_otherwise ? seen(volume->cell->wrap->ball_centre) : middle;
  const Seen low = seen({p.x, p.y, volume->figures.bottom + 0.4 * volume->figures.storey_height});
  for (const Seen& at : {shown, middle, seen({p.x, p.y, top}), low})
    if (is_met_first(choices_.camera.ray(at.x, at.y, width(), height()), *volume, *facts_, choices_.section, shows("buildings")))
      return at;
  Seen nowhere = middle;
  nowhere.is_in_front = false;
  return nowhere;
}

// The most important ones, and of those that are alike the first.
std::vector<LabelRequest> SceneView::label_wishes() const {
  const Lens lens(choices_.camera, width(), height());
  const double least = kLeastVolumeOnScreen * editor_->theme.scale(), of_marks = 14.0 * editor_->theme.scale();
  const std::size_t volumes = facts_->volumes.size(), marks = shows("marks") ? facts_->marks.size() : 0;
  std::set<std::uint32_t> chosen;
  for (const std::string& id : editor_->picks.nodes) chosen.insert(seen_index(id));
  const std::string& hovered_id = editor_->picks.hovered_node;
  const std::uint32_t nobody = static_cast<std::uint32_t>(facts_->places.size());
  const std::uint32_t hovered = hovered_id.empty() ? nobody : seen_index(hovered_id);
  std::vector<LabelCandidate> candidates;
  const auto consider = [&](std::uint32_t node, double size, std::size_t order) {
    const bool is_chosen = chosen.contains(node), is_hovered = node == hovered;
    if (!is_chosen && !is_hovered && size < least) return;
    const Seen at = lens.project(place_of(node));
    const bool is_inside = at.x > -50 && at.y > -20 && at.x < width() + 50 && at.y < height() + 20;
    if (!at.is_in_front || !is_inside) return;
    candidates.push_back({size + (is_hovered ? 2e6 : 0) + (is_chosen ? 1e6 : 0), order});
  };
  std::size_t order = 0;
  const VolumeColumns& columns = facts_->columns;
  for (std::size_t k = 0; k < volumes; ++k)
    consider(columns.node[k], columns.radius[k] / lens.metres_per_pixel(columns.position[k]), order++);
  // Who has no name has an id for programs, such as each junction of a map: that is told where people point.
  for (std::size_t k = 0; k < marks; ++k, ++order) {
    const MarkFacts& mark = facts_->marks[k];
    const bool is_nameless = mark.name == mark.id && !chosen.contains(mark.node) && mark.node != hovered;
    if (!is_nameless && !hides(choices_.section, place_of(mark.node))) consider(mark.node, of_marks, order);
  }
  const std::size_t count = std::min(kMostLabels, candidates.size());
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end());
  std::vector<LabelRequest> wishes;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t row = candidates[k].order;
    LabelRequest& wish = wishes.emplace_back();
    wish.is_mark = row >= volumes;
    wish.text = wish.is_mark ? &facts_->marks[row - volumes].name : &facts_->volumes[row].name;
    wish.node = wish.is_mark ? facts_->marks[row - volumes].node : facts_->volumes[row].node;
    wish.at = lens.project(place_of(wish.node));
    if (!wish.is_mark) wish.reach = columns.radius[row] / lens.metres_per_pixel(columns.position[row]);
    wish.is_chosen = wish.node == hovered || chosen.contains(wish.node);
    wish.stream = stream_of(*editor_, *facts_->state, wish.node);
  }
  return wishes;
}

void SceneView::draw_labels() {
  if (!shows("labels")) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  std::vector<LabelRequest> wishes = label_wishes();

  ImDrawList& list = *ImGui::GetWindowDrawList();
  ImFont* font = theme.fonts().small;
  std::vector<Rectangle> taken;
  for (const LabelRequest& w : wishes) {
    const ImVec2 extent = extent_of(font, w);
    // What is much smaller than its name would be hidden by it: the card says it where people point.
    if (!w.is_mark && !w.is_chosen && 2 * w.reach < kLeastShareOfLabel * extent.x) continue;
    const Seen anchor = w.is_mark || w.is_chosen ? w.at : visible_anchor(w.node, w.at);
    if (!anchor.is_in_front) continue;
    const ImVec2 p = on_screen(anchor);
    const float below = w.is_mark ? theme.px(20) + (w.stream ? 0.575f * font->FontSize : 0) : 0;
    const float padding = theme.px(5), gap = theme.px(20), beside = extent.x / 2 + theme.px(16);
    const std::array<ImVec2, 6> offsets = {{{0, below}, {0, -gap}, {0, gap}, {beside, 0}, {-beside, 0}, {0, -2 * gap}}};
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const ImVec2 middle{p.x + offsets[k].x, p.y + offsets[k].y};
      const Rectangle place{middle.x - extent.x / 2 - padding, middle.y - extent.y / 2 - theme.px(2),
                            middle.x + extent.x / 2 + padding, middle.y + extent.y / 2 + theme.px(2)};
      if (std::any_of(taken.begin(), taken.end(), [&](const Rectangle& r) { return r.meets(place); })) continue;
      taken.push_back(place);
      if (k > 0 && !w.is_mark) {
        list.AddLine(p, middle, faded(c.text, 0.55f), 1);
        list.AddCircleFilled(p, theme.px(2), faded(c.text, 0.8f));
      }
      write_label(list, theme, w, place, {std::round(middle.x - extent.x / 2), std::round(middle.y - extent.y / 2)});
      break;
    }
  }
}

void SceneView::draw_scale_and_north() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Camera& camera = choices_.camera;
  // The arrow of north lies flat in the scene, so that it turns and tilts with it.
  const double turn = (90 - facts_->state->plan->settings.true_north) * std::numbers::pi / 180;
  const Vector3 north{std::cos(turn), std::sin(turn), 0}, east{north.y, -north.x, 0};
  const float bottom = at_.y + height() - strip_height();
  const ImVec2 middle{at_.x + width() - theme.px(38), bottom - theme.px(44)};
  const float r = theme.px(17);
  const auto at = [&](const Vector3& v) {
    return ImVec2{middle.x + r * static_cast<float>(dot(v, camera.right())),
                  middle.y - r * static_cast<float>(dot(v, camera.up()))};
  };
  std::array<ImVec2, 32> ring;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / ring.size();
    ring[k] = at({std::cos(angle), std::sin(angle), 0});
  }
  list.AddPolyline(ring.data(), static_cast<int>(ring.size()), faded(c.text_soft, 0.6f), ImDrawFlags_Closed, theme.px(1));
  list.AddTriangleFilled(at(1.0 * north), at(-0.35 * north + 0.42 * east), at(-0.1 * north), c.text_soft);
  list.AddTriangleFilled(at(1.0 * north), at(-0.35 * north - 0.42 * east), at(-0.1 * north), faded(c.text_soft, 0.5f));
  ImFont* font = theme.fonts().small;
  const ImVec2 n = at(1.45 * north);
  list.AddText(font, font->FontSize, {n.x - theme.px(4), n.y - theme.px(7)}, c.text_soft, "N");
  // A bar of a round length, true at the point that the camera turns around.
  const double unit = camera.metres_per_pixel(camera.target, height());
  const double metres = round_distance(unit * theme.px(90));
  const float length = static_cast<float>(metres / unit);
  const ImVec2 end{at_.x + width() - theme.px(76), bottom - theme.px(26)}, begin{end.x - length, end.y};
  list.AddLine(begin, end, c.text_soft, theme.px(1.5f));
  for (const ImVec2 p : {begin, end, ImVec2{(begin.x + end.x) / 2, end.y}})
    list.AddLine({p.x, p.y - theme.px(4)}, p, c.text_soft, theme.px(1.2f));
  const std::string text = reading::quantity(metres, Unit::metre);
  const ImVec2 extent = font->CalcTextSizeA(font->FontSize, 1e4f, 0, text.c_str());
  list.AddText(font, font->FontSize, {(begin.x + end.x - extent.x) / 2, end.y - theme.px(5) - extent.y}, c.text_soft,
               text.c_str());
}

// What keys do just now, across the top where nothing else lies.
void SceneView::draw_hint(const std::string& text) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const float most = width() - theme.px(40);
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, most), pad{theme.px(9), theme.px(5)};
  const ImVec2 at{at_.x + (width() - extent.x) / 2, at_.y + theme.px(50)};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x - pad.x, at.y - pad.y}, {at.x + extent.x + pad.x, at.y + extent.y + pad.y}, faded(c.raised, 0.9f),
                     theme.px(5));
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), at, c.text_soft, text.c_str(), nullptr, most);
}

void SceneView::draw_layers_popup() {
  PersonSettings& person = editor_->person;
  ImGui::PushFont(editor_->theme.fonts().strong);
  ImGui::TextUnformatted("Layers");
  ImGui::PopFont();
  for (const Layer& layer : layers()) {
    bool is_shown = is_on(person, layer.id);
    if (ImGui::Checkbox(layer.label, &is_shown)) set_layer(person, layer.id, is_shown);
  }
  ImGui::Separator();
  bool is_cut = choices_.section.is_on;
  if (ImGui::Checkbox("Section (Alt+B; Shift+wheel moves it)", &is_cut)) toggle_section();
  if (choices_.section.is_on && ImGui::SmallButton("Turn it")) next_section();
}

// Two quiet buttons: what is shown, and what the colours mean.
void SceneView::draw_tools() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImGui::SetCursorScreenPos({at_.x + theme.px(10), at_.y + theme.px(10)});
  ImGui::PushStyleColor(ImGuiCol_Button, faded(c.raised, 0.85f));
  if (ImGui::Button((std::string(icon::kEye) + "  Show##layers").c_str())) ImGui::OpenPopup("layers");
  ImGui::SameLine(0, theme.px(6));
  std::string label = "Use";
  const std::vector<ColourChoice>& known = colours_.choices(*facts_);
  for (const ColourChoice& choice : known)
    if (choice.id == colour_choice()) label = choice.label;
  if (ImGui::Button(("Colour: " + label + "##colours").c_str())) ImGui::OpenPopup("colours");
  note_place(*editor_, "view/colours");
  ImGui::SameLine(0, theme.px(6));
  if (ImGui::Button((std::string("Drawn: ") + form_of(editor_->person.drawn_as).label + "##forms").c_str()))
    ImGui::OpenPopup("forms");
  note_place(*editor_, "view/forms");
  hidden_note_ = {};
  if (const std::string hidden = hidden_.text(*editor_); !hidden.empty()) {
    ImGui::SameLine(0, theme.px(6));
    ImGui::PushStyleColor(ImGuiCol_Text, c.warning);
    if (ImGui::Button((std::string(icon::kHidden) + "  " + hidden + "##hidden").c_str())) show_all(*editor_);
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Click to show all in 3D");
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    hidden_note_ = {low.x, low.y, high.x, high.y};
  }
  ImGui::PopStyleColor();
  if (is_walking_) { draw_hint("Walking: W A S D, drag to look around, E and Q up and down, Esc ends it"); }
  if (ImGui::BeginPopup("layers")) {
    draw_layers_popup();
    ImGui::EndPopup();
  }
  draw_forms_popup();
  ImGui::SetNextWindowSizeConstraints({theme.px(240), 0}, {theme.px(420), theme.px(420)});
  if (ImGui::BeginPopup("colours")) {
    for (std::size_t k = 0; k < known.size(); ++k) {
      if (k == 4) ImGui::Separator();
      if (ImGui::Selectable(known[k].label.c_str(), known[k].id == colour_choice())) colour_by(known[k].id);
    }
    ImGui::EndPopup();
  }
}

}  // namespace bl::desktop
