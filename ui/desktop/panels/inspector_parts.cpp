// The smaller parts of the inspector: switches, lists, chips, cards and quiet lines of text.
#include <algorithm>
#include <cctype>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/base/text.h"
#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop {

bool passes_filter(const std::string& filter, const std::string& text) {
  return lower_case(text).find(lower_case(filter)) != std::string::npos;
}

void filter_field(Workbench& editor, float width) {
  PanelMemory& memory = memory_of(editor);
  if (ImGui::IsWindowAppearing()) {
    memory.filter.clear();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(width);
  const std::string hint = std::string(icon::kSearch) + "  search";
  ImGui::InputTextWithHint("##filter", hint.c_str(), &memory.filter);
  note_place(editor, "filter");
}

bool switch_field(Workbench& editor, const std::string& key, bool is_on, bool is_mixed) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushID(key.c_str());
  const float height = ImGui::GetFrameHeight(), width = theme.px(30), knob = theme.px(7);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool is_pressed = press_area("##switch", {theme.px(80), height});
  note_place(editor, key);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float top = at.y + (height - theme.px(18)) / 2, bottom = top + theme.px(18), middle = (top + bottom) / 2;
  const ImU32 ground = is_mixed ? mixed(c.sunken, c.accent, 0.35f) : is_on ? c.accent : c.sunken;
  list.AddRectFilled({at.x, top}, {at.x + width, bottom}, ground, theme.px(9));
  if (!is_on || ImGui::IsItemHovered())
    list.AddRect({at.x, top}, {at.x + width, bottom}, ImGui::IsItemHovered() ? c.accent : c.line, theme.px(9));
  const float x = is_mixed ? at.x + width / 2 : is_on ? at.x + width - theme.px(9) : at.x + theme.px(9);
  list.AddCircleFilled({x, middle}, knob - 1, is_on && !is_mixed ? c.on_accent : c.text_soft, 24);
  const char* word = is_mixed ? "several" : is_on ? "on" : "off";
  list.AddText({at.x + width + theme.px(8), at.y + ImGui::GetStyle().FramePadding.y}, c.text_soft, word);
  ImGui::PopID();
  return is_pressed;
}

bool begin_list(Workbench& editor, const std::string& key, const std::string& shown, float width, ImU32 colour, float before) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushID(key.c_str());
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const bool is_pressed = press_area("##list", {width, ImGui::GetFrameHeight()});
  note_place(editor, key);
  const ImVec2 to = ImGui::GetItemRectMax();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float pad = theme.px(7), arrow = theme.px(4);
  list.AddRectFilled(from, to, ImGui::IsItemHovered() ? mixed(c.sunken, c.accent, 0.12f) : c.sunken,
                     ImGui::GetStyle().FrameRounding);
  const std::string text = fitted(shown, width - 2 * pad - 3 * arrow);
  list.AddText({from.x + pad, from.y + ImGui::GetStyle().FramePadding.y}, colour != 0 ? colour : c.text, text.c_str());
  const ImVec2 tip{to.x - pad - arrow, (from.y + to.y) / 2 + arrow / 2};
  list.AddTriangleFilled({tip.x - arrow, tip.y - arrow}, {tip.x + arrow, tip.y - arrow}, tip, c.text_faint);
  ImGui::PopID();
  const std::string popup = "list " + key;
  if (is_pressed) ImGui::OpenPopup(popup.c_str());
  ImGui::SetNextWindowPos({from.x - before, to.y + theme.px(2)}, ImGuiCond_Appearing);
  ImGui::SetNextWindowSizeConstraints({std::max(width, theme.px(240)), 0}, {theme.px(380), theme.px(420)});
  return ImGui::BeginPopup(popup.c_str());
}

bool list_entry(Workbench& editor, const std::string& label, const std::string& doc, bool is_chosen) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushID(label.c_str());
  const float wrap = std::max(theme.px(220), ImGui::GetContentRegionAvail().x - theme.px(30));
  ImFont* small = theme.fonts().small;
  const float line = ImGui::GetTextLineHeight(), indent = theme.px(20);
  const ImVec2 extent = doc.empty() ? ImVec2(0, 0) : small->CalcTextSizeA(small->FontSize, FLT_MAX, wrap - indent, doc.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = line + extent.y + theme.px(doc.empty() ? 4 : 8);
  const bool is_pressed = ImGui::Selectable("##entry", false, ImGuiSelectableFlags_DontClosePopups, {wrap, height});
  note_place(editor, "entry/" + label);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (is_chosen) list.AddText({at.x, at.y + theme.px(2)}, c.accent, icon::kCheck);
  list.AddText({at.x + indent, at.y + theme.px(2)}, c.text, label.c_str());
  if (!doc.empty())
    list.AddText(small, small->FontSize, {at.x + indent, at.y + theme.px(3) + line}, c.text_soft, doc.c_str(), nullptr,
                 wrap - indent);
  ImGui::PopID();
  return is_pressed;
}

bool sign_button(Workbench& editor, const char* sign, const std::string& hint, ImU32 colour, bool is_shown) {
  const Theme& theme = editor.theme;
  const ImVec2 size{theme.px(20), ImGui::GetFrameHeight()};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(sign);
  const bool is_pressed = press_area("##sign", size);
  ImGui::PopID();
  if (!is_shown && !ImGui::IsItemHovered()) return is_pressed;
  const ImVec2 extent = ImGui::CalcTextSize(sign);
  ImGui::GetWindowDrawList()->AddText({at.x + (size.x - extent.x) / 2, at.y + (size.y - extent.y) / 2},
                                      ImGui::IsItemHovered() ? theme.colours().accent : colour, sign);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", hint.c_str());
  return is_pressed;
}

int chips(Workbench& editor, const std::string& key, const std::vector<std::string>& labels, bool is_fixed, int* clicked) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x, gap = theme.px(4), pad = theme.px(7);
  const float left = ImGui::GetCursorPosX(), height = ImGui::GetTextLineHeight() + theme.px(4),
              cross = is_fixed ? 0 : theme.px(14);
  int removed = -1;
  ImGui::PushID(key.c_str());
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const std::string label = fitted(labels[k], std::max(theme.px(30), right - ImGui::GetWindowPos().x - left - 2 * pad - cross));
    const float width = ImGui::CalcTextSize(label.c_str()).x + 2 * pad + cross;
    if (k > 0) {
      ImGui::SameLine(0, gap);
      if (ImGui::GetCursorScreenPos().x + width > right) {
        ImGui::NewLine();
        ImGui::SetCursorPosX(left);
      }
    }
    ImGui::PushID(static_cast<int>(k));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool is_pressed = press_area("##chip", {width, height});
    note_place(editor, key + "/" + std::to_string(k));
    const bool is_at_cross = !is_fixed && ImGui::IsItemHovered() && ImGui::GetIO().MousePos.x > at.x + width - cross - pad / 2;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::IsItemHovered() ? mixed(c.raised, c.accent, 0.15f) : c.raised,
                       height / 2);
    list.AddText({at.x + pad, at.y + theme.px(2)}, c.text, label.c_str());
    if (!is_fixed)
      list.AddText({at.x + width - cross - theme.px(1), at.y + theme.px(2)}, is_at_cross ? c.bad : c.text_faint, icon::kClose);
    if (is_pressed && is_at_cross) removed = static_cast<int>(k);
    else if (is_pressed && clicked != nullptr) *clicked = static_cast<int>(k);
    ImGui::PopID();
  }
  ImGui::PopID();
  if (!labels.empty()) ImGui::Dummy({0, theme.px(1)});
  return removed;
}

void small_text(Workbench& editor, const std::string& text, ImU32 colour, float wrap_width) {
  ImGui::PushFont(editor.theme.fonts().small);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  if (wrap_width >= 0) ImGui::PushTextWrapPos(wrap_width > 0 ? ImGui::GetCursorPosX() + wrap_width : 0);
  ImGui::TextUnformatted(text.c_str());
  if (wrap_width >= 0) ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  ImGui::PopFont();
}

void card(Workbench& editor, const std::string& heading, const std::string& text, const std::string& facts) {
  const Theme& theme = editor.theme;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(12), theme.px(10)});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(theme.px(340));
  if (!heading.empty()) {
    ImGui::PushFont(theme.fonts().strong);
    ImGui::TextUnformatted(heading.c_str());
    ImGui::PopFont();
  }
  if (!text.empty()) ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  if (!facts.empty()) small_text(editor, facts, theme.colours().text_soft, theme.px(340));
  ImGui::EndTooltip();
  ImGui::PopStyleVar();
}

}  // namespace bl::desktop
