// Copies as JSON text: written from the scene's records, read back as strictly as a file.
#include "ui/desktop/panels/canvas/clipboard.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/file/scene_file.h"
#include "core/reading/figures.h"
#include "core/reading/views/node.h"
#include "core/reading/views/volume.h"
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

// Where a volume has been put; nothing for what takes no room.
Vector3* volume_place(NodeRecord& node) {
  const auto base = node.types.find(std::string(kBaseNode));
  if (base == node.types.end() || !reading::is_a<reading::VolumeFigures>(node)) return nullptr;
  return std::get_if<Vector3>(
      &base->second.try_emplace(reading::port_name_of<&reading::NodePlace::position>(), Vector3{}).first->second);
}

// All copies by the same way, so that they lie to each other as their originals do: the least at which none meets a volume.
void move_aside(const Board& board, std::map<std::string, NodeRecord>& copies) {
  std::vector<Vector3*> places;
  for (auto& [id, node] : copies)
    if (Vector3* place = volume_place(node)) places.push_back(place);
  std::vector<Vector3> taken;
  for (const auto& [id, node] : board.editor.scene().nodes)
    if (const auto position =
            reading::setting<&reading::VolumeFigures::position>(board.editor.scene(), board.editor.types(), node))
      taken.push_back(*position);
  double aside = 0;
  const auto is_taken = [&](const Vector3* place) {
    const Vector3 at{place->x + aside, place->y, place->z};
    return std::any_of(taken.begin(), taken.end(), [&](const Vector3& other) { return norm(at - other) < kLeastApart; });
  };
  for (int tries = 0; tries < 100 && std::any_of(places.begin(), places.end(), is_taken); ++tries) aside += kAside;
  for (Vector3* place : places) place->x += aside;
}

// Gives names to what the copies name. What names another copy is said once all copies are there: it is taken out here.
std::vector<Command> settle_references(Pasting& pasting, const std::string& id, NodeRecord& node) {
  std::vector<Command> later;
  for (auto& [type, values] : node.types) {
    const TypificationDefinition* definition = pasting.board.editor.types().typification(type);
    for (auto value = values.begin(); value != values.end();) {
      auto* selection = std::get_if<Shared<Selection>>(&value->second);
      const PortDefinition* port = definition == nullptr ? nullptr : definition->find_port(value->first);
      if (selection == nullptr || port == nullptr) {
        ++value;
        continue;
      }
      Selection renamed = **selection;
      const bool names_copies = std::any_of(renamed.ids.begin(), renamed.ids.end(),
                                            [&](const std::string& other) { return pasting.new_ids.contains(other); });
      rename(pasting, renamed);
      value->second = Shared<Selection>(std::move(renamed));
      if (names_copies)
        later.push_back(command<SetPort>(
            {pasting.new_ids.at(id), {type + "." + port->id}, JsonValue::of(value_to_json(value->second, *port))}));
      value = names_copies ? values.erase(value) : std::next(value);
    }
  }
  return later;
}

Result<void> paste_nodes(Pasting& pasting, const Json& list) {
  for (const Json& item : list) {
    const std::string id = text_in(item, "id");
    if (id.empty()) return Error{ErrorCode::missing, "nodes", "a node has no id"};
    if (pasting.new_ids.contains(id)) return Error{ErrorCode::conflict, "nodes/" + id, "two nodes have this id"};
    pasting.new_ids[id] = pasting.ids.of(id);
  }
  const Registry& registry = pasting.board.editor.types();
  std::map<std::string, NodeRecord> nodes;
  for (const Json& item : list) {
    const std::string id = text_in(item, "id");
    auto node = node_from_json(without(item, {"id", "box"}), registry, "nodes/" + id);
    if (!node) return node.error();
    nodes[id] = std::move(*node);
    const std::string& copy = pasting.new_ids[id];
    pasting.nodes.insert(copy);
    join_entered(pasting.board, pasting.patch, "nodes", copy);
    if (const auto at = point_in(item, "box")) pasting.patch["boxes"][copy] = place_json(*at + pasting.shift);
  }
  move_aside(pasting.board, nodes);
  std::vector<Command> later;
  for (auto& [id, node] : nodes) {
    const std::vector<Command> references = settle_references(pasting, id, node);
    later.insert(later.end(), references.begin(), references.end());
    pasting.commands.push_back(command<AddNode>({pasting.new_ids[id], JsonValue::of(node_to_json(node, registry))}));
  }
  pasting.commands.insert(pasting.commands.end(), later.begin(), later.end());
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
    pasting.commands.push_back(command<AddLink>({copy, JsonValue::of(link_to_json(*link, registry))}));
    if (const auto dots = item.find("dots"); dots != item.end() && dots->is_array())
      for (const Json& dot : *dots)
        if (const auto at = point_in(Json::object({{"at", dot}}), "at")) {
          Json& list_of = pasting.patch["dots"][copy];
          if (list_of.is_null()) list_of = Json::array();
          list_of.push_back(place_json(*at + pasting.shift));
        }
  }
  return {};
}

void paste_comments(Pasting& pasting, const Json& list, std::set<std::string>& pasted) {
  for (const Json& item : list) {
    const auto at = point_in(item, "at");
    const auto size = point_in(item, "size");
    if (!at) continue;
    const auto& known = pasting.board.model.view.comments;
    const std::string id =
        fresh_key("comment", [&](const std::string& key) { return known.contains(key) || pasted.contains(key); });
    pasted.insert(id);
    Json& comment = pasting.patch["comments"][id];
    comment["at"] = place_json(*at + pasting.shift);
    comment["size"] = place_json(size.value_or(ImVec2(220, 70)));
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
      if (const auto at = point_in(item, key)) {
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
  const Workbench& editor = board.editor;
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
      item["box"] = place_json(board.model.boxes[k].box.at);
    clip["nodes"].push_back(std::move(item));
  }
  for (const auto& [id, link] : editor.scene().links) {
    if (!link.ghost.empty() || !is_inner(link.from, nodes) || !is_inner(link.to, nodes)) continue;
    Json item = Json::object();
    item["id"] = id;
    item.update(link_to_json(link, editor.types()));
    if (const auto dots = board.model.view.dots.find(id); dots != board.model.view.dots.end())
      for (const ImVec2& p : dots->second) item["dots"].push_back(place_json(p));
    clip["links"].push_back(std::move(item));
  }
  for (const std::string& id : board.picked_comments)
    if (const auto found = board.model.view.comments.find(id); found != board.model.view.comments.end()) {
      const Comment& comment = found->second;
      clip["comments"].push_back(
          {{"at", place_json(comment.box.at)}, {"size", place_json(comment.box.size)}, {"text", comment.text}});
    }
  return write_json(clip, 2);
}

bool paste_clip(Board& board, const std::string& text, ImVec2 place, bool is_shift) {
  Workbench& editor = board.editor;
  const auto clip = parse_json(text);
  if (!clip || !clip->is_object() || text_in(*clip, kMark) != "clip") {
    editor.notify(NoticeKind::told, "The clipboard holds nothing that was copied from a canvas.");
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
    editor.notify(NoticeKind::error, "This copy cannot be pasted: " + done.error().text());
    return false;
  }
  paste_comments(pasting, list_in(*clip, "comments"), comments);
  add_view_patch(pasting.commands, pasting.patch);
  const std::string what =
      pasting.nodes.empty() ? reading::counted(comments.size(), "comment") : reading::counted(pasting.nodes.size(), "node");
  if (pasting.commands.empty() || !submit_as(board, pasting.commands, (is_shift ? "Duplicate " : "Paste ") + what)) return false;
  editor.picks.links.clear();
  editor.picks.nodes = pasting.nodes;
  update_now(board);
  board.picked_comments = comments;
  if (pasting.lost > 0)
    editor.notify(NoticeKind::warning,
                  "Pasted without " + reading::counted(pasting.lost, "reference") + " to nodes that are not in this scene.");
  return true;
}

void copy_chosen(Board& board) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.notify(NoticeKind::told, "Choose nodes to copy them.");
  ImGui::SetClipboardText(clip.c_str());
  if (!board.editor.picks.nodes.empty())
    board.editor.notify(NoticeKind::told,
                        reading::counted(board.editor.picks.nodes.size(), "node") + " copied, with the links among them.");
}

void cut_chosen(Board& board) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.notify(NoticeKind::told, "Choose nodes to cut them.");
  ImGui::SetClipboardText(clip.c_str());
  remove_chosen(board, false);
}

void paste(Board& board) {
  const char* text = ImGui::GetClipboardText();
  paste_clip(board, text == nullptr ? "" : text, board.cursor(), false);
}

void duplicate_chosen(Board& board, ImVec2 shift) {
  const std::string clip = clip_of_choice(board);
  if (clip.empty()) return board.editor.notify(NoticeKind::told, "Choose nodes to duplicate them.");
  paste_clip(board, clip, shift, true);
}

}  // namespace bl::desktop::canvas
