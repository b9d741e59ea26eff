// Removes, mutes and moves nodes, links and dots.
#include "ui/desktop/panels/canvas/edits.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/file/scene_file.h"
#include "core/reading/figures.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/fits.h"

namespace bl::desktop::canvas {

namespace {

constexpr std::size_t kMostReconnections = 32;

// A named set is known by its nodes: without one of them it has another key, and its place goes along; of less than two nodes
// there is no set.
void rename_sets(const Board& board, const std::set<std::string>& nodes, const std::set<std::string>& links, Json& patch) {
  const auto& places = board.model.view.sets;
  std::set<std::string> going, staying;
  for (const auto& [id, link] : board.editor.scene().links)
    for (const Selection* end : {&link.from, &link.to}) {
      const std::string key = key_of(*end);
      const auto place = places.find(key);
      if (place == places.end()) continue;
      going.insert(key);
      if (links.contains(id)) continue;
      Selection left = *end;
      std::erase_if(left.ids, [&](const std::string& node) { return nodes.contains(node); });
      if (!left.is_query() && left.ids.size() < 2) continue;
      const std::string fresh = key_of(left);
      staying.insert(fresh);
      if (fresh != key && !places.contains(fresh)) patch["sets"][fresh] = place_json(place->second);
    }
  for (const std::string& key : going)
    if (!staying.contains(key)) patch["sets"][key] = nullptr;
}

// The view's entries of nodes and links that go.
Json forgetting(const Board& board, const std::set<std::string>& nodes, const std::set<std::string>& links) {
  const ViewData& view = board.model.view;
  Json patch = Json::object();
  rename_sets(board, nodes, links, patch);
  for (const std::string& id : nodes) {
    if (view.boxes.contains(id)) patch["boxes"][id] = nullptr;
    if (view.collapsed.contains(id)) patch["collapsed"][id] = nullptr;
    if (view.hidden.contains(id)) patch["hidden"][id] = nullptr;
    if (const std::string frame = view.frame_of_node(id); !frame.empty()) patch["frames"][frame]["nodes"][id] = nullptr;
  }
  for (const std::string& id : links)
    if (view.dots.contains(id)) patch["dots"][id] = nullptr;
  return patch;
}

const std::string* only_id(const Selection& selection) {
  return !selection.is_query() && selection.ids.size() == 1 ? &selection.ids.front() : nullptr;
}

// For each kind: whom the node's links come from, and whom they lead to; one of the links lends its parameters.
struct Meeting {
  std::vector<std::string> before, after;
  const LinkRecord* example = nullptr;
};

void reconnect(const Board& board, const std::string& node, const std::set<std::string>& going, FreshIds& ids,
               std::vector<Command>& commands) {
  const Scene& scene = board.editor.scene();
  std::map<std::string, Meeting> meetings;
  for (const auto& [id, link] : scene.links) {
    const std::string *from = only_id(link.from), *to = only_id(link.to);
    if (from == nullptr || to == nullptr || *from == *to || !link.ghost.empty() || (*from != node && *to != node)) continue;
    const std::string& other = *from == node ? *to : *from;
    if (going.contains(other)) continue;
    Meeting& meeting = meetings[link.kind];
    if (meeting.example == nullptr) meeting.example = &link;
    (*from == node ? meeting.after : meeting.before).push_back(other);
  }
  for (auto& [kind, meeting] : meetings) {
    std::vector<std::pair<std::string, std::string>> pairs;
    // Kinds that change both of their ends have no direction: the neighbours are joined one after the other.
    const Line* line = nullptr;
    for (const Line& known : board.model.lines)
      if (known.kind == kind) line = &known;
    if (line != nullptr && line->changes_from) {
      meeting.before.insert(meeting.before.end(), meeting.after.begin(), meeting.after.end());
      for (std::size_t k = 1; k < meeting.before.size(); ++k) pairs.emplace_back(meeting.before[k - 1], meeting.before[k]);
    } else {
      for (const std::string& a : meeting.before)
        for (const std::string& b : meeting.after) pairs.emplace_back(a, b);
    }
    for (std::size_t k = 0; k < pairs.size() && k < kMostReconnections; ++k) {
      LinkRecord link = *meeting.example;
      link.from.ids = {pairs[k].first};
      link.to.ids = {pairs[k].second};
      if (pairs[k].first == pairs[k].second) continue;
      commands.push_back(command<AddLink>(
          {ids.of(pairs[k].first + "_" + pairs[k].second), JsonValue::of(link_to_json(link, board.editor.types()))}));
    }
  }
}

}  // namespace

std::string FreshIds::of(const std::string& wish) {
  const Scene& scene = editor_->scene();
  return *given_
              .insert(fresh_key(to_identifier(wish).substr(0, 56),
                                [&](const std::string& id) {
                                  return given_.contains(id) || scene.nodes.contains(id) || scene.links.contains(id);
                                }))
              .first;
}

void update_now(Board& board) {
  board.model.update(board.editor);
  board.hovered = {};
}

void add_view_patch(std::vector<Command>& commands, const Json& patch) {
  if (!patch.empty()) commands.push_back(command<SetView>({JsonValue::of(patch), false}));
}

std::set<std::string> links_of_choice(const Board& board) {
  std::set<std::string> links = board.editor.picks.links;
  const auto& boxes = board.model.boxes;
  for (const Line& line : board.model.lines)
    for (const std::size_t end : {line.from, line.to})
      if (end < boxes.size() && board.editor.picks.nodes.contains(boxes[end].id)) links.insert(line.id);
  // Another panel may have removed some since the canvas was drawn last.
  std::erase_if(links, [&](const std::string& id) { return !board.editor.scene().links.contains(id); });
  return links;
}

bool submit_as(Board& board, const std::vector<Command>& commands, const std::string& label) {
  return board.editor.submit(commands, board.editor.new_gesture(), label);
}

namespace {

// All that reaches what is chosen: also links of the whole scene that end at a set with a chosen node in it.
std::set<std::string> links_heard(const Board& board) {
  std::set<std::string> links = links_of_choice(board);
  const Workbench& editor = board.editor;
  const auto& nodes = editor.picks.nodes;
  const auto reaches = [&](const Selection& end) {
    const std::vector<std::string> members = resolve(editor.scene(), editor.types(), end);
    return std::any_of(members.begin(), members.end(), [&](const std::string& id) { return nodes.contains(id); });
  };
  for (const auto& [id, link] : editor.scene().links)
    if (!nodes.empty() && (reaches(link.from) || reaches(link.to))) links.insert(id);
  return links;
}

// Who is heard alone, for the history.
std::string soloists(const Board& board) {
  const Picks& picks = board.editor.picks;
  if (picks.nodes.size() == 1) return "\xc2\xb7 " + board.editor.name_of(*picks.nodes.begin());
  if (!picks.nodes.empty()) return reading::counted(picks.nodes.size(), "node");
  return picks.links.size() == 1 ? "\xc2\xb7 " + *picks.links.begin() : reading::counted(picks.links.size(), "link");
}

// Takes a frame away; what is in it, and stays, comes to lie in the nearest frame around it that stays too.
void dissolve(const Board& board, const std::string& id, const std::set<std::string>& going, Json& patch) {
  const auto& frames = board.model.view.frames;
  const auto frame = frames.find(id);
  if (frame == frames.end()) return;
  std::string outer = frame->second.in;
  // Frames in a ring have nothing around them.
  for (std::size_t steps = 0; board.picked_frames.contains(outer) && frames.contains(outer); ++steps)
    outer = steps < frames.size() ? frames.at(outer).in : std::string();
  if (!frames.contains(outer)) outer.clear();
  for (const auto& [other, inner] : frames)
    if (inner.in == id && !board.picked_frames.contains(other))
      patch["frames"][other]["in"] = outer.empty() ? Json() : Json(outer);
  patch["frames"][id] = nullptr;
  if (outer.empty()) return;
  for (const std::string& node : frame->second.nodes)
    if (!going.contains(node)) patch["frames"][outer]["nodes"][node] = true;
  for (const std::string& comment : frame->second.comments)
    if (!board.picked_comments.contains(comment)) patch["frames"][outer]["comments"][comment] = true;
}

}  // namespace

void remove_chosen(Board& board, bool reconnects) {
  Workbench& editor = board.editor;
  const std::set<std::string> nodes = editor.picks.nodes;
  std::set<std::string> links = editor.picks.links;
  std::vector<Command> commands;
  FreshIds ids(editor);
  if (reconnects)
    for (const std::string& id : nodes) reconnect(board, id, nodes, ids, commands);
  for (const std::string& id : links) commands.push_back(command<RemoveLink>({id}));
  for (const std::string& id : nodes) commands.push_back(command<RemoveNode>({id}));
  // Links that go with their last node.
  for (const auto& [id, link] : editor.scene().links) {
    const auto goes = [&](const Selection& end) {
      return !end.is_query() && !end.ids.empty() &&
             std::all_of(end.ids.begin(), end.ids.end(), [&](const auto& n) { return nodes.contains(n); });
    };
    if (goes(link.from) || goes(link.to)) links.insert(id);
  }
  Json patch = forgetting(board, nodes, links);
  for (const std::string& id : board.picked_comments) {
    patch["comments"][id] = nullptr;
    if (const std::string frame = board.model.view.frame_of_comment(id); !frame.empty())
      patch["frames"][frame]["comments"][id] = nullptr;
  }
  for (const std::string& id : board.picked_frames) dissolve(board, id, nodes, patch);
  drop_emptied_frames(board, patch);
  add_view_patch(commands, patch);
  if (commands.empty()) return editor.notify(NoticeKind::told, "Nothing is selected that could be removed.");
  editor.submit(commands, editor.new_gesture());
}

void remove_links(Board& board, const std::set<std::string>& links) {
  std::vector<Command> commands;
  for (const std::string& id : links) commands.push_back(command<RemoveLink>({id}));
  add_view_patch(commands, forgetting(board, {}, links));
  if (board.editor.submit(commands, board.editor.new_gesture()))
    board.editor.notify(NoticeKind::told, reading::counted(links.size(), "link") + " removed.");
}

void mute_chosen(Board& board) {
  std::set<std::string> links = links_of_choice(board);
  const auto& all = board.editor.scene().links;
  // Those of unknown kinds are kept as they are; they do not run anyway.
  std::erase_if(links, [&](const std::string& id) { return !all.at(id).ghost.empty(); });
  if (links.empty()) return board.editor.notify(NoticeKind::told, "Choose links, or nodes with links, to mute them.");
  const bool mutes = std::any_of(links.begin(), links.end(), [&](const std::string& id) { return !all.at(id).is_muted; });
  std::vector<Command> commands;
  for (const std::string& id : links)
    if (all.at(id).is_muted != mutes) commands.push_back(command<MuteLink>({id, mutes}));
  board.editor.submit(commands, board.editor.new_gesture());
}

void solo_chosen(Board& board) {
  Workbench& editor = board.editor;
  std::vector<Command> commands;
  const auto& all = editor.scene().links;
  if (!board.soloed.empty()) {
    for (const std::string& id : board.soloed)
      if (all.contains(id) && all.at(id).is_muted) commands.push_back(command<MuteLink>({id, false}));
    board.soloed.clear();
    if (submit_as(board, commands, "Unmute " + reading::counted(commands.size(), "link")))
      editor.notify(NoticeKind::told, "All links count again.");
    return;
  }
  const std::set<std::string> heard = links_heard(board);
  if (heard.empty()) return editor.notify(NoticeKind::told, "Choose links, or nodes with links, to mute all others.");
  std::set<std::string> others;
  for (const auto& [id, link] : all)
    if (!heard.contains(id) && !link.is_muted && link.ghost.empty())
      commands.push_back(command<MuteLink>({id, true})), others.insert(id);
  if (commands.empty()) return editor.notify(NoticeKind::told, "All other links are muted already.");
  if (!submit_as(board, commands, "Solo " + soloists(board))) return;
  board.soloed = others;
  editor.notify(NoticeKind::told, reading::counted(others.size(), "other link") + " muted; Q brings them back.");
}

void move_links(Board& board, std::size_t from, std::size_t to) {
  Workbench& editor = board.editor;
  const Selection target = board.model.selection_of(to);
  std::vector<Command> commands;
  std::string refused;
  std::size_t count = 0;
  for (const Line& line : board.model.lines) {
    if ((line.from != from && line.to != from) || line.definition == nullptr) continue;
    Selection a = board.model.selection_of(line.from), b = board.model.selection_of(line.to);
    if (line.from == from) a = target;
    if (line.to == from) b = target;
    if (const auto why = misfit(editor.types(), editor.scene(), *line.definition, a, b)) refused = line.label + " stays: " + *why;
    else commands.push_back(command<SetLinkEnds>({line.id, a, b})), ++count;
  }
  if (!commands.empty()) editor.submit(commands, editor.new_gesture());
  if (!refused.empty()) return editor.notify(NoticeKind::warning, refused);
  editor.notify(NoticeKind::told,
                count == 0 ? "It has no links that could be moved." : reading::counted(count, "link") + " moved.");
}

void collapse_chosen(Board& board) {
  const auto& nodes = board.editor.picks.nodes;
  if (nodes.empty()) return;
  const auto& collapsed = board.model.view.collapsed;
  const bool closes = std::any_of(nodes.begin(), nodes.end(), [&](const std::string& id) { return !collapsed.contains(id); });
  Json patch = Json::object();
  for (const std::string& id : nodes) {
    if (closes) patch["collapsed"][id] = true;
    else patch["collapsed"][id] = nullptr;
  }
  board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture());
}

namespace {

void arrange_dots(Board& board, const std::string& link, const std::vector<ImVec2>& dots) {
  Json patch = Json::object();
  Json& list = patch["dots"][link];
  list = dots.empty() ? Json() : Json::array();
  for (const ImVec2& p : dots) list.push_back(place_json(p));
  board.editor.arrange(JsonValue::of(patch), board.editor.new_gesture());
}

}  // namespace

void add_dot(Board& board, std::size_t line, ImVec2 at) {
  if (line >= board.model.lines.size()) return;
  const Line& known = board.model.lines[line];
  if (known.is_crossing)
    return board.editor.notify(NoticeKind::told, "This link leads out of the frame: leave the frame to edit its dots.");
  // Between the two neighbours that the curve passes there: counted by how many dots come before the nearest stretch.
  std::size_t nearest = 1;
  for (std::size_t s = 1; s < known.points.size(); ++s)
    if (distance(at, known.points[s - 1], known.points[s]) < distance(at, known.points[nearest - 1], known.points[nearest]))
      nearest = s;
  const std::size_t steps = std::max<std::size_t>(1, (known.points.size() - 1) / (known.dots.size() + 1));
  std::vector<ImVec2> dots = known.dots;
  const std::size_t place = std::min((nearest - 1) / steps, dots.size());
  dots.insert(dots.begin() + static_cast<std::ptrdiff_t>(place), at);
  arrange_dots(board, known.id, dots);
}

void remove_dot(Board& board, std::size_t line, std::size_t dot) {
  if (line >= board.model.lines.size() || dot >= board.model.lines[line].dots.size()) return;
  std::vector<ImVec2> dots = board.model.lines[line].dots;
  dots.erase(dots.begin() + static_cast<std::ptrdiff_t>(dot));
  arrange_dots(board, board.model.lines[line].id, dots);
}

}  // namespace bl::desktop::canvas
