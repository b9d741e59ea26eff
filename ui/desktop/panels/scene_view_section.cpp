// The section's plane under the hand: handles for its place and its angle, a strip with its numbers, and where it is kept.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <GLFW/glfw3.h>

#include "core/base/text.h"
#include "core/base/unit.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

// In points: how near the mouse has to be; how far the arrow of the place reaches; a field of the strip.
constexpr float kPlaneGrip = 11, kPlaneArrow = 25, kPlaneField = 76;
constexpr double kPlaneFine = 0.1, kPlaneTurnSnap = 15, kFullTurn = 360;
constexpr double kRadian = std::numbers::pi / 180;
// An arrow that is seen so end-on cannot be pulled; a plane that is seen so level cannot be turned.
constexpr double kEndOn = 0.2, kTooLevel = 0.12;
// How many files a person's settings remember a section of.
constexpr std::size_t kMostSections = 40;

// The way in which the number of its place grows.
Vector3 axis_of(const ViewSection& section) { return is_level(section) ? Vector3{0, 0, 1} : -section.normal; }

ViewSection placed_at(const ViewSection& section, double position) {
  if (!is_level(section)) return upright_section(bearing_of(section), position);
  return section.normal.z > 0 ? level_section(position) : flipped(level_section(position));
}

// Turned so that it still goes through the point.
ViewSection turned_to(double bearing, const Point3& through) {
  const ViewSection at_origin = upright_section(bearing, 0);
  return upright_section(bearing, -dot(at_origin.normal, through));
}

double rounded_to(double value, double step) { return step * std::round(value / step) + 0.0; }

std::string bearing_text(double bearing) { return shortest(rounded_to(bearing, 0.1)) + "\xc2\xb0"; }

}  // namespace

void SceneView::toggle_section() {
  ViewSection& section = choices_.section;
  // It comes back where it was.
  if (section.is_on || section != ViewSection{}) section.is_on = !section.is_on;
  else next_section();
}

void SceneView::next_section() {
  if (!facts_) return;
  ViewSection& section = choices_.section;
  const Point3 middle = facts_->centre;
  if (!section.is_on) section = level_section(facts_->ground + 0.45 * 2 * (middle.z - facts_->ground));
  else if (is_level(section)) section = turned_to(0, middle);
  else if (section.normal.y != 0) section = turned_to(270, middle);
  else section = {};
}

void SceneView::set_section(const ViewSection& section) { choices_.section = section; }

std::string SceneView::section_for_export() const {
  return facts_ && choices_.section.is_on ? section_option(choices_.section, model_box(*facts_)) : "";
}

// A person's section of a scene stands among their settings, as cameras of the scene do in the scene: it is no part of it.
void SceneView::recall_section() {
  kept_section_ = {};
  const auto& sections = editor_->person.sections;
  const auto found = sections.find(editor_->document->source());
  if (found == sections.end()) return;
  if (const auto section = section_from_text(found->second)) choices_.section = kept_section_ = *section;
}

void SceneView::keep_section() {
  if (choices_.section == kept_section_) return;
  kept_section_ = choices_.section;
  auto& sections = editor_->person.sections;
  const std::string& file = editor_->document->source();
  if (file.empty()) return;
  if (!kept_section_.is_on) {
    sections.erase(file);
    return;
  }
  if (!sections.contains(file) && sections.size() >= kMostSections) sections.erase(sections.begin());
  sections[file] = section_text(kept_section_);
}

// Where they can be taken hold of: at places of the frame that are in the picture.
std::vector<SceneView::PlaneHandlePlace> SceneView::plane_handle_places() const {
  std::vector<PlaneHandlePlace> places;
  if (!choices_.section.is_on || editor_->is_beamer || is_walking_ || move_ || reshape_ || !facts_) return places;
  const std::array<Point3, 4> corners = section_corners(choices_.section, model_box(*facts_));
  const float edge = editor_->theme.px(14);
  const auto first_in_sight = [&](const std::vector<Point3>& wanted) -> std::optional<Point3> {
    for (const Point3& at : wanted)
      if (const Seen p = seen(at);
          p.is_in_front && p.x > edge && p.y > edge && p.x < width() - edge && p.y < height() - strip_height() - edge)
        return at;
    return {};
  };
  const auto between_of = [&](std::size_t a, std::size_t b, double share) {
    return corners[a] + share * (corners[b] - corners[a]);
  };
  const Vector3 forward = choices_.camera.forward(), axis = axis_of(choices_.section);
  const bool is_flat = is_level(choices_.section);
  std::vector<Point3> for_place, for_angle;
  for (const double share : is_flat ? std::vector{0.0, 0.5, 1.0} : std::vector{0.5, 0.25, 0.75, 0.1, 0.9})
    for (const auto& [a, b] : is_flat ? std::vector<std::pair<std::size_t, std::size_t>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}}
                                      : std::vector<std::pair<std::size_t, std::size_t>>{{3, 2}, {0, 1}})
      for_place.push_back(between_of(a, b, share));
  if (!is_flat) for_angle = {corners[2], corners[3], corners[1], corners[0]};
  if (std::abs(dot(forward, axis)) < std::sqrt(1 - kEndOn * kEndOn))
    if (const auto at = first_in_sight(for_place)) places.push_back({PlaneHandle::place, *at});
  if (!is_flat && std::abs(forward.z) > kTooLevel)
    if (const auto at = first_in_sight(for_angle)) places.push_back({PlaneHandle::angle, *at});
  return places;
}

std::vector<std::pair<SceneView::PlaneHandle, ImVec2>> SceneView::plane_handles() const {
  std::vector<std::pair<PlaneHandle, ImVec2>> found;
  for (const PlaneHandlePlace& place : plane_handle_places()) found.emplace_back(place.handle, on_screen(seen(place.at)));
  return found;
}

std::optional<SceneView::PlaneHandlePlace> SceneView::plane_handle_at(ImVec2 mouse) const {
  std::optional<PlaneHandlePlace> nearest;
  double least = kPlaneGrip * editor_->theme.scale();
  for (const PlaneHandlePlace& place : plane_handle_places()) {
    const ImVec2 p = on_screen(seen(place.at));
    const double far = std::hypot(p.x - mouse.x, p.y - mouse.y);
    if (far > least) continue;
    least = far;
    nearest = place;
  }
  return nearest;
}

// Along the axis [m], or around the pivot from east anticlockwise [degree].
std::optional<double> SceneView::hand_on(const PlaneDrag& drag) const {
  const Ray ray = ray_at(ImGui::GetIO().MousePos);
  if (drag.handle == PlaneHandle::place) {
    const auto at = nearest_on_axis(ray, drag.pivot, axis_of(drag.start));
    return at ? std::optional(dot(*at - drag.pivot, axis_of(drag.start))) : std::nullopt;
  }
  const auto at = meet_plane(ray, drag.pivot, {0, 0, 1});
  if (!at || distance(*at, facts_->centre) > 20 * facts_->radius) return {};
  const Vector3 way = *at - drag.pivot;
  return std::hypot(way.x, way.y) > 1e-6 ? std::optional(std::atan2(way.y, way.x) / kRadian) : std::nullopt;
}

void SceneView::begin_plane_drag(const PlaneHandlePlace& place) {
  drag_ = Drag::none;
  PlaneDrag drag{place.handle, choices_.section, place.at, 0, 0};
  if (place.handle == PlaneHandle::angle) {
    // Around the middle of the frame, at the height of the hand.
    const auto corners = section_corners(choices_.section, model_box(*facts_));
    drag.pivot = 0.5 * (corners[0] + corners[1]);
    drag.pivot.z = place.at.z;
  }
  const auto grip = hand_on(drag);
  if (!grip) return;
  drag.grip = *grip;
  plane_drag_ = drag;
}

void SceneView::go_on_with_plane() {
  const ImGuiIO& io = ImGui::GetIO();
  PlaneDrag& drag = *plane_drag_;
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) choices_.section = drag.start;
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) || !ImGui::IsMouseDown(0)) {
    plane_drag_.reset();
    return;
  }
  const auto hand = hand_on(drag);
  if (!hand) return;
  const double fine = io.KeyShift ? kPlaneFine : 1;
  if (drag.handle == PlaneHandle::place) {
    const double position = position_of(drag.start) + fine * (*hand - drag.grip);
    choices_.section = placed_at(drag.start, rounded_to(position, io.KeyCtrl ? 1.0 : io.KeyShift ? 0.001 : 0.01));
    return;
  }
  const double further = *hand - drag.grip - drag.turned;
  drag.turned += further - kFullTurn * std::round(further / kFullTurn);
  // Bearings go clockwise, angles of the plane do not.
  const double bearing = bearing_of(drag.start) - fine * drag.turned;
  choices_.section = turned_to(rounded_to(bearing, io.KeyCtrl ? kPlaneTurnSnap : 0.1), drag.pivot);
}

void SceneView::draw_plane_handles() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_free = is_hovered_ && !plane_drag_ && drag_ == Drag::none;
  const auto under = is_free ? plane_handle_at(ImGui::GetIO().MousePos) : std::nullopt;
  for (const PlaneHandlePlace& place : plane_handle_places()) {
    if (plane_drag_ && plane_drag_->handle != place.handle) continue;
    const bool is_hot = plane_drag_ || (under && under->handle == place.handle);
    const ImVec2 p = on_screen(seen(place.at));
    const ImU32 ink = is_hot ? c.text : c.accent;
    const float r = theme.px(is_hot ? 7.5f : 6), wide = theme.px(is_hot ? 2.6f : 1.8f);
    list.AddCircleFilled(p, r, ink);
    list.AddCircle(p, r, c.sky);
    if (place.handle == PlaneHandle::place) {
      const double unit = choices_.camera.metres_per_pixel(place.at, height()) * theme.scale();
      for (const double side : {-1.0, 1.0}) {
        const Seen tip_seen = seen(place.at + side * kPlaneArrow * unit * axis_of(choices_.section));
        const ImVec2 tip = on_screen(tip_seen);
        const float dx = tip.x - p.x, dy = tip.y - p.y, length = std::hypot(dx, dy);
        if (!tip_seen.is_in_front || length < 1.3f * r) continue;
        const float ux = dx / length, uy = dy / length, head = theme.px(8), half = theme.px(4.5f);
        list.AddLine({p.x + r * ux, p.y + r * uy}, {tip.x - head * ux, tip.y - head * uy}, ink, wide);
        list.AddTriangleFilled(tip, {tip.x - head * ux - half * uy, tip.y - head * uy + half * ux},
                               {tip.x - head * ux + half * uy, tip.y - head * uy - half * ux}, ink);
      }
    } else {
      const auto corners = section_corners(choices_.section, model_box(*facts_));
      const Point3 middle = 0.5 * (corners[0] + corners[1]);
      const double dx = place.at.x - middle.x, dy = place.at.y - middle.y, radius = std::hypot(dx, dy),
                   start = std::atan2(dy, dx);
      std::array<ImVec2, 17> arc;
      const double step = 0.55 * kPlaneArrow * choices_.camera.metres_per_pixel(place.at, height()) * theme.scale() / 4;
      for (std::size_t k = 0; k < arc.size(); ++k) {
        const double angle = start + (static_cast<double>(k) - 8) * step / std::max(radius, 1e-6);
        arc[k] = on_screen(seen({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle), place.at.z}));
      }
      list.AddPolyline(arc.data(), static_cast<int>(arc.size()), ink, 0, wide);
    }
    note_area(*editor_, place.handle == PlaneHandle::place ? "view/plane/place" : "view/plane/angle", {p.x - r, p.y - r},
              {p.x + r, p.y + r});
  }
  if (under) draw_hint(under->handle == PlaneHandle::place ? "Drag: move the section" : "Drag: turn the section");
  if (!plane_drag_) return;
  const bool is_place = plane_drag_->handle == PlaneHandle::place;
  draw_beside_hand(
      is_place ? "Section at  " + fixed(position_of(choices_.section), 2) + " m"
               : "Section towards  " + bearing_text(bearing_of(choices_.section)),
      is_place ? "Shift: fine   Ctrl: whole metres   Esc: back" : "Shift: fine   Ctrl: steps of 15\xc2\xb0   Esc: back");
}

// A number of the strip: typed with its unit, or dragged.
std::optional<double> SceneView::plane_field(const char* key, const std::string& shown, double value, double per_pixel,
                                             bool is_length) {
  CellLook look;
  look.is_scrubbed = true;
  const CellEvent event = cell(*editor_, key, shown, shown, editor_->theme.px(kPlaneField), look);
  ImGui::SameLine(0, editor_->theme.px(6));
  if (event.is_scrubbing) {
    if (event.has_scrub_begun) plane_scrub_ = value;
    plane_scrub_ += per_pixel * event.scrubbed;
    return rounded_to(plane_scrub_, is_length ? 0.01 : 0.1);
  }
  if (!event.is_typed) return {};
  const auto typed = parse_quantity(event.text, is_length ? Unit::metre : Unit::degree);
  if (typed && std::abs(*typed) < 1e6) return *typed;
  complain(
      *editor_, key,
      is_length ? "expects a length such as 12.5 or 1250 cm" : "expects an angle such as 35 or 35\xc2\xb0, clockwise from north");
  return {};
}

void SceneView::draw_section_strip() {
  ViewSection& section = choices_.section;
  if (!section.is_on || !facts_) return;
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  const float row = ImGui::GetFrameHeight(), gap = theme.px(6);
  ImGui::SetCursorScreenPos({at_.x + theme.px(10), at_.y + theme.px(10) + row + gap});
  ImGui::GetWindowDrawList()->AddRectFilled(
      {at_.x + theme.px(6), ImGui::GetCursorScreenPos().y - theme.px(3)},
      {at_.x + theme.px(6) + strip_width_, ImGui::GetCursorScreenPos().y + row + theme.px(3)}, faded(c.raised, 0.85f),
      theme.px(5));
  ImGui::AlignTextToFramePadding();
  const auto words = [&](const char* text) {
    ImGui::TextUnformatted(text);
    ImGui::SameLine(0, gap);
  };
  const auto button = [&](const char* label, const char* key, const char* hint) {
    const bool is_pressed_now = ImGui::Button(label);
    note_place(*editor_, key);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", hint);
    ImGui::SameLine(0, gap);
    return is_pressed_now;
  };
  words("Section");
  const bool was_level = is_level(section);
  if (button(was_level ? "Level##kind" : "Upright##kind", "view/section/kind", "Level or upright (Shift+Alt+B turns it)"))
    section =
        was_level ? turned_to(0, facts_->centre) : level_section(facts_->ground + 0.9 * (facts_->centre.z - facts_->ground));
  words("at");
  const double position = position_of(section);
  if (const auto to = plane_field("view/section/at", fixed(position, 2) + " m", position, facts_->radius / 400, true))
    section = placed_at(section, *to);
  if (!is_level(section)) {
    words("towards");
    const double bearing = bearing_of(section);
    const auto corners = section_corners(section, model_box(*facts_));
    if (const auto to = plane_field("view/section/towards", bearing_text(bearing), bearing, 0.5, false))
      section = turned_to(*to, 0.5 * (corners[0] + corners[1]));
  }
  if (button("Flip##section", "view/section/flip", "Show the other side")) section = flipped(section);
  if (button("Export ...##section", "view/section/export", "This section as a drawing"))
    if (editor_->dialogs != nullptr) editor_->dialogs->show_export(section_for_export());
  if (button("Off##section", "view/section/off", "No section (Alt+B)")) section.is_on = false;
  strip_width_ = ImGui::GetCursorScreenPos().x - at_.x - theme.px(6);
  ImGui::NewLine();
  draw_complaint(*editor_, "view/section/at", theme.px(300));
  draw_complaint(*editor_, "view/section/towards", theme.px(300));
}

}  // namespace bl::desktop
