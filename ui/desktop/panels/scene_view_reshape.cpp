// Handles on a standing volume: its storeys, and the angle and the aspect of its block. One drag is one gesture.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <GLFW/glfw3.h>

#include "core/base/text.h"
#include "core/reading/views/node.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

// In points: how near the mouse has to be, how far handles stand from what they change, and from the middle at the least, where
// the arms of the move stand.
constexpr float kHandleGrip = 10, kHandleGap = 26, kHandleLeast = 118;
constexpr double kFineShare = 0.1, kTurnSnap = 15, kAspectSnap = 0.25;
constexpr double kDegree = std::numbers::pi / 180;
// Where the eye looks so level, or so straight down, a handle cannot be pulled.
constexpr double kLevel = 0.12, kUpright = 0.97;
constexpr double kLeastAspect = 0.05, kMostAspect = 20, kMostStoreys = 500;  // as the ports have them

std::string path_of_handle(SceneView::Handle handle) {
  switch (handle) {
    case SceneView::Handle::angle: return reading::path_of<&reading::FootprintFigures::angle>();
    case SceneView::Handle::aspect: return reading::path_of<&reading::FootprintFigures::aspect>();
    default: return reading::path_of<&reading::FootprintFigures::storeys>();
  }
}

Vector3 direction(double degrees) { return {std::cos(degrees * kDegree), std::sin(degrees * kDegree), 0}; }

// Away from the arms of the move, which point to east and north.
Vector3 turned_away(const Vector3& axis) { return axis.x + axis.y > 0 ? -axis : axis; }

// From -180 to 180.
double half_turns(double degrees) { return degrees - 360 * std::round(degrees / 360); }

}  // namespace

// Of the one that is chosen, where it stands.
std::vector<SceneView::HandlePlace> SceneView::handle_places() const {
  std::vector<HandlePlace> places;
  if (editor_->is_beamer || is_walking_ || move_ || !facts_ || editor_->picks.nodes.size() != 1) return places;
  const std::string& id = *editor_->picks.nodes.begin();
  const VolumeFacts* volume = facts_->volume_of(seen_index(id));
  const auto node = editor_->scene().nodes.find(id);
  if (volume == nullptr || !volume->cell || node == editor_->scene().nodes.end()) return places;
  const auto figures = reading::row_of<reading::FootprintFigures>(*facts_->state, volume->node);
  if (!figures || !(volume->figures.weight > 0)) return places;
  Point3 centre = place_of(volume->node);
  centre.z = volume->figures.bottom;
  const double unit = choices_.camera.metres_per_pixel(centre, height()) * editor_->theme.scale();
  const double gap = kHandleGap * unit, least = kHandleLeast * unit;
  const Vector3 forward = choices_.camera.forward();
  if (std::abs(forward.z) < kUpright) {
    const double top = std::max(volume->figures.bottom + volume->figures.height, place_of(volume->node).z + least - gap);
    const Point3 roof{centre.x, centre.y, volume->figures.bottom + volume->figures.height};
    places.push_back({Handle::storeys, {centre.x, centre.y, top + gap}, roof, id});
  }
  if (figures->form != "block" || std::abs(forward.z) < kLevel) return places;
  const Vector3 first = direction(figures->angle), second{-first.y, first.x, 0};
  const double aspect = figures->aspect > 0 ? figures->aspect : 1, weight = volume->figures.weight;
  const Vector3 u = turned_away(first), v = turned_away(second);
  const double a = std::sqrt(weight * aspect), b = std::sqrt(weight / aspect);
  places.push_back({Handle::angle, centre + std::max(a + gap, least) * u, centre + a * u, id});
  places.push_back({Handle::aspect, centre + (b + 0.5 * gap) * v, centre + b * v, id});
  return places;
}

std::vector<std::pair<SceneView::Handle, ImVec2>> SceneView::handles() const {
  std::vector<std::pair<Handle, ImVec2>> found;
  for (const HandlePlace& place : handle_places())
    if (const Seen at = seen(place.at); at.is_in_front) found.emplace_back(place.handle, on_screen(at));
  return found;
}

std::optional<SceneView::HandlePlace> SceneView::reshape_at(ImVec2 mouse) const {
  std::optional<HandlePlace> nearest;
  double least = kHandleGrip * editor_->theme.scale();
  for (const HandlePlace& place : handle_places()) {
    const Seen at = seen(place.at);
    const ImVec2 p = on_screen(at);
    const double far = std::hypot(p.x - mouse.x, p.y - mouse.y);
    if (!at.is_in_front || far > least) continue;
    least = far;
    nearest = place;
  }
  return nearest;
}

// Where the hand is: the angle around the centre, the distance along the second side, the height.
std::optional<double> SceneView::hand_on(const Reshape& reshape) const {
  const Ray ray = ray_at(ImGui::GetIO().MousePos);
  if (reshape.handle == Handle::storeys) {
    const auto at = nearest_on_axis(ray, reshape.centre, {0, 0, 1});
    return at ? std::optional(at->z) : std::nullopt;
  }
  const auto at = meet_plane(ray, reshape.centre, {0, 0, 1});
  if (!at || distance(*at, facts_->centre) > 20 * facts_->radius) return {};
  const Vector3 way = *at - reshape.centre;
  if (reshape.handle == Handle::angle) return norm(way) > 1e-6 ? std::optional(std::atan2(way.y, way.x) / kDegree) : std::nullopt;
  const auto figures = reading::row_of<reading::FootprintFigures>(*facts_->state, seen_index(reshape.node));
  if (!figures) return {};
  const Vector3 first = direction(figures->angle);
  return std::abs(dot(way, Vector3{-first.y, first.x, 0}));
}

void SceneView::begin_reshape(const HandlePlace& place) {
  drag_ = Drag::none;
  const std::string path = path_of_handle(place.handle);
  if (editor_->scene().nodes.at(place.node).locked.contains(path))
    return editor_->notify(NoticeKind::warning, std::string(icon::kLock) + "  " + path + " of " + editor_->name_of(place.node) +
                                                    " is locked. Unlock it in the inspector to change it.");
  const std::uint32_t node = seen_index(place.node);
  const auto figures = reading::row_of<reading::FootprintFigures>(*facts_->state, node);
  const VolumeFacts* volume = facts_->volume_of(node);
  if (!figures || volume == nullptr) return;
  Reshape reshape;
  reshape.handle = place.handle;
  reshape.node = place.node;
  reshape.centre = place_of(node);
  reshape.centre.z = volume->figures.bottom;
  reshape.storey_height = std::max(0.1, volume->figures.storey_height);
  reshape.start = place.handle == Handle::angle    ? figures->angle
                  : place.handle == Handle::aspect ? figures->aspect
                                                   : static_cast<double>(figures->storeys);
  reshape.value = reshape.start;
  const auto grip = hand_on(reshape);
  if (!grip) return;
  reshape.grip = *grip;
  reshape.gesture = editor_->new_gesture();
  reshape_ = std::move(reshape);
}

void SceneView::go_on_reshaping() {
  const ImGuiIO& io = ImGui::GetIO();
  Reshape& reshape = *reshape_;
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) || !editor_->scene().nodes.contains(reshape.node)) return end_reshape(false);
  if (!ImGui::IsMouseDown(0)) return end_reshape(true);
  const auto hand = hand_on(reshape);
  if (!hand) return;
  const double fine = io.KeyShift ? kFineShare : 1;
  double value = reshape.value;
  if (reshape.handle == Handle::storeys) {
    const double steps = std::round(fine * (*hand - reshape.grip) / reshape.storey_height);
    value = std::clamp(reshape.start + steps, 1.0, kMostStoreys);
  } else if (reshape.handle == Handle::angle) {
    // In small steps, so that a hand may go around more than once.
    reshape.turned += half_turns(*hand - reshape.grip - reshape.turned);
    value = reshape.start + fine * reshape.turned;
    value = io.KeyCtrl ? kTurnSnap * std::round(value / kTurnSnap) : std::round(10 * value) / 10;
    value = half_turns(value) + 0.0;
  } else if (reshape.grip > 1e-3) {
    // The area stays, so that a second side of twice the length has a first one of half of it.
    const double share = std::max(*hand, 0.02 * reshape.grip) / reshape.grip;
    value = reshape.start / std::pow(share, 2 * fine);
    value = io.KeyCtrl ? kAspectSnap * std::round(value / kAspectSnap) : std::round(100 * value) / 100;
    value = std::clamp(value, kLeastAspect, kMostAspect);
  }
  if (value == reshape.value) return;
  reshape.value = value;
  const std::string text = reshape.handle == Handle::storeys ? fixed(value, 0) : shortest(value);
  editor_->show({command<SetPort>({reshape.node, {path_of_handle(reshape.handle)}, {text}})}, reshape.gesture);
}

void SceneView::end_reshape(bool is_kept) {
  if (!reshape_) return;
  if (is_kept) editor_->end_gesture(reshape_->gesture);
  else editor_->document->running().abandon(reshape_->gesture);
  reshape_.reset();
  drag_ = Drag::none;
}

void SceneView::draw_reshape() {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_free = is_hovered_ && !reshape_ && drag_ == Drag::none;
  const auto under = is_free ? reshape_at(ImGui::GetIO().MousePos) : std::nullopt;
  for (const HandlePlace& place : handle_places()) {
    if (reshape_ && reshape_->handle != place.handle) continue;
    const Seen middle = seen(place.at), foot = seen(place.foot);
    if (!middle.is_in_front || !foot.is_in_front) continue;
    const bool is_hot = reshape_ || (under && under->handle == place.handle);
    const ImVec2 p = on_screen(middle), f = on_screen(foot);
    const ImU32 ink = is_hot ? c.text : c.accent;
    const float r = theme.px(is_hot ? 7.5f : 6), wide = theme.px(is_hot ? 2.4f : 1.6f);
    list.AddLine(f, p, faded(ink, 0.8f), wide);
    if (place.handle == Handle::storeys) {
      // A double arrow: up for more storeys, down for fewer.
      list.AddTriangleFilled({p.x - r, p.y - theme.px(2)}, {p.x, p.y - theme.px(2) - 1.3f * r}, {p.x + r, p.y - theme.px(2)},
                             ink);
      list.AddTriangleFilled({p.x - r, p.y + theme.px(2)}, {p.x + r, p.y + theme.px(2)}, {p.x, p.y + theme.px(2) + 1.3f * r},
                             ink);
    } else if (place.handle == Handle::angle) {
      // A piece of the circle that the hand follows.
      const Point3 centre = place_of(seen_index(place.node));
      const Vector3 way{place.at.x - centre.x, place.at.y - centre.y, 0};
      const double start = std::atan2(way.y, way.x) / kDegree, radius = norm(way);
      std::array<ImVec2, 17> arc;
      for (std::size_t k = 0; k < arc.size(); ++k) {
        const Vector3 to = direction(start + 3.0 * (static_cast<double>(k) - 8));
        arc[k] = on_screen(seen({centre.x + radius * to.x, centre.y + radius * to.y, place.at.z}));
      }
      list.AddPolyline(arc.data(), static_cast<int>(arc.size()), ink, 0, wide);
      list.AddCircleFilled(p, r, ink);
      list.AddCircle(p, r, c.sky);
    } else {
      list.AddRectFilled({p.x - 0.85f * r, p.y - 0.85f * r}, {p.x + 0.85f * r, p.y + 0.85f * r}, ink, theme.px(1));
      list.AddRect({p.x - 0.85f * r, p.y - 0.85f * r}, {p.x + 0.85f * r, p.y + 0.85f * r}, c.sky, theme.px(1));
    }
    note_area(*editor_,
              place.handle == Handle::storeys ? "view/storeys"
              : place.handle == Handle::angle ? "view/angle"
                                              : "view/aspect",
              {p.x - r, p.y - r}, {p.x + r, p.y + r});
  }
  if (under)
    draw_hint(under->handle == Handle::storeys ? "Drag: more or fewer storeys"
              : under->handle == Handle::angle ? "Drag: turn the block"
                                               : "Drag: make the block longer or wider");
  if (!reshape_) return;
  const double value = reshape_->value;
  const std::string text = reshape_->handle == Handle::storeys ? fixed(value, 0) + (value == 1 ? " storey" : " storeys")
                           : reshape_->handle == Handle::angle ? "Angle  " + fixed(value, 1) + "\xc2\xb0"
                                                               : "Sides  " + fixed(value, 2) + " : 1";
  draw_beside_hand(text, reshape_->handle == Handle::storeys ? "Shift: fine   Esc: back"
                         : reshape_->handle == Handle::angle ? "Shift: fine   Ctrl: steps of 15\xc2\xb0   Esc: back"
                                                             : "Shift: fine   Ctrl: quarters   Esc: back");
}

}  // namespace bl::desktop
