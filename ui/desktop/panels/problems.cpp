// The list of problems: a sentence for each, what it is about first; a press goes there.
#include <algorithm>

#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/problems_list.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/statistics_record.h"

namespace bl::desktop {

namespace {

struct Sign {
  const char* text;
  ImU32 colour;
};

Sign sign_of(const Theme& theme, const ProblemItem& item) {
  const Colours& c = theme.colours();
  switch (item.kind) {
    case ProblemKind::conflict: return {icon::kBalance, c.warning};
    case ProblemKind::rule: return {icon::kWarning, c.bad};
    case ProblemKind::shortage: return {icon::kWarning, item.is_error ? c.bad : c.warning};
    case ProblemKind::failing: return {icon::kError, c.bad};
    case ProblemKind::no_room: return {icon::kCube, c.warning};
    case ProblemKind::place: return {icon::kCube, c.warning};
    case ProblemKind::idle: return {icon::kMuted, c.text_faint};
    case ProblemKind::file: return {icon::kFile, item.is_error ? c.bad : c.warning};
  }
  return {icon::kWarning, c.warning};
}

// Counts by kind; a press shows that kind alone, another one all again.
void draw_filters(Workbench& editor, ProblemList& problems) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushFont(theme.fonts().small);
  bool is_first = true;
  for (int k = -1; k < static_cast<int>(kProblemKinds); ++k) {
    const auto kind = static_cast<ProblemKind>(std::max(0, k));
    const std::size_t count = k < 0 ? problems.items().size() : problems.count(kind);
    if (count == 0 && problems.filter != k) continue;
    if (!is_first) ImGui::SameLine(0, theme.px(4));
    is_first = false;
    const bool is_on = problems.filter == k;
    ImGui::PushStyleColor(ImGuiCol_Button, is_on ? c.accent_soft : c.raised);
    ImGui::PushStyleColor(ImGuiCol_Text, is_on ? c.text : c.text_soft);
    const std::string text = std::string(k < 0 ? "All" : label_of(kind)) + "  " + reading::grouped(static_cast<double>(count)) +
                             "###filter" + std::to_string(k);
    if (ImGui::Button(text.c_str())) problems.filter = is_on ? -1 : k;
    note_place(editor, "problems/filter/" + std::string(k < 0 ? "All" : label_of(kind)));
    ImGui::PopStyleColor(2);
  }
  ImGui::PopFont();
}

void go_to(Workbench& editor, const ProblemItem& item) {
  if (!editor.document || (item.nodes.empty() && item.links.empty())) return;
  if (!ImGui::GetIO().KeyShift) editor.picks.clear();
  for (const std::string& node : item.nodes)
    if (editor.scene().nodes.contains(node)) editor.picks.nodes.insert(node);
  // Of a conflict the node is what matters; its links are in the sentence and in the inspector.
  if (item.nodes.empty())
    for (const std::string& link : item.links)
      if (editor.scene().links.contains(link)) editor.picks.links.insert(link);
  if (!ImGui::IsMouseDoubleClicked(0)) return;
  if (editor.canvas != nullptr) editor.canvas->fit(false);
  if (editor.view != nullptr) editor.view->fit(false);
}

void draw_item(Workbench& editor, ProblemItem& item, int index, float height) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(index);
  // On the press, not the release: rows may change places in between.
  const bool is_activated = press_area("##problem", {width, height});
  const bool is_pressed = ImGui::IsItemClicked() || (is_activated && !ImGui::IsMouseReleased(0));
  ImGui::PopID();
  note_place(editor, "problem/" + std::to_string(index));
  const bool is_hovered = ImGui::IsItemHovered();
  const bool is_chosen = !item.nodes.empty() && editor.picks.nodes.contains(item.nodes.front());
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_hovered || is_chosen)
    list.AddRectFilled(at, {at.x + width, at.y + height}, is_hovered ? faded(c.accent, 0.12f) : faded(c.accent, 0.07f),
                       theme.px(3));
  const Sign sign = sign_of(theme, item);
  const float y = at.y + (height - ImGui::GetFontSize()) / 2, indent = theme.px(26);
  list.AddText({at.x + theme.px(5), y}, sign.colour, sign.text);
  ImFont* strong = theme.fonts().strong;
  const float subject_width = strong->CalcTextSizeA(strong->FontSize, FLT_MAX, 0, item.subject.c_str()).x;
  list.AddText(strong, strong->FontSize, {at.x + indent, y}, c.text, item.subject.c_str());
  const float rest = width - indent - subject_width - theme.px(16);
  list.AddText({at.x + indent + subject_width + theme.px(10), y}, c.text_soft, fitted(item.text, rest).c_str());
  if (is_hovered) {
    if (!item.nodes.empty() && editor.document) editor.picks.hovered_node = item.nodes.front();
    else if (!item.links.empty() && editor.document) editor.picks.hovered_link = item.links.front();
    std::string lines = item.text;
    if (item.kind == ProblemKind::conflict)
      for (std::size_t k = lines.find("; "); k != std::string::npos; k = lines.find("; ", k)) lines.replace(k, 2, "\n");
    card(editor, item.subject, lines,
         item.nodes.empty() && item.links.empty() ? "" : "press to go there, twice to bring it into sight");
  }
  if (is_pressed) go_to(editor, item);
}

void draw_nothing(Workbench& editor) {
  const Colours& c = editor.theme.colours();
  ImGui::Dummy({0, editor.theme.px(6)});
  ImGui::PushStyleColor(ImGuiCol_Text, c.good);
  ImGui::TextUnformatted(icon::kCheck);
  ImGui::PopStyleColor();
  ImGui::SameLine();
  const bool has_run = editor.moment && editor.state().tick > 0;
  ImGui::TextUnformatted(all_is_well(has_run).c_str());
}

}  // namespace

void draw_problems(Workbench& editor) {
  PanelMemory& memory = memory_of(editor);
  ProblemList& problems = *memory.problems;
  if (problems.items().empty()) return draw_nothing(editor);
  draw_filters(editor, problems);
  ImGui::BeginChild("problem list", {0, 0});
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < problems.items().size(); ++k)
    if (problems.filter < 0 || static_cast<int>(problems.items()[k].kind) == problems.filter) shown.push_back(k);
  const float height = std::round(ImGui::GetFontSize() + editor.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()), height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      ProblemItem item = problems.items()[shown[static_cast<std::size_t>(row)]];
      if (editor.moment) write_problem(editor.state(), memory.record->figures(editor).accounts, item);
      draw_item(editor, item, row, height);
    }
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace bl::desktop
