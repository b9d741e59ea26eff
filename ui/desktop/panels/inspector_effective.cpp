// Below a setting: its effective value, the links that changed it, and the tension between them.
#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "ui/desktop/panels/inspector.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

// As many digits as one reads at a glance; what was set is shown exactly, what became of it need not be.
std::string glance(const Value& value, const PortDefinition& port) {
  if (const auto* number = std::get_if<double>(&value); number != nullptr && !means_none(port, *number))
    return reading::quantity(as_number(value), port.unit);
  return value_text(value, port, port.unit);
}

bool differs(const Value& set, const Value& effective) {
  if (const auto* point = std::get_if<Vector3>(&set))
    if (const auto* now = std::get_if<Vector3>(&effective)) return distance(*point, *now) > 1e-3;
  if (const auto* number = std::get_if<double>(&set)) {
    const double now = as_number(effective);
    return std::abs(*number - now) > 1e-6 * std::max(std::abs(*number), std::abs(now));
  }
  return !(set == effective);
}

// "cap (Set cap) and brief (Demand)", each link once.
std::string movers(const State& state, const reading::ConflictRow& row) {
  constexpr std::size_t kNamed = 4;
  std::vector<std::string> names;
  for (const std::string& id : row.links) {
    if (id.empty()) continue;
    const std::size_t at = reading::link_index(*state.plan, id);
    const LinkDefinition* kind = at < state.plan->links.size() ? state.plan->links[at].definition : nullptr;
    std::string name = id + (kind != nullptr ? " (" + kind->label + ")" : "");
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  }
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), kNamed); ++k)
    text += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more" : text;
}

void draw_tension_bar(const Theme& theme, float width, double severity) {
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = theme.px(3);
  ImGui::Dummy({width, height});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, faded(c.warning, 0.15f), height / 2);
  // A tenth of the value already fills half of the bar: conflicts start small.
  const auto share = static_cast<float>(1 - std::exp(-7 * severity));
  list.AddRectFilled(at, {at.x + std::max(height, share * width), at.y + height}, c.warning, height / 2);
}

}  // namespace

void draw_effective(Workbench& editor, InspectorView& view, PortRef ref, const Value& set, float width) {
  const State& state = editor.state();
  const PortDefinition& port = state.plan->port(ref);
  if (port.rule == CombineRule::none) return;
  const TypePlan& type = state.plan->nodes[ref.node].types[ref.type];
  const Value& effective = state.value(ref);
  const double tension = state.nodes[ref.node].types[ref.type].tension[ref.port];
  const double severity = reading::severity_of(state, ref, tension);
  const bool is_tense = severity >= reading::kMinorSeverity, is_moved = state.tick > 0 && differs(set, effective);
  if (!is_tense && !is_moved) return;
  const reading::ConflictRow& row = view.pulls(state, ref);
  const Colours& c = editor.theme.colours();
  ImGui::BeginGroup();
  if (is_tense) draw_tension_bar(editor.theme, width, severity);
  if (is_moved) {
    const std::string who = movers(state, row);
    const std::string because =
        type.is_locked[ref.port] ? ""
        : who.empty()            ? ""
                                 : (type.is_set[ref.port] || port.rule != CombineRule::blend ? ", moved by " : ", from ") + who;
    small_text(editor, "\xE2\x86\x92 " + glance(effective, port) + because, c.text_soft, width + 2 * editor.theme.px(20));
  } else if (type.is_locked[ref.port]) {
    small_text(editor, "locked against " + movers(state, row), c.text_soft, width + 2 * editor.theme.px(20));
  }
  ImGui::EndGroup();
  if (!ImGui::IsItemHovered()) return;
  std::string text;
  for (const std::string& pull : row.pulls) text += (text.empty() ? "" : "\n") + pull;
  std::string facts = "set " + value_text(set, port, port.unit) +
                      (type.is_set[ref.port] ? "" : " (the default, which does not count as a proposal)") +
                      "  \xE2\x86\x92  effective " + glance(effective, port);
  if (is_tense)
    facts +=
        "\ntension " + reading::quantity(tension, port.unit) + ", " + reading::percent(severity) + " of the size of the value";
  card(editor, is_tense ? "Who pulls here" : "What moves it", text, facts);
}

}  // namespace bl::desktop
