// Copies as JSON text: written from the scene's records, read back as strictly as a file.
#include "ui/desktop/panels/canvas/clipboard.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/file/scene_file.h"
#include "ui/cli/report/figures.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"

namespace bl::desktop::canvas {

namespace {

constexpr const char* kMark = "behaviourlinks";
// A copy stands beside its original in space too: volumes in one place would take each other's room.
constexpr double kAside = 6, kLeastApart = 1;

bool is_inner(const Selection& end, const std::set<std::string>& nodes) {
  return !end.is_query() && !end.ids.empty() &&
         std::all_of(end.ids.begin(), end.ids.end(), [&](const std::string& id) { return nodes.contains(id); });
}

Json corner_json(ImVec2 at) { return place_json(at); }

// One node or link of a clip, without its id: what the readers of files expect.
Json without(Json json, std::initializer_list<const char*> keys) {
  for (const char* key : keys) json.erase(key);
  return json;
}

struct Pasting {
  Board& board;
  FreshIds ids;
  std::map<std::string, std::string> new_ids;
  std::set<std::string> nodes;
  std::vector<Command> commands;
  Json patch = Json::object();
  ImVec2 shift;
  std::size_t lost = 0;  // references to nodes that are not here
};

std::optional<ImVec2> corner_of(const Json& item, const char* key) {
  const auto found = item.find(key);
  if (found == item.end() || !found->is_array() || found->size() != 2 || !(*found)[0].is_number() || !(*found)[1].is_number())
    return std::nullopt;
  const ImVec2 at{(*found)[0].get<float>(), (*found)[1].get<float>()};
  if (!std::isfinite(at.x) || !std::isfinite(at.y)) return std::nullopt;
  return ImVec2{std::clamp(at.x, -1e5f, 1e5f), std::clamp(at.y, -1e5f, 1e5f)};
}

std::string text_in(const Json& item, const char* key) {
  const auto found = item.find(key);
  return found != item.end() && found->is_string() ? found->get<std::string>() : std::string();
}

// Names of copied nodes become those of their copies; names of nodes that are not in this scene go.
void rename(Pasting& pasting, Selection& selection) {
  std::vector<std::string> ids;
  for (const std::string& id : selection.ids) {
    if (const auto copy = pasting.new_ids.find(id); copy != pasting.new_ids.end()) ids.push_back(copy->second);
    else if (pasting.board.editor.scene().nodes.contains(id)) ids.push_back(id);
    else ++pasting.lost;
  }
  selection.ids = ids;
}

void move_aside(const Pasting& pasting, NodeRecord& node) {
  const auto base = node.types.find(std::string(kBaseNode));
  if (base == node.types.end() || !node.types.contains("smart_volume")) return;
  const auto found = base->second.find("position");
  Vector3 place;
  if (found != base->second.end())
    if (const auto* set = std::get_if<Vector3>(&found->second)) place = *set;
  const auto is_taken = [&](const Vector3& at) {
    for (const auto& [id, other] : pasting.board.editor.scene().nodes) {
      const auto values = other.types.find(std::string(kBaseNode));
      if (values == other.types.end() || !other.types.contains("smart_volume")) continue;
      const auto position = values->second.find("position");
      const auto* set = position == values->second.end() ? nullptr : std::get_if<Vector3>(&position->second);
      if (norm(at - (set != nullptr ? *set : Vector3{})) < kLeastApart) return true;
    }
    return false;
  };
  for (int tries = 0; tries < 100 && is_taken(place); ++tries) place.x += kAside;
  base->second["position"] = place;
}

Result<void> paste_nodes(Pasting& pasting, const Json& list) {
  for (const Json& item : list) {
    const std::string id = text_in(item, "id");
    if (id.empty()) return Error{ErrorCode::missing, "nodes", "a node has no id"};
    pasting.new_ids[id] = pasting.ids.of(id);
  }
  const Registry& registry = pasting.board.editor.types();
  for (const Json& item : list) {
    const std::string id = text_in(item, "id");
    auto node = node_from_json(without(item, {"id", "box"}), registry, "nodes/" + id);
    if (!node) return node.error();
    for (auto& [type, values] : node->types)
      for (auto& [port, value] : values)
        if (auto* selection = std::get_if<Shared<Selection>>(&value)) {
          Selection renamed = **selection;
          rename(pasting, renamed);
          value = Shared<Selection>(std::move(renamed));
        }
    move_aside(pasting, *node);
    const std::string& copy = pasting.new_ids[id];
    pasting.commands.push_back(command<AddNode>({copy, {write_json_line(node_to_json(*node, registry))}}));
    pasting.nodes.insert(copy);
    join_entered(pasting.board, pasting.patch, "nodes", copy);
    if (const auto at = corner_of(item, "box")) pasting.patch["boxes"][copy] = corner_json(*at + pasting.shift);
  }
  return {};
}

Result<void> paste_links(Pasting& pasting, const Json& list) {
  const Registry& registry = pasting.board.editor.types();
  for (const Json& item : list) {
    const std::string id = text_in(item, "id");
    if (id.empty()) return Error{ErrorCode::missing, "links", "a link has no id"};
    auto link = link_from_json(without(item, {"id", "dots"}), registry, "links/" + id);
    if (!link) return link.error();
    if (!link->ghost.empty()) continue;  // what an unknown kind refers to cannot be renamed
    rename(pasting, link->from);
    rename(pasting, link->to);
    if (link->from.is_empty() || link->to.is_empty()) continue;
    const std::string copy = pasting.ids.of(id);
    pasting.commands.push_back(command<AddLink>({copy, {write_json_line(link_to_json(*link, registry))}}));
    if (const auto dots = item.find("dots"); dots != item.end() && dots->is_array())
      for (const Json& dot : *dots)
        if (const auto at = corner_of(Json::object({{"at", dot}}), "at")) {
          Json& list_of = pasting.patch["dots"][copy];
          if (list_of.is_null()) list_of = Json::array();
          list_of.push_back(corner_json(*at + pasting.shift));
        }
  }
  return {};
}

void paste_comments(Pasting& pasting, const Json& list, std::set<std::string>& pasted) {
  for (const Json& item : list) {
    const auto at = corner_of(item, "at");
    const auto size = corner_of(item, "size");
    if (!at) continue;
    std::string id = "comment";
    const auto& known = pasting.board.model.view.comments;
    for (int k = 2; known.contains(id) || pasted.contains(id); ++k) id = "comment-" + std::to_string(k);
    pasted.insert(id);
    Json& comment = pasting.patch["comments"][id];
    comment["at"] = corner_json(*at + pasting.shift);
    comment["size"] = corner_json(size.value_or(ImVec2(220, 70)));
    comment["text"] = text_in(item, "text");
    join_entered(pasting.board, pasting.patch, "comments", id);
  }
}

// The list under a key; an empty one where there is none of objects.
Json list_in(const Json& clip, const char* key) {
  const auto found = clip.find(key);
  if (found == clip.end() || !found->is_array()) return Json::array();
  for (const Json& item : *found)
    if (!item.is_object()) return Json::array();
  return *found;
}

std::optional<Box> box_of_clip(const Json& clip) {
  std::optional<Box> all;
  const auto take = [&](const Json& list, const char* key) {
    for (const Json& item : list)
      if (const auto at = corner_of(item, key)) {
        const Box box{*at, {kBoxWidth, 100}};
        all = all ? all->with(box) : box;
      }
  };
  take(list_in(clip, "nodes"), "box");
  take(list_in(clip, "comments"), "at");
  return all;
}

}  // namespace

std::string clip_of_choice(const Board& board) {
  const Editor& editor = board.editor;
  const auto& nodes = editor.picks.nodes;
  if (nodes.empty() && board.picked_comments.empty()) return "";
  Json clip = Json::object();
  clip[kMark] = "clip";
  clip["nodes"] = Json::array();
  clip["links"] = Json::array();
  for (const std::string& id : nodes) {
    const auto found = editor.scene().nodes.find(id);
    if (found == editor.scene().nodes.end()) continue;
    Json item = Json::object();
    item["id"] = id;
    item.update(node_to_json(found->second, editor.types()));
    if (const std::size_t k = board.model.find_box(id); k < board.model.boxes.size())
      item["box"] = corner_json(board.model.boxes[k].box.at);
    clip["nodes"].push_back(std::move(item));
  }
  for (const auto& [id, link] : editor.scene().links) {
    if (!link.ghost.empty() || !is_inner(link.from, nodes) || !is_inner(link.to, nodes)) continue;
    Json item = Json::object();
    item["id"] = id;
    item.update(link_to_json(link, editor.types()));
    if (const auto dots = board.model.view.dots.find(id); dots != board.model.view.dots.end())
      for (const ImVec2& p : dots->second) item["dots"].push_back(corner_json(p));
    clip["links"].push_back(std::move(item));
  }
  for (const std::string& id : board.picked_comments)
    if (const auto found = board.model.view.comments.find(id); found != board.model.view.comments.end()) {
      const Comment& comment = found->second;
      clip["comments"].push_back(
          {{"at", corner_json(comment.box.at)}, {"size", corner_json(comment.box.size)}, {"text", comment.text}});
    }
  return write_json(clip, 2);
}

bool paste_clip(Board& board, const std::string& text, ImVec2 place, bool is_shift) {
  Editor& editor = board.editor;
  const auto clip = parse_json(text);
  if (!clip || !clip->is_object() || text_in(*clip, kMark) != "clip") {
    editor.tell(NoticeKind::told, "The clipboard holds nothing that was copied from a canvas.");
    return false;
  }
  const auto box = box_of_clip(*clip);
  Pasting pasting{board, FreshIds(editor), {}, {}, {}, Json::object(), {0, 0}};
  pasting.shift = is_shift ? place : box ? place - box->centre() : ImVec2(0, 0);
  pasting.shift = {std::round(pasting.shift.x / kGrid) * kGrid, std::round(pasting.shift.y / kGrid) * kGrid};
  std::set<std::string> comments;
  auto done = paste_nodes(pasting, list_in(*clip, "nodes"));
  if (done) done = paste_links(pasting, list_in(*clip, "links"));
  if (!done) {
    editor.tell(NoticeKind::error, "This copy cannot be pasted: " + done.error().text());
    return false;
  }
  paste_comments(pasting, list_in(*clip, "comments"), comments);
  add_view_patch(pasting.commands, pasting.patch);
  const std::string what =
      pasting.nodes.empty() ? report::counted(comments.size(), "comment") : report::counted(pasting.nodes.size(), "node");
  if (pasting.commands.empty() || !submit_as(board, pasting.commands, (is_shift ? "Duplicate " : "Paste ") + what)) return false;
  editor.picks.links.clear();
  editor.picks.nodes = pasting.nodes;
  board.model.update(editor);
  board.picked_comments = comments;
  if (pasting.lost > 0)
    editor.tell(NoticeKind::warning,
                "Pasted without " + report::counted(pasting.lost, "reference") + " to nodes that are not in this scene.");
  return true;
}

void copy_chosen(Board& board) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.tell(NoticeKind::told, "Choose nodes to copy them.");
  ImGui::SetClipboardText(clip.c_str());
  if (!board.editor.picks.nodes.empty())
    board.editor.tell(NoticeKind::told,
                      report::counted(board.editor.picks.nodes.size(), "node") + " copied, with the links among them.");
}

void cut_chosen(Board& board) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.tell(NoticeKind::told, "Choose nodes to cut them.");
  ImGui::SetClipboardText(clip.c_str());
  remove_chosen(board, false);
}

void paste(Board& board) {
  const char* text = ImGui::GetClipboardText();
  paste_clip(board, text == nullptr ? "" : text, board.cursor(), false);
}

void duplicate_chosen(Board& board, ImVec2 shift) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.tell(NoticeKind::told, "Choose nodes to duplicate them.");
  paste_clip(board, clip, shift, true);
}

}  // namespace bl::desktop::canvas
