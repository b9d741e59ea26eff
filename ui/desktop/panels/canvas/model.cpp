// Makes boxes, pills and lines from the scene; places by the view where it speaks, else by the automatic layout.
#include "ui/desktop/panels/canvas/model.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/reading/report_model.h"
#include "core/reading/views/volume.h"
#include "ui/desktop/panels/canvas/auto_layout.h"
#include "ui/desktop/panels/canvas/link_paths.h"
#include "ui/desktop/panels/canvas/sections.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop::canvas {

namespace {

constexpr float kFramePadding = 18;
constexpr float kLoopRoom = 46;  // above a pill, for links from a set to itself
constexpr int kDeepestFrame = 32;
constexpr std::size_t kOneColumn = 7;

Selection ends_of_ghost(const Json& json, const char* key) {
  Selection selection;
  const auto found = json.find(key);
  if (found == json.end()) return selection;
  if (found->is_string()) selection.ids = {found->get<std::string>()};
  if (found->is_array())
    for (const Json& id : *found)
      if (id.is_string()) selection.ids.push_back(id.get<std::string>());
  return selection;
}

// Nothing where it is no volume.
std::optional<std::string> use_of(const Workbench& editor, const std::string& node) {
  return reading::setting<&reading::VolumeFigures::use>(editor.scene(), editor.types(), editor.scene().nodes.at(node));
}

// Of several roles the one whose column stands first decides.
CanvasColumn column_of(const Registry& registry, const NodeRecord& node) {
  CanvasColumn column = CanvasColumn::any;
  for (const auto& [id, values] : node.types)
    if (const TypificationDefinition* type = registry.typification(id)) column = std::min(column, type->column);
  return column;
}

// Do nodes only take other places by it?
bool only_moves(const Command& command) {
  if (const auto list = command.arguments.find("commands"); command.id == "batch" && list != command.arguments.end()) {
    const auto* parts = std::get_if<CommandList>(&list->second);
    return parts != nullptr && std::all_of((*parts)->begin(), (*parts)->end(), only_moves);
  }
  const auto port = command.arguments.find("port");
  if (command.id != "set_port" || port == command.arguments.end()) return false;
  const auto* path = std::get_if<std::string>(&port->second);
  return path != nullptr && *path == "node.position";
}

}  // namespace

bool NodeBox::is_ghost() const {
  return std::any_of(sections.begin(), sections.end(), [](const Section& s) { return s.type == nullptr; });
}

ImVec2 Line::at_share(float share) const {
  if (points.empty()) return {};
  float whole = 0;
  for (std::size_t k = 1; k < points.size(); ++k) whole += length(points[k] - points[k - 1]);
  float left = whole * share;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const float step = length(points[k] - points[k - 1]);
    if (left <= step) return points[k - 1] + (points[k] - points[k - 1]) * (step > 0 ? left / step : 0);
    left -= step;
  }
  return points.back();
}

ImVec2 Line::middle() const { return at_share(0.5f); }

std::string key_of(const Selection& selection) {
  if (selection.is_query()) return selection.typification + (selection.tag.empty() ? "" : "#" + selection.tag);
  std::string key;
  for (const std::string& id : selection.ids) key += (key.empty() ? "" : ",") + id;
  return key;
}

std::string text_of(const Workbench& editor, const Selection& selection) {
  if (selection.is_query()) {
    const TypificationDefinition* type = editor.types().typification(selection.typification);
    const std::string label = type != nullptr ? type->label : selection.typification;
    if (selection.tag.empty()) return "all " + label + "s";
    return (label.empty() ? "" : label + "s ") + "#" + selection.tag;
  }
  if (selection.ids.size() == 1) return editor.name_of(selection.ids.front());
  return std::to_string(selection.ids.size()) + " nodes";
}

void Model::update(const Workbench& editor) {
  const std::uint64_t document = editor.document->id();
  const std::size_t log_size = editor.document->running().log().size();
  const Scene& scene = editor.scene();
  const bool is_other = document != document_ || node_count_ != scene.nodes.size() || log_size < log_size_;
  const std::vector<LogEntry>& log = editor.document->running().log();
  // A drag in 3D says a new place many times a second, of which no box says anything.
  while (!is_other && log_size_ < log_size && only_moves(log[log_size_].command)) ++log_size_;
  if (is_other || log_size != log_size_ || entered != narrowed_to_ || is_dark_ != editor.theme.is_dark()) {
    if (document != document_ || log_size < log_size_) kept_.clear();
    document_ = document;
    log_size_ = log_size;
    node_count_ = scene.nodes.size();
    is_dark_ = editor.theme.is_dark();
    narrowed_to_ = entered;
    if (scene.view != view_text_ || revision == 0 || is_view_moved) view = read_view(view_text_ = scene.view);
    is_view_moved = false;
    ++revision;
    make_boxes(editor);
    make_lines(editor);
    place(editor);
    narrow();
    families.clear();
    for (const Line& line : lines) families.emplace(line.family.label, line.family.colour);
    trace_lines();
    plan_ = nullptr;
    state_ = nullptr;
  }
  if (plan_ != editor.state().plan) find_indices(editor);
  if (state_ != editor.moment->state) {
    state_ = editor.moment->state;
    ++state_revision;
  }
}

void Model::make_boxes(const Workbench& editor) {
  boxes.clear();
  for (const auto& [id, node] : editor.scene().nodes) {
    NodeBox& box = boxes.emplace_back();
    box.id = id;
    box.name = node.name.empty() ? id : node.name;
    box.sections = sections_of(editor.types(), node);
    box.is_collapsed = view.collapsed.contains(id);
    box.is_hidden = view.hidden.contains(id);
    box.box.size = {kBoxWidth, box.is_collapsed ? kHeadHeight : height_of(box.sections)};
  }
  number_uses(editor);
}

void Model::number_uses(const Workbench& editor) {
  const UseNumbers numbers(editor.scene());
  for (NodeBox& box : boxes)
    if (const auto use = use_of(editor, box.id)) box.use = numbers.tone(*use);
}

std::size_t Model::find_box(const std::string& id) const {
  const auto found =
      std::lower_bound(boxes.begin(), boxes.end(), id, [](const NodeBox& b, const std::string& key) { return b.id < key; });
  return found != boxes.end() && found->id == id ? static_cast<std::size_t>(found - boxes.begin()) : boxes.size();
}

std::size_t Model::find_line(const std::string& id) const {
  const auto found =
      std::lower_bound(lines.begin(), lines.end(), id, [](const Line& l, const std::string& key) { return l.id < key; });
  return found != lines.end() && found->id == id ? static_cast<std::size_t>(found - lines.begin()) : lines.size();
}

// The box of a single node, or the pill of a set; makes the pill where there is none yet. kNoIndex for nothing at all.
std::size_t Model::anchor_of(const Workbench& editor, const Selection& selection) {
  if (!selection.is_query() && selection.ids.size() <= 1) {
    const std::size_t box = selection.ids.empty() ? boxes.size() : find_box(selection.ids.front());
    return box < boxes.size() ? box : kNoIndex;
  }
  const std::string key = key_of(selection);
  for (std::size_t k = 0; k < pills.size(); ++k)
    if (pills[k].key == key) return boxes.size() + k;
  Pill& pill = pills.emplace_back();
  pill.key = key;
  pill.selection = selection;
  pill.label = text_of(editor, selection);
  for (const std::string& id : resolve(editor.scene(), editor.types(), selection))
    if (const std::size_t box = find_box(id); box < boxes.size()) pill.members.push_back(box);
  if (selection.is_query()) pill.label += "  ·  " + std::to_string(pill.members.size());
  const float letters =
      static_cast<float>(std::count_if(pill.label.begin(), pill.label.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  pill.box.size = {std::ceil((40 + 7.2f * letters) / kGrid) * kGrid, kPillHeight};
  return boxes.size() + pills.size() - 1;
}

void Model::make_lines(const Workbench& editor) {
  pills.clear();
  lines.clear();
  undrawn = 0;
  for (const auto& [id, link] : editor.scene().links) {
    Selection from = link.from, to = link.to;
    if (!link.ghost.empty()) {
      const Json json = Json::parse(link.ghost, nullptr, false);
      if (json.is_object()) from = ends_of_ghost(json, "from"), to = ends_of_ghost(json, "to");
    }
    const std::size_t a = anchor_of(editor, from), b = anchor_of(editor, to);
    if (a == kNoIndex || b == kNoIndex) {
      ++undrawn;
      continue;
    }
    Line& line = lines.emplace_back();
    line.id = id;
    line.kind = link.kind;
    line.definition = link.ghost.empty() ? editor.types().link(link.kind) : nullptr;
    line.label = line.definition != nullptr ? line.definition->label : link.kind + " (unknown here)";
    line.from = a;
    line.to = b;
    line.is_muted = link.is_muted;
    line.is_enabled = link.is_enabled;
    line.strength = static_cast<float>(link.strength);
    line.family = editor.theme.family_of(editor.types().link(link.kind));
    if (line.definition != nullptr) {
      const auto& writes = line.definition->proposes;
      line.changes_from = std::any_of(writes.begin(), writes.end(), [](const LinkWrite& w) { return w.end == End::from; });
      line.changes_to = std::any_of(writes.begin(), writes.end(), [](const LinkWrite& w) { return w.end == End::to; });
    }
    if (const auto dots = view.dots.find(id); dots != view.dots.end()) line.dots = dots->second;
  }
}

// Boxes and pills together: sources in a column or two, then pills, then the rest in the field.
std::vector<ImVec2> Model::automatic_places(const Workbench& editor) const {
  std::vector<LayoutItem> items;
  std::size_t sources = 0;
  for (const NodeBox& box : boxes) {
    const CanvasColumn column = column_of(editor.types(), editor.scene().nodes.at(box.id));
    LayoutItem& item = items.emplace_back();
    item.size = {kBoxWidth, height_of(box.sections)};
    item.column = column == CanvasColumn::first ? 0 : column == CanvasColumn::second ? 1 : -1;
    sources += item.column >= 0 ? 1 : 0;
    item.kin = use_of(editor, box.id).value_or("");
  }
  // A few sources stand in one column, which leaves the field more room.
  for (LayoutItem& item : items)
    if (sources <= kOneColumn && item.column == 1) item.column = 0;
  for (const Pill& pill : pills) items.push_back({pill.box.size + ImVec2(0, kLoopRoom), 2, ""});
  std::vector<std::pair<std::size_t, std::size_t>> links;
  for (const Line& line : lines)
    if (line.from < boxes.size() && line.to < boxes.size()) links.emplace_back(line.from, line.to);
  std::vector<ImVec2> places = lay_out(items, links);
  for (std::size_t k = boxes.size(); k < places.size(); ++k) places[k] = places[k] + ImVec2(0, kLoopRoom);
  return places;
}

void Model::place(const Workbench& editor) {
  const auto is_unknown = [&](const std::string& key, bool is_stored) { return !is_stored && !kept_.contains(key); };
  std::set<std::string> fresh;  // seen for the first time, and nobody says where it lies
  for (NodeBox& box : boxes) {
    box.is_stored = view.boxes.contains(box.id);
    if (is_unknown(box.id, box.is_stored)) fresh.insert(box.id);
  }
  for (Pill& pill : pills) {
    pill.is_stored = view.sets.contains(pill.key);
    if (is_unknown("\n" + pill.key, pill.is_stored)) fresh.insert("\n" + pill.key);
  }
  if (!fresh.empty()) {
    const std::vector<ImVec2> places = automatic_places(editor);
    for (std::size_t k = 0; k < boxes.size(); ++k)
      if (fresh.contains(boxes[k].id)) kept_[boxes[k].id] = places[k];
    for (std::size_t k = 0; k < pills.size(); ++k)
      if (fresh.contains("\n" + pills[k].key)) kept_["\n" + pills[k].key] = places[boxes.size() + k];
  }
  for (NodeBox& box : boxes) box.box.at = box.is_stored ? view.boxes.at(box.id) : kept_.at(box.id);
  for (Pill& pill : pills) pill.box.at = pill.is_stored ? view.sets.at(pill.key) : kept_.at("\n" + pill.key);
  if (!fresh.empty() && fresh.size() < boxes.size() + pills.size()) make_room(fresh);
  note_unstored();
}

void Model::note_unstored() {
  unstored_boxes.clear();
  unstored_sets.clear();
  for (const NodeBox& box : boxes)
    if (!box.is_stored) unstored_boxes[box.id] = box.box.at;
  for (const Pill& pill : pills)
    if (!pill.is_stored) unstored_sets[pill.key] = pill.box.at;
}

// What is placed for the first time gives way, downwards, to what people have placed and to what has been seen already.
void Model::make_room(const std::set<std::string>& fresh) {
  std::vector<Box> taken;
  for (const NodeBox& box : boxes)
    if (!fresh.contains(box.id)) taken.push_back(box.box);
  for (const Pill& pill : pills)
    if (!fresh.contains("\n" + pill.key)) taken.push_back(pill.box);
  const auto give_way = [&](Box& box, const std::string& key) {
    if (!fresh.contains(key)) return;
    for (std::size_t tries = 0; tries <= taken.size(); ++tries) {
      const auto blocker =
          std::find_if(taken.begin(), taken.end(), [&](const Box& other) { return other.touches(box.grown(8)); });
      if (blocker == taken.end()) break;
      box.at.y = std::ceil((blocker->high().y + 2 * kGrid) / kGrid) * kGrid;
    }
    taken.push_back(box);
    kept_[key] = box.at;
  };
  for (NodeBox& box : boxes) give_way(box.box, box.id);
  for (Pill& pill : pills) give_way(pill.box, "\n" + pill.key);
}

void Model::trace_lines() {
  std::vector<Box> bodies;
  bodies.reserve(anchors());
  for (std::size_t k = 0; k < anchors(); ++k) bodies.push_back(anchor(k));
  std::vector<Route> routes;
  routes.reserve(lines.size());
  for (const Line& line : lines) routes.push_back({line.from, line.to, line.dots});
  auto curves = trace(bodies, routes);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    lines[k].points = std::move(curves[k]);
    lines[k].bounds = {lines[k].points.front(), {0, 0}};
    for (const ImVec2& p : lines[k].points) lines[k].bounds = lines[k].bounds.with({p, {0, 0}});
  }
}

void Model::find_indices(const Workbench& editor) {
  const Plan& plan = *editor.state().plan;
  const bool has_the_same_indices = plan_ && plan_->dependents == plan.dependents;
  plan_ = editor.state().plan;
  if (has_the_same_indices) return;
  for (NodeBox& box : boxes) {
    const std::uint32_t at = plan.node_index(box.id);
    box.in_state = at < plan.nodes.size() ? at : kNoIndex;
    for (Section& section : box.sections) {
      section.in_state = kNoIndex;
      if (box.in_state == kNoIndex) continue;
      const auto& types = plan.nodes[at].types;
      for (std::size_t t = 0; t < types.size(); ++t)
        if (types[t].definition->id == section.type_id) section.in_state = t;
    }
  }
  for (Line& line : lines) {
    const std::size_t at = reading::link_index(plan, line.id);
    line.in_state = at < plan.links.size() ? static_cast<std::uint32_t>(at) : kNoIndex;
  }
}

Selection Model::selection_of(std::size_t anchor) const {
  if (is_door(anchor)) return doors[anchor - boxes.size() - pills.size()].selection;
  if (anchor >= boxes.size()) return pills[anchor - boxes.size()].selection;
  Selection one;
  one.ids = {boxes[anchor].id};
  return one;
}

bool Model::frame_box(const std::string& id, Box& out, int depth) const {
  const auto found = view.frames.find(id);
  if (found == view.frames.end() || depth > kDeepestFrame || !shows_frame(id)) return false;
  bool has_content = false;
  const auto take = [&](const Box& box) {
    out = has_content ? out.with(box) : box;
    has_content = true;
  };
  for (const std::string& node : found->second.nodes)
    if (const std::size_t k = find_box(node); k < boxes.size()) take(boxes[k].box);
  for (const std::string& comment : found->second.comments)
    if (const auto c = view.comments.find(comment); c != view.comments.end()) take(c->second.box);
  for (const auto& [other, frame] : view.frames) {
    Box inner;
    if (frame.in == id && other != id && frame_box(other, inner, depth + 1)) take(inner);
  }
  if (!has_content) return false;
  out = out.grown(kFramePadding);
  out = out.with({{out.at.x, out.at.y - kFrameHead + 6}, {0, 0}});
  return true;
}

Box Model::bounds() const {
  bool has_any = false;
  Box all{{-200, -150}, {400, 300}};
  const auto take = [&](const Box& box) {
    all = has_any ? all.with(box) : box;
    has_any = true;
  };
  for (std::size_t k = 0; k < anchors(); ++k) take(anchor(k));
  for (const auto& [id, comment] : view.comments)
    if (shows_comment(id)) take(comment.box);
  for (const auto& [id, frame] : view.frames)
    if (Box box; frame_box(id, box)) take(box);
  return all;
}

}  // namespace bl::desktop::canvas
