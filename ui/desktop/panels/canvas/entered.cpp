// Into frames and out of them: the model is narrowed, what is chosen follows, and the camera comes back to where it was.
#include "ui/desktop/panels/canvas/entered.h"

#include <nlohmann/json.hpp>

#include "ui/desktop/panels/canvas/arrangement.h"

namespace bl::desktop::canvas {

namespace {

bool lies_in(const ViewData& view, const std::string& frame, const Selection& end) {
  return !end.is_query() && !end.ids.empty() &&
         std::all_of(end.ids.begin(), end.ids.end(), [&](const std::string& id) { return view.holds_node(frame, id); });
}

// Is everything that is chosen seen from this frame? What has gone from the scene does not count.
bool holds_choice(const Board& board, const std::string& frame) {
  const Scene& scene = board.editor.scene();
  const ViewData& view = board.model.view;
  for (const std::string& id : board.editor.picks.nodes)
    if (scene.nodes.contains(id) && !view.holds_node(frame, id)) return false;
  for (const std::string& id : board.editor.picks.links) {
    const auto link = scene.links.find(id);
    if (link == scene.links.end() || !link->second.ghost.empty()) continue;
    if (!lies_in(view, frame, link->second.from) && !lies_in(view, frame, link->second.to)) return false;
  }
  return true;
}

std::string outer_of(const ViewData& view, const std::string& frame) {
  const auto way = view.way_to(frame);
  return way.size() < 2 ? std::string() : way[way.size() - 2];
}

// What cannot be seen any more is not chosen, not pointed at, and not in the middle of being edited.
void forget_unseen(Board& board) {
  Picks& picks = board.editor.picks;
  const Model& model = board.model;
  std::erase_if(picks.nodes, [&](const std::string& id) { return model.find_box(id) == model.boxes.size(); });
  std::erase_if(picks.links, [&](const std::string& id) { return model.find_line(id) == model.lines.size(); });
  std::erase_if(board.picked_comments, [&](const std::string& id) { return !model.shows_comment(id); });
  std::erase_if(board.picked_frames, [&](const std::string& id) { return !model.shows_frame(id); });
  board.drag = {};
  board.edit = {};
  board.hovered = {};
}

void narrow_to(Board& board, const std::string& frame) {
  board.poses[board.model.entered] = board.camera.aim();
  board.model.entered = frame;
  board.model.update(board.editor);
  board.way_in = board.model.view.way_to(frame);
  board.drag = {};
  board.edit = {};
  board.hovered = {};
}

// Where the camera was when the frame was last looked at, or all that is in it.
void look_again(Board& board, bool is_soft) {
  const auto known = board.poses.find(board.model.entered);
  if (known != board.poses.end()) board.camera.go_to(known->second, is_soft);
  else board.camera.fit(board.model.bounds(), is_soft);
}

}  // namespace

void bring_up_to_date(Board& board) {
  board.model.update(board.editor);
  if (board.model.entered.empty()) return;
  const ViewData& view = board.model.view;
  std::string seen = board.model.entered;
  // A frame that has gone, perhaps by undo: up to the next one that is still there.
  while (!board.way_in.empty() && !view.frames.contains(board.way_in.back())) board.way_in.pop_back();
  if (!view.frames.contains(seen)) seen = board.way_in.empty() ? std::string() : board.way_in.back();
  while (!seen.empty() && !holds_choice(board, seen)) seen = outer_of(view, seen);
  if (seen == board.model.entered) return void(board.way_in = view.way_to(seen));
  narrow_to(board, seen);
  look_again(board, false);
  if (!board.editor.picks.nodes.empty()) show_node(board, *board.editor.picks.nodes.begin());
}

std::string frame_to_enter(const Board& board) {
  const Model& model = board.model;
  for (const std::string& id : board.picked_frames)
    if (model.view.frames.contains(id) && model.shows_frame(id)) return id;
  for (const std::string& id : board.editor.picks.nodes)
    if (const std::string frame = model.view.frame_of_node(id); !frame.empty() && model.shows_frame(frame)) return frame;
  return "";
}

void enter_frame(Board& board, const std::string& frame) {
  if (frame == board.model.entered || (!frame.empty() && !board.model.view.frames.contains(frame))) return;
  const bool is_up = frame.empty() || board.model.view.is_within(board.model.entered, frame);
  narrow_to(board, frame);
  forget_unseen(board);
  if (is_up) look_again(board, true);
  else board.camera.fit(board.model.bounds(), true);
}

void leave_frame(Board& board) {
  const std::string left = board.model.entered;
  if (left.empty()) return;
  enter_frame(board, outer_of(board.model.view, left));
  board.editor.picks.clear();
  board.picked_comments.clear();
  board.picked_frames = {left};  // so that I goes back in
}

void leave_to_node(Board& board, const std::string& node) {
  std::string seen = board.model.entered;
  while (!seen.empty() && !board.model.view.holds_node(seen, node)) seen = outer_of(board.model.view, seen);
  if (seen == board.model.entered) return;
  narrow_to(board, seen);
  forget_unseen(board);
  look_again(board, false);
}

void go_through(Board& board, std::size_t door) {
  if (door >= board.model.doors.size()) return;
  const Door behind = board.model.doors[door];
  if (!behind.is_set) {
    leave_to_node(board, behind.id);
    board.editor.picks.only_node(behind.id);
    return show_node(board, behind.id);
  }
  // A set is seen where all of its members are; that of a rule only on the whole canvas.
  std::string seen = board.model.entered;
  while (!seen.empty() && !lies_in(board.model.view, seen, behind.selection)) seen = outer_of(board.model.view, seen);
  enter_frame(board, seen);
  for (const Pill& pill : board.model.pills)
    if (pill.key == behind.id) board.camera.fit(pill.box.grown(160), true);
}

void join_entered(const Board& board, Json& patch, const char* list, const std::string& id) {
  const std::string& frame = board.model.entered;
  if (board.model.view.frames.contains(frame)) patch["frames"][frame][list][id] = true;
}

}  // namespace bl::desktop::canvas
