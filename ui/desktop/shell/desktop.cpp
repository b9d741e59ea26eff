// Lays out the panels and lets each draw itself.
#include "ui/desktop/shell/desktop.h"

#include <algorithm>
#include <iterator>

#include <imgui_internal.h>

#include "core/guest/room_guest.h"
#include "core/making/context_import.h"
#include "core/making/media_making.h"
#include "ui/desktop/look/splitter.h"
#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/start_page.h"
#include "ui/desktop/view/renderer.h"

namespace bl::desktop {

namespace {

constexpr float kLeastPane = 160;
// With large letters on a small screen, fields and lists leave room for what they are about.
constexpr float kMostOfSide = 0.36f, kMostOfBottom = 0.4f;
constexpr const char* kSide = "side";
constexpr double kNoticeSeconds = 5;
// Dear ImGui shows a caret for two thirds of 1.2 s and hides it for one.
constexpr double kCaretSeconds = 0.4;
// Values that a gesture has not logged yet are looked at this often.
constexpr double kGestureSeconds = 0.05;

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

// A pane of its own at a place; `draw` fills it.
template <class Draw>
void pane(const char* name, ImVec2 at, ImVec2 size, ImU32 ground, ImVec2 padding, Draw draw) {
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
  const bool is_open = ImGui::Begin(name, nullptr, kFixed);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  if (is_open) draw();
  ImGui::End();
}

// What input changes by the passing of time: keys that are held, a field that is written into, the ground behind a dialog.
void ask_for_input(const Editor& editor) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto is_held = [](bool is_down) { return is_down; };
  const bool has_dialog = ImGui::GetTopMostPopupModal() != nullptr;
  const float dimmed = ImGui::GetCurrentContext()->DimBgRatio;
  if (std::any_of(std::begin(io.KeysDown), std::end(io.KeysDown), is_held) ||
      std::any_of(std::begin(io.MouseDown), std::end(io.MouseDown), is_held) || dimmed != (has_dialog ? 1.0f : 0.0f))
    editor.go_on();
  if (io.WantTextInput) editor.wake_at(editor.now + kCaretSeconds);
}

}  // namespace

Desktop::Desktop(const Registry& registry, PersonSettings& person, Renderer& renderer)
    : editor_(std::make_unique<Workbench>(registry, person)),
      canvas_(std::make_unique<Canvas>(*editor_)),
      view_(std::make_unique<SceneView>(*editor_, renderer)),
      dialogs_(std::make_unique<Dialogs>(*editor_)),
      start_page_(std::make_unique<StartPage>(*editor_)),
      renderer_(&renderer) {
  editor_->canvas = canvas_.get();
  editor_->view = view_.get();
  editor_->dialogs = dialogs_.get();
}

Desktop::~Desktop() = default;

std::string Desktop::title() {
  if (!editor_->document) return "BehaviourLinks";
  return std::string(editor_->document->is_unsaved() ? "* " : "") + editor_->document->name() + " - BehaviourLinks";
}

void Desktop::place_picture(const std::string& path) {
  Workbench& editor = *editor_;
  making::MediaOptions options;
  options.scene = editor.document->source();
  const auto made = making::make_media(path, editor.scene(), options);
  if (!made) return editor.notify(NoticeKind::error, path + ": " + made.error().message);
  if (!editor.submit(made->command)) return;
  editor.picks.only_node(made->id);
  for (const std::string& note : made->notes) editor.notify(NoticeKind::told, note);
}

void Desktop::drop(const std::vector<std::string>& paths) {
  std::vector<std::string> surroundings;
  for (const std::string& path : paths)
    if (making::is_context_file(path)) surroundings.push_back(path);
  for (const std::string& path : paths)
    if (std::find(surroundings.begin(), surroundings.end(), path) == surroundings.end()) drop_one(path);
  if (!surroundings.empty()) dialogs_->show_import(surroundings);
}

void Desktop::drop_one(const std::string& path) {
  if (editor_->document && making::is_picture_name(path)) return place_picture(path);
  if (!path.ends_with(".lua")) return dialogs_->guard([this, path] { editor_->open(path, true); });
  if (editor_->document) editor_->script_watch.add(*editor_, path);
  else
    editor_->notify(NoticeKind::warning, "A link script belongs to a scene: open the scene first, then drop the script again.");
}

void Desktop::ask_to_quit() {
  dialogs_->guard([this] { editor_->wants_quit = true; });
}

void Desktop::offer_recovery() {
  std::vector<std::string> unreadable;
  dialogs_->offer_recovery(host::Journal::find(editor_->program, &unreadable));
  for (const std::string& text : unreadable) editor_->notify(NoticeKind::warning, text);
}

// Each reason once: people who go on working with a full disk know it.
void Desktop::watch_journal() {
  const std::string problem = editor_->document->journal_problem();
  if (problem != told_problem_ && !problem.empty())
    editor_->notify(NoticeKind::warning, "A crash would lose your changes until they are saved: " + problem);
  told_problem_ = problem;
}

void Desktop::frame(double now) {
  Workbench& editor = *editor_;
  editor.now = now;
  editor.next_frame = kNoFrame;
  editor.begin_frame();
  (void)editor.script_watch.poll(editor);
  if (editor.document) editor.moment = editor.document->running().moment();
  else editor.moment = nullptr;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  float top = 0;
  run_pressed_actions(editor);
  // On the canvas and in 3D, keys are commands. Where Dear ImGui walked through fields with them as well, it would also stop to
  // feel the mouse.
  const bool is_at_fields = !editor.document || editor.area == Area::panels ||
                            ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags =
      is_at_fields ? io.ConfigFlags | ImGuiConfigFlags_NavEnableKeyboard : io.ConfigFlags & ~ImGuiConfigFlags_NavEnableKeyboard;
  if (!editor.is_beamer && ImGui::BeginMainMenuBar()) {
    draw_menus(editor);
    top = ImGui::GetWindowHeight();
    ImGui::EndMainMenuBar();
  } else {
    editor.menu_opening = {};
  }
  if (editor.document) {
    start_page_->leave();
    watch_journal();
    watch_run(editor);
    follow_somebody();
    draw_workspace(top);
    tell_whereabouts();
  } else {
    const Colours& c = editor.theme.colours();
    pane("start", {0, top}, {size.x, size.y - top}, c.window, {0, 0}, [&] { start_page_->draw(); });
  }
  editor.bytes_sent += renderer_->take_bytes_sent();
  dialogs_->draw();
  draw_notices();
  if (editor.document) let_rest();
  ask_for_input(editor);
}

// A scene that needs each tick for itself keeps the clock awake: devices are served in each, and some pictures follow its number.
void Desktop::let_rest() {
  host::Running& running = editor_->document->running();
  running.let_rest(!editor_->has_devices && !view_->shows_ticks());
  if (running.has_waiting_values()) editor_->wake_at(editor_->now + kGestureSeconds);
}

// The camera of somebody else, until this person moves their own.
void Desktop::follow_somebody() {
  Workbench& editor = *editor_;
  if (editor.followed == 0 || (followed_camera_ && *followed_camera_ != view_->camera())) {
    editor.followed = followed_camera_ ? 0 : editor.followed;
    followed_camera_.reset();
  }
  for (const Other& other : editor.others) {
    if (other.seat != editor.followed || other.camera.empty()) continue;
    const Camera camera = camera_from_json_text(other.camera, view_->camera());
    if (camera != view_->camera()) view_->set_camera(camera);
    followed_camera_ = view_->camera();
  }
}

// What the others of a room see of this window.
void Desktop::tell_whereabouts() {
  Workbench& editor = *editor_;
  guest::RoomGuest* room = editor.document ? editor.document->room() : nullptr;
  if (room == nullptr) return;
  // The scene of a room comes after its window has opened.
  if (fitted_ != editor.document->id() && room->standing().has_scene && !editor.moment->state->nodes.empty()) {
    fitted_ = editor.document->id();
    canvas_->fit(true);
    view_->fit(true);
  }
  static constexpr std::size_t kMostHeld = 32;
  guest::Whereabouts where;
  where.cursor = view_->cursor();
  for (const std::string& id : editor.picks.nodes)
    if (where.holds.size() < kMostHeld) where.holds.push_back(id);
  where.camera = JsonValue(to_json_text(view_->camera()));
  room->set_whereabouts(std::move(where));
}

// Toolbar, then canvas and 3D view side by side, the inspector to their right and lists and charts below.
void Desktop::draw_workspace(float top) {
  Workbench& editor = *editor_;
  PersonSettings& person = editor.person;
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  editor.picks.lit_node = editor.picks.hovered_node;
  editor.picks.lit_link = editor.picks.hovered_link;
  editor.picks.hovered_node.clear();
  editor.picks.hovered_link.clear();
  if (editor.is_beamer) {
    pane("view", {0, 0}, size, c.sky, {0, 0}, [&] { view_->draw(size); });
    return;
  }
  const float bar = theme.px(40), gap = theme.px(4);
  pane("toolbar", {0, top}, {size.x, bar}, c.panel, {theme.px(12), theme.px(6)}, [&] { draw_clock(editor); });
  const float y = top + bar + 1;
  const float side =
      person.shows_side ? std::min({theme.px(person.side_width), kMostOfSide * size.x, size.x - 2 * kLeastPane}) : 0;
  const float bottom = person.shows_bottom
                           ? std::min({theme.px(person.bottom_height), kMostOfBottom * (size.y - y), (size.y - y) - kLeastPane})
                           : 0;
  const float middle_width = size.x - side - (side > 0 ? gap : 0), middle_height = size.y - y - bottom - (bottom > 0 ? gap : 0);
  const float left = std::clamp(person.canvas_share * middle_width, kLeastPane, std::max(kLeastPane, middle_width - kLeastPane));
  pane("canvas", {0, y}, {left, middle_height}, c.canvas, {0, 0}, [&] { canvas_->draw({left, middle_height}); });
  const ImVec2 view_size{middle_width - left - gap, middle_height};
  pane("view", {left + gap, y}, view_size, c.sky, {0, 0}, [&] { view_->draw(view_size); });
  const ImVec2 padding{theme.px(12), theme.px(10)};
  const auto fields = [&](const char* name, ImVec2 at, ImVec2 room, void (*draw)(Workbench&)) {
    pane(name, at, room, c.panel, padding, [&] {
      if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) && ImGui::IsMouseClicked(0)) editor.area = Area::panels;
      draw(editor);
    });
  };
  if (bottom > 0) fields("bottom", {0, size.y - bottom}, {middle_width, bottom}, draw_bottom);
  if (side > 0) fields(kSide, {size.x - side, y}, {side, size.y - y}, draw_inspector);
  // With F6 one sees where the keys go; with the mouse one knows.
  if (editor.area == Area::panels && was_area_ != Area::panels && !ImGui::IsMouseDown(0))
    ImGui::SetWindowFocus(side > 0 ? kSide : "bottom");
  was_area_ = editor.area;
  if (const float moved = splitter("split middle", {left, y}, {gap, middle_height}, true, theme); moved != 0)
    person.canvas_share = std::clamp((left + moved) / middle_width, 0.1f, 0.9f);
  if (side > 0)
    if (const float moved = splitter("split side", {size.x - side - gap, y}, {gap, size.y - y}, true, theme); moved != 0)
      person.side_width = std::clamp(person.side_width - moved / theme.scale(), 200.0f, 800.0f);
  if (bottom > 0)
    if (const float moved = splitter("split bottom", {0, size.y - bottom - gap}, {middle_width, gap}, false, theme); moved != 0)
      person.bottom_height = std::clamp(person.bottom_height - moved / theme.scale(), 80.0f, 800.0f);
}

void Desktop::draw_notices() {
  Workbench& editor = *editor_;
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  for (Notice& notice : editor.notices)
    if (notice.until == Notice::kUnseen) notice.until = editor.now + (notice.kind == NoticeKind::error ? 2 : 1) * kNoticeSeconds;
  std::erase_if(editor.notices, [&](const Notice& n) { return n.until <= editor.now; });
  for (const Notice& notice : editor.notices) editor.wake_at(notice.until);
  float y = ImGui::GetIO().DisplaySize.y - theme.px(20);
  for (std::size_t k = editor.notices.size(); k-- > 0;) {
    const Notice& notice = editor.notices[k];
    const bool is_error = notice.kind == NoticeKind::error, is_warning = notice.kind == NoticeKind::warning;
    const std::string text = (is_error     ? std::string(icon::kError) + "  "
                              : is_warning ? std::string(icon::kWarning) + "  "
                                           : "") +
                             notice.text;
    const float wrap = theme.px(440);
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const ImVec2 pad{theme.px(14), theme.px(10)};
    const ImVec2 box{extent.x + 2 * pad.x, extent.y + 2 * pad.y};
    const ImVec2 at{(ImGui::GetIO().DisplaySize.x - box.x) / 2, y - box.y};
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled(at, {at.x + box.x, at.y + box.y}, c.raised, theme.px(6));
    list.AddRect(at, {at.x + box.x, at.y + box.y}, is_error ? c.bad : is_warning ? c.warning : c.line, theme.px(6));
    list.AddText(theme.fonts().body, theme.fonts().body->FontSize, {at.x + pad.x, at.y + pad.y}, c.text, text.c_str(), nullptr,
                 wrap);
    y -= box.y + theme.px(8);
  }
}

}  // namespace bl::desktop
