// The course of drags: nothing reaches the scene before the button is let go.
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/clipboard.h"
#include "ui/desktop/panels/canvas/context_menu.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/mouse.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kTremble = 4, kGuideReach = 6;

// What a press on something that can be moved chooses, as soon as it is pressed.
void choose_pressed(Board& board) {
  const Drag& drag = board.drag;
  Picks& picks = board.editor.picks;
  const auto press = [&](std::set<std::string>& set, const std::string& id) {
    const bool is_in = set.contains(id);
    if (drag.toggles && is_in) return void(set.erase(id));
    if (!drag.adds && !drag.toggles && !is_in) picks.clear(), board.picked_comments.clear(), board.picked_frames.clear();
    set.insert(id);
  };
  if (drag.grabbed.thing == Thing::node) {
    if (drag.leaves) board.picked_frames.clear();  // with Shift it leaves its frame, which then stays
    press(picks.nodes, drag.grabbed.id);
  }
  if (drag.grabbed.thing == Thing::comment) press(board.picked_comments, drag.grabbed.id);
  if (drag.grabbed.thing == Thing::frame) press(board.picked_frames, drag.grabbed.id);
}

void gather_frame(const Board& board, const std::string& id, std::set<std::string>& nodes, std::set<std::string>& comments) {
  for (const auto& [other, frame] : board.model.view.frames) {
    if (!board.model.view.is_within(other, id)) continue;
    nodes.insert(frame.nodes.begin(), frame.nodes.end());
    comments.insert(frame.comments.begin(), frame.comments.end());
  }
}

// Everything that moves with what was grabbed: what is chosen, and what lies in chosen frames.
void gather_moving(Board& board) {
  Drag& drag = board.drag;
  std::set<std::string> nodes = board.editor.picks.nodes, comments = board.picked_comments;
  for (const std::string& frame : board.picked_frames) gather_frame(board, frame, nodes, comments);
  if (drag.grabbed.thing == Thing::pill) {
    nodes.clear(), comments.clear();
    drag.anchors.push_back(drag.grabbed.index);
  }
  for (const std::string& id : nodes)
    if (const std::size_t k = board.model.find_box(id); k < board.model.boxes.size()) drag.anchors.push_back(k);
  for (const std::string& id : comments)
    if (board.model.view.comments.contains(id)) drag.comments.push_back(id);
  for (const std::size_t k : drag.anchors) drag.old_anchors.push_back(board.model.anchor(k));
  for (const std::string& id : drag.comments) drag.old_comments.push_back(board.model.view.comments.at(id).box);
  // Dots of links between nodes that both move, move too.
  for (const Line& line : board.model.lines) {
    const auto moves = [&](std::size_t anchor) {
      return std::find(drag.anchors.begin(), drag.anchors.end(), anchor) != drag.anchors.end();
    };
    if (drag.copies || line.dots.empty() || !moves(line.from) || !moves(line.to)) continue;
    for (std::size_t d = 0; d < line.dots.size(); ++d) drag.dots.emplace_back(line.id, d), drag.old_dots.push_back(line.dots[d]);
  }
}

Box& anchor_box(Model& model, std::size_t k) {
  return k < model.boxes.size() ? model.boxes[k].box : model.pills[k - model.boxes.size()].box;
}

// One axis of the snapping: the shift that brings an edge or the middle of the grabbed box onto one of another box.
struct Snap {
  float shift = 0, away = 0, line = 0;
  std::size_t other = kNoIndex;
};
void consider(Snap& best, float mine, float theirs, std::size_t other) {
  if (std::abs(theirs - mine) < best.away) best = {theirs - mine, std::abs(theirs - mine), theirs, other};
}

void snap(Board& board, const Box& grabbed) {
  Drag& drag = board.drag;
  drag.guides.clear();
  Box moved{grabbed.at + drag.shift, grabbed.size};
  const float reach = kGuideReach / board.camera.factor();
  Snap x{0, reach, 0, kNoIndex}, y{0, reach, 0, kNoIndex};
  const Box sight = board.camera.sight();
  for (std::size_t k = 0; k < board.model.anchors(); ++k) {
    if (std::find(drag.anchors.begin(), drag.anchors.end(), k) != drag.anchors.end()) continue;
    const Box& other = board.model.anchor(k);
    if (!other.touches(sight)) continue;
    consider(x, moved.low().x, other.low().x, k);
    consider(x, moved.high().x, other.high().x, k);
    consider(x, moved.centre().x, other.centre().x, k);
    consider(y, moved.low().y, other.low().y, k);
    consider(y, moved.high().y, other.high().y, k);
    consider(y, moved.centre().y, other.centre().y, k);
  }
  const auto grid = [](float v) { return std::round(v / kGrid) * kGrid; };
  drag.shift.x += x.other != kNoIndex ? x.shift : grid(moved.at.x) - moved.at.x;
  drag.shift.y += y.other != kNoIndex ? y.shift : grid(moved.at.y) - moved.at.y;
  moved.at = grabbed.at + drag.shift;
  if (x.other != kNoIndex) {
    const Box both = moved.with(board.model.anchor(x.other));
    drag.guides.emplace_back(ImVec2(x.line, both.low().y - 10), ImVec2(x.line, both.high().y + 10));
  }
  if (y.other != kNoIndex) {
    const Box both = moved.with(board.model.anchor(y.other));
    drag.guides.emplace_back(ImVec2(both.low().x - 10, y.line), ImVec2(both.high().x + 10, y.line));
  }
}

void move_to_shift(Board& board) {
  Drag& drag = board.drag;
  for (std::size_t k = 0; k < drag.anchors.size(); ++k)
    anchor_box(board.model, drag.anchors[k]).at = drag.old_anchors[k].at + drag.shift;
  board.model.is_view_moved = board.model.is_view_moved || !drag.comments.empty();
  for (std::size_t k = 0; k < drag.comments.size(); ++k)
    board.model.view.comments.at(drag.comments[k]).box.at = drag.old_comments[k].at + drag.shift;
  for (std::size_t k = 0; k < drag.dots.size() && k < drag.old_dots.size(); ++k)
    if (const std::size_t line = board.model.find_line(drag.dots[k].first); line < board.model.lines.size())
      board.model.lines[line].dots[drag.dots[k].second] = drag.old_dots[k] + drag.shift;
  board.model.trace_lines();
}

void go_on_moving(Board& board) {
  Drag& drag = board.drag;
  if (drag.anchors.empty() && drag.comments.empty()) gather_moving(board);
  drag.shift = board.cursor() - drag.begin;
  if (drag.anchors.empty() && drag.comments.empty()) return;
  Box grabbed = drag.anchors.empty() ? drag.old_comments.front() : drag.old_anchors.front();
  for (std::size_t k = 0; k < drag.anchors.size(); ++k)
    if (drag.grabbed.thing == Thing::node && drag.anchors[k] == drag.grabbed.index) grabbed = drag.old_anchors[k];
  if (board.snaps) snap(board, grabbed);
  move_to_shift(board);
}

void go_on_boxing(Board& board) {
  const Drag& drag = board.drag;
  const ImVec2 cursor = board.cursor();
  const Box box = box_between(drag.begin, cursor);
  const bool encloses = cursor.x >= drag.begin.x;
  const bool keeps = drag.adds || drag.toggles;
  Picks& picks = board.editor.picks;
  picks.nodes = keeps ? drag.base_nodes : std::set<std::string>();
  picks.links = keeps ? drag.base_links : std::set<std::string>();
  board.picked_comments = keeps ? drag.base_comments : std::set<std::string>();
  board.picked_frames = keeps ? drag.base_frames : std::set<std::string>();
  const auto is_in = [&](const Box& other) { return encloses ? box.encloses(other) : box.touches(other); };
  const auto take = [&](std::set<std::string>& set, const std::string& id) {
    if (drag.toggles && set.erase(id) > 0) return;
    set.insert(id);
  };
  bool has_nodes = false;
  for (const NodeBox& node : board.model.boxes)
    if (is_in(node.box)) take(picks.nodes, node.id), has_nodes = true;
  for (const auto& [id, comment] : board.model.view.comments)
    if (board.model.shows_comment(id) && is_in(comment.box)) take(board.picked_comments, id), has_nodes = true;
  // A frame is large and lies behind: it is meant where all of it is inside, whichever way the box was drawn.
  for (const auto& [id, frame] : board.model.view.frames)
    if (Box outline; board.model.frame_box(id, outline) && box.encloses(outline)) take(board.picked_frames, id);
  if (has_nodes) return;
  for (const Line& line : board.model.lines) {
    if (board.is_hidden(line)) continue;
    const bool any = std::any_of(line.points.begin(), line.points.end(), [&](ImVec2 p) { return box.holds(p); });
    if (encloses ? box.encloses(line.bounds) : any) take(picks.links, line.id);
  }
}

// A swipe only grows: each frame looks at its newest stretch alone.
void go_on_cutting(Board& board, ImVec2 cursor) {
  Drag& drag = board.drag;
  if (!drag.swipe.empty() && length(cursor - drag.swipe.back()) * board.camera.factor() <= 2) return;
  drag.swipe.push_back(cursor);
  if (drag.swipe.size() < 2) return;
  const ImVec2 last = drag.swipe[drag.swipe.size() - 2];
  const Box stretch = box_between(last, cursor).grown(1);
  for (const Line& line : board.model.lines) {
    if (board.is_hidden(line) || !line.bounds.grown(1).touches(stretch)) continue;
    for (std::size_t p = 1; p < line.points.size(); ++p)
      if (do_cross(last, cursor, line.points[p - 1], line.points[p])) drag.cut.insert(line.id);
  }
}

void centre_by_minimap(Board& board) {
  const Box all = board.model.bounds().grown(60);
  const Box& map = board.minimap;
  const float k = std::min(map.size.x / all.size.x, map.size.y / all.size.y);
  if (map.size.x > 0) board.camera.centre_on(all.centre() + (ImGui::GetIO().MousePos - map.centre()) * (1 / k));
}

}  // namespace

void cancel_drag(Board& board) {
  Drag& drag = board.drag;
  drag.shift = {};
  if (drag.deed == DragMode::move || drag.deed == DragMode::dot) move_to_shift(board);
  if (drag.deed == DragMode::comment_corner && !drag.old_comments.empty())
    board.model.view.comments.at(drag.grabbed.id).box = drag.old_comments.front();
  drag = {};
}

void go_on_dragging(Board& board) {
  Drag& drag = board.drag;
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 cursor = board.cursor();
  const bool is_new = !drag.is_far && drag.old_anchors.empty();
  if (!drag.is_far && length(cursor - drag.begin) * board.camera.factor() > kTremble) drag.is_far = true;
  switch (drag.deed) {
    case DragMode::pan:
      if (drag.is_far) board.camera.pan(io.MouseDelta);
      if (board.space_since >= 0) board.has_space_panned = true;
      break;
    case DragMode::box:
      if (is_new) {
        drag.base_nodes = board.editor.picks.nodes, drag.base_links = board.editor.picks.links;
        drag.base_comments = board.picked_comments, drag.base_frames = board.picked_frames;
      }
      if (drag.is_far) go_on_boxing(board);
      break;
    case DragMode::move:
      if (ImGui::IsMouseClicked(drag.button)) choose_pressed(board);
      if (drag.is_far) go_on_moving(board);
      break;
    case DragMode::cut: go_on_cutting(board, cursor); break;
    case DragMode::dot:
      if (const std::size_t line = board.model.find_line(drag.grabbed.id); line < board.model.lines.size()) {
        if (drag.old_dots.empty()) drag.old_dots = {board.model.lines[line].dots[drag.grabbed.index]};
        drag.shift = cursor - drag.begin;
        if (drag.is_far) move_to_shift(board);
      }
      break;
    case DragMode::comment_corner: {
      Box& box = board.model.view.comments.at(drag.grabbed.id).box;
      if (drag.old_comments.empty()) drag.old_comments = {box};
      board.model.is_view_moved = true;
      const ImVec2 size = drag.old_comments.front().size + (cursor - drag.begin);
      box.size = {std::max(60.0f, std::round(size.x / kGrid) * kGrid), std::max(30.0f, std::round(size.y / kGrid) * kGrid)};
      break;
    }
    case DragMode::minimap: centre_by_minimap(board); break;
    default: break;
  }
}

namespace {

// Nodes that were dragged out of their frames, with Shift, or into one. In an entered frame nothing leaves that frame itself.
void patch_membership(const Board& board, const Drag& drag, Json& patch) {
  const ViewData& view = board.model.view;
  if (!board.picked_frames.empty()) return;
  std::string target;
  if (!drag.leaves)
    for (const auto& [id, frame] : view.frames) {
      Box box;
      const bool is_new = std::none_of(drag.anchors.begin(), drag.anchors.end(), [&](std::size_t k) {
        return k < board.model.boxes.size() && frame.nodes.contains(board.model.boxes[k].id);
      });
      if (is_new && board.model.frame_box(id, box) && box.holds(board.cursor()) && (target.empty() || view.is_within(id, target)))
        target = id;
    }
  const std::string& ground = board.model.entered;
  const auto update = [&](const std::string& id, const std::string& own, const char* list) {
    const bool is_free = own == ground;
    const std::string& goal = drag.leaves ? ground : target;
    if (drag.leaves == is_free || (!drag.leaves && target.empty())) return;
    if (!own.empty()) patch["frames"][own][list][id] = nullptr;
    if (!goal.empty()) patch["frames"][goal][list][id] = true;
  };
  for (const std::size_t k : drag.anchors)
    if (k < board.model.boxes.size()) update(board.model.boxes[k].id, view.frame_of_node(board.model.boxes[k].id), "nodes");
  for (const std::string& id : drag.comments) update(id, view.frame_of_comment(id), "comments");
}

void end_move(Board& board) {
  const Drag drag = board.drag;
  if (!drag.is_far) {
    // A click on one of several chosen things chooses it alone.
    if (!drag.adds && !drag.toggles && drag.grabbed.thing == Thing::node) board.editor.picks.only_node(drag.grabbed.id);
    return;
  }
  if (drag.copies) {
    const ImVec2 shift = drag.shift;
    cancel_drag(board);
    return duplicate_chosen(board, shift);
  }
  Json patch = Json::object();
  for (const std::size_t k : drag.anchors) {
    const bool is_box = k < board.model.boxes.size();
    const std::string& key = is_box ? board.model.boxes[k].id : board.model.pills[k - board.model.boxes.size()].key;
    patch[is_box ? "boxes" : "sets"][key] = place_json(board.model.anchor(k).at);
  }
  for (const std::string& id : drag.comments) patch["comments"][id]["at"] = place_json(board.model.view.comments.at(id).box.at);
  for (const auto& [id, dot] : drag.dots) {
    Json list = Json::array();
    if (const std::size_t line = board.model.find_line(id); line < board.model.lines.size())
      for (const ImVec2& p : board.model.lines[line].dots) list.push_back(place_json(p));
    patch["dots"][id] = std::move(list);
  }
  patch_membership(board, drag, patch);
  drop_emptied_frames(board, patch);
  if (!patch.empty()) board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture());
}

void end_cut(Board& board) {
  if (board.drag.cut.empty()) return;
  remove_links(board, board.drag.cut);
  board.hovered = {};  // the cursor may rest upon a link that has just gone
}

void end_link(Board& board) {
  const Drag& drag = board.drag;
  const Hit over = board.hovered;
  const ImVec2 at = ImGui::GetIO().MousePos;
  if (takes_links(over.thing)) {
    if (over.index == drag.grabbed.index) return;
    if (drag.deed == DragMode::relink) move_links(board, drag.grabbed.index, over.index);
    else open_link_menu(board, drag.grabbed.index, over.index, at);
  } else if (drag.deed == DragMode::link && drag.is_far && board.camera.pane().holds(at)) {
    open_drop_menu(board, drag.grabbed.index, at);
  }
}

void pin_or_unpin(Board& board) {
  const Hit& hit = board.drag.grabbed;
  if (hit.thing != Thing::node && hit.thing != Thing::node_edge) return;
  if (std::erase(board.pinned, hit.id) == 0) board.pinned.push_back(hit.id);
}

}  // namespace

void end_drag(Board& board) {
  switch (board.drag.deed) {
    case DragMode::pan:
      if (!board.drag.is_far && board.drag.button == 2) pin_or_unpin(board);
      if (!board.drag.is_far && board.drag.button == 1) open_menu(board, board.drag.grabbed, ImGui::GetIO().MousePos);
      break;
    case DragMode::box:
      if (!board.drag.is_far && !board.drag.adds && !board.drag.toggles) {
        board.editor.picks.clear();
        board.picked_comments.clear();
        board.picked_frames.clear();
      }
      break;
    case DragMode::dot: board.drag.anchors.clear(); [[fallthrough]];
    case DragMode::move: end_move(board); break;
    case DragMode::cut: end_cut(board); break;
    case DragMode::link:
    case DragMode::relink: end_link(board); break;
    case DragMode::comment_corner: {
      Json patch = Json::object();
      patch["comments"][board.drag.grabbed.id]["size"] = place_json(board.model.view.comments.at(board.drag.grabbed.id).box.size);
      if (board.drag.is_far) board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture());
      break;
    }
    default: break;
  }
  board.drag = {};
}

}  // namespace bl::desktop::canvas
