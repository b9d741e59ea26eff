// Mouse and keys of the 3D view: navigation as people have it in their fingers, choosing, and walking.
#include <algorithm>
#include <cmath>

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include "ui/desktop/panels/scene_view.h"

namespace bl::desktop {

namespace {

constexpr float kClickSlack = 4;
constexpr float kMarkReach = 11, kLinkReach = 5;
constexpr double kViewWheelStep = 0.87, kWalkSpeed = 7, kRunFactor = 4;

bool is_down(int key) { return ImGui::IsKeyDown(key); }

// Keeps the window's other keys from being taken while hands are on these.
void hold_keys() { ImGui::GetCurrentContext()->WantTextInputNextFrame = 1; }

double distance_to_segment(ImVec2 p, ImVec2 a, ImVec2 b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
  const double t = length > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

}  // namespace

Ray SceneView::ray_at(ImVec2 mouse) const { return choices_.camera.ray(mouse.x - at_.x, mouse.y - at_.y, width(), height()); }

// What the mouse is over: a volume, the ground, or the plane through the target that faces the eye.
Point3 SceneView::place_under(ImVec2 mouse) const {
  const Ray ray = ray_at(mouse);
  if (const auto hit = pick(ray, *facts_, choices_.section, shows("buildings"))) return hit->place;
  const auto on_ground = meet_plane(ray, {0, 0, facts_->ground}, {0, 0, 1});
  if (on_ground && distance(*on_ground, facts_->centre) < 6 * facts_->radius) return *on_ground;
  const auto facing = meet_plane(ray, choices_.camera.target, choices_.camera.forward());
  return facing ? *facing : choices_.camera.target;
}

SceneView::Drag SceneView::drag_of_preset(int& button) const {
  const ImGuiIO& io = ImGui::GetIO();
  const std::string& preset = editor_->person.navigation;
  const auto on = [&](int which) { return ImGui::IsMouseClicked(which) && (button = which, true); };
  const auto usual = [&] { return io.KeyShift ? Drag::pan : io.KeyCtrl ? Drag::zoom : Drag::orbit; };
  if (preset == "polyscope") {
    if (on(ImGuiMouseButton_Right) || on(ImGuiMouseButton_Middle)) return Drag::pan;
    return Drag::none;  // the left button orbits once it has moved: see take_left_button
  }
  if (on(ImGuiMouseButton_Middle)) return usual();
  if (preset == "rhino" && on(ImGuiMouseButton_Right)) return usual();
  if (on(ImGuiMouseButton_Right)) return Drag::pan;
  return Drag::none;
}

void SceneView::navigate(ImVec2 moved) {
  Camera& camera = choices_.camera;
  if (moved.x == 0 && moved.y == 0) return;
  change_began_ = -1;
  if (drag_ == Drag::orbit && is_walking_) camera.look(-moved.x, moved.y);
  else if (drag_ == Drag::orbit) camera.orbit(moved.x, moved.y);
  else if (drag_ == Drag::pan) camera.pan(moved.x, moved.y, height());
  else if (drag_ == Drag::zoom) camera.zoom(std::exp(0.008 * moved.y), camera.target);
}

void SceneView::take_wheel() {
  const ImGuiIO& io = ImGui::GetIO();
  if (!is_hovered_ || io.MouseWheel == 0 || !std::isfinite(io.MouseWheel)) return;
  if (io.KeyShift) {
    if (!choices_.section.is_on) toggle_section();
    // A hundredth of the scene for each notch; upwards shows more.
    choices_.section.offset += io.MouseWheel * 0.02 * facts_->radius;
    return;
  }
  if (is_walking_) return choices_.camera.walk(2.0 * io.MouseWheel, 0, 0);
  const double factor = std::pow(kViewWheelStep, std::clamp(static_cast<double>(io.MouseWheel), -5.0, 5.0));
  change_began_ = -1;
  choices_.camera.zoom(factor, place_under(io.MousePos));
}

void SceneView::walk_about() {
  hold_keys();
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_first_frame = editor_->now <= walk_began_;  // the key that began it is still down
  if (!is_first_frame && (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) || ImGui::IsKeyPressed(GLFW_KEY_6, false)))
    return toggle_walk();
  const double reach = kWalkSpeed * std::min(0.1, editor_->now - last_frame_) * (io.KeyShift ? kRunFactor : 1);
  const double ahead =
      (is_down(GLFW_KEY_W) || is_down(GLFW_KEY_UP) ? 1 : 0) - (is_down(GLFW_KEY_S) || is_down(GLFW_KEY_DOWN) ? 1 : 0);
  const double aside =
      (is_down(GLFW_KEY_D) || is_down(GLFW_KEY_RIGHT) ? 1 : 0) - (is_down(GLFW_KEY_A) || is_down(GLFW_KEY_LEFT) ? 1 : 0);
  const double upwards = (is_down(GLFW_KEY_E) ? 1 : 0) - (is_down(GLFW_KEY_Q) ? 1 : 0);
  if (ahead != 0 || aside != 0 || upwards != 0) choices_.camera.walk(reach * ahead, reach * aside, reach * upwards);
}

void SceneView::take_keys() {
  if (is_walking_ && editor_->area == Area::view) walk_about();
  if (is_moving()) hold_keys();
  if (move_ && move_->is_by_key) take_typed();
}

void SceneView::take_mouse() {
  take_wheel();
  if (drag_ == Drag::orbit || drag_ == Drag::pan || drag_ == Drag::zoom) {
    if (ImGui::IsMouseDown(drag_button_)) navigate(ImGui::GetIO().MouseDelta);  // none while the pointer is nowhere
    else drag_ = Drag::none;
  } else if (is_hovered_ && drag_ == Drag::none && !reshape_ && !plane_drag_ && !(move_ && !move_->is_by_key)) {
    const Drag begun = drag_of_preset(drag_button_);
    const bool ends_move = move_ && begun != Drag::none && drag_button_ == ImGuiMouseButton_Right;
    if (ends_move) end_move(false);
    else if (begun != Drag::none) drag_ = begun;
  }
  if (move_) return go_on_moving();
  if (reshape_) return go_on_reshaping();
  if (plane_drag_) return go_on_with_plane();
  take_left_button();
  point_at();
}

void SceneView::take_left_button() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool is_polyscope = editor_->person.navigation == "polyscope";
  if (is_hovered_ && drag_ == Drag::none && ImGui::IsMouseClicked(0)) {
    // Two dots may be set fast.
    if (ImGui::IsMouseDoubleClicked(0) && !is_placing()) return click(true);
    // With Shift or Ctrl people choose; while a hand already moves things, they make it fine or snap.
    const bool takes_hold = !io.KeyShift && !io.KeyCtrl && !is_placing();
    if (const auto place = takes_hold ? reshape_at(io.MousePos) : std::nullopt) return begin_reshape(*place);
    if (const auto place = takes_hold ? plane_handle_at(io.MousePos) : std::nullopt) return begin_plane_drag(*place);
    const int handle = takes_hold ? handle_at(io.MousePos) : -1;
    if (handle >= 0) return begin_move(handle, false);
    drag_ = Drag::pressed;
    pressed_at_ = io.MousePos;
    note_pressed();
    pressed_on_ = takes_hold ? clicked_node_ : "";
    return;
  }
  if (drag_ == Drag::pressed) {
    const float far = std::max(std::abs(io.MousePos.x - pressed_at_.x), std::abs(io.MousePos.y - pressed_at_.y));
    if (!ImGui::IsMouseDown(0)) {
      drag_ = Drag::none;
      return click(false);
    }
    if (far < kClickSlack * editor_->theme.scale()) return;
    drag_ = Drag::box;
    if (is_walking_ || (is_polyscope && !io.KeyCtrl)) {
      drag_ = io.KeyShift ? Drag::pan : Drag::orbit;
      drag_button_ = 0;
    } else if (is_polyscope && io.KeyShift) {
      drag_ = Drag::zoom;
      drag_button_ = 0;
    } else if (!pressed_on_.empty()) {
      drag_ = Drag::none;
      if (!editor_->picks.nodes.contains(pressed_on_)) editor_->picks.only_node(pressed_on_);
      begin_move(Move::kFree, false);
    }
    return;
  }
  if (drag_ == Drag::box && !ImGui::IsMouseDown(0)) {
    select_box();
    drag_ = Drag::none;
  }
}

// What people saw when they pressed: the clock may have put something else there in this very frame.
void SceneView::note_pressed() {
  point_at();
  const bool is_where_shown = shown_for_.x == pressed_at_.x && shown_for_.y == pressed_at_.y;
  const auto still_there = [&](const std::string& id) { return id.empty() || seen_index(id) < facts_->places.size(); };
  clicked_node_ = is_where_shown && still_there(shown_node_) ? shown_node_ : pointed_at_;
  clicked_link_ = is_where_shown && editor_->scene().links.contains(shown_link_) ? shown_link_ : pointed_link_;
}

void SceneView::choose(const std::string& id, bool is_node) {
  const ImGuiIO& io = ImGui::GetIO();
  Picks& picks = editor_->picks;
  auto& chosen = is_node ? picks.nodes : picks.links;
  if (io.KeyCtrl) {
    if (chosen.erase(id) == 0) chosen.insert(id);
  } else if (io.KeyShift) {
    chosen.insert(id);
  } else if (is_node) {
    picks.only_node(id);
  } else {
    picks.only_link(id);
  }
}

void SceneView::click(bool is_double) {
  const ImGuiIO& io = ImGui::GetIO();
  point_at();
  if (is_double) {
    Camera camera = choices_.camera;
    const Point3 place = place_under(io.MousePos);
    camera.target = place;
    return go_to(camera);
  }
  if (take_dot(pressed_at_)) return;
  if (editor_->scene().nodes.contains(clicked_node_)) return choose(clicked_node_, true);
  if (editor_->scene().links.contains(clicked_link_)) return choose(clicked_link_, false);
  if (!io.KeyShift && !io.KeyCtrl) editor_->picks.clear();
}

void SceneView::select_box() {
  const ImGuiIO& io = ImGui::GetIO();
  const Box box{std::min(pressed_at_.x, io.MousePos.x) - at_.x, std::min(pressed_at_.y, io.MousePos.y) - at_.y,
                std::max(pressed_at_.x, io.MousePos.x) - at_.x, std::max(pressed_at_.y, io.MousePos.y) - at_.y};
  const bool touches = io.MousePos.x < pressed_at_.x;
  const Sight sight{choices_.camera, width(), height(), choices_.section, shows("marks")};
  if (!io.KeyShift && !io.KeyCtrl) editor_->picks.clear();
  for (const std::uint32_t node : pick_box(box, touches, *facts_, sight)) {
    std::set<std::string>& chosen = editor_->picks.nodes;
    if (!io.KeyCtrl || chosen.erase(id_of(node)) == 0) chosen.insert(id_of(node));
  }
}

std::string SceneView::street_under(const ImVec2& mouse) const {
  double reach = kLinkReach * editor_->theme.scale();
  std::string found;
  for (const StreetFacts& street : facts_->urban.streets) {
    const std::vector<Point3> line = line_of(street, choices_.held);
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Seen a = seen(line[k - 1]), b = seen(line[k]);
      if (!a.is_in_front || !b.is_in_front) continue;
      const double far = distance_to_segment(mouse, on_screen(a), on_screen(b));
      if (far >= reach) continue;
      reach = far;
      found = street.id;
    }
  }
  return found;
}

void SceneView::point_at() {
  if (!is_hovered_ || (drag_ != Drag::none && drag_ != Drag::pressed)) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  hit_ = pick(ray_at(mouse), *facts_, choices_.section, shows("buildings"));
  std::string found = hit_ ? id_of(hit_->node) : "";
  double nearest = kMarkReach * editor_->theme.scale();
  const auto try_mark = [&](std::uint32_t node, const std::string& id) {
    const Seen at = seen(place_of(node));
    const ImVec2 p = on_screen(at);
    const double far = std::hypot(p.x - mouse.x, p.y - mouse.y);
    if (!at.is_in_front || far > nearest) return;
    nearest = far;
    found = id;
  };
  if (shows("marks"))
    for (const MarkFacts& mark : facts_->marks)
      if (!hides(choices_.section, place_of(mark.node))) try_mark(mark.node, mark.id);
  // As they are drawn: a volume without a shape has its mark whatever the layers say.
  for (const VolumeFacts& volume : facts_->volumes)
    if (!volume.cell) try_mark(volume.node, volume.id);
  if (found.empty() && shows("streets")) found = street_under(mouse);
  pointed_at_ = found;
  if (!found.empty()) editor_->picks.hovered_node = found;
  if (!found.empty() || !shows("links")) return;
  double reach = kLinkReach * editor_->theme.scale();
  for (const LinkFacts& link : facts_->links) {
    const Seen a = seen(place_of(link.from)), b = seen(place_of(link.to));
    if (!a.is_in_front || !b.is_in_front) continue;
    const double far = distance_to_segment(mouse, on_screen(a), on_screen(b));
    if (far >= reach) continue;
    reach = far;
    pointed_link_ = editor_->picks.hovered_link = link.id;
  }
}

}  // namespace bl::desktop
