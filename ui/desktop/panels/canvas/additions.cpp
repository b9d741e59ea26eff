// Lists of choices for the search box, and the commands that a choice becomes.
#include "ui/desktop/panels/canvas/additions.h"

#include <nlohmann/json.hpp>

#include "core/file/scene_file.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/brief_uses.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/canvas/fits.h"
#include "ui/desktop/panels/canvas/placing.h"

namespace bl::desktop::canvas {

namespace {

// Links between more nodes than these are laid to a set.
constexpr std::size_t kMostBundled = 40;
// More than any recency.
constexpr int kAfterVolumes = 5000;

int recency_of(const Workbench& editor, const std::string& id) {
  const auto& recent = editor.person.recent_additions;
  const auto found = std::find(recent.begin(), recent.end(), id);
  return found == recent.end() ? 1000 : static_cast<int>(found - recent.begin());
}

void remember(Workbench& editor, const std::string& id) { editor.person.remember(editor.person.recent_additions, id); }

std::string first_sentence(const std::string& doc) {
  const std::size_t end = doc.find(". ");
  return end == std::string::npos ? doc : doc.substr(0, end + 1);
}

ImU32 colour_of_type(const Board& board, const std::string& id) {
  const auto& all = board.editor.types().typifications();
  return board.theme().category(static_cast<std::size_t>(std::distance(all.begin(), all.find(id))));
}

bool is_role(const TypificationDefinition& type) { return type.id != kBaseNode; }

bool is_volume(const std::string& type) { return type == reading::type_of<reading::VolumeFigures>(); }

// A new node with one role; its box's head lies at `at`.
Command new_node(Board& board, const TypificationDefinition& role, const std::string& id, ImVec2 at, Json& patch) {
  Json node = Json::object();
  const std::size_t number = id.rfind('-');
  node["name"] = role.label + (number == std::string::npos ? "" : " " + id.substr(number + 1));
  if (is_volume(role.id)) {
    const Point3 place = place_volume(board.editor.types(), board.editor.scene());
    node["position"] = Json::array({place.x, place.y, place.z});
  }
  node["types"][role.id] = Json::parse(first_values(board.editor, role.id));
  patch["boxes"][id] =
      place_json({std::round((at.x - kBoxWidth / 2) / kGrid) * kGrid, std::round((at.y - kHeadHeight / 2) / kGrid) * kGrid});
  join_entered(board, patch, "nodes", id);
  return command<AddNode>({id, JsonValue::of(node)});
}

Command new_link(const Board& board, const LinkDefinition& kind, const std::string& id, const Selection& from,
                 const Selection& to, PortValues parameters) {
  LinkRecord link;
  link.kind = kind.id;
  link.from = from;
  link.to = to;
  link.parameters = std::move(parameters);
  return command<AddLink>({id, JsonValue::of(link_to_json(link, board.editor.types()))});
}

}  // namespace

void add_node(Board& board, const std::string& type, ImVec2 at) {
  Workbench& editor = board.editor;
  const TypificationDefinition& role = *editor.types().typification(type);
  FreshIds ids(editor);
  const std::string id = ids.of(role.label);
  Json patch = Json::object();
  std::vector<Command> commands{new_node(board, role, id, at, patch)};
  add_view_patch(commands, patch);
  if (!editor.submit(commands, editor.new_gesture())) return;
  remember(editor, type);
  editor.picks.only_node(id);
  if (is_volume(type)) tell_uses(editor, {id});
}

namespace {

bool lacks_role(const Scene& scene, const std::string& node, const std::string& type) {
  const auto found = scene.nodes.find(node);
  return found != scene.nodes.end() && !found->second.types.contains(type);
}

void add_role(Board& board, const std::string& type) {
  Workbench& editor = board.editor;
  std::vector<Command> commands;
  std::vector<std::string> nodes;
  for (const std::string& id : editor.picks.nodes)
    if (lacks_role(editor.scene(), id, type)) {
      commands.push_back(command<Typify>({id, type, {first_values(editor, type, commands.size())}}));
      nodes.push_back(id);
    }
  if (!editor.submit(commands, editor.new_gesture())) return;
  remember(editor, type);
  if (is_volume(type)) tell_uses(editor, nodes);
}

std::string short_name(const Board& board, const Selection& selection) {
  if (!selection.is_query() && selection.ids.size() == 1) return selection.ids.front();
  return selection.is_query() ? (selection.tag.empty() ? selection.typification + "s" : selection.tag)
                              : text_of(board.editor, selection);
}

void lay_link(Board& board, const std::string& kind, const Selection& from, const Selection& to) {
  Workbench& editor = board.editor;
  const LinkDefinition& definition = *editor.types().link(kind);
  FreshIds ids(editor);
  const std::string id = ids.of(short_name(board, from).substr(0, 24) + "_" + short_name(board, to).substr(0, 24));
  if (!editor.submit(
          new_link(board, definition, id, from, to, chosen_ports(editor.types(), editor.scene(), definition, from, to)),
          editor.new_gesture()))
    return;
  remember(editor, kind);
  editor.picks.only_link(id);
}

void add_linked_node(Board& board, const std::string& kind, const std::string& type, const Selection& from, ImVec2 at) {
  Workbench& editor = board.editor;
  const LinkDefinition& definition = *editor.types().link(kind);
  const TypificationDefinition& role = *editor.types().typification(type);
  FreshIds ids(editor);
  const std::string node = ids.of(role.label);
  const std::string link = ids.of(short_name(board, from).substr(0, 24) + "_" + node.substr(0, 24));
  Json patch = Json::object();
  Selection to;
  to.ids = {node};
  // The ports that the link chooses are looked for in a scene that has the node already.
  Scene after = editor.scene();
  after.nodes[node].types[role.id];
  std::vector<Command> commands{
      new_node(board, role, node, at, patch),
      new_link(board, definition, link, from, to, chosen_ports(editor.types(), after, definition, from, to))};
  add_view_patch(commands, patch);
  if (!editor.submit(commands, editor.new_gesture())) return;
  remember(editor, kind);
  remember(editor, type);
  editor.picks.only_node(node);
  if (is_volume(type)) tell_uses(editor, {node});
}

// Links between the chosen nodes: from the first that was chosen to each of the others, or the other way round where only that
// fits. One choice is one step.
struct Bundle {
  std::vector<Selection> from, to;
  std::string text;
};

Bundle bundle_of(const Board& board, bool is_back) {
  const auto& order = board.choice_order;
  Bundle bundle;
  for (std::size_t k = 1; k < order.size(); ++k) {
    Selection first, other;
    first.ids = {order.front()};
    other.ids = {order[k]};
    bundle.from.push_back(is_back ? other : first);
    bundle.to.push_back(is_back ? first : other);
  }
  const std::string one = board.editor.name_of(order.front());
  const std::string rest =
      order.size() == 2 ? board.editor.name_of(order.back()) : "each of " + std::to_string(order.size() - 1) + " others";
  bundle.text = is_back ? rest + "  \xe2\x86\x92  " + one : one + "  \xe2\x86\x92  " + rest;
  return bundle;
}

bool does_fit(const Board& board, const LinkDefinition& kind, const Bundle& bundle) {
  for (std::size_t k = 0; k < bundle.from.size(); ++k)
    if (misfit(board.editor.types(), board.editor.scene(), kind, bundle.from[k], bundle.to[k])) return false;
  return true;
}

void lay_bundle(Board& board, const std::string& kind, const Bundle& bundle) {
  Workbench& editor = board.editor;
  const LinkDefinition& definition = *editor.types().link(kind);
  FreshIds ids(editor);
  std::vector<Command> commands;
  std::set<std::string> laid;
  for (std::size_t k = 0; k < bundle.from.size(); ++k) {
    const std::string id =
        ids.of(short_name(board, bundle.from[k]).substr(0, 24) + "_" + short_name(board, bundle.to[k]).substr(0, 24));
    commands.push_back(new_link(board, definition, id, bundle.from[k], bundle.to[k],
                                chosen_ports(editor.types(), editor.scene(), definition, bundle.from[k], bundle.to[k])));
    laid.insert(id);
  }
  if (!editor.submit(commands, editor.new_gesture())) return;
  remember(editor, kind);
  editor.picks.clear();
  editor.picks.links = laid;
}

void offer_links(const Board& board, Picker& picker) {
  const std::size_t count = board.choice_order.size();
  if (count < 2 || count > kMostBundled) return;
  const Workbench& editor = board.editor;
  const Bundle forth = bundle_of(board, false), back = bundle_of(board, true);
  for (const auto& [id, kind] : editor.types().links()) {
    const bool fits_forth = does_fit(board, kind, forth);
    if (!fits_forth && !does_fit(board, kind, back)) continue;
    // Whoever has chosen several nodes is likelier to link them than to add another one.
    picker.choices.push_back({id, kind.label + ": " + (fits_forth ? forth : back).text, first_sentence(kind.doc), "",
                              editor.theme.family_of(&kind).colour, 2 * recency_of(editor, id) - 1,
                              "link " + std::string(editor.theme.family_of(&kind).label), fits_forth ? "link" : "link back"});
  }
}

}  // namespace

void open_addition(Board& board, ImVec2 screen) {
  const Workbench& editor = board.editor;
  Picker picker;
  picker.at = screen;
  picker.title = "Add";
  picker.hint = "What do you want to add?";
  picker.empty_text = "Nothing of that name";
  const ImVec2 at = board.camera.to_plane(screen);
  for (const auto& [id, type] : editor.types().typifications())
    if (is_role(type))
      picker.choices.push_back({id, type.label, first_sentence(type.doc), "", colour_of_type(board, id),
                                2 * recency_of(editor, id), "new node", "node"});
  const auto& picks = editor.picks.nodes;
  if (!picks.empty()) {
    const std::string whom = picks.size() == 1 ? editor.name_of(*picks.begin()) : std::to_string(picks.size()) + " chosen nodes";
    for (const auto& [id, type] : editor.types().typifications()) {
      if (!is_role(type)) continue;
      const bool has_all =
          std::all_of(picks.begin(), picks.end(), [&](const std::string& n) { return !lacks_role(editor.scene(), n, id); });
      picker.choices.push_back({id, type.label + " as a role of " + whom, first_sentence(type.doc),
                                has_all ? "It has this role already." : "", colour_of_type(board, id),
                                2 * recency_of(editor, id) + 1, "typification", "role"});
    }
  }
  follow_choice(board);
  offer_links(board, picker);
  picker.choices.push_back({"comment", "Comment on the canvas", "A text box that stays on the canvas; no tick reads it.", "",
                            board.theme().colours().warning, 3000, "text note", "comment"});
  picker.taken = [at](Board& b, const Choice& choice) {
    if (choice.extra == "comment") add_comment(b, at);
    else if (choice.extra == "role") add_role(b, choice.id);
    else if (choice.extra.starts_with("link")) lay_bundle(b, choice.id, bundle_of(b, choice.extra == "link back"));
    else add_node(b, choice.id, at);
  };
  open_picker(board, std::move(picker));
}

void open_link_menu(Board& board, std::size_t from, std::size_t to, ImVec2 screen) {
  const Workbench& editor = board.editor;
  const Selection a = board.model.selection_of(from), b = board.model.selection_of(to);
  Picker picker;
  picker.at = screen;
  picker.title = text_of(editor, a) + "  \xe2\x86\x92  " + text_of(editor, b);
  picker.hint = "Which link?";
  picker.empty_text = "No kind of that name";
  for (const auto& [id, kind] : editor.types().links()) {
    const auto why = misfit(editor.types(), editor.scene(), kind, a, b);
    picker.choices.push_back({id, kind.label, first_sentence(kind.doc), why ? "Does not fit: " + *why + "." : "",
                              editor.theme.family_of(&kind).colour, recency_of(editor, id),
                              std::string(editor.theme.family_of(&kind).label), ""});
  }
  picker.taken = [a, b](Board& board_now, const Choice& choice) { lay_link(board_now, choice.id, a, b); };
  open_picker(board, std::move(picker));
}

void open_drop_menu(Board& board, std::size_t from, ImVec2 screen) {
  const Workbench& editor = board.editor;
  const Selection a = board.model.selection_of(from);
  const ImVec2 at = board.camera.to_plane(screen);
  Picker picker;
  picker.at = screen;
  picker.title = "A new node, linked from " + text_of(editor, a);
  picker.hint = "Which link, to what?";
  picker.empty_text = "Nothing that fits";
  for (const auto& [id, kind] : editor.types().links())
    for (const auto& [role, type] : editor.types().typifications()) {
      if (!is_role(type) || misfit_with_new(editor.types(), editor.scene(), kind, a, type)) continue;
      // Every node has a place, but only a volume's is seen: moving a table of numbers about helps nobody.
      const bool is_seen = is_volume(role);
      if (!is_seen && knows_places_only(kind, End::to)) continue;
      // What was used last decides among volumes and among the rest, never between them.
      const int taste = is_seen ? 0 : kAfterVolumes;
      picker.choices.push_back({id, kind.label + "  \xe2\x86\x92  " + type.label, first_sentence(kind.doc), "",
                                editor.theme.family_of(&kind).colour, recency_of(editor, id) + taste, "", role});
    }
  picker.taken = [a, at](Board& b, const Choice& choice) { add_linked_node(b, choice.id, choice.extra, a, at); };
  open_picker(board, std::move(picker));
}

void open_find(Board& board) {
  Picker picker;
  const Box& pane = board.camera.pane();
  picker.at = {pane.high().x - board.theme().px(400), pane.low().y + board.theme().px(44)};
  picker.title = "Find";
  picker.hint = "Name, id or role; arrow keys go from one to the next";
  picker.empty_text = "No node of that name";
  // What the entered frame holds comes first.
  for (const auto* boxes : {&board.model.boxes, &board.model.outside_boxes})
    for (const NodeBox& box : *boxes) {
      std::string roles;
      for (const Section& section : box.sections) roles += (roles.empty() ? "" : ", ") + section.label;
      const int recency = boxes == &board.model.boxes ? 1000 : 1500;
      picker.choices.push_back({box.id, box.name, box.id + "  ·  " + roles, "",
                                box.sections.empty() ? 0 : colour_of(board, box.sections.front()), recency, roles, ""});
    }
  for (const auto* lines : {&board.model.lines, &board.model.outside_lines})
    for (const Line& line : *lines)
      picker.choices.push_back(
          {line.id, line.label + " (" + line.id + ")", "link", "", line.family.colour, 2000, line.kind, "link"});
  picker.text = board.find_text;
  const auto go = [](Board& b, const Choice& choice) {
    if (choice.extra == "link") {
      b.editor.picks.only_link(choice.id);
      bring_up_to_date(b);
      if (const std::size_t k = b.model.find_line(choice.id); k < b.model.lines.size())
        b.camera.fit(b.model.lines[k].bounds.grown(120), true);
    } else {
      b.editor.picks.only_node(choice.id);
      show_node(b, choice.id);
    }
    b.find_text = b.picker.text;
  };
  picker.looked_at = go;
  picker.taken = go;
  open_picker(board, std::move(picker));
}

}  // namespace bl::desktop::canvas
