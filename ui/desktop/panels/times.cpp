// The tab Time: what a tick takes and in which of its parts, and who takes it, the slowest first; a press goes there.
#include <algorithm>
#include <cmath>

#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/charts.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"
#include "ui/desktop/panels/scene_view.h"
#include "ui/desktop/panels/statistics_record.h"
#include "ui/desktop/panels/time_list.h"

namespace bl::desktop {

namespace {

using reading::TimeGrouping;
using reading::TimeRow;

constexpr float kTickWidth = 300;  // [points]: the parts of the tick at the left
constexpr auto kSpan = reading::TimeSpan::recent;
constexpr float kPast = 0.65f;  // opacity of figures that are those of before

bool is_resting(const Workbench& editor) { return editor.moment->is_resting; }

ImU32 plain_colour_of_part(const Theme& theme, TickPart part) {
  const Colours& c = theme.colours();
  switch (part) {
    case TickPart::links: return theme.category(0);
    case TickPart::roles: return theme.category(2);
    case TickPart::sets: return theme.category(1);
    // What the engine takes for itself.
    case TickPart::commands: return mixed(c.text_soft, c.panel, 0.1f);
    case TickPart::ports: return mixed(c.text_soft, c.panel, 0.4f);
    case TickPart::publish: return mixed(c.text_soft, c.panel, 0.65f);
  }
  return c.text_faint;
}

ImU32 colour_of_part(const Theme& theme, TickPart part) { return ImGui::GetColorU32(plain_colour_of_part(theme, part)); }

// A count is whole where all ticks agree.
std::string count_text(double count) {
  const double whole = std::round(count);
  return std::abs(count - whole) < 0.005 ? reading::grouped(whole) : reading::readable(count);
}

// The tick as one bar, each part in its colour.
void draw_stack(Workbench& editor, const TimeTable& table) {
  const Theme& theme = editor.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = theme.px(10);
  ImGui::Dummy({width, height + theme.px(4)});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + width, at.y + height}, theme.colours().sunken, theme.px(2));
  const double tick = reading::tick_seconds(table, kSpan);
  double before = 0;
  for (std::size_t k = 0; k < kTickParts && tick > 0; ++k) {
    const auto part = static_cast<TickPart>(k);
    const double share = reading::part_seconds(table, part, kSpan) / tick;
    const float from = at.x + width * static_cast<float>(std::min(1.0, before)),
                to = at.x + width * static_cast<float>(std::min(1.0, before + share));
    before += share;
    if (to - from < 0.5f) continue;
    list.AddRectFilled({from, at.y}, {std::max(from + 1, to - theme.px(1)), at.y + height}, colour_of_part(theme, part));
  }
}

void draw_part(Workbench& editor, const TimeTable& table, TickPart part) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const double seconds = reading::part_seconds(table, part, kSpan), tick = reading::tick_seconds(table, kSpan);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImFont* small = theme.fonts().small;
  const float height = std::round(small->FontSize + theme.px(5)), y = at.y + (height - small->FontSize) / 2;
  ImGui::Dummy({width, height});
  note_place(editor, std::string("times/part/") + reading::label_of(part));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_hovered) list.AddRectFilled(at, {at.x + width, at.y + height}, faded(c.accent, 0.12f), theme.px(3));
  list.AddRectFilled({at.x + theme.px(2), y + theme.px(2)}, {at.x + theme.px(10), y + theme.px(10)}, colour_of_part(theme, part),
                     theme.px(2));
  const auto right = [&](const std::string& text, float edge, ImU32 colour) {
    const float wide = small->CalcTextSizeA(small->FontSize, FLT_MAX, 0, text.c_str()).x;
    list.AddText(small, small->FontSize, {at.x + edge - wide, y}, ImGui::GetColorU32(colour), text.c_str());
  };
  list.AddText(small, small->FontSize, {at.x + theme.px(18), y}, ImGui::GetColorU32(c.text), reading::label_of(part));
  right(reading::duration(seconds), width - theme.px(58), c.text);
  right(tick > 0 ? reading::grouped(100 * seconds / tick, 1) + "\xC2\xA0%" : "", width - theme.px(4), c.text_soft);
  if (is_hovered) card(editor, reading::label_of(part), reading::doc_of(part));
}

void draw_rest(Workbench& editor) {
  const Colours& c = editor.theme.colours();
  ImGui::PushStyleColor(ImGuiCol_Text, c.good);
  ImGui::TextUnformatted(icon::kCheck);
  ImGui::PopStyleColor();
  ImGui::SameLine();
  ImGui::TextUnformatted("At rest: nothing is evaluated.");
}

void draw_tick(Workbench& editor, const TimeTable& table) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const bool rests = is_resting(editor);
  if (rests) draw_rest(editor);
  ImGui::PushFont(theme.fonts().title);
  ImGui::PushStyleColor(ImGuiCol_Text, rests ? c.text_soft : c.text);
  ImGui::TextUnformatted(reading::duration(reading::tick_seconds(table, kSpan)).c_str());
  ImGui::PopStyleColor();
  ImGui::PopFont();
  ImGui::SameLine(0, theme.px(8));
  ImGui::AlignTextToFramePadding();
  small_text(editor, rests ? "a tick, before it came to rest" : "a tick, mean of the last ticks", c.text_soft, -1);
  if (rests) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, kPast);
  draw_stack(editor, table);
  for (std::size_t k = 0; k < kTickParts; ++k) draw_part(editor, table, static_cast<TickPart>(k));
  if (rests) ImGui::PopStyleVar();
  const std::vector<double>& ticks = memory_of(editor).record->tick_ms;
  if (ticks.size() < 2 || ImGui::GetContentRegionAvail().y < theme.px(56)) return;
  ImGui::Dummy({0, theme.px(4)});
  small_text(editor, "the last " + reading::counted(ticks.size(), "tick"), c.text_soft, -1);
  const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  spark_line(theme, at, {at.x + room.x, at.y + std::min(room.y, theme.px(54)) - theme.px(2)}, ticks, c.accent);
}

void draw_groupings(Workbench& editor, TimeList& list) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushFont(theme.fonts().small);
  constexpr std::pair<TimeGrouping, const char*> kGroupings[] = {
      {TimeGrouping::kinds, "Kinds"}, {TimeGrouping::nodes, "Nodes"}, {TimeGrouping::links, "Links"}};
  for (const auto& [grouping, label] : kGroupings) {
    const bool is_on = list.grouping() == grouping;
    ImGui::PushStyleColor(ImGuiCol_Button, is_on ? c.accent_soft : c.raised);
    ImGui::PushStyleColor(ImGuiCol_Text, is_on ? c.text : c.text_soft);
    if (ImGui::Button(label)) list.choose(grouping);
    note_place(editor, std::string("times/by/") + label);
    ImGui::PopStyleColor(2);
    ImGui::SameLine(0, theme.px(4));
  }
  ImGui::PopFont();
  ImGui::SameLine(0, theme.px(12));
  small_text(editor, reading::counted(list.rows().size(), "row"), c.text_soft, -1);
}

void go_to(Workbench& editor, const TimeList& list, const TimeRow& row) {
  if (!ImGui::GetIO().KeyShift) editor.picks.clear();
  for (const std::string& id : list.ids_of(row)) {
    if (row.is_link() && editor.scene().links.contains(id)) editor.picks.links.insert(id);
    if (!row.is_link() && editor.scene().nodes.contains(id)) editor.picks.nodes.insert(id);
  }
  if (!ImGui::IsMouseDoubleClicked(0)) return;
  if (editor.canvas != nullptr) editor.canvas->fit(false);
  if (editor.view != nullptr) editor.view->fit(false);
}

void point_out(Workbench& editor, const TimeList& list, const TimeRow& row) {
  const TimeTable& table = *list.table();
  const bool is_kind = list.grouping() == TimeGrouping::kinds;
  if (!is_kind) (row.is_link() ? editor.picks.hovered_link : editor.picks.hovered_node) = list.ids_of(row).front();
  std::string text = reading::duration(row.seconds) + " a tick";
  if (row.evaluations > 0)
    text +=
        ": " + count_text(row.evaluations) + (row.evaluations == 1 ? " run of " : " runs of ") + reading::duration(row.each());
  if (row.is_analysis) text += "\nand " + reading::duration(row.beside) + " a tick on a thread of its own";
  const std::string facts = "since this list was opened " + reading::duration(row.total_seconds) + " in " +
                            reading::counted(table.ticks.evaluations, "tick") + "\npress to choose " +
                            (is_kind && row.members > 1 ? "all of them" : "it") + ", twice to bring it into sight";
  card(editor, reading::label_of(table, list.grouping(), row), text, facts);
}

void number_cell(const std::string& text, ImU32 colour) {
  if (!ImGui::TableNextColumn()) return;
  const float room = ImGui::GetContentRegionAvail().x, width = ImGui::CalcTextSize(text.c_str()).x;
  if (room > width) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

// A bar as long as the share, in the colour of its part of the tick, and the share at its right end.
void share_cell(Workbench& editor, const TimeRow& row) {
  if (!ImGui::TableNextColumn()) return;
  const Theme& theme = editor.theme;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const std::string text = reading::grouped(100 * row.share, 1) + "\xC2\xA0%";
  const float number = theme.px(52), room = ImGui::GetContentRegionAvail().x, middle = at.y + ImGui::GetTextLineHeight() / 2;
  if (room > number + theme.px(12))
    bar(theme, {at.x, middle - theme.px(4)}, {at.x + room - number, middle + theme.px(4)}, row.share, -1,
        colour_of_part(theme, row.part));
  ImGui::GetWindowDrawList()->AddText({at.x + room - ImGui::CalcTextSize(text.c_str()).x, at.y},
                                      ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
  ImGui::Dummy({0, 0});
}

void draw_row(Workbench& editor, TimeList& list, const TimeRow& row, int index) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const TimeTable& table = *list.table();
  const TimeGrouping grouping = list.grouping();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(index);
  const bool is_chosen = grouping != TimeGrouping::kinds &&
                         (row.is_link() ? editor.picks.links : editor.picks.nodes).contains(list.ids_of(row).front());
  // On the press, not the release: rows may change places in between.
  const bool is_activated = ImGui::Selectable("##row", is_chosen, ImGuiSelectableFlags_SpanAllColumns);
  const bool is_pressed = ImGui::IsItemClicked() || (is_activated && !ImGui::IsMouseReleased(0));
  ImGui::PopID();
  note_place(editor, "times/row/" + std::to_string(index));
  const bool is_hovered = ImGui::IsItemHovered();
  ImGui::SameLine(0, 0);
  ImGui::TextUnformatted(fitted(reading::label_of(table, grouping, row), ImGui::GetContentRegionAvail().x).c_str());
  ImGui::TableNextColumn();
  ImGui::PushStyleColor(ImGuiCol_Text, c.text_soft);
  ImGui::TextUnformatted(fitted(reading::kind_text(grouping, row), ImGui::GetContentRegionAvail().x).c_str());
  ImGui::PopStyleColor();
  number_cell(reading::duration(row.seconds), c.text);
  share_cell(editor, row);
  number_cell(count_text(row.evaluations), c.text);
  if (grouping != TimeGrouping::nodes) number_cell(row.is_link() ? count_text(row.pairs) : std::string(), c.text);
  number_cell(row.evaluations > 0 ? reading::duration(row.each()) : std::string(), c.text);
  if (list.has_beside() && grouping != TimeGrouping::links)
    number_cell(row.is_analysis ? reading::duration(row.beside) : std::string(), c.text);
  number_cell(reading::duration(row.total_seconds), c.text_soft);
  if (is_hovered) point_out(editor, list, row);
  if (is_pressed) go_to(editor, list, row);
}

struct Column {
  TimeColumn column;
  const char* name;
  float weight;
  const char* doc;
};

std::vector<Column> columns_of(const TimeList& list) {
  const TimeGrouping grouping = list.grouping();
  constexpr const char* kWho = "A press on a row chooses it, two bring it into sight.";
  std::vector<Column> columns;
  if (grouping == TimeGrouping::kinds)
    columns = {{TimeColumn::name, "Kind", 1.9f, kWho},
               {TimeColumn::kind, "Of these", 1.5f, "Links, roles of single nodes, or roles over sets of nodes that have run."}};
  else if (grouping == TimeGrouping::nodes)
    columns = {{TimeColumn::name, "Node", 1.9f, kWho},
               {TimeColumn::kind, "Role", 1.5f, "A node has a row for each of its roles."}};
  else columns = {{TimeColumn::name, "Link", 1.9f, kWho}, {TimeColumn::kind, "Kind", 1.5f, "The kind of the link."}};
  columns.push_back({TimeColumn::seconds, "Time", 0.9f, "In a tick, a mean of the last ticks; of all threads together."});
  columns.push_back({TimeColumn::share, "Share", 1.8f, "Of the tick, as the clock sees it."});
  columns.push_back({TimeColumn::evaluations, "Runs", 0.7f, "Evaluations in a tick. What has not changed does not run."});
  if (grouping != TimeGrouping::nodes)
    columns.push_back({TimeColumn::pairs, "Pairs", 0.7f, "Pairs of nodes in a tick, of links to sets."});
  columns.push_back({TimeColumn::each, "Each", 0.9f, "One run."});
  if (list.has_beside() && grouping != TimeGrouping::links)
    columns.push_back({TimeColumn::beside, "Beside", 0.9f, "In a tick, of analyses on a thread of their own."});
  columns.push_back({TimeColumn::total, "Total", 0.9f, "Since this list was opened."});
  return columns;
}

void draw_heads(Workbench& editor, const std::vector<Column>& columns) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (const Column& column : columns) {
    if (!ImGui::TableNextColumn()) continue;
    ImGui::TableHeader(column.name);
    note_place(editor, std::string("times/head/") + column.name);
    if (ImGui::IsItemHovered()) card(editor, column.name, column.doc);
  }
}

void draw_time_table(Workbench& editor, TimeList& list) {
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_Sortable | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Resizable |
                                     ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
  const std::vector<Column> columns = columns_of(list);
  const std::string id = "times " + std::to_string(static_cast<int>(list.grouping())) + " " + std::to_string(columns.size());
  if (!ImGui::BeginTable(id.c_str(), static_cast<int>(columns.size()), kFlags)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  for (const Column& column : columns) {
    const bool is_text = column.column == TimeColumn::name || column.column == TimeColumn::kind;
    ImGuiTableColumnFlags flags = ImGuiTableColumnFlags_WidthStretch;
    if (!is_text) flags |= ImGuiTableColumnFlags_PreferSortDescending;
    if (column.column == TimeColumn::seconds) flags |= ImGuiTableColumnFlags_DefaultSort;
    ImGui::TableSetupColumn(column.name, flags, column.weight, static_cast<ImGuiID>(column.column));
  }
  draw_heads(editor, columns);
  if (ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs(); specs != nullptr && specs->SpecsDirty) {
    if (specs->SpecsCount > 0)
      list.sort(static_cast<TimeColumn>(specs->Specs[0].ColumnUserID),
                specs->Specs[0].SortDirection == ImGuiSortDirection_Descending);
    specs->SpecsDirty = false;
  }
  const std::vector<TimeRow>& rows = list.rows();
  const float height = std::round(ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(rows.size()), height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
      draw_row(editor, list, rows[static_cast<std::size_t>(row)], row);
  ImGui::EndTable();
}

void draw_no_times(Workbench& editor) {
  ImGui::Dummy({0, editor.theme.px(6)});
  if (is_resting(editor)) return draw_rest(editor);
  ImGui::TextUnformatted("Times are measured while this list is open: they come with the next tick.");
}

}  // namespace

void draw_times(Workbench& editor) {
  if (!editor.document) return;
  PanelMemory& memory = memory_of(editor);
  memory.times_frame = ImGui::GetFrameCount();
  TimeList& list = *memory.times;
  list.follow(editor.moment->times);
  if (list.table() == nullptr) return draw_no_times(editor);
  const Theme& theme = editor.theme;
  ImGui::BeginChild("tick", {std::min(theme.px(kTickWidth), 0.3f * ImGui::GetContentRegionAvail().x), 0}, false,
                    ImGuiWindowFlags_NoScrollbar);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {theme.px(8), theme.px(2)});
  draw_tick(editor, *list.table());
  ImGui::PopStyleVar();
  ImGui::EndChild();
  ImGui::SameLine(0, theme.px(18));
  ImGui::BeginChild("who", {0, 0});
  draw_groupings(editor, list);
  if (is_resting(editor)) ImGui::PushStyleVar(ImGuiStyleVar_Alpha, kPast);
  draw_time_table(editor, list);
  if (is_resting(editor)) ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace bl::desktop
