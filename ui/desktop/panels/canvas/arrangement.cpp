// Changes of the view alone, from the keyboard and the menus.
#include "ui/desktop/panels/canvas/arrangement.h"

#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "ui/desktop/panels/canvas/auto_layout.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"

namespace bl::desktop::canvas {

namespace {

std::vector<std::size_t> chosen_boxes(const Board& board) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < board.model.boxes.size(); ++k)
    if (board.editor.picks.nodes.contains(board.model.boxes[k].id)) chosen.push_back(k);
  return chosen;
}

// Submits new places of boxes as one step.
void put(Board& board, const std::vector<std::pair<std::size_t, ImVec2>>& places) {
  Json patch = Json::object();
  for (const auto& [k, at] : places)
    if (length(at - board.model.boxes[k].box.at) > 0.01f || !board.model.boxes[k].is_stored)
      patch["boxes"][board.model.boxes[k].id] = place_json(at);
  if (!patch.empty()) board.editor.arrange(write_json_line(patch), board.editor.new_gesture());
}

std::string fresh_key(const std::string& base, const std::function<bool(const std::string&)>& is_taken) {
  std::string key = base;
  for (int k = 2; is_taken(key); ++k) key = base + "-" + std::to_string(k);
  return key;
}

}  // namespace

std::optional<Box> box_of_choice(const Board& board) {
  std::optional<Box> all;
  const auto take = [&](const Box& box) { all = all ? all->with(box) : box; };
  for (const std::size_t k : chosen_boxes(board)) take(board.model.boxes[k].box);
  for (const std::string& id : board.picked_comments)
    if (const auto found = board.model.view.comments.find(id); found != board.model.view.comments.end()) take(found->second.box);
  for (const std::string& id : board.picked_frames)
    if (Box box; board.model.frame_box(id, box)) take(box);
  for (const std::string& id : board.editor.picks.links)
    if (const std::size_t k = board.model.find_line(id); k < board.model.lines.size()) take(board.model.lines[k].bounds);
  return all;
}

void align_chosen(Board& board, Alignment alignment) {
  const auto chosen = chosen_boxes(board);
  if (chosen.size() < 2) return board.editor.tell(NoticeKind::told, "Choose two or more nodes to align them.");
  const Box all = *box_of_choice(board);
  std::vector<std::pair<std::size_t, ImVec2>> places;
  for (const std::size_t k : chosen) {
    const Box& box = board.model.boxes[k].box;
    ImVec2 at = box.at;
    switch (alignment) {
      case Alignment::left: at.x = all.low().x; break;
      case Alignment::right: at.x = all.high().x - box.size.x; break;
      case Alignment::top: at.y = all.low().y; break;
      case Alignment::bottom: at.y = all.high().y - box.size.y; break;
      case Alignment::centre: at.x = all.centre().x - box.size.x / 2; break;
      case Alignment::middle: at.y = all.centre().y - box.size.y / 2; break;
    }
    places.emplace_back(k, at);
  }
  put(board, places);
}

void distribute_chosen(Board& board, bool is_across) {
  auto chosen = chosen_boxes(board);
  if (chosen.size() < 3) return board.editor.tell(NoticeKind::told, "Choose three or more nodes to distribute them.");
  const auto low = [&](std::size_t k) { return is_across ? board.model.boxes[k].box.at.x : board.model.boxes[k].box.at.y; };
  const auto size = [&](std::size_t k) { return is_across ? board.model.boxes[k].box.size.x : board.model.boxes[k].box.size.y; };
  std::stable_sort(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) { return low(a) < low(b); });
  float taken = 0, end = low(chosen.front());
  for (const std::size_t k : chosen) taken += size(k), end = std::max(end, low(k) + size(k));
  const float gap = (end - low(chosen.front()) - taken) / static_cast<float>(chosen.size() - 1);
  float at = low(chosen.front());
  std::vector<std::pair<std::size_t, ImVec2>> places;
  for (const std::size_t k : chosen) {
    ImVec2 place = board.model.boxes[k].box.at;
    (is_across ? place.x : place.y) = at;
    places.emplace_back(k, place);
    at += size(k) + gap;
  }
  put(board, places);
}

void lay_out_chosen(Board& board) {
  auto chosen = chosen_boxes(board);
  const bool is_all = chosen.size() < 2;
  if (is_all && !board.model.entered.empty()) {
    // Of the whole canvas, only what is shown is laid out.
    chosen.clear();
    for (std::size_t k = 0; k < board.model.boxes.size(); ++k) chosen.push_back(k);
    if (chosen.empty()) return;
  } else if (is_all) {
    // Everything goes back to the automatic layout: what the view says of boxes, sets and dots goes.
    Json patch = Json::object();
    for (const auto& [id, at] : board.model.view.boxes) patch["boxes"][id] = nullptr;
    for (const auto& [key, at] : board.model.view.sets) patch["sets"][key] = nullptr;
    for (const auto& [id, dots] : board.model.view.dots) patch["dots"][id] = nullptr;
    board.model.forget_places();
    if (!patch.empty()) board.editor.arrange(write_json_line(patch), board.editor.new_gesture());
    board.after_frame = [](Board& b) {
      b.model.update(b.editor);
      b.camera.fit(b.model.bounds(), true);
    };
    return;
  }
  std::vector<LayoutItem> items;
  std::vector<std::pair<std::size_t, std::size_t>> links;
  std::map<std::size_t, std::size_t> place_of;
  for (const std::size_t k : chosen) {
    place_of[k] = items.size();
    items.push_back({board.model.boxes[k].box.size, -1, board.model.boxes[k].name});
  }
  for (const Line& line : board.model.lines)
    if (place_of.contains(line.from) && place_of.contains(line.to)) links.emplace_back(place_of[line.from], place_of[line.to]);
  const auto places = lay_out(items, links);
  // The upper left corner stays where it was.
  Box around = board.model.boxes[chosen.front()].box;
  for (const std::size_t k : chosen) around = around.with(board.model.boxes[k].box);
  const ImVec2 corner = around.at;
  std::vector<std::pair<std::size_t, ImVec2>> moved;
  for (std::size_t k = 0; k < chosen.size(); ++k) moved.emplace_back(chosen[k], places[k] + corner);
  put(board, moved);
}

void frame_chosen(Board& board) {
  const auto& nodes = board.editor.picks.nodes;
  if (nodes.empty() && board.picked_comments.empty() && board.picked_frames.empty())
    return board.editor.tell(NoticeKind::told, "Choose nodes, and Ctrl+G puts a frame around them.");
  const ViewData& view = board.model.view;
  const std::string id = fresh_key("frame", [&](const std::string& key) { return view.frames.contains(key); });
  Json patch = Json::object();
  Json& frame = patch["frames"][id];
  frame["name"] = "Frame";
  frame["colour"] = view.frames.size() % 9;
  // A frame around things that all lie in one frame lies in it as well; whole frames move in as they are.
  std::set<std::string> outer;
  for (const std::string& node : nodes) {
    const std::string own = view.frame_of_node(node);
    if (!own.empty() && board.picked_frames.contains(own)) continue;
    outer.insert(own);
    if (!own.empty()) patch["frames"][own]["nodes"][node] = nullptr;
    patch["frames"][id]["nodes"][node] = true;
  }
  for (const std::string& comment : board.picked_comments) {
    const std::string own = view.frame_of_comment(comment);
    outer.insert(own);
    if (!own.empty()) patch["frames"][own]["comments"][comment] = nullptr;
    patch["frames"][id]["comments"][comment] = true;
  }
  for (const std::string& inner : board.picked_frames)
    if (view.frames.contains(inner)) outer.insert(view.frames.at(inner).in), patch["frames"][inner]["in"] = id;
  const std::string in = outer.size() == 1 && !outer.begin()->empty() ? *outer.begin() : board.model.entered;
  if (!in.empty()) patch["frames"][id]["in"] = in;
  if (!board.editor.arrange(write_json_line(patch), board.editor.new_gesture())) return;
  board.model.update(board.editor);
  board.picked_frames = {id};
  begin_edit(board, Thing::frame, id);
}

void add_comment(Board& board) {
  const ViewData& view = board.model.view;
  const std::string id = fresh_key("comment", [&](const std::string& key) { return view.comments.contains(key); });
  Json patch = Json::object();
  Json& comment = patch["comments"][id];
  comment["at"] = place_json(board.cursor());
  comment["size"] = place_json({220, 70});
  comment["text"] = "";
  join_entered(board, patch, "comments", id);
  if (!board.editor.arrange(write_json_line(patch), board.editor.new_gesture())) return;
  board.model.update(board.editor);
  board.picked_comments = {id};
  begin_edit(board, Thing::comment, id);
}

void begin_edit(Board& board, Thing thing, const std::string& id) {
  const ViewData& view = board.model.view;
  std::string text;
  if (thing == Thing::node) text = board.editor.name_of(id);
  else if (thing == Thing::comment && view.comments.contains(id)) text = view.comments.at(id).text;
  else if (thing == Thing::frame && view.frames.contains(id)) text = view.frames.at(id).name;
  else return;
  board.edit = {thing, id, text, true};
}

namespace {

void end_edit(Board& board) {
  const InlineEdit edit = board.edit;
  board.edit = {};
  Editor& editor = board.editor;
  const ViewData& view = board.model.view;
  Json patch = Json::object();
  if (edit.thing == Thing::node && edit.text != editor.name_of(edit.id)) {
    editor.submit(command<RenameNode>({edit.id, edit.text}), editor.new_gesture());
  } else if (edit.thing == Thing::comment && view.comments.contains(edit.id) && view.comments.at(edit.id).text != edit.text) {
    patch["comments"][edit.id]["text"] = edit.text;
  } else if (edit.thing == Thing::frame && view.frames.contains(edit.id) && view.frames.at(edit.id).name != edit.text) {
    patch["frames"][edit.id]["name"] = edit.text;
  }
  if (!patch.empty()) editor.arrange(write_json_line(patch), editor.new_gesture());
}

// Where the text stands that is edited; nothing where it has gone.
std::optional<Box> box_of_edit(const Board& board) {
  const InlineEdit& edit = board.edit;
  if (edit.thing == Thing::node) {
    const std::size_t k = board.model.find_box(edit.id);
    if (k >= board.model.boxes.size()) return std::nullopt;
    return Box{board.model.boxes[k].box.at, {kBoxWidth, kHeadHeight}};
  }
  if (edit.thing == Thing::comment) {
    const auto found = board.model.view.comments.find(edit.id);
    return found == board.model.view.comments.end() ? std::nullopt : std::optional<Box>(found->second.box);
  }
  Box box;
  if (!board.model.frame_box(edit.id, box)) return std::nullopt;
  return Box{box.at, {std::max(box.size.x, 160.0f), 26}};
}

}  // namespace

void draw_inline_edit(Board& board) {
  InlineEdit& edit = board.edit;
  if (edit.thing == Thing::nothing) return;
  const auto place = box_of_edit(board);
  if (!place) return void(board.edit = {});
  const Box screen = board.camera.to_screen(*place);
  const float least = 120 * board.theme().scale();
  ImGui::SetCursorScreenPos(screen.at);
  if (edit.is_fresh) ImGui::SetKeyboardFocusHere();
  const ImVec2 size{std::max(screen.size.x, least), std::max(screen.size.y, ImGui::GetFrameHeight())};
  bool is_done = false;
  if (edit.thing == Thing::comment) {
    is_done = ImGui::InputTextMultiline("##edit", &edit.text, size,
                                        ImGuiInputTextFlags_CtrlEnterForNewLine | ImGuiInputTextFlags_EnterReturnsTrue);
  } else {
    ImGui::SetNextItemWidth(size.x);
    is_done = ImGui::InputText("##edit", &edit.text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  }
  const bool is_left = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false);
  const bool is_out = !edit.is_fresh && ImGui::IsItemDeactivated();
  edit.is_fresh = false;
  if (is_left) board.edit = {};
  else if (is_done || is_out) end_edit(board);
}

void show_node(Board& board, const std::string& id) {
  leave_to_node(board, id);
  const std::size_t k = board.model.find_box(id);
  if (k >= board.model.boxes.size()) return;
  const Box& box = board.model.boxes[k].box;
  if (board.camera.sight().encloses(box) && board.camera.zoom() > 0.3) return;
  board.camera.fit(box.grown(std::max(160.0f, 0.5f * kBoxWidth)), true);
}

void step_choice(Board& board, ImVec2 direction) {
  const auto chosen = chosen_boxes(board);
  const ImVec2 from = chosen.empty() ? board.camera.sight().centre() : board.model.boxes[chosen.front()].box.centre();
  std::size_t best = board.model.boxes.size();
  float least = 1e30f;
  for (std::size_t k = 0; k < board.model.boxes.size(); ++k) {
    const ImVec2 way = board.model.boxes[k].box.centre() - from;
    const float ahead = dot(way, direction), aside = std::abs(cross(way, direction));
    if (!chosen.empty() && (k == chosen.front() || ahead < 1)) continue;
    const float cost = chosen.empty() ? length(way) : ahead + 2.5f * aside;
    if (cost < least) least = cost, best = k;
  }
  if (best == board.model.boxes.size()) return;
  board.editor.picks.only_node(board.model.boxes[best].id);
  show_node(board, board.model.boxes[best].id);
}

}  // namespace bl::desktop::canvas
