// The steps of this document, the newest last; a press takes back or brings back everything up to it.
#include <cmath>

#include "core/guest/room_guest.h"
#include "core/reading/figures.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_cell.h"
#include "ui/desktop/panels/panels.h"

namespace bl::desktop {

namespace {

std::size_t done_steps(Workbench& editor) {
  std::size_t count = 0;
  for (const host::HistoryStep& step : editor.document->history()) count += step.is_undone ? 0 : 1;
  return count;
}

// Until so many steps are done; stops where one cannot be taken back or brought back.
void go_to_step(Workbench& editor, std::size_t wanted) {
  for (std::size_t done = done_steps(editor); done != wanted;) {
    if (done > wanted) editor.undo();
    else editor.redo();
    const std::size_t now = done_steps(editor);
    if (now == done) return;
    done = now;
  }
}

// Whether it was pressed.
bool draw_step(Workbench& editor, int index, const std::string& label, const std::string& detail, bool is_undone, bool is_current,
               float height) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::PushID(index);
  const bool is_pressed = press_area("##step", {width, height});
  ImGui::PopID();
  note_place(editor, "step/" + std::to_string(index));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (ImGui::IsItemHovered()) list.AddRectFilled(at, {at.x + width, at.y + height}, faded(c.accent, 0.12f), theme.px(3));
  else if (is_current) list.AddRectFilled(at, {at.x + width, at.y + height}, faded(c.accent, 0.07f), theme.px(3));
  const float x = at.x + theme.px(12), middle = at.y + height / 2, y = at.y + (height - ImGui::GetFontSize()) / 2;
  list.AddLine({x, at.y}, {x, at.y + height}, c.line);
  if (is_current) list.AddCircleFilled({x, middle}, theme.px(4.5f), c.accent);
  else list.AddCircleFilled({x, middle}, theme.px(3), is_undone ? c.line : c.text_faint);
  list.AddText({at.x + theme.px(28), y}, is_undone ? c.text_faint : c.text, fitted(label, width - theme.px(240)).c_str());
  ImFont* small = theme.fonts().small;
  const float detail_width = small->CalcTextSizeA(small->FontSize, FLT_MAX, 0, detail.c_str()).x;
  list.AddText(small, small->FontSize, {at.x + width - detail_width - theme.px(8), middle - small->FontSize / 2}, c.text_faint,
               detail.c_str());
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", editor.document->room() != nullptr ? "Undo takes back your own last step"
                            : is_undone                        ? "Redo everything up to here"
                            : is_current                       ? "This is how the scene is now"
                                                               : "Undo everything after this");
  return is_pressed;
}

}  // namespace

void draw_history(Workbench& editor) {
  if (!editor.document) return;
  const std::vector<host::HistoryStep>& steps = editor.document->history();
  const guest::RoomGuest* room = editor.document->room();
  const std::size_t done = done_steps(editor);
  const float height = std::round(ImGui::GetFontSize() + editor.theme.px(8));
  int wanted = -1;
  ImGui::BeginChild("steps", {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(steps.size()) + 1, height);
  while (clipper.Step())
    for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) {
      bool is_hit = false;
      if (row == 0) {
        is_hit = draw_step(editor, 0, room == nullptr ? "Opened" : "Joined", editor.document->name(), false, done == 0, height);
      } else {
        const host::HistoryStep& step = steps[static_cast<std::size_t>(row) - 1];
        const std::string detail = (room == nullptr ? "" : room->people().name_of(step.author.id) + ",  ") + "tick " +
                                   reading::grouped(static_cast<double>(step.tick)) + ",  " +
                                   reading::counted(step.entries, "command");
        is_hit = draw_step(editor, row, step.label, detail, step.is_undone, static_cast<std::size_t>(row) == done, height);
      }
      if (is_hit) wanted = row;
    }
  // The newest step stays in sight when it comes in.
  std::size_t& seen = memory_of(editor).seen_steps;
  if (seen != steps.size()) ImGui::SetScrollHereY(1);
  seen = steps.size();
  ImGui::PopStyleVar();
  ImGui::EndChild();
  // In a room the steps of all stand here, and each takes back their own, the last first.
  if (wanted >= 0 && room == nullptr) go_to_step(editor, static_cast<std::size_t>(wanted));
}

}  // namespace bl::desktop
