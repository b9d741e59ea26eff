// Chosen nodes: name, then a section for each role that they share, settings before results.
#include <algorithm>

#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "core/reading/views/volume.h"
#include "core/session/table_rows.h"
#include "ui/desktop/panels/brief_uses.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/inspector_quantity.h"

#include <nlohmann/json.hpp>

namespace bl::desktop {

namespace {

std::string path_of(const TypificationDefinition& type, const PortDefinition& port) { return type.id + "." + port.id; }

void lock_ports(Workbench& editor, const std::vector<std::string>& nodes, const std::string& path, bool is_locking) {
  std::vector<Command> commands;
  for (const std::string& id : nodes) {
    if (editor.scene().nodes.at(id).locked.contains(path) == is_locking) continue;
    commands.push_back(is_locking ? command<LockPort>({id, {path}}) : command<UnlockPort>({id, {path}}));
  }
  editor.submit(commands);
}

void draw_name(Workbench& editor, const InspectorView& view) {
  if (view.nodes().size() != 1) return;
  const std::string& id = view.nodes().front();
  const std::string& name = editor.scene().nodes.at(id).name;
  float width = 0;
  begin_row(editor, "name", "Name", "The name that people see; the id never changes.", "", {}, width);
  CellLook look;
  look.hint = id.c_str();
  const CellEvent event = cell(editor, "name", name, name, width, look);
  end_row();
  if (event.is_typed) editor.submit(command<RenameNode>({id, event.text}));
}

// Nothing is said at the nodes any more: the default holds, or what the scene says.
void reset_ports(Workbench& editor, const std::vector<std::string>& nodes, const std::string& path) {
  std::vector<Command> commands;
  for (const std::string& id : nodes) commands.push_back(command<SetPort>({id, {path}, {"null"}}));
  editor.submit(commands);
}

void draw_setting(Workbench& editor, InspectorView& view, const TypificationDefinition& type, const SharedPort& shared) {
  const PortDefinition& port = *shared.port;
  const std::string path = path_of(type, port);
  const bool can_move = port.rule != CombineRule::none, is_single = view.nodes().size() == 1;
  RowSigns signs{!shared.is_default, can_move, shared.is_locked || shared.is_partly_locked,
                 is_single && can_be_driven(editor, port)};
  float width = 0;
  const RowEvent event = begin_row(editor, path, label_of(port.id), port.doc, facts_of(port, shared.unit), signs, width);
  const Subject subject{path, &port, shared.unit, shared.value, shared.is_mixed, false, shared.is_default};
  const auto change = value_field(editor, subject, width);
  draw_complaint(editor, path, width);
  if (port.kind == ValueKind::point)
    for (const char* part : {"/x", "/y", "/z"}) draw_complaint(editor, path + part, width);
  if (is_single) {
    const std::uint32_t node = editor.index_of(view.nodes().front());
    const auto ref =
        node < editor.state().nodes.size() ? editor.state().plan->find(node, PortPath{type.id, port.id, ""}) : std::nullopt;
    if (ref) draw_effective(editor, view, *ref, shared.value, width);
  }
  end_row();
  // The view points into the scene as it was: one change, and the frame goes on with what it has.
  if (change) change_ports(editor, view.nodes(), type, port, path, *change);
  else if (event.wants_reset) reset_ports(editor, view.nodes(), path);
  else if (event.wants_lock) lock_ports(editor, view.nodes(), path, !signs.is_locked);
  else if (event.wants_drive) drive_by_expression(editor, view.nodes().front(), path, as_number(shared.value), shared.unit);
}

// Computed values of several nodes: one where they agree, the span of numbers where they do not.
std::string span_text(const State& state, const std::vector<PortRef>& refs, const PortDefinition& port, Unit unit) {
  double low = 0, high = 0;
  bool is_same = true, is_number = port.kind == ValueKind::number || port.kind == ValueKind::integer;
  for (std::size_t k = 0; k < refs.size(); ++k) {
    const Value& value = state.value(refs[k]);
    is_same = is_same && value == state.value(refs.front());
    const double number = as_number(value);
    low = k == 0 ? number : std::min(low, number);
    high = k == 0 ? number : std::max(high, number);
  }
  if (is_same) return value_text(state.value(refs.front()), port, unit);
  if (!is_number) return "several";
  const Unit first_unit = unit == Unit::ratio || unit == Unit::second ? unit : Unit::none;  // these may be said in another
  return value_text(low, port, first_unit) + " to " + value_text(high, port, unit);
}

void draw_computed(Workbench& editor, const InspectorView& view, const TypificationDefinition& type, const PortDefinition& port) {
  constexpr std::size_t kMostRead = 64;
  const State& state = editor.state();
  std::vector<PortRef> refs;
  for (std::size_t k = 0; k < std::min(view.nodes().size(), kMostRead); ++k) {
    const std::uint32_t node = editor.index_of(view.nodes()[k]);
    if (node >= state.nodes.size()) continue;
    if (const auto ref = state.plan->find(node, PortPath{type.id, port.id, ""})) refs.push_back(*ref);
  }
  if (refs.empty()) return;
  const std::string path = path_of(type, port);
  const NodeRecord& node = editor.scene().nodes.at(view.nodes().front());
  const Unit unit = unit_of(editor.types(), node, type, port);
  float width = 0;
  begin_row(editor, path, label_of(port.id), port.doc, facts_of(port, unit), {}, width);
  width += 2 * editor.theme.px(20);
  if (view.nodes().size() == 1) {
    value_field(editor, {path, &port, unit, state.value(refs.front()), false, true, false}, width);
  } else {
    CellLook look;
    look.is_fixed = true;
    look.colour = editor.theme.colours().text_soft;
    cell(editor, path, view.nodes().size() > kMostRead ? "\xE2\x80\x93" : span_text(state, refs, port, unit), "", width, look);
  }
  end_row();
}

void draw_failure(Workbench& editor, const InspectorView& view, const TypificationDefinition& type) {
  if (view.nodes().size() != 1) return;
  const State& state = editor.state();
  const std::uint32_t node = editor.index_of(view.nodes().front());
  if (node >= state.nodes.size()) return;
  const auto& types = state.plan->nodes[node].types;
  for (std::size_t t = 0; t < types.size(); ++t)
    if (types[t].definition == &type && state.nodes[node].types[t].error)
      small_text(editor, std::string(icon::kError) + "  " + state.nodes[node].types[t].error->text(), editor.theme.colours().bad);
}

void draw_type(Workbench& editor, InspectorView& view, const SharedType& shared) {
  const TypificationDefinition& type = *shared.type;
  const bool is_base = type.id == kBaseNode;
  bool wants_removal = false;
  if (!is_base && !section(editor, type.id, type.label, type.doc, &wants_removal)) return;
  draw_failure(editor, view, type);
  for (const SharedPort& setting : shared.settings) draw_setting(editor, view, type, setting);
  // What the scene says for all nodes is shown like a result: it is set in the scene's settings.
  const auto is_result = [](const PortDefinition& p) { return p.of_scene == OfScene::always || (p.is_computed && !p.recall); };
  if (std::any_of(type.ports.begin(), type.ports.end(), is_result)) {
    // Results stand closer together than what can be changed.
    if (!shared.settings.empty()) ImGui::Dummy({0, editor.theme.px(2)});
    const ImGuiStyle& style = ImGui::GetStyle();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, editor.theme.px(2)});
    for (const PortDefinition& port : type.ports)
      if (is_result(port)) draw_computed(editor, view, type, port);
    ImGui::PopStyleVar();
  }
  if (!wants_removal) return;
  std::vector<Command> commands;
  for (const std::string& id : view.nodes()) commands.push_back(command<Untypify>({id, type.id}));
  editor.submit(commands);
}

void draw_add_role(Workbench& editor, const InspectorView& view) {
  ImGui::Dummy({0, editor.theme.px(6)});
  const float width = ImGui::GetContentRegionAvail().x;
  if (!begin_list(editor, "add role", std::string(icon::kPlus) + "  add a role", width, editor.theme.colours().text_soft)) return;
  filter_field(editor, ImGui::GetContentRegionAvail().x);
  const std::string filter = memory_of(editor).filter;
  for (const auto& [id, type] : editor.types().typifications()) {
    std::vector<std::string> lacking;
    for (const std::string& node : view.nodes())
      if (!editor.scene().nodes.at(node).types.contains(id)) lacking.push_back(node);
    if (lacking.empty() || !(passes_filter(filter, type.label) || passes_filter(filter, id))) continue;
    if (!list_entry(editor, type.label, type.doc, false)) continue;
    std::vector<Command> commands;
    for (const std::string& node : lacking)
      commands.push_back(command<Typify>({node, id, {first_values(editor, id, commands.size())}}));
    if (editor.submit(commands) && id == reading::type_of<reading::VolumeFigures>()) tell_uses(editor, lacking);
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace

void change_ports(Workbench& editor, const std::vector<std::string>& nodes, const TypificationDefinition& type,
                  const PortDefinition& port, const std::string& key, const Change& change) {
  PanelMemory& memory = memory_of(editor);
  if (memory.complaint_key == key) memory.complaint_key.clear();
  std::vector<Command> commands;
  for (const std::string& id : nodes) {
    const auto node = editor.scene().nodes.find(id);
    if (node == editor.scene().nodes.end() || !node->second.types.contains(type.id)) continue;
    const Value& old = set_value(editor.scene(), node->second, type, port);
    const Value fresh = change.make(old);
    if (fresh == old && !(port.keeps_default && !node->second.types.at(type.id).contains(port.id))) continue;
    if (auto checked = check_value(port, fresh, ""); !checked) return complain(editor, key, checked.error().message);
    if (port.kind == ValueKind::table) {
      const auto steps =
          table_commands(id, path_of(type, port), port, *std::get<Shared<Table>>(old), *std::get<Shared<Table>>(fresh));
      commands.insert(commands.end(), steps.begin(), steps.end());
    } else {
      commands.push_back(command<SetPort>({id, {path_of(type, port)}, JsonValue::of(value_to_json(fresh, port))}));
    }
  }
  if (change.is_live) editor.show(commands, memory.scrub.gesture);
  else editor.submit(commands);
}

void inspect_nodes(Workbench& editor, InspectorView& view) {
  const std::size_t count = view.nodes().size();
  if (count == 1) {
    const std::string& id = view.nodes().front();
    heading(editor, editor.name_of(id), id);
  } else {
    heading(editor, reading::counted(count, "node"), "edited together; different values are shown as 'several'");
  }
  draw_name(editor, view);
  for (const SharedType& shared : view.types()) draw_type(editor, view, shared);
  if (count == 1)
    for (const auto& [type, json] : editor.scene().nodes.at(view.nodes().front()).ghosts) {
      if (!section(editor, "ghost/" + type, type, "A role that this program does not know.", nullptr)) continue;
      draw_ghost(editor, json, "This program does not know the role; it is kept unchanged and does nothing.");
    }
  draw_add_role(editor, view);
  if (count == 1) list_links(editor, view);
}

}  // namespace bl::desktop
