// Changes of the view alone, from the keyboard and the menus.
#include "ui/desktop/panels/canvas/arrangement.h"

#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>
#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "ui/desktop/panels/canvas/auto_layout.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/canvas/stored_places.h"

namespace bl::desktop::canvas {

namespace {

std::vector<std::size_t> chosen_boxes(const Board& board) {
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < board.model.boxes.size(); ++k)
    if (board.editor.picks.nodes.contains(board.model.boxes[k].id)) chosen.push_back(k);
  return chosen;
}

// Submits new places of boxes as one step.
void put(Board& board, const std::vector<std::pair<std::size_t, ImVec2>>& places, const std::string& verb) {
  Json patch = Json::object();
  for (const auto& [k, at] : places)
    if (length(at - board.model.boxes[k].box.at) > 0.01f || !board.model.boxes[k].is_stored)
      patch["boxes"][board.model.boxes[k].id] = place_json(at);
  std::vector<Command> commands;
  add_view_patch(commands, patch);
  if (!commands.empty()) submit_as(board, commands, verb + " " + reading::counted(places.size(), "node"));
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
  if (chosen.size() < 2) return board.editor.notify(NoticeKind::told, "Choose two or more nodes to align them.");
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
  put(board, places, "Align");
}

void distribute_chosen(Board& board, bool is_across) {
  auto chosen = chosen_boxes(board);
  if (chosen.size() < 3) return board.editor.notify(NoticeKind::told, "Choose three or more nodes to distribute them.");
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
  put(board, places, "Distribute");
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
    return lay_out_all(board);
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
  put(board, moved, "Lay out");
}

namespace {

// Frames that are chosen, and those all of whose nodes are: the outermost of them, which take the others along.
std::set<std::string> whole_frames(const Board& board) {
  const ViewData& view = board.model.view;
  std::set<std::string> whole;
  for (const auto& [id, frame] : view.frames) {
    std::size_t count = 0, chosen = 0;
    for (const NodeBox& box : board.model.boxes)
      if (view.holds_node(id, box.id)) ++count, chosen += board.editor.picks.nodes.contains(box.id) ? 1 : 0;
    if (board.model.shows_frame(id) && (board.picked_frames.contains(id) || (count > 0 && chosen == count))) whole.insert(id);
  }
  std::set<std::string> outermost = whole;
  std::erase_if(outermost, [&](const std::string& id) {
    return std::any_of(whole.begin(), whole.end(), [&](const std::string& other) {
      // Of frames in a ring the first one counts.
      return other != id && view.is_within(id, other) && (!view.is_within(other, id) || other < id);
    });
  });
  return outermost;
}

}  // namespace

void drop_emptied_frames(const Board& board, Json& patch) {
  const auto changed = patch.find("frames");
  if (changed == patch.end() || !changed->is_object()) return;
  const auto& frames = board.model.view.frames;
  // What the patch says of a frame; null where it removes it, nothing where it is silent.
  const auto said = [&](const std::string& id) -> const Json* {
    const auto found = changed->find(id);
    return found == changed->end() ? nullptr : &*found;
  };
  const auto keeps_any = [&](const std::string& id, const char* list, const std::set<std::string>& old, const auto& exists) {
    const Json* change = said(id);
    const auto members = change != nullptr && change->contains(list) ? change->at(list) : Json::object();
    return std::any_of(old.begin(), old.end(), [&](const auto& m) { return !members.contains(m) && exists(m); }) ||
           std::any_of(members.begin(), members.end(), [](const Json& is_in) { return !is_in.is_null(); });
  };
  const auto is_node = [&](const std::string& id) { return board.editor.scene().nodes.contains(id); };
  const auto is_comment = [&](const std::string& id) { return board.model.view.comments.contains(id); };
  const auto outer_of = [&](const std::string& id, const std::string& old) {
    const Json* change = said(id);
    if (change == nullptr || !change->contains("in")) return old;
    return change->at("in").is_string() ? change->at("in").get<std::string>() : std::string();
  };
  const auto is_empty = [&](const std::string& id, const Frame& frame) {
    if (keeps_any(id, "nodes", frame.nodes, is_node) || keeps_any(id, "comments", frame.comments, is_comment)) return false;
    for (const auto& [other, inner] : frames)
      if (other != id && (said(other) == nullptr || !said(other)->is_null()) && outer_of(other, inner.in) == id) return false;
    // A frame that the same patch makes.
    for (const auto& [other, change] : changed->items())
      if (!frames.contains(other) && change.is_object() && outer_of(other, "") == id) return false;
    return true;
  };
  // One that goes may have been all that was left in the one around it.
  for (bool is_done = false; !is_done;) {
    is_done = true;
    for (const auto& [id, frame] : frames) {
      const bool is_touched = said(id) != nullptr || std::any_of(frames.begin(), frames.end(), [&](const auto& inner) {
                                return inner.second.in == id && said(inner.first) != nullptr;
                              });
      if (!is_touched || (said(id) != nullptr && said(id)->is_null()) || !is_empty(id, frame)) continue;
      (*changed)[id] = nullptr;
      is_done = false;
    }
  }
}

void frame_chosen(Board& board) {
  const auto& nodes = board.editor.picks.nodes;
  if (nodes.empty() && board.picked_comments.empty() && board.picked_frames.empty())
    return board.editor.notify(NoticeKind::told, "Choose nodes, and Ctrl+G puts a frame around them.");
  const ViewData& view = board.model.view;
  const std::string id = fresh_key("frame", [&](const std::string& key) { return view.frames.contains(key); });
  Json patch = Json::object();
  Json& frame = patch["frames"][id];
  frame["name"] = "Frame";
  frame["colour"] = view.frames.size() % 9;
  // A frame around things that all lie in one frame lies in it as well; whole frames move in as they are.
  const std::set<std::string> whole = whole_frames(board);
  const auto moves_along = [&](const std::string& own) {
    return std::any_of(whole.begin(), whole.end(), [&](const std::string& outer) { return view.is_within(own, outer); });
  };
  std::set<std::string> around;
  const auto take = [&](const char* list, const std::string& thing, const std::string& own) {
    if (!own.empty() && moves_along(own)) return;
    around.insert(own);
    if (!own.empty()) patch["frames"][own][list][thing] = nullptr;
    patch["frames"][id][list][thing] = true;
  };
  for (const std::string& node : nodes) take("nodes", node, view.frame_of_node(node));
  for (const std::string& comment : board.picked_comments) take("comments", comment, view.frame_of_comment(comment));
  for (const std::string& inner : whole) around.insert(view.frames.at(inner).in), patch["frames"][inner]["in"] = id;
  if (around.empty()) return;
  const std::string in = around.size() == 1 && view.frames.contains(*around.begin()) ? *around.begin() : board.model.entered;
  if (!in.empty()) patch["frames"][id]["in"] = in;
  drop_emptied_frames(board, patch);
  if (!board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture())) return;
  update_now(board);
  board.picked_frames = {id};
  begin_edit(board, Thing::frame, id);
}

void add_comment(Board& board, ImVec2 at) {
  const ViewData& view = board.model.view;
  const std::string id = fresh_key("comment", [&](const std::string& key) { return view.comments.contains(key); });
  Json patch = Json::object();
  Json& comment = patch["comments"][id];
  comment["at"] = place_json(at);
  comment["size"] = place_json({220, 70});
  comment["text"] = "";
  join_entered(board, patch, "comments", id);
  if (!board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture())) return;
  update_now(board);
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
  Workbench& editor = board.editor;
  const ViewData& view = board.model.view;
  Json patch = Json::object();
  if (edit.thing == Thing::node && edit.text != editor.name_of(edit.id)) {
    editor.submit(command<RenameNode>({edit.id, edit.text}), editor.new_gesture());
  } else if (edit.thing == Thing::comment && view.comments.contains(edit.id) && view.comments.at(edit.id).text != edit.text) {
    patch["comments"][edit.id]["text"] = edit.text;
  } else if (edit.thing == Thing::frame && view.frames.contains(edit.id) && view.frames.at(edit.id).name != edit.text) {
    patch["frames"][edit.id]["name"] = edit.text;
  }
  if (!patch.empty()) editor.arrange(JsonValue::of(patch), editor.new_gesture());
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
  return Box{box.at, {std::max(box.size.x, 160.0f), kFrameHead}};
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

void fit_all(Board& board, bool is_soft) {
  const Model& model = board.model;
  std::vector<Box> bodies;
  for (std::size_t k = 0; k < model.anchors(); ++k) bodies.push_back(model.anchor(k));
  for (const auto& [id, comment] : model.view.comments)
    if (model.shows_comment(id)) bodies.push_back(comment.box);
  board.camera.fit(model.bounds(), is_soft, bodies);
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
