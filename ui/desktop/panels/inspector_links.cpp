// Selected links: their kind, ends, strength and parameters, and their present proposals.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

constexpr std::size_t kMostListedVoices = 40;

// Would the link find its ports at an end that names these nodes?
bool has_ports(const Workbench& editor, const LinkDefinition& kind, End end, const Selection& selection) {
  const auto fits = [&](const std::string& type) {
    if (type.empty() || type == kBaseNode) return true;
    if (selection.is_query()) return selection.typification == type;
    return std::all_of(selection.ids.begin(), selection.ids.end(), [&](const std::string& id) {
      const auto node = editor.scene().nodes.find(id);
      return node != editor.scene().nodes.end() && node->second.types.contains(type);
    });
  };
  for (const LinkRead& read : kind.reads)
    if (read.end == end && !read.is_optional && !fits(read.path.typification)) return false;
  for (const LinkWrite& write : kind.proposes)
    if (write.end == end && !write.is_optional && !fits(write.path.typification)) return false;
  return true;
}

template <class Make>
void submit_each(Workbench& editor, const std::vector<std::string>& links, std::int64_t live_gesture, Make make) {
  std::vector<Command> commands;
  for (const std::string& id : links)
    if (editor.scene().links.contains(id)) commands.push_back(make(id));
  if (live_gesture != 0) editor.show(commands, live_gesture);
  else editor.submit(commands);
}

void draw_ends(Workbench& editor, const InspectorView& view) {
  if (view.links().size() != 1 || view.kind() == nullptr) return;
  const std::string& id = view.links().front();
  const LinkRecord link = editor.scene().links.at(id);
  const std::size_t at = reading::link_index(*editor.state().plan, id);
  float width = 0;
  for (const End end : {End::from, End::to}) {
    const bool is_from = end == End::from;
    const std::size_t count = at < editor.state().links.size() ? editor.state().plan->links[at].nodes[is_from ? 0 : 1].size() : 0;
    begin_row(editor, is_from ? "from" : "to", is_from ? "From" : "To",
              is_from ? "Where the link starts." : "Where the link ends.", reading::counted(count, "node") + " now", {}, width);
    const Selection& now = is_from ? link.from : link.to;
    const auto chosen = selection_field(editor, is_from ? "from" : "to", now, false, width);
    if (now.is_query()) small_text(editor, reading::counted(count, "node"), editor.theme.colours().text_faint, width);
    end_row();
    if (chosen) editor.submit(command<SetLinkEnds>({id, is_from ? *chosen : link.from, is_from ? link.to : *chosen}));
  }
  const bool can_swap =
      has_ports(editor, *view.kind(), End::from, link.to) && has_ports(editor, *view.kind(), End::to, link.from);
  ImGui::BeginDisabled(!can_swap);
  begin_row(editor, "swap", "", "", "", {}, width);
  ImGui::PushFont(editor.theme.fonts().small);
  const bool is_swapped = ImGui::Button("\xE2\x86\x94  swap the ends");
  note_place(editor, "swap");
  ImGui::PopFont();
  end_row();
  ImGui::EndDisabled();
  if (!can_swap && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
    ImGui::SetTooltip("Swapped, this kind of link would not find the ports that it needs.");
  if (is_swapped && can_swap) editor.submit(command<SetLinkEnds>({id, link.to, link.from}));
}

void draw_strength(Workbench& editor, const InspectorView& view) {
  const LinkRecord& first = editor.scene().links.at(view.links().front());
  bool is_mixed = false;
  for (const std::string& id : view.links()) is_mixed = is_mixed || editor.scene().links.at(id).strength != first.strength;
  static const PortDefinition port = [] {
    PortDefinition p;
    p.id = "strength";
    p.doc = "How much its proposals count among others, from 0 to 1.";
    p.unit = Unit::ratio;
    p.default_value = 1.0;
    p.hard_minimum = 0;
    p.hard_maximum = 1;
    p.soft_minimum = 0;
    p.soft_maximum = 1;
    return p;
  }();
  float width = 0;
  const RowEvent event = begin_row(editor, "strength", "Strength", port.doc, facts_of(port, port.unit),
                                   {first.strength != 1 || is_mixed, false, false, false}, width);
  auto change = number_field(
      editor, {"strength", &port, port.unit, first.strength, is_mixed, false, !is_mixed && first.strength == 1}, width);
  draw_complaint(editor, "strength", width);
  end_row();
  if (event.wants_reset) change = constant(1.0);
  if (!change) return;
  PanelMemory& memory = memory_of(editor);
  if (memory.complaint_key == "strength") memory.complaint_key.clear();
  const double now = as_number(change->make(first.strength));
  if (auto checked = check_value(port, now, ""); !checked) return complain(editor, "strength", checked.error().message);
  submit_each(editor, view.links(), change->is_live ? memory.scrub.gesture : 0, [&](const std::string& id) {
    const double fresh = as_number(change->make(editor.scene().links.at(id).strength));
    return command<SetLinkStrength>({id, std::clamp(fresh, 0.0, 1.0)});
  });
}

void draw_switches(Workbench& editor, const InspectorView& view) {
  const LinkRecord first = editor.scene().links.at(view.links().front());
  bool is_mixed[2] = {false, false};
  for (const std::string& id : view.links()) {
    const LinkRecord& link = editor.scene().links.at(id);
    is_mixed[0] = is_mixed[0] || link.is_enabled != first.is_enabled;
    is_mixed[1] = is_mixed[1] || link.is_muted != first.is_muted;
  }
  float width = 0;
  begin_row(editor, "enabled", "Enabled", "When off, the link is not evaluated.", "", {}, width);
  const bool is_enabled_hit = switch_field(editor, "enabled", first.is_enabled, is_mixed[0]);
  end_row();
  begin_row(editor, "muted", "Muted", "When on, the link is evaluated and shown, but its proposals do not count.", "", {}, width);
  const bool is_muted_hit = switch_field(editor, "muted", first.is_muted, is_mixed[1]);
  end_row();
  if (is_enabled_hit)
    submit_each(editor, view.links(), 0, [&](const std::string& id) {
      return command<EnableLink>({id, is_mixed[0] || !first.is_enabled});
    });
  if (is_muted_hit)
    submit_each(editor, view.links(), 0, [&](const std::string& id) {
      return command<MuteLink>({id, is_mixed[1] || !first.is_muted});
    });
}

void change_parameter(Workbench& editor, const InspectorView& view, const PortDefinition& port, const std::string& key,
                      const Change& change) {
  PanelMemory& memory = memory_of(editor);
  if (memory.complaint_key == key) memory.complaint_key.clear();
  std::vector<Command> commands;
  for (const std::string& id : view.links()) {
    const LinkRecord& link = editor.scene().links.at(id);
    const auto found = link.parameters.find(port.id);
    const Value& old = found == link.parameters.end() ? port.default_value : found->second;
    const Value fresh = change.make(old);
    if (fresh == old) continue;
    if (auto checked = check_value(port, fresh, ""); !checked) return complain(editor, key, checked.error().message);
    commands.push_back(command<SetLinkParameter>({id, port.id, JsonValue::of(value_to_json(fresh, port))}));
  }
  if (change.is_live) editor.show(commands, memory.scrub.gesture);
  else editor.submit(commands);
}

void draw_parameters(Workbench& editor, const InspectorView& view) {
  if (view.kind() == nullptr || view.parameters().empty()) return;
  if (!section(editor, "parameters", "Parameters", view.kind()->doc, nullptr)) return;
  for (const SharedPort& shared : view.parameters()) {
    const PortDefinition& port = *shared.port;
    const std::string key = "parameter." + port.id;
    float width = 0;
    const RowEvent event = begin_row(editor, key, label_of(port.id), port.doc, facts_of(port, shared.unit),
                                     {!shared.is_default, false, false, false}, width);
    auto change = value_field(editor, {key, &port, shared.unit, shared.value, shared.is_mixed, false, shared.is_default}, width);
    draw_complaint(editor, key, width);
    end_row();
    if (event.wants_reset) change = constant(port.default_value);
    if (change) change_parameter(editor, view, port, key, *change);
  }
}

// One row for each port that the link speaks to; a press goes to the node.
void draw_voices(Workbench& editor, const std::string& id) {
  const State& state = editor.state();
  const Colours& c = editor.theme.colours();
  const std::size_t at = reading::link_index(*state.plan, id);
  if (at >= state.links.size()) return;
  const auto& error = state.links[at].error ? state.links[at].error : state.plan->links[at].error;
  if (error) small_text(editor, std::string(icon::kError) + "  " + error->text(), c.bad);
  if (!section(editor, "voices", "What it says now", "The last proposal of the link for each value that it changes.", nullptr))
    return;
  const std::vector<Voice>& voices = state.links[at].voices;
  if (voices.empty()) small_text(editor, state.tick == 0 ? "nothing yet: no tick has run" : "nothing", c.text_faint);
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {style.FramePadding.x, editor.theme.px(2)});
  float width = 0;
  for (std::size_t k = 0; k < std::min(voices.size(), kMostListedVoices); ++k) {
    const Voice& voice = voices[k];
    const std::uint32_t to = voice.target.node;
    // A node is named once, however much is said to it.
    const std::string name = k > 0 && voices[k - 1].target.node == to ? std::string() : state.plan->nodes[to].name;
    const std::string key = "voice/" + std::to_string(k), port = label_of(state.plan->port(voice.target).id);
    begin_row(editor, key, name, "", "", {}, width);
    width += 2 * editor.theme.px(20);
    CellLook look;
    look.is_fixed = true;
    look.colour = c.text_soft;
    // Its loudness stands above; here counts what it says.
    Voice plain = voice;
    plain.strength = 1;
    const bool is_silent = state.plan->port(voice.target).rule == CombineRule::sum && voice.magnitude < 5e-4;
    const std::string says = is_silent ? std::string("hardly anything") : reading::voice_text(state, plain);
    const CellEvent event = cell(editor, key, port + ": " + says, "", width, look);
    if (event.is_hovered) {
      editor.picks.hovered_node = state.plan->nodes[to].id;
      card(editor, state.plan->nodes[to].name + " \xC2\xB7 " + port, reading::voice_text(state, voice), "press to go there");
      if (ImGui::IsMouseClicked(0)) editor.picks.only_node(state.plan->nodes[to].id);
    }
    end_row();
  }
  ImGui::PopStyleVar();
  if (voices.size() > kMostListedVoices)
    small_text(editor, "and " + std::to_string(voices.size() - kMostListedVoices) + " more", c.text_faint);
}

}  // namespace

void list_links(Workbench& editor, InspectorView& view) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const State& state = editor.state();
  const std::vector<std::size_t>& links = view.touching(state);
  if (links.empty() || !section(editor, "links", "Links", "The links that start or end here.", nullptr)) return;
  for (std::size_t k = 0; k < std::min(links.size(), kMostListedVoices); ++k) {
    const LinkPlan& link = state.plan->links[links[k]];
    if (!editor.scene().links.contains(link.id)) continue;  // taken away since the last tick
    const std::string kind = link.definition != nullptr ? link.definition->label : "unknown kind";
    const bool has_failed = state.links[links[k]].error || link.error, is_quiet = !link.is_enabled || link.is_muted;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::PushID(link.id.c_str());
    const bool is_pressed = press_area("##link", {ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight()});
    ImGui::PopID();
    note_place(editor, "link/" + link.id);
    const ImVec2 to = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
      editor.picks.hovered_link = link.id;
      list.AddRectFilled(at, to, faded(c.accent, 0.12f), theme.px(3));
    }
    const float y = at.y + ImGui::GetStyle().FramePadding.y, middle = (at.y + to.y) / 2;
    const ImU32 colour = link.definition != nullptr ? theme.family_of(link.definition).colour : c.text_faint;
    list.AddLine({at.x + theme.px(2), middle}, {at.x + theme.px(12), middle}, is_quiet ? faded(colour, 0.4f) : colour,
                 theme.px(2.5f));
    const std::string text = kind + (has_failed ? ", failing" : !link.is_enabled ? ", off" : link.is_muted ? ", muted" : "");
    list.AddText({at.x + theme.px(20), y}, has_failed ? c.bad : is_quiet ? c.text_faint : c.text, text.c_str());
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    list.AddText({at.x + theme.px(30) + width, y}, c.text_faint, fitted(link.id, to.x - at.x - width - theme.px(34)).c_str());
    if (is_pressed) editor.picks.only_link(link.id);
  }
  if (links.size() > kMostListedVoices)
    small_text(editor, "and " + std::to_string(links.size() - kMostListedVoices) + " more", c.text_faint);
}

void inspect_links(Workbench& editor, InspectorView& view) {
  const LinkRecord& first = editor.scene().links.at(view.links().front());
  const bool is_single = view.links().size() == 1;
  if (is_single && !first.ghost.empty()) {
    heading(editor, first.kind.empty() ? view.links().front() : first.kind, view.links().front());
    draw_ghost(editor, first.ghost, "This program does not know this kind of link; it is kept unchanged and does nothing.");
    return;
  }
  const LinkDefinition* kind = view.kind();
  const std::string title = kind != nullptr ? kind->label : "Links of several kinds";
  const Family family = editor.theme.family_of(kind);
  heading(editor, is_single ? title : reading::counted(view.links().size(), "link"), is_single ? view.links().front() : title,
          kind != nullptr ? family.colour : 0);
  if (kind != nullptr && is_single) {
    small_text(editor, kind->doc, editor.theme.colours().text_soft);
    ImGui::Dummy({0, editor.theme.px(4)});
  }
  draw_ends(editor, view);
  draw_strength(editor, view);
  draw_switches(editor, view);
  draw_parameters(editor, view);
  if (is_single) draw_voices(editor, view.links().front());
}

}  // namespace bl::desktop
