// Moving what is chosen: a gizmo of three axes and three planes, or G, an axis and a number with its unit.
#include <algorithm>
#include <array>
#include <cmath>

#include <GLFW/glfw3.h>

#include "core/base/text.h"
#include "core/base/unit.h"
#include "core/reading/views/node.h"
#include "core/reading/views/solver.h"
#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr float kArm = 84, kPlaneNear = 20, kPlaneFar = 36, kGrip = 7;
constexpr double kSnap = 1, kFine = 0.1;
constexpr std::array<ImU32, 3> kAxisColours = {0xff5a5ae0u, 0xff5fb86fu, 0xffe08a4bu};
constexpr std::array<const char*, 3> kAxisNames = {"X", "Y", "Z"};

Vector3 axis(int k) { return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }

std::string json_of(const Point3& p) {
  // To the millimetre: what a hand places has no more digits than that.
  const auto text = [](double x) { return shortest(std::round(x * 1000) / 1000 + 0.0); };
  return "[" + text(p.x) + ", " + text(p.y) + ", " + text(p.z) + "]";
}

double cross_of(ImVec2 a, ImVec2 b, ImVec2 p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); }

// What is being typed, as far as it is a length [m].
std::optional<double> typed_length(const std::string& text) {
  const auto metres = parse_quantity(text, Unit::metre);
  return metres && std::isfinite(*metres) ? metres : std::nullopt;
}

bool is_in_quad(const std::array<ImVec2, 4>& q, ImVec2 p) {
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 4; ++i) (cross_of(q[i], q[(i + 1) % 4], p) > 0 ? left : right)++;
  return left == 0 || right == 0;
}

// Corners of the small square of the plane across axis k.
std::array<Point3, 4> plane_corners(const Point3& centre, int k, double unit) {
  const Vector3 u = axis((k + 1) % 3), v = axis((k + 2) % 3);
  const double a = kPlaneNear * unit, b = kPlaneFar * unit;
  return {centre + a * u + a * v, centre + b * u + a * v, centre + b * u + b * v, centre + a * u + b * v};
}

}  // namespace

// Chosen nodes that stand somewhere in the picture.
std::vector<std::string> SceneView::placed(bool tells) {
  std::vector<std::string> ids;
  for (const std::string& id : editor_->picks.nodes) {
    const auto found = editor_->scene().nodes.find(id);
    if (found == editor_->scene().nodes.end() || seen_index(id) >= facts_->places.size()) continue;
    if (left_out_.contains(id)) {
      if (tells) editor_->notify(NoticeKind::told, editor_->name_of(id) + " is hidden from 3D: Shift+H shows it again.");
      continue;
    }
    // A boundary stands where its corners are, whatever its node's place.
    if (!reading::is_a<reading::BoundaryFigures>(found->second)) ids.push_back(id);
  }
  return ids;
}

// Those whose place is not locked. A locked one says so.
std::vector<std::string> SceneView::movable(bool tells) {
  std::vector<std::string> ids = placed(tells);
  std::erase_if(ids, [&](const std::string& id) {
    const bool is_locked = editor_->scene().nodes.at(id).locked.contains(reading::path_of<&reading::NodePlace::position>());
    if (is_locked && tells)
      editor_->notify(NoticeKind::warning, std::string(icon::kLock) + "  " + editor_->name_of(id) +
                                               " is locked in its place. Unlock its position in the inspector to move it.");
    return is_locked;
  });
  return ids;
}

// Where a move takes hold. What is locked has a gizmo too, so that a hand that tries it is told.
std::optional<Point3> SceneView::gizmo_centre() {
  if (editor_->is_beamer || is_walking_ || reshape_) return {};
  if (move_) return move_->anchor + move_->shift;
  std::vector<std::string> ids = movable(false);
  if (ids.empty()) ids = placed(false);
  if (ids.empty()) return {};
  Point3 centre;
  for (const std::string& id : ids) centre += facts_->places[seen_index(id)] / static_cast<double>(ids.size());
  return centre;
}

int SceneView::handle_at(ImVec2 mouse) {
  const auto centre = gizmo_centre();
  if (!centre) return -1;
  const Seen middle = seen(*centre);
  if (!middle.is_in_front) return -1;
  const float scale = editor_->theme.scale();
  const double unit = choices_.camera.metres_per_pixel(*centre, height()) * scale;
  for (int k = 0; k < 3; ++k) {
    std::array<ImVec2, 4> quad;
    const auto corners = plane_corners(*centre, k, unit);
    for (std::size_t i = 0; i < 4; ++i) quad[i] = on_screen(seen(corners[i]));
    if (std::abs(choices_.camera.forward().x * axis(k).x + choices_.camera.forward().y * axis(k).y +
                 choices_.camera.forward().z * axis(k).z) > 0.12 &&
        is_in_quad(quad, mouse))
      return 3 + k;
  }
  int nearest = -1;
  double least = kGrip * scale;
  const ImVec2 from = on_screen(middle);
  for (int k = 0; k < 3; ++k) {
    const ImVec2 to = on_screen(seen(*centre + kArm * unit * axis(k)));
    const double dx = to.x - from.x, dy = to.y - from.y, length = dx * dx + dy * dy;
    if (length < 100) continue;  // seen end-on
    const double t = std::clamp(((mouse.x - from.x) * dx + (mouse.y - from.y) * dy) / length, 0.15, 1.05);
    const double far = std::hypot(mouse.x - from.x - t * dx, mouse.y - from.y - t * dy);
    if (far < least) least = far, nearest = k;
  }
  return nearest;
}

void SceneView::begin_move_by_key() {
  if (facts_ && !move_) begin_move(Move::kFree, true);
}

void SceneView::begin_move(int handle, bool is_by_key) {
  const std::vector<std::string> ids = movable(true);
  if (ids.empty()) return;
  Move move;
  move.handle = handle;
  move.is_by_key = is_by_key;
  for (const std::string& id : ids) {
    move.starts[id] = facts_->places[seen_index(id)];
    move.anchor += move.starts[id] / static_cast<double>(ids.size());
  }
  move.gesture = editor_->new_gesture();
  move_ = std::move(move);
  drag_ = Drag::none;
  // Where the hand takes hold: everything counts from here.
  move_->grip = move_->anchor;
  if (const auto at = hand_shift()) move_->grip = move_->anchor + *at;
}

// How far the hand is from its grip, along the axis or in the plane of the handle.
std::optional<Vector3> SceneView::hand_shift() const {
  const Ray ray = ray_at(ImGui::GetIO().MousePos);
  const Point3& through = move_->anchor;
  std::optional<Point3> at;
  if (move_->handle < 3) {
    at = nearest_on_axis(ray, through, axis(move_->handle));
  } else if (move_->handle < Move::kFree) {
    at = meet_plane(ray, through, axis(move_->handle - 3));
  } else {
    const bool is_steep = std::abs(choices_.camera.forward().z) > 0.16;
    at = meet_plane(ray, through, is_steep ? Vector3{0, 0, 1} : choices_.camera.forward());
  }
  // Beyond the horizon there is no place to put anything.
  if (!at || distance(*at, facts_->centre) > 20 * facts_->radius) return {};
  return *at - move_->grip;
}

void SceneView::go_on_moving() {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) return end_move(false);
  if (!move_->is_by_key && !ImGui::IsMouseDown(0)) return end_move(true);
  if (move_->is_by_key && is_hovered_ && ImGui::IsMouseClicked(0)) return end_move(true);
  if (!move_->typed.empty()) return;
  auto shift = hand_shift();
  if (!shift) return;
  if (io.KeyShift) *shift = kFine * *shift;
  if (io.KeyCtrl) {
    const auto snapped = [](double start, double by) { return by == 0 ? 0.0 : kSnap * std::round((start + by) / kSnap) - start; };
    *shift = {snapped(move_->anchor.x, shift->x), snapped(move_->anchor.y, shift->y), snapped(move_->anchor.z, shift->z)};
  }
  if (distance(*shift, move_->shift) < 5e-4) return;
  move_->shift = *shift;
  apply_move();
}

void SceneView::take_typed() {
  ImGuiIO& io = ImGui::GetIO();
  Move& move = *move_;
  if (!io.KeyCtrl)
    for (int k = 0; k < 3; ++k)
      if (move.typed.empty() && ImGui::IsKeyPressed(GLFW_KEY_X + k, false)) {
        // Along this axis; with Shift in the plane across it. The grip is taken anew.
        move.handle = io.KeyShift ? 3 + k : k;
        move.shift = {};
        move.grip = move.anchor;
        if (const auto at = hand_shift()) move.grip = move.anchor + *at;
      }
  for (const ImWchar letter : io.InputQueueCharacters) {
    const bool is_number = (letter >= '0' && letter <= '9') || letter == '-' || letter == '.' || letter == ',';
    const bool is_unit = !move.typed.empty() && (letter == ' ' || (letter >= 'a' && letter <= 'z')) && letter != 'g';
    if ((is_number || is_unit) && move.typed.size() < 24) move.typed += letter == ',' ? '.' : static_cast<char>(letter);
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_BACKSPACE) && !move.typed.empty()) move.typed.pop_back();
  // A length goes along one axis.
  if (!move.typed.empty() && move.handle >= 3) move.handle = 0;
  if (const auto metres = typed_length(move.typed); metres && distance(move.shift, *metres * axis(move.handle)) > 5e-4) {
    move.shift = *metres * axis(move.handle);
    apply_move();
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) || ImGui::IsKeyPressed(GLFW_KEY_KP_ENTER, false)) end_move(true);
}

void SceneView::apply_move() {
  std::vector<Command> commands;
  for (const auto& [id, start] : move_->starts)
    commands.push_back(
        command<SetPort>({id, {reading::path_of<&reading::NodePlace::position>()}, {json_of(start + move_->shift)}}));
  editor_->show(commands, move_->gesture);
}

void SceneView::end_move(bool is_kept) {
  if (!move_) return;
  // What was read before the slip is not what is meant: it can be mended, or taken back.
  if (is_kept && !move_->typed.empty() && !typed_length(move_->typed))
    return editor_->notify(NoticeKind::warning,
                           "`" + move_->typed + "` is no length: type a number, and a unit such as m or cm.");
  if (is_kept) editor_->end_gesture(move_->gesture);
  else editor_->document->running().abandon(move_->gesture);
  move_.reset();
  drag_ = Drag::none;
}

void SceneView::draw_gizmo() {
  const auto centre = gizmo_centre();
  if (!centre) return;
  const Seen middle = seen(*centre);
  if (!middle.is_in_front) return;
  const Theme& theme = editor_->theme;
  const double unit = choices_.camera.metres_per_pixel(*centre, height()) * theme.scale();
  const ImVec2 from = on_screen(middle);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (!move_) hot_handle_ = is_hovered_ && drag_ == Drag::none ? handle_at(ImGui::GetIO().MousePos) : -1;
  const int held = move_ ? move_->handle : hot_handle_;
  for (int k = 0; k < 3; ++k) {
    const ImU32 colour = kAxisColours[static_cast<std::size_t>(k)];
    if (move_ && held != k && held != 3 + (k + 1) % 3 && held != 3 + (k + 2) % 3 && held != Move::kFree) continue;
    const ImVec2 to = on_screen(seen(*centre + kArm * unit * axis(k)));
    const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
    if (length < 10) continue;
    const float ux = dx / length, uy = dy / length, tip = theme.px(11), wide = theme.px(4.5f);
    list.AddLine({from.x + 0.1f * dx, from.y + 0.1f * dy}, to, colour, theme.px(held == k ? 3.6f : 2.2f));
    list.AddTriangleFilled({to.x + ux * tip, to.y + uy * tip}, {to.x - uy * wide, to.y + ux * wide},
                           {to.x + uy * wide, to.y - ux * wide}, colour);
    list.AddText(theme.fonts().small, theme.fonts().small->FontSize,
                 {to.x + ux * 1.9f * tip - theme.px(4), to.y + uy * 1.9f * tip - theme.px(7)}, colour,
                 kAxisNames[static_cast<std::size_t>(k)]);
  }
  for (int k = 0; k < 3 && !move_; ++k) {
    const Vector3 f = choices_.camera.forward();
    if (std::abs(k == 0 ? f.x : k == 1 ? f.y : f.z) < 0.12) continue;
    std::array<ImVec2, 4> quad;
    const auto corners = plane_corners(*centre, k, unit);
    for (std::size_t i = 0; i < 4; ++i) quad[i] = on_screen(seen(corners[i]));
    const ImU32 colour = kAxisColours[static_cast<std::size_t>(k)];
    list.AddQuadFilled(quad[0], quad[1], quad[2], quad[3], faded(colour, hot_handle_ == 3 + k ? 0.85f : 0.4f));
  }
  list.AddCircleFilled(from, theme.px(4), theme.colours().text);
  list.AddCircle(from, theme.px(4), theme.colours().sky);
}

// Beside the hand: how far it has come, or what is being typed.
void SceneView::draw_typed() {
  if (!move_) return;
  const Vector3& s = move_->shift;
  const auto metres = [](double x) { return fixed(x, 2) + " m"; };
  std::string text;
  if (!move_->typed.empty()) {
    text = std::string(kAxisNames[static_cast<std::size_t>(std::min(move_->handle, 2))]) + "  " + move_->typed + "_";
  } else if (move_->handle < 3) {
    text = std::string(kAxisNames[static_cast<std::size_t>(move_->handle)]) + "  " + metres(dot(s, axis(move_->handle)));
  } else {
    text = metres(s.x) + "   " + metres(s.y) + (s.z != 0 ? "   " + metres(s.z) : "");
  }
  const std::string hint = move_->is_by_key
                               ? "X Y Z: axis   number: exactly   Shift: fine   Ctrl: whole metres   Enter: done   Esc: back"
                               : "Shift: fine   Ctrl: whole metres   Esc: back";
  draw_beside_hand(text, hint);
}

void SceneView::draw_beside_hand(const std::string& text, const std::string& hint) {
  const Theme& theme = editor_->theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 extent = theme.fonts().strong->CalcTextSizeA(theme.fonts().strong->FontSize, 1e4f, 0, text.c_str());
  const ImVec2 at{mouse.x + theme.px(18), mouse.y + theme.px(14)}, pad{theme.px(8), theme.px(5)};
  list.AddRectFilled(at, {at.x + extent.x + 2 * pad.x, at.y + extent.y + 2 * pad.y}, c.raised, theme.px(4));
  list.AddRect(at, {at.x + extent.x + 2 * pad.x, at.y + extent.y + 2 * pad.y}, c.line, theme.px(4));
  list.AddText(theme.fonts().strong, theme.fonts().strong->FontSize, {at.x + pad.x, at.y + pad.y}, c.text, text.c_str());
  draw_hint(hint);
}

}  // namespace bl::desktop
