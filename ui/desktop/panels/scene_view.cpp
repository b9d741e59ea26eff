// The 3D view's frame: follow the state, answer to people, draw; and the camera's ways of going somewhere.
#include "ui/desktop/panels/scene_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"

namespace bl::desktop {

namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kChangeSeconds = 0.28;
// Nothing has moved for so long: there is time for a finer picture.
constexpr double kStillSeconds = 0.3;

// How many shapes of volumes one picture makes: some thirty milliseconds of work. Where more change, they come in turn.
constexpr std::size_t kMostShapes = 1000;

// How often pictures that are on their way are looked for.
constexpr double kPictureSeconds = 0.05;

bool has_same_shapes(const VolumeList& a, const VolumeList& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (k % VolumeList::kLeaf == 0 && a.shares_leaf(b, k / VolumeList::kLeaf)) k += VolumeList::kLeaf - 1;
    else if (a[k].cell != b[k].cell) return false;
  }
  return true;
}

}  // namespace

void SceneView::draw(ImVec2 size) {
  at_ = ImGui::GetWindowPos();
  size_ = size;
  if (!editor_->moment || size.x < 8 || size.y < 8) return;
  is_hovered_ = ImGui::IsWindowHovered() && !ImGui::IsAnyItemHovered();
  if (ImGui::IsWindowHovered()) editor_->point_at(Area::view);
  follow_document();
  follow_state();
  advance_camera();
  shown_node_ = std::exchange(pointed_at_, {});
  shown_link_ = std::exchange(pointed_link_, {});
  take_keys();
  take_mouse();
  choices_.held.clear();
  if (move_)
    for (const auto& [id, start] : move_->starts)
      if (const std::uint32_t node = seen_index(id); node < facts_->places.size()) choices_.held[node] = start + move_->shift;
  keep_section();
  follow_sun();
  follow_choice();
  choices_.folder = editor_->document->folder();
  const Colouring& colouring = colours_.of(facts_, colour_choice(), editor_->theme);
  ViewScene scene = build_view(*facts_, colouring, choices_, editor_->picks, editor_->person, editor_->theme, &pictures_);
  const bool has_same_cells = still_facts_ && has_same_shapes(facts_->volumes, still_facts_->volumes);
  if (scene.camera != still_camera_ || scene.sun != still_sun_ || !has_same_cells) still_since_ = editor_->now;
  still_camera_ = scene.camera;
  still_sun_ = scene.sun;
  still_facts_ = facts_;
  scene.is_hurried = editor_->now < still_since_ + kStillSeconds;
  if (scene.is_hurried) editor_->wake_at(still_since_ + kStillSeconds);
  const ImVec2 density = ImGui::GetIO().DisplayFramebufferScale;
  const float dense = density.x > 0 ? density.x : 1;
  const std::uintptr_t picture = renderer_->draw(scene, static_cast<int>(size.x * dense), static_cast<int>(size.y * dense));
  // Pictures of OpenGL stand on their heads.
  if (picture != 0)
    ImGui::GetWindowDrawList()->AddImage(reinterpret_cast<ImTextureID>(picture), at_, {at_.x + size.x, at_.y + size.y}, {0, 1},
                                         {1, 0});
  if (change_began_ >= 0 || is_sun_running_) editor_->go_on();
  if (renderer_->is_waiting()) editor_->wake_at(editor_->now + kPictureSeconds);
  draw_overlay();
  shown_for_ = is_hovered_ ? ImGui::GetIO().MousePos : ImVec2{-1, -1};
  last_frame_ = editor_->now;
}

void SceneView::draw_overlay() {
  ImGui::GetWindowDrawList()->PushClipRect(at_, {at_.x + size_.x, at_.y + size_.y}, true);
  draw_marks();
  draw_labels();
  draw_media_notes();
  draw_pin();
  draw_dots();
  draw_others();
  draw_gizmo();
  draw_reshape();
  draw_plane_handles();
  draw_dimensions();
  draw_scale_and_north();
  draw_legends(editor_->is_beamer);
  if (drag_ == Drag::box) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Colours& c = editor_->theme.colours();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 low{std::min(mouse.x, pressed_at_.x), std::min(mouse.y, pressed_at_.y)};
    const ImVec2 high{std::max(mouse.x, pressed_at_.x), std::max(mouse.y, pressed_at_.y)};
    // To the right it encloses, to the left it touches; the fill says which.
    list.AddRectFilled(low, high, faded(c.accent, mouse.x >= pressed_at_.x ? 0.06f : 0.16f));
    list.AddRect(low, high, c.accent);
  }
  draw_card();
  draw_typed();
  draw_sun_strip();
  draw_draft_banner();
  ImGui::GetWindowDrawList()->PopClipRect();
  storey_slider_ = {};
  if (editor_->is_beamer) return draw_title();
  draw_storey_slider();
  draw_tools();
  draw_section_strip();
}

void SceneView::forget() {
  document_ = 0;
  all_facts_ = whole_ = facts_ = nullptr;
  drawn_ = {};
  storeys_shown_ = storeys_in_all_ = cellars_in_all_ = 0;
  still_facts_ = nullptr;
  colours_ = {};
  pictures_ = {};
  move_.reset();
  reshape_.reset();
  plane_drag_.reset();
  preview_.reset();
  is_sun_running_ = false;
  shade_.clear();
  reach_state_ = nullptr;
  choices_.sun = {};
  choices_.isochrones = nullptr;
}

void SceneView::follow_document() {
  if (document_ == editor_->document->id()) return;
  forget();
  document_ = editor_->document->id();
  hit_.reset();
  shown_for_ = {-1, -1};
  drag_ = Drag::none;
  is_walking_ = false;
  pin_.reset();
  choices_ = ViewChoices{.camera = choices_.camera, .section = {}, .held = {}};
  recall_section();
  wants_fit_ = true;
  has_fitted_boundary_ = false;
}

void SceneView::follow_state() {
  const bool is_another = !all_facts_ || all_facts_->state != editor_->moment->state || !all_facts_->awaited.empty();
  if (is_another) all_facts_ = read_facts(editor_->moment->state, all_facts_.get(), kMostShapes);
  if (!all_facts_->awaited.empty()) editor_->go_on();
  if (const auto& hidden = hidden_.of(*editor_); is_another || hidden != left_out_) {
    left_out_ = hidden;
    whole_ = hidden.empty() ? all_facts_ : facts_without(*all_facts_, hidden);
    storeys_in_all_ = storeys_in(*whole_);
    cellars_in_all_ = cellars_in(*whole_);
  }
  follow_look();
  if (wanted_box_ && !wants_fit_) {
    const auto [low, high] = *wanted_box_;
    wanted_box_.reset();
    Camera camera = change_began_ >= 0 ? to_ : choices_.camera;
    camera.fit(0.5 * (low + high), std::max(10.0, 0.55 * distance(low, high)), width() / std::max(1.0f, height()));
    go_to(camera);
  }
  // A boundary has no shape before the first tick: the first view is made again with it.
  const bool has_boundary_now = !all_facts_->boundaries.empty() && !has_fitted_boundary_;
  if (!wants_fit_ && !has_boundary_now) return;
  has_fitted_boundary_ = !all_facts_->boundaries.empty();
  if (!wants_fit_ && drag_ != Drag::none) return;
  wants_fit_ = false;
  Camera camera;
  camera.azimuth = -0.9;
  camera.elevation = 0.52;
  camera.fit({facts_->centre.x, facts_->centre.y, facts_->ground + 0.35 * (facts_->centre.z - facts_->ground)},
             0.86 * facts_->radius, width() / std::max(1.0f, height()));
  set_camera(camera);
}

void SceneView::set_camera(const Camera& camera) {
  choices_.camera = to_ = camera;
  choices_.camera.limit();
  change_began_ = -1;
}

void SceneView::go_to(const Camera& camera) {
  from_ = choices_.camera;
  to_ = camera;
  to_.limit();
  change_began_ = editor_->now;
}

void SceneView::advance_camera() {
  if (change_began_ < 0) return;
  const double t = (editor_->now - change_began_) / kChangeSeconds;
  choices_.camera = between(from_, to_, std::clamp(t, 0.0, 1.0));
  if (t >= 1) change_began_ = -1;
}

Point3 SceneView::place_of(std::uint32_t node) const {
  const auto held = choices_.held.find(node);
  return held == choices_.held.end() ? facts_->places[node] : held->second;
}

Seen SceneView::place_in_window(const Point3& point) const {
  Seen place = seen(point);
  place.x += at_.x;
  place.y += at_.y;
  return place;
}

void SceneView::fit(bool all) {
  if (!facts_) return;
  Camera camera = change_began_ >= 0 ? to_ : choices_.camera;
  Vector3 low{1e300, 1e300, 1e300}, high = -low;
  for (std::uint32_t n = 0; n < facts_->places.size() && !all; ++n) {
    if (!editor_->picks.nodes.contains(id_of(n))) continue;
    const VolumeFacts* volume = facts_->volume_of(n);
    const double around = volume != nullptr && volume->figures.radius > 0 ? volume->figures.radius : 0.05 * facts_->radius;
    const Point3 p = facts_->places[n];
    low = {std::min(low.x, p.x - around), std::min(low.y, p.y - around), std::min(low.z, p.z - around)};
    high = {std::max(high.x, p.x + around), std::max(high.y, p.y + around), std::max(high.z, p.z + around)};
  }
  const double aspect = width() / std::max(1.0f, height());
  if (low.x <= high.x) camera.fit(0.5 * (low + high), 0.55 * distance(low, high), aspect);
  else camera.fit(facts_->centre, 0.86 * facts_->radius, aspect);
  go_to(camera);
}

void SceneView::fit_to(const Point3& low, const Point3& high) { wanted_box_ = {low, high}; }

void SceneView::put_pin(const Pin& pin) {
  pin_ = pin;
  chosen_at_pin_ = editor_->picks.nodes;
  constexpr double kAround = 160;  // [m]: near enough to see what else is there
  Camera camera = change_began_ >= 0 ? to_ : choices_.camera;
  camera.target = pin.place;
  camera.distance = std::min(camera.distance, kAround);
  is_walking_ = false;
  go_to(camera);
}

void SceneView::look_from(Side side) {
  Camera camera = is_walking_ ? before_walk_ : change_began_ >= 0 ? to_ : choices_.camera;
  is_walking_ = false;
  camera.azimuth = side == Side::east ? 0 : side == Side::axonometric ? -kHalfTurn / 4 : -kHalfTurn / 2;
  camera.elevation = side == Side::plan ? kHalfTurn / 2 : side == Side::axonometric ? 0.6155 : 0;
  camera.is_parallel = true;
  go_to(camera);
}

void SceneView::toggle_parallel() {
  Camera camera = change_began_ >= 0 ? to_ : choices_.camera;
  camera.is_parallel = !camera.is_parallel;
  set_camera(camera);
}

void SceneView::toggle_walk() {
  if (!facts_) return;
  is_walking_ = !is_walking_;
  walk_began_ = editor_->now;
  if (!is_walking_) return go_to(before_walk_);
  before_walk_ = change_began_ >= 0 ? to_ : choices_.camera;
  // Down to the height of people's eyes, before what is seen now.
  Camera camera = choices_.camera;
  const Point3 eye = camera.eye();
  Vector3 out{eye.x - facts_->centre.x, eye.y - facts_->centre.y, 0};
  // From above nobody knows where to stand: outside, on the side that is lowest in the picture.
  if (norm(out) < 0.9 * facts_->radius) out = {std::cos(camera.azimuth), std::sin(camera.azimuth), 0};
  const Point3 stand =
      Point3{facts_->centre.x, facts_->centre.y, facts_->ground + 1.7} + (1.15 * facts_->radius / norm(out)) * out;
  camera.is_parallel = false;
  camera.azimuth = std::atan2(out.y, out.x);
  camera.elevation = -0.06;
  camera.distance = 10;
  camera.target = stand + camera.distance * camera.forward();
  go_to(camera);
}

void SceneView::store_camera(int number) {
  if (!editor_->document || number < 1 || number > 9) return;
  const std::string key = std::to_string(number);
  if (editor_->arrange("{\"cameras\": {\"" + key + "\": " + to_json_text(choices_.camera) + "}}"))
    editor_->notify(NoticeKind::told,
                    "This view is saved as number " + key + "; in beamer mode (F1) the key " + key + " goes back to it.");
}

void SceneView::recall_camera(int number) {
  if (!editor_->document) return;
  const Json view = Json::parse(editor_->scene().view, nullptr, false);
  const auto cameras = view.is_object() ? view.find("cameras") : view.end();
  const bool has_cameras = view.is_object() && cameras != view.end() && cameras->is_object();
  const std::string key = std::to_string(number);
  if (!has_cameras || !cameras->contains(key)) {
    editor_->notify(NoticeKind::told, "There is no view number " + key + " yet: Ctrl+" + key + " saves the present one.");
    return;
  }
  is_walking_ = false;
  go_to(camera_from_json_text((*cameras)[key].dump(), choices_.camera));
}

}  // namespace bl::desktop
