// The ground of the canvas, frames and comments upon it, and what a drag in progress shows.
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/link_paths.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kLeastGrid = 14;

// Dots at the crossings of a grid that grows coarser as it is looked at from further away.
void draw_grid(const Board& board, ImDrawList& list) {
  const Colours& c = board.theme().colours();
  float step = 2 * kGrid;
  while (step * board.camera.factor() < kLeastGrid) step *= 5;
  const Box sight = board.camera.sight();
  const auto lines = [&](float spacing, ImU32 colour) {
    for (float x = std::floor(sight.at.x / spacing) * spacing; x < sight.high().x; x += spacing) {
      const float at = std::floor(board.camera.to_screen(ImVec2(x, 0)).x);
      list.AddRectFilled({at, board.camera.pane().low().y}, {at + 1, board.camera.pane().high().y}, colour);
    }
    for (float y = std::floor(sight.at.y / spacing) * spacing; y < sight.high().y; y += spacing) {
      const float at = std::floor(board.camera.to_screen(ImVec2(0, y)).y);
      list.AddRectFilled({board.camera.pane().low().x, at}, {board.camera.pane().high().x, at + 1}, colour);
    }
  };
  lines(step, faded(c.grid, 0.75f));
  lines(step * 5, faded(c.grid_strong, 0.8f));
}

void draw_frame(Board& board, const std::string& id, const Frame& frame) {
  Box box;
  if (!board.model.frame_box(id, box) || !box.touches(board.camera.sight())) return;
  const Colours& c = board.theme().colours();
  const Box screen = board.camera.to_screen(box);
  const float k = board.camera.factor();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 tone = board.theme().category(frame.colour);
  const bool is_picked = board.picked_frames.contains(id);
  const bool is_hovered = board.hovered.thing == Thing::frame && board.hovered.id == id;
  list.AddRectFilled(screen.low(), screen.high(), faded(tone, board.theme().is_dark() ? 0.07f : 0.14f), 8 * k);
  list.AddRectFilled(screen.low(), {screen.high().x, screen.low().y + kFrameHead * k}, faded(tone, 0.16f), 8 * k,
                     ImDrawFlags_RoundCornersTop);
  list.AddRect(screen.low(), screen.high(), is_picked ? c.accent : faded(tone, is_hovered ? 0.8f : 0.4f), 8 * k, 0,
               is_picked ? 2.0f : 1.2f);
  if (board.edit.thing == Thing::frame && board.edit.id == id) return;
  const float pixels = readable_height(13 * k, 11 * board.theme().scale(), 0.05f * screen.size.x);
  draw_text(board, {screen.low().x + 10 * k, screen.low().y + 5 * k}, pixels, mixed(c.text, tone, 0.3f),
            frame.name.empty() ? "Frame" : frame.name, screen.size.x - 20 * k);
}

void draw_comment(Board& board, const std::string& id, const Comment& comment) {
  if (!comment.box.touches(board.camera.sight())) return;
  const Colours& c = board.theme().colours();
  const Box screen = board.camera.to_screen(comment.box);
  const float k = board.camera.factor();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_picked = board.picked_comments.contains(id);
  const ImU32 paper = board.theme().is_dark() ? IM_COL32(74, 68, 44, 235) : IM_COL32(255, 248, 214, 245);
  list.AddRectFilled(screen.low(), screen.high(), paper, 4 * k);
  list.AddRect(screen.low(), screen.high(), is_picked ? c.accent : faded(c.warning, 0.35f), 4 * k, 0, is_picked ? 2.0f : 1.0f);
  list.AddTriangleFilled(screen.high(), screen.high() - ImVec2(9 * k, 0), screen.high() - ImVec2(0, 9 * k),
                         faded(c.warning, 0.5f));
  if (board.edit.thing == Thing::comment && board.edit.id == id) return;
  const float pixels = comment_height(board, comment);
  if (pixels < 4) return;
  const ImVec4 clip(screen.low().x, screen.low().y, screen.high().x, screen.high().y);
  list.AddText(board.theme().canvas_font(pixels), pixels,
               {screen.low().x + 8 * k, screen.low().y + std::min(6 * k, 0.5f * (screen.size.y - pixels))}, c.text,
               comment.text.empty() ? "Double-click to write" : comment.text.c_str(), nullptr, screen.size.x - 16 * k, &clip);
}

void draw_new_link(Board& board, ImDrawList& list, ImVec2 cursor) {
  const Colours& c = board.theme().colours();
  const Drag& drag = board.drag;
  const bool is_moving = drag.deed == DragMode::relink;
  const auto points = trace_to_point(board.model.anchor(drag.grabbed.index), cursor);
  std::vector<ImVec2> screen;
  for (const ImVec2& p : points) screen.push_back(board.camera.to_screen(p));
  list.AddPolyline(screen.data(), static_cast<int>(screen.size()), is_moving ? c.warning : c.accent, 0,
                   2.2f * board.theme().scale());
  list.AddCircleFilled(screen.back(), 4 * board.theme().scale(), is_moving ? c.warning : c.accent, 12);
  const Hit& over = board.hovered;
  if (takes_links(over.thing) && over.index != drag.grabbed.index) {
    const Box box = board.camera.to_screen(board.model.anchor(over.index));
    list.AddRect(box.low() - ImVec2(3, 3), box.high() + ImVec2(3, 3), c.accent, 7, 0, 2.5f);
  } else {
    const char* hint = is_moving ? "Move all links to..." : over.thing == Thing::nothing ? "Let go to add a linked node" : "";
    draw_text(board, screen.back() + ImVec2(12, -6), 12 * board.theme().scale(), c.text_soft, hint);
  }
}

}  // namespace

float comment_height(const Board& board, const Comment& comment) {
  const float k = board.camera.factor();
  return readable_height(12.5f * k, 9 * board.theme().scale(), 0.45f * comment.box.size.y * k);
}

void draw_ground(Board& board) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_grid(board, list);
}

void draw_frames_and_comments(Board& board) {
  // Outer frames first, so that the inner ones lie upon them.
  std::vector<std::pair<float, std::string>> order;
  for (const auto& [id, frame] : board.model.view.frames)
    if (Box box; board.model.frame_box(id, box)) order.emplace_back(-box.size.x * box.size.y, id);
  std::sort(order.begin(), order.end());
  for (const auto& [area, id] : order) draw_frame(board, id, board.model.view.frames.at(id));
  for (const auto& [id, comment] : board.model.view.comments)
    if (board.model.shows_comment(id)) draw_comment(board, id, comment);
}

void draw_deed(Board& board) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Colours& c = board.theme().colours();
  const Drag& drag = board.drag;
  const ImVec2 cursor = board.cursor();
  if (drag.deed == DragMode::link || drag.deed == DragMode::relink) return draw_new_link(board, list, cursor);
  if (drag.deed == DragMode::cut) {
    std::vector<ImVec2> screen;
    for (const ImVec2& p : drag.swipe) screen.push_back(board.camera.to_screen(p));
    if (screen.size() > 1)
      list.AddPolyline(screen.data(), static_cast<int>(screen.size()), c.bad, 0, 1.8f * board.theme().scale());
    return;
  }
  if (!drag.is_far) return;
  if (drag.deed == DragMode::box) {
    const Box box = box_between(board.camera.to_screen(drag.begin), board.camera.to_screen(cursor));
    const bool encloses = cursor.x >= drag.begin.x;
    list.AddRectFilled(box.low(), box.high(), faded(c.accent, 0.1f));
    // Without rounding: ImGui divides by zero at corners of nearly no radius, as a box of three pixels has.
    list.AddRect(box.low(), box.high(), faded(c.accent, encloses ? 0.9f : 0.5f), 0, 0, encloses ? 1.5f : 1.0f);
    draw_text(board, {box.low().x + 4, box.high().y + 3}, 11 * board.theme().scale(), c.text_soft,
              encloses ? "inside" : "touching");
  }
  if (drag.deed != DragMode::move) return;
  for (const auto& [from, to] : drag.guides)
    list.AddLine(board.camera.to_screen(from), board.camera.to_screen(to), faded(c.accent, 0.7f), 1);
  if (drag.copies)
    for (const Box& old : drag.old_anchors) {
      const Box screen = board.camera.to_screen(old);
      list.AddRect(screen.low(), screen.high(), c.text_faint, 5, 0, 1.5f);
    }
  if (drag.copies || drag.leaves) {
    const ImVec2 at = board.camera.to_screen(cursor) + ImVec2(14, 10);
    draw_text(board, at, 12 * board.theme().scale(), c.accent, drag.copies ? "duplicate" : "out of its frame");
  }
}

}  // namespace bl::desktop::canvas
