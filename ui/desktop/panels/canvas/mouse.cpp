// What lies under the cursor, and which drag a press begins.
#include "ui/desktop/panels/canvas/mouse.h"

#include <GLFW/glfw3.h>

#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kEdgeInside = 5, kEdgeOutside = 8, kLineReach = 6, kDotReach = 8;
constexpr double kWheelStep = 1.15;
// Space held for longer is no key press any more, but a hand on the canvas.
constexpr double kSpaceSeconds = 0.35;

// Boxes and pills, the upper ones first. Edges count on both sides of the outline, the inner part less on small boxes.
Hit hit_body(const Board& board, ImVec2 at, bool edges_only) {
  const float scale = board.theme().scale();
  for (std::size_t k = board.model.anchors(); k-- > 0;) {
    const Box screen = board.camera.to_screen(board.model.anchor(k));
    const float least = std::min(screen.size.x, screen.size.y);
    const float inside = std::min(kEdgeInside * scale, 0.05f * least), outside = std::min(kEdgeOutside * scale, 0.25f * least);
    if (!screen.grown(outside).holds(at)) continue;
    const bool is_pill = k >= board.model.boxes.size();
    const bool is_edge = !screen.grown(-inside).holds(at);
    if (edges_only != is_edge) continue;
    if (board.model.is_door(k))
      return {Thing::door, board.model.doors[k - board.model.boxes.size() - board.model.pills.size()].id, k};
    const std::string id = is_pill ? board.model.pills[k - board.model.boxes.size()].key : board.model.boxes[k].id;
    return {is_pill ? (is_edge ? Thing::pill_edge : Thing::pill) : (is_edge ? Thing::node_edge : Thing::node), id, k};
  }
  return {};
}

Hit hit_line(const Board& board, ImVec2 at) {
  const float scale = board.theme().scale();
  const ImVec2 p = board.camera.to_plane(at);
  const float reach = kLineReach * scale / board.camera.factor();
  Hit best;
  float nearest = reach;
  for (std::size_t k = 0; k < board.model.lines.size(); ++k) {
    const Line& line = board.model.lines[k];
    if (board.is_hidden(line) || !line.bounds.grown(reach).holds(p)) continue;
    for (std::size_t d = 0; d < line.dots.size(); ++d)
      if (length(line.dots[d] - p) < kDotReach * scale / board.camera.factor()) return {Thing::dot, line.id, d};
    for (std::size_t s = 1; s < line.points.size(); ++s)
      if (const float away = distance(p, line.points[s - 1], line.points[s]); away < nearest) {
        nearest = away;
        best = {Thing::link, line.id, k};
      }
  }
  return best;
}

Hit hit_frame(const Board& board, ImVec2 at) {
  Hit best;
  float least = 1e30f;
  for (const auto& [id, frame] : board.model.view.frames) {
    Box box;
    if (!board.model.frame_box(id, box) || box.size.x * box.size.y > least) continue;
    Box head = board.camera.to_screen(box);
    head.size.y = std::max(kFrameHead * board.camera.factor(), 8.0f);
    if (head.holds(at)) best = {Thing::frame, id, 0}, least = box.size.x * box.size.y;
  }
  return best;
}

// Adding, dots, and texts that are edited in their place.
void handle_double_click(Board& board, const Hit& hit) {
  const ImVec2 at = ImGui::GetIO().MousePos;
  switch (hit.thing) {
    case Thing::nothing: open_addition(board, at); break;
    case Thing::link: add_dot(board, hit.index, board.camera.to_plane(at)); break;
    case Thing::dot: remove_dot(board, board.model.find_line(hit.id), hit.index); break;
    case Thing::frame: board.after_frame = [id = hit.id](Board& b) { enter_frame(b, id); }; break;
    case Thing::node:
    case Thing::comment: begin_edit(board, hit.thing, hit.id); break;
    default: break;
  }
}

void handle_keys_held(Board& board, bool is_hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false) && board.drag.deed != DragMode::none) cancel_drag(board);
  const bool is_typing = io.WantTextInput || board.picker.is_open;
  if (is_hovered && !is_typing && ImGui::IsKeyPressed(GLFW_KEY_SPACE, false) && !io.KeyCtrl && !io.KeyAlt && !io.KeyShift) {
    board.space_since = board.editor.now;
    board.has_space_panned = false;
  }
  // Space alone adds; Space with a drag pans. Which one it was is known when it is let go.
  if (board.space_since >= 0 && !ImGui::IsKeyDown(GLFW_KEY_SPACE)) {
    const bool is_tap = !board.has_space_panned && board.editor.now - board.space_since < kSpaceSeconds;
    board.space_since = -1;
    if (is_tap && is_hovered && !is_typing) open_addition(board, io.MousePos);
  }
}

void point_at(Board& board, bool is_hovered) {
  Hit hit;
  if (is_hovered) hit = hit_at(board, ImGui::GetIO().MousePos);
  if (!(hit == board.hovered)) {
    board.hovered = hit;
    board.hovered_since = board.editor.now;
  }
  Picks& picks = board.editor.picks;
  if (hit.thing == Thing::node || hit.thing == Thing::node_edge || hit.thing == Thing::door) picks.hovered_node = hit.id;
  if (hit.thing == Thing::link || hit.thing == Thing::dot) { picks.hovered_link = hit.id; }
}

void set_cursor(const Board& board) {
  const Thing thing = board.hovered.thing;
  if (board.drag.deed == DragMode::pan || (board.space_since >= 0 && board.drag.deed == DragMode::none))
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
  else if (thing == Thing::node_edge || thing == Thing::pill_edge || thing == Thing::chip || thing == Thing::door ||
           thing == Thing::crumb || thing == Thing::card_cross)
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  else if (thing == Thing::comment_corner) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNWSE);
}

}  // namespace

ImVec2 Board::cursor() const {
  if (menu.is_acting) return camera.to_plane(menu.at);
  const ImVec2 at = ImGui::GetIO().MousePos;
  return camera.to_plane(camera.pane().holds(at) || drag.deed != DragMode::none ? at : camera.pane().centre());
}

Hit hit_at(const Board& board, ImVec2 at) {
  for (std::size_t k = board.crosses.size(); k-- > 0;)
    if (board.crosses[k].second.holds(at)) return {Thing::card_cross, board.crosses[k].first, k};
  for (std::size_t k = 0; k < board.crumbs.size(); ++k)
    if (board.crumbs[k].box.holds(at)) return {Thing::crumb, board.crumbs[k].frame, k};
  for (std::size_t k = 0; k < board.chips.size(); ++k)
    if (board.chips[k].second.holds(at)) return {Thing::chip, board.chips[k].first, k};
  if (board.minimap.size.x > 0 && board.minimap.holds(at)) return {Thing::minimap, "", 0};
  if (Hit hit = hit_body(board, at, false); hit.thing != Thing::nothing) return hit;
  if (Hit hit = hit_line(board, at); hit.thing == Thing::dot) return hit;
  if (Hit hit = hit_body(board, at, true); hit.thing != Thing::nothing) return hit;
  for (const auto& [id, comment] : board.model.view.comments) {
    if (!board.model.shows_comment(id)) continue;
    const Box screen = board.camera.to_screen(comment.box);
    if (Box{screen.high() - ImVec2(12, 12), {14, 14}}.holds(at)) return {Thing::comment_corner, id, 0};
    if (screen.holds(at)) return {Thing::comment, id, 0};
  }
  if (Hit hit = hit_line(board, at); hit.thing != Thing::nothing) return hit;
  return hit_frame(board, at);
}

void handle_mouse(Board& board, bool is_hovered) {
  const ImGuiIO& io = ImGui::GetIO();
  if (board.drag.deed != DragMode::none && board.drag.revision != board.model.revision) board.drag = {};
  point_at(board, is_hovered || board.drag.deed != DragMode::none);
  handle_keys_held(board, is_hovered);
  if (is_hovered && io.MouseWheel != 0)
    board.camera.zoom_at(io.MousePos, std::pow(kWheelStep, static_cast<double>(io.MouseWheel)));
  if (board.drag.deed != DragMode::none) {
    if (ImGui::IsMouseDown(board.drag.button)) go_on_dragging(board);
    else if (const Hit grabbed = board.drag.grabbed; board.drag.is_double && !board.drag.is_far)
      board.drag = {}, handle_double_click(board, grabbed);
    else end_drag(board);
  } else if (is_hovered && board.edit.thing == Thing::nothing) {
    for (const int button : {0, 1, 2})
      if (ImGui::IsMouseClicked(button)) {
        const Hit hit = board.hovered;
        begin_drag(board, button);
        // A second press may still become a drag; on a link there is none.
        board.drag.is_double = button == 0 && ImGui::IsMouseDoubleClicked(0) && !io.KeyAlt && !io.KeyCtrl && !io.KeyShift;
        if (board.drag.is_double && board.drag.deed == DragMode::none) board.drag = {}, handle_double_click(board, hit);
        break;
      }
  }
  if (is_hovered) set_cursor(board);
}

void begin_drag(Board& board, int button) {
  const ImGuiIO& io = ImGui::GetIO();
  const Hit hit = board.hovered;
  Drag& drag = board.drag;
  drag = {};
  drag.button = button;
  drag.grabbed = hit;
  drag.begin = board.camera.to_plane(io.MousePos);
  drag.revision = board.model.revision;
  Picks& picks = board.editor.picks;
  const bool is_swipe = (button == 1 && io.KeyCtrl) || (button == 0 && ImGui::IsKeyDown(GLFW_KEY_Y) && !io.KeyCtrl);
  if (is_swipe) {
    drag.deed = DragMode::cut;
  } else if (button != 0 || board.space_since >= 0) {
    drag.deed = DragMode::pan;
  } else if (hit.thing == Thing::chip) {
    press_chip(board, hit.id);
  } else if (hit.thing == Thing::card_cross) {
    std::erase(board.pinned, hit.id);
  } else if (hit.thing == Thing::crumb) {
    board.after_frame = [frame = hit.id](Board& b) { enter_frame(b, frame); };
  } else if (hit.thing == Thing::door) {
    const std::size_t door = hit.index - board.model.boxes.size() - board.model.pills.size();
    board.after_frame = [door](Board& b) { go_through(b, door); };
  } else if (hit.thing == Thing::minimap) {
    drag.deed = DragMode::minimap;
  } else if (is_body(hit.thing) && io.KeyCtrl && io.KeyShift) {
    drag.deed = DragMode::relink;
  } else if (hit.thing == Thing::node_edge || hit.thing == Thing::pill_edge) {
    drag.deed = DragMode::link;
  } else if (hit.thing == Thing::dot) {
    drag.deed = DragMode::dot;
    drag.dots = {{hit.id, hit.index}};
  } else if (hit.thing == Thing::link) {
    if (io.KeyAlt) return add_dot(board, hit.index, drag.begin);
    if (!io.KeyShift && !io.KeyCtrl) picks.only_link(hit.id);
    else if (io.KeyCtrl && picks.links.erase(hit.id) > 0) return;
    else picks.links.insert(hit.id);
  } else if (hit.thing == Thing::comment_corner) {
    drag.deed = DragMode::comment_corner;
  } else {
    drag.deed = hit.thing == Thing::nothing ? DragMode::box : DragMode::move;
    drag.adds = io.KeyShift;
    drag.toggles = io.KeyCtrl;
    drag.copies = io.KeyAlt && (hit.thing == Thing::node || hit.thing == Thing::comment);  // as a clip can hold
    drag.leaves = io.KeyShift;
  }
  go_on_dragging(board);
}

}  // namespace bl::desktop::canvas
