// The tab Import: counts of taken, repaired and skipped elements at the left, the elements at the right; a click goes to one.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/dialogs.h"
#include "ui/desktop/panels/import_list.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/scene_view.h"

#include <imgui_stdlib.h>

namespace bl::desktop {

namespace {

constexpr float kGroups = 330;  // [points]: width of the counts at the left

const char* outcome_label(importing::ImportOutcome outcome) {
  constexpr const char* kLabels[] = {"Taken", "Repaired", "Skipped"};
  return kLabels[static_cast<int>(outcome)];
}

struct RowSign {
  const char* text;
  ImU32 colour;
};
RowSign sign_of(const Theme& theme, importing::ImportOutcome outcome) {
  const Colours& c = theme.colours();
  switch (outcome) {
    case importing::ImportOutcome::taken: return {icon::kCheck, c.good};
    case importing::ImportOutcome::repaired: return {icon::kReset, c.warning};
    case importing::ImportOutcome::skipped: return {icon::kClose, c.bad};
  }
  return {icon::kCheck, c.good};
}

std::string number(std::size_t count) { return reading::grouped(static_cast<double>(count)); }

// Those of its nodes that are in the scene: an import can have been undone, and nodes removed since.
std::vector<std::string> nodes_of(const Workbench& editor, const importing::ImportRow& row) {
  std::vector<std::string> nodes;
  std::copy_if(row.made.begin(), row.made.end(), std::back_inserter(nodes),
               [&](const std::string& id) { return editor.scene().nodes.contains(id); });
  return nodes;
}

std::string place_text(const Workbench& editor, const importing::ImportRow& row) {
  const std::vector<std::string> nodes = nodes_of(editor, row);
  if (nodes.size() == 1) return editor.name_of(nodes.front());
  if (nodes.size() > 1) return reading::counted(nodes.size(), "node");
  if (!row.made.empty() && !row.place) return "removed since";
  if (!row.place) return "no place";
  return "at " + reading::grouped((*row.place)[0], 1) + ", " + reading::grouped((*row.place)[1], 1) + " m";
}

std::string title_of(const importing::ImportRow& row) { return row.kind + (row.id.empty() ? "" : " " + row.id); }

// To its nodes; else a pin to its place; else a sentence why neither can be.
void go_to(Workbench& editor, const importing::ImportRow& row) {
  const std::vector<std::string> nodes = nodes_of(editor, row);
  if (!nodes.empty()) {
    editor.picks.links.clear();
    editor.picks.nodes = {nodes.begin(), nodes.end()};
    if (editor.view != nullptr) editor.view->drop_pin(), editor.view->fit(false);
    if (editor.canvas != nullptr) editor.canvas->fit(false);
    return;
  }
  if (row.place && editor.view != nullptr) {
    editor.picks.clear();
    const double ground = editor.view->facts() == nullptr ? 0 : editor.view->facts()->ground;
    const std::string what = title_of(row) + "\n" + outcome_label(row.outcome) + ": " + why_of(row) +
                             (special_of(row).empty() ? "" : "\n" + special_of(row));
    return editor.view->put_pin({{(*row.place)[0], (*row.place)[1], ground}, what});
  }
  editor.notify(NoticeKind::told,
                row.count > 1 ? "This row stands for " + number(row.count) + " elements, which have no place of their own."
                              : "The file does not say where " + title_of(row) + " lies.");
}

void draw_outcomes(Workbench& editor, ImportList& list) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushFont(theme.fonts().small);
  const auto chip = [&](int outcome, const std::string& label, std::size_t count) {
    const bool is_on = list.outcome() == outcome && list.group() == list.groups().size();
    ImGui::PushStyleColor(ImGuiCol_Button, is_on ? c.accent_soft : c.raised);
    ImGui::PushStyleColor(ImGuiCol_Text, is_on ? c.text : c.text_soft);
    if (ImGui::Button((label + "  " + number(count) + "###outcome" + std::to_string(outcome)).c_str()))
      list.choose_outcome(outcome);
    note_place(editor, "import/outcome/" + label);
    ImGui::PopStyleColor(2);
    ImGui::SameLine(0, theme.px(4));
  };
  chip(-1, "All", list.total());
  for (const importing::ImportOutcome outcome :
       {importing::ImportOutcome::skipped, importing::ImportOutcome::repaired, importing::ImportOutcome::taken})
    chip(static_cast<int>(outcome), outcome_label(outcome), list.count(outcome));
  ImGui::PopFont();
}

// Counts by reason; a press shows those rows alone.
void draw_groups(Workbench& editor, ImportList& list, float width) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::BeginChild("groups", {width, 0});
  const float height = std::round(ImGui::GetFontSize() + theme.px(6));
  for (std::size_t k = 0; k < list.groups().size(); ++k) {
    const ImportGroup& group = list.groups()[k];
    if (list.outcome() >= 0 && static_cast<int>(group.outcome) != list.outcome()) continue;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::PushID(static_cast<int>(k));
    if (press_area("group", {room, height})) list.choose_group(k);
    const bool is_hovered = ImGui::IsItemHovered();
    note_place(editor, "import/group/" + std::to_string(k));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (is_hovered || list.group() == k)
      draw.AddRectFilled(at, {at.x + room, at.y + height}, faded(c.accent, list.group() == k ? 0.25f : 0.12f), theme.px(3));
    const RowSign sign = sign_of(theme, group.outcome);
    const float y = at.y + (height - ImGui::GetFontSize()) / 2;
    const std::string count = number(group.count);
    const float count_width = ImGui::CalcTextSize(count.c_str()).x;
    draw.AddText({at.x + theme.px(4), y}, sign.colour, sign.text);
    draw.AddText({at.x + theme.px(24), y}, c.text,
                 fitted(group.kind + ": " + group.reason, room - count_width - theme.px(44)).c_str());
    draw.AddText({at.x + room - count_width - theme.px(8), y}, c.text_soft, count.c_str());
    if (is_hovered)
      card(editor, std::string(outcome_label(group.outcome)) + ": " + reading::counted(group.count, group.kind), group.reason);
    ImGui::PopID();
    ImGui::SetCursorScreenPos({at.x, at.y + height});
  }
  ImGui::EndChild();
}

void draw_row(Workbench& editor, const ImportEntry& entry, int index, bool has_files) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const importing::ImportRow& row = *entry.row;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(index);
  const bool is_chosen = !row.made.empty() && editor.picks.nodes.contains(row.made.front());
  if (ImGui::Selectable("##row", is_chosen, ImGuiSelectableFlags_SpanAllColumns)) go_to(editor, row);
  note_place(editor, "import/row/" + std::to_string(index));
  if (ImGui::IsItemHovered()) {
    if (!row.made.empty() && editor.scene().nodes.contains(row.made.front())) editor.picks.hovered_node = row.made.front();
    const bool goes = row.place || !nodes_of(editor, row).empty();
    card(editor, title_of(row), why_of(row) + (special_of(row).empty() ? "" : "\n" + special_of(row)),
         nodes_of(editor, row).empty() ? goes ? "press for its place" : "it has no place"
                                       : "press to go to the node made from it");
  }
  ImGui::PopID();
  const RowSign sign = sign_of(theme, row.outcome);
  // In a column of their own, however wide the sign is.
  const ImVec2 at = ImGui::GetItemRectMin();
  ImGui::SameLine(0, 0);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({at.x + theme.px(4), ImGui::GetCursorScreenPos().y}, sign.colour, sign.text);
  list.AddText({at.x + theme.px(24), ImGui::GetCursorScreenPos().y}, c.text, outcome_label(row.outcome));
  ImGui::Dummy({0, 0});
  const auto column = [&](const std::string& text, ImU32 colour) {
    if (!ImGui::TableNextColumn()) return;
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(fitted(text, ImGui::GetContentRegionAvail().x).c_str());
    ImGui::PopStyleColor();
  };
  column(row.kind, c.text_soft);
  column(row.count > 1 ? number(row.count) + " together" : row.id, row.count > 1 ? c.text_soft : c.text);
  column(why_of(row), c.text);
  column(special_of(row), c.text_soft);
  column(place_text(editor, row), row.made.empty() ? c.text_soft : c.text);
  if (has_files) column(*entry.file, c.text_soft);
}

void draw_table(Workbench& editor, ImportList& list) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate | ImGuiTableFlags_ScrollY |
                                     ImGuiTableFlags_Resizable | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                     ImGuiTableFlags_SizingStretchProp;
  const bool has_files = list.files() > 1;
  if (!ImGui::BeginTable("elements", has_files ? kImportColumns : kImportColumns - 1, kFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  struct Column {
    const char* name;
    float weight;
  };
  constexpr Column kColumns[] = {{"Outcome", 1},    {"Kind", 0.8f},  {"Id", 1.3f},  {"Why", 2.6f},
                                 {"Special", 1.8f}, {"Where", 1.5f}, {"File", 1.2f}};
  for (int k = 0; k < (has_files ? kImportColumns : kImportColumns - 1); ++k)
    ImGui::TableSetupColumn(kColumns[k].name, ImGuiTableColumnFlags_WidthStretch, kColumns[k].weight, static_cast<ImGuiID>(k));
  ImGui::TableHeadersRow();
  note_place(editor, "import/heads");
  if (ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs != nullptr && specs->SpecsDirty) {
    if (specs->SpecsCount > 0)
      list.sort(static_cast<ImportColumn>(specs->Specs[0].ColumnUserID),
                specs->Specs[0].SortDirection == ImGuiSortDirection_Descending);
    specs->SpecsDirty = false;
  }
  const std::vector<ImportEntry>& shown = list.shown();
  const float height = std::round(ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()), height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
      draw_row(editor, shown[static_cast<std::size_t>(row)], row, has_files);
  if (shown.empty()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("None");
  }
  ImGui::EndTable();
}

void draw_no_imports(Workbench& editor) {
  ImGui::Dummy({0, editor.theme.px(6)});
  ImGui::TextUnformatted(
      "Nothing was imported into this scene yet. After an import, this list shows every element of the files and its result.");
  ImGui::Dummy({0, editor.theme.px(4)});
  if (ImGui::Button("Import surroundings ...")) editor.dialogs->show_import();
}

}  // namespace

void draw_imports(Workbench& editor) {
  if (!editor.document) return;
  PanelMemory& memory = memory_of(editor);
  ImportList& list = *memory.imports;
  list.follow(editor.document->imports(), editor.document->id(), editor.document->imports_revision());
  if (list.total() == 0) return draw_no_imports(editor);
  const Theme& theme = editor.theme;
  draw_outcomes(editor, list);
  ImGui::SameLine(0, theme.px(12));
  ImGui::SetNextItemWidth(theme.px(190));
  if (ImGui::InputTextWithHint("##search", "id, reason, detail ...", &memory.import_search)) list.search(memory.import_search);
  note_place(editor, "import/search");
  ImGui::SameLine(0, theme.px(8));
  if (ImGui::Button("Write as CSV ...")) editor.dialogs->ask_import_report();
  note_place(editor, "import/csv");
  ImGui::SameLine(0, theme.px(12));
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", reading::counted(list.shown().size(), "row").c_str());
  // Counts take a third of a narrow pane at most.
  draw_groups(editor, list, std::min(theme.px(kGroups), 0.34f * ImGui::GetContentRegionAvail().x));
  ImGui::SameLine(0, theme.px(10));
  ImGui::BeginChild("rows", {0, 0});
  draw_table(editor, list);
  ImGui::EndChild();
}

}  // namespace bl::desktop
