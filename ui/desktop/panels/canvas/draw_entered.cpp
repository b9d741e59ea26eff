// What shows that one is in a frame: the breadcrumb above, and the doors to what is linked from outside.
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/entered.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kCrumbText = 13, kCrumbHeight = 24, kMostCrumb = 220, kDoorText = 11.5f, kLeastDoorText = 8.5f;
constexpr const char* kSeparator = "\xe2\x80\xba";

std::string name_of_scene(const Workbench& editor) {
  const std::string& title = editor.state().plan->settings.title;
  return title.empty() ? editor.document->name() : title;
}

}  // namespace

float place_crumbs(Board& board) {
  board.crumbs.clear();
  if (board.model.entered.empty()) return 0;
  const float scale = board.theme().scale();
  const Box& pane = board.camera.pane();
  ImVec2 at = pane.low() + ImVec2(10, 8) * scale;
  const auto add = [&](const std::string& frame, const std::string& label) {
    const float width = std::min(text_width(board, kCrumbText * scale, label), kMostCrumb * scale) + 16 * scale;
    if (at.x + width > pane.high().x - 10 * scale && !board.crumbs.empty())
      at = {pane.low().x + 10 * scale, at.y + (kCrumbHeight + 2) * scale};
    board.crumbs.push_back({frame, label, Box{at, {width, kCrumbHeight * scale}}});
    at.x += width + 14 * scale;
  };
  add("", name_of_scene(board.editor));
  for (const std::string& frame : board.way_in)
    if (const auto found = board.model.view.frames.find(frame); found != board.model.view.frames.end())
      add(frame, found->second.name.empty() ? "Frame" : found->second.name);
  return at.y + (kCrumbHeight + 4) * scale - pane.low().y;
}

void draw_crumbs(Board& board) {
  const Colours& c = board.theme().colours();
  const float scale = board.theme().scale(), pixels = kCrumbText * scale;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (std::size_t k = 0; k < board.crumbs.size(); ++k) {
    const Crumb& crumb = board.crumbs[k];
    const bool is_here = k + 1 == board.crumbs.size();
    const bool is_hovered = board.hovered.thing == Thing::crumb && board.hovered.index == k;
    const auto frame = board.model.view.frames.find(crumb.frame);
    const ImU32 tone =
        frame == board.model.view.frames.end() ? c.panel : mixed(c.panel, board.theme().category(frame->second.colour), 0.3f);
    list.AddRectFilled(crumb.box.low(), crumb.box.high(), faded(tone, 0.95f), 5 * scale);
    if (is_hovered && !is_here) list.AddRect(crumb.box.low(), crumb.box.high(), c.accent, 5 * scale);
    draw_text(board, crumb.box.low() + ImVec2(8, 5) * scale, pixels, is_here || is_hovered ? c.text : c.text_soft, crumb.label,
              crumb.box.size.x - 16 * scale);
    if (!is_here)
      draw_text(board, {crumb.box.high().x + 4 * scale, crumb.box.low().y + 4 * scale}, pixels, c.text_faint, kSeparator);
  }
}

void draw_doors(Board& board) {
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Box sight = board.camera.sight().grown(20);
  const float k = board.camera.factor(), scale = board.theme().scale();
  for (std::size_t d = 0; d < board.model.doors.size(); ++d) {
    const Door& door = board.model.doors[d];
    if (!door.box.touches(sight)) continue;
    const Box screen = board.camera.to_screen(door.box);
    const bool is_lit =
        (board.hovered.thing == Thing::door && board.hovered.id == door.id) || board.editor.picks.lit_node == door.id;
    // A tag that points outwards.
    const float tip = 0.5f * screen.size.y;
    const ImVec2 low = screen.low(), high = screen.high(), middle = screen.centre();
    const ImVec2 corners[] = {
        door.is_left ? ImVec2(low.x + tip, low.y) : low, door.is_left ? ImVec2(high.x, low.y) : ImVec2(high.x - tip, low.y),
        door.is_left ? high : ImVec2(high.x, middle.y), door.is_left ? ImVec2(low.x + tip, high.y) : ImVec2(high.x - tip, high.y),
        door.is_left ? ImVec2(low.x, middle.y) : ImVec2(low.x, high.y)};
    list.AddConvexPolyFilled(corners, 5, mixed(c.canvas, c.text, is_lit ? 0.2f : 0.09f));
    list.AddPolyline(corners, 5, is_lit ? c.accent : mixed(c.line, c.text_soft, 0.35f), ImDrawFlags_Closed,
                     (is_lit ? 1.8f : 1.0f) * scale);
    const float pixels = std::max(kDoorText * k, kLeastDoorText * scale);
    if (screen.size.x < 34 * scale) continue;
    // Too low for its letters, it is named below.
    const float y = screen.size.y < 1.1f * pixels ? high.y + 2 : middle.y - 0.6f * pixels;
    draw_text(board, {low.x + (door.is_left ? tip + 4 * k : 8 * k), y}, pixels, is_lit ? c.text : c.text_soft, door.label,
              std::max(screen.size.x - tip - 12 * k, 40 * scale));
  }
}

}  // namespace bl::desktop::canvas
