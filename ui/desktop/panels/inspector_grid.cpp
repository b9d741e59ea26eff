// Tables and lists of points: rows of typed cells below a line that folds them away.
#include <algorithm>

#include "core/define/codec.h"
#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_quantity.h"
#include "ui/desktop/panels/inspector_value.h"

namespace bl::desktop {

namespace {

constexpr int kRowsInSight = 8;

// What a person did to the grid.
struct GridEdit {
  enum class What { none, set, add, remove } what = What::none;
  std::size_t row = 0, column = 0;
  Scalar value = 0.0;
};

struct Grid {
  std::string key;
  std::vector<ColumnDefinition> columns;
  std::size_t rows = 0;
  std::function<Scalar(std::size_t, std::size_t)> get;
  bool is_fixed = false;
  std::string noun;
};

// The line that shows how much there is, and folds it in and out.
bool is_unfolded(Workbench& editor, const Grid& grid, bool is_mixed, float width) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushID(grid.key.c_str());
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("unfolded");
  bool is_open = storage.GetBool(id, false);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  if (press_area("##fold", {width, ImGui::GetFrameHeight()}) && !is_mixed) storage.SetBool(id, is_open = !is_open);
  note_place(editor, grid.key);
  ImGui::PopID();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float middle = at.y + ImGui::GetFrameHeight() / 2, r = theme.px(3.5f), x = at.x + theme.px(5);
  const ImU32 colour = ImGui::IsItemHovered() ? c.accent : c.text_faint;
  if (is_open) list.AddTriangleFilled({x - r, middle - r / 2}, {x + r, middle - r / 2}, {x, middle + r}, colour);
  else list.AddTriangleFilled({x - r / 2, middle - r}, {x - r / 2, middle + r}, {x + r, middle}, colour);
  const std::string text = is_mixed ? "several" : grid.rows == 0 ? "none" : reading::counted(grid.rows, grid.noun);
  list.AddText({at.x + theme.px(15), at.y + ImGui::GetStyle().FramePadding.y}, grid.is_fixed ? c.text_soft : c.text,
               text.c_str());
  return is_open && !is_mixed;
}

// Typed text as a value of the column, or a complaint at the grid.
bool read_field(Workbench& editor, const Grid& grid, const ColumnDefinition& column, const std::string& text, double now,
                Scalar& out) {
  if (column.is_text) {
    out = text;
    return true;
  }
  const auto number = typed_number(text, column.unit, now);
  std::string refusal = number ? "" : number.error().message;
  if (number) {
    PortDefinition port;
    port.unit = column.unit;
    port.hard_minimum = column.minimum;
    port.hard_maximum = column.maximum;
    if (auto checked = check_value(port, *number, ""); !checked) refusal = checked.error().message;
  }
  if (!refusal.empty()) {
    complain(editor, grid.key, "`" + text + "` was refused for " + label_of(column.id) + ": " + refusal);
    return false;
  }
  out = *number;
  return true;
}

std::string field_text(const Scalar& field, bool is_fixed) {
  if (const double* number = std::get_if<double>(&field))
    return is_fixed ? reading::readable(*number) : shown_number(*number, Unit::none);
  if (const auto* numbers = std::get_if<Numbers>(&field)) return reading::counted((*numbers)->size(), "number");
  if (const auto* indices = std::get_if<Indices>(&field)) return reading::counted((*indices)->size(), "number");
  return std::get<std::string>(field);
}

void draw_field(Workbench& editor, const Grid& grid, std::size_t r, std::size_t c, float width, GridEdit& edit) {
  const ColumnDefinition& column = grid.columns[c];
  const Scalar value = grid.get(r, c);
  const double* number = std::get_if<double>(&value);
  CellLook look;
  // Lists are for programs: nobody edits a hundred thousand fields.
  look.is_fixed = grid.is_fixed || column.list != ListOf::nothing;
  look.is_right = number != nullptr;
  if (value == column.default_value && !column.is_required) look.colour = editor.theme.colours().text_faint;
  const std::string key = grid.key + "/" + std::to_string(r) + "/" + column.id;
  const std::string shown = field_text(value, grid.is_fixed);
  const std::string start = number ? typed_form(*number, column.unit) : shown;
  const CellEvent event = cell(editor, key, shown, start, width, look);
  if (!event.is_typed) return;
  Scalar fresh;
  if (!read_field(editor, grid, column, event.text, number ? *number : 0, fresh)) return;
  edit = {GridEdit::What::set, r, c, std::move(fresh)};
}

void draw_heads(Workbench& editor, const Grid& grid) {
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (std::size_t c = 0; c < grid.columns.size(); ++c) {
    const ColumnDefinition& column = grid.columns[c];
    ImGui::TableSetColumnIndex(static_cast<int>(c) + 1);
    const std::string unit(info(column.unit).pretty);
    small_text(editor, label_of(column.id) + (unit.empty() ? "" : " [" + unit + "]"), editor.theme.colours().text_soft, -1);
    if (ImGui::IsItemHovered()) card(editor, label_of(column.id), column.doc);
  }
}

GridEdit draw_rows(Workbench& editor, const Grid& grid) {
  const Theme& theme = editor.theme;
  GridEdit edit;
  const float line = ImGui::GetFrameHeight() + theme.px(2);
  const auto seen = static_cast<float>(std::min<std::size_t>(grid.rows, kRowsInSight));
  const float height = theme.px(24) + line * std::max(1.0f, seen) + theme.px(12);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {theme.px(2), theme.px(1)});
  const auto flags =
      ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoKeepColumnsVisible;
  if (ImGui::BeginTable("grid", static_cast<int>(grid.columns.size()) + 1, flags, {0, height})) {
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("#", 0, theme.px(grid.is_fixed ? 24.0f : 40.0f));
    for (const ColumnDefinition& column : grid.columns) {
      const float head = ImGui::CalcTextSize((column.id + " [m2]").c_str()).x;
      ImGui::TableSetupColumn(column.id.c_str(), 0, std::max(theme.px(column.is_text ? 96.0f : 66.0f), head));
    }
    draw_heads(editor, grid);
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(grid.rows), line);
    while (clipper.Step())
      for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
        const auto r = static_cast<std::size_t>(row);
        ImGui::PushID(row);
        ImGui::TableNextRow(0, line);
        ImGui::TableSetColumnIndex(0);
        if (!grid.is_fixed) {
          const float top = ImGui::GetCursorScreenPos().y, mouse = ImGui::GetIO().MousePos.y;
          const bool is_near = ImGui::IsWindowHovered() && mouse >= top && mouse < top + line;
          if (sign_button(editor, icon::kClose, "Remove this row", theme.colours().text_faint, is_near))
            edit = {GridEdit::What::remove, r, 0, 0.0};
          note_place(editor, grid.key + "/" + std::to_string(r) + "/remove");
          ImGui::SameLine(0, 0);
        }
        ImGui::AlignTextToFramePadding();
        small_text(editor, std::to_string(row), theme.colours().text_faint, -1);
        for (std::size_t c = 0; c < grid.columns.size(); ++c) {
          ImGui::TableSetColumnIndex(static_cast<int>(c) + 1);
          draw_field(editor, grid, r, c, ImGui::GetContentRegionAvail().x, edit);
        }
        ImGui::PopID();
      }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  return edit;
}

GridEdit draw_grid(Workbench& editor, const Grid& grid, bool is_mixed, float width) {
  GridEdit edit;
  // Unfolded rows take the whole width of the panel, below label and line.
  if (!is_unfolded(editor, grid, is_mixed, width)) return edit;
  ImGui::PushID(grid.key.c_str());
  ImGui::EndGroup();
  ImGui::SetCursorPosX(ImGui::GetCursorStartPos().x);
  if (grid.rows > 0) edit = draw_rows(editor, grid);
  if (!grid.is_fixed) {
    ImGui::PushFont(editor.theme.fonts().small);
    const std::string label = std::string(icon::kPlus) + "  add a " + grid.noun;
    if (ImGui::Button(label.c_str())) edit = {GridEdit::What::add, grid.rows, 0, 0.0};
    note_place(editor, grid.key + "/add");
    ImGui::PopFont();
  }
  ImGui::BeginGroup();
  ImGui::PopID();
  return edit;
}

}  // namespace

std::optional<Change> points_field(Workbench& editor, const Subject& subject, float width) {
  const auto& points = *std::get<Shared<std::vector<Point3>>>(subject.value);
  Grid grid{subject.key, {}, points.size(), {}, subject.is_fixed, "point"};
  for (const char* id : {"x", "y", "z"})
    grid.columns.push_back({.id = id,
                            .is_required = true,
                            .unit = subject.unit,
                            .minimum = -kCoordinateLimit,
                            .maximum = kCoordinateLimit,
                            .doc = ""});
  constexpr double Vector3::*kParts[] = {&Vector3::x, &Vector3::y, &Vector3::z};
  grid.get = [&](std::size_t r, std::size_t c) { return Scalar(points[r].*kParts[c]); };
  const GridEdit edit = draw_grid(editor, grid, subject.is_mixed, width);
  if (edit.what == GridEdit::What::none) return std::nullopt;
  std::vector<Point3> fresh = points;
  if (edit.what == GridEdit::What::set) fresh[edit.row].*kParts[edit.column] = std::get<double>(edit.value);
  if (edit.what == GridEdit::What::remove) fresh.erase(fresh.begin() + static_cast<std::ptrdiff_t>(edit.row));
  if (edit.what == GridEdit::What::add) fresh.push_back(fresh.empty() ? Point3{} : fresh.back());
  return constant(Shared<std::vector<Point3>>(std::move(fresh)));
}

std::optional<Change> table_field(Workbench& editor, const Subject& subject, float width) {
  const Table& table = *std::get<Shared<Table>>(subject.value);
  const auto& columns = subject.port->columns;
  const auto field = [&](std::size_t r, std::size_t c) {
    return c < table.rows[r].size() ? table.rows[r][c] : columns[c].default_value;
  };
  const Grid grid{subject.key, columns, table.rows.size(), field, subject.is_fixed, "row"};
  const GridEdit edit = draw_grid(editor, grid, subject.is_mixed, width);
  if (edit.what == GridEdit::What::none) return std::nullopt;
  Table fresh = table;
  fresh.columns.clear();
  for (const ColumnDefinition& column : columns) fresh.columns.push_back(column.id);
  if (edit.what == GridEdit::What::set) fresh.rows[edit.row][edit.column] = edit.value;
  if (edit.what == GridEdit::What::remove) fresh.rows.erase(fresh.rows.begin() + static_cast<std::ptrdiff_t>(edit.row));
  if (edit.what == GridEdit::What::add) {
    auto& row = fresh.rows.emplace_back();
    for (const ColumnDefinition& column : columns) row.push_back(column.default_value);
  }
  return constant(Shared<Table>(std::move(fresh)));
}

}  // namespace bl::desktop
