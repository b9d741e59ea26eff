// Rows, sections and headings: one grid of labels and fields for everything that can be inspected.
#include <algorithm>

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector.h"

namespace bl::desktop {

RowEvent begin_row(Workbench& editor, const std::string& key, const std::string& label, const std::string& doc,
                   const std::string& facts, const RowSigns& signs, float& width) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  RowEvent event;
  ImGui::PushID(key.c_str());
  const float room = ImGui::GetContentRegionAvail().x, left = ImGui::GetCursorPosX(), top = ImGui::GetCursorPosY();
  const float label_width = std::clamp(0.36f * room, theme.px(84), theme.px(150)), sign = theme.px(20);
  const float row = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  press_area("##label", {label_width - theme.px(6), row});
  const bool is_hovered = ImGui::IsItemHovered();
  const std::string text = fitted(label, label_width - theme.px(10));
  ImGui::GetWindowDrawList()->AddText({at.x, at.y + ImGui::GetStyle().FramePadding.y}, is_hovered ? c.text : c.text_soft,
                                      text.c_str());
  if (is_hovered && (!doc.empty() || !facts.empty())) card(editor, label, doc, facts);
  // The signs come first, so that a field may grow below them; they are quiet until the mouse is in the row.
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool is_in_row =
      ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) && mouse.y >= at.y && mouse.y < at.y + row;
  float x = left + room;
  const auto place = [&](const char* icon, const std::string& hint, ImU32 colour, bool is_shown, const char* name) {
    x -= sign;
    ImGui::SetCursorPos({x, top});
    const bool is_pressed = sign_button(editor, icon, hint, colour, is_shown);
    note_place(editor, key + "/" + name);
    return is_pressed;
  };
  if (signs.can_lock) {
    const std::string hint = signs.is_locked ? "Locked: links cannot change the value. Press to unlock it."
                                             : "Lock the value, so that links cannot change it.";
    event.wants_lock = place(signs.is_locked ? icon::kLock : icon::kUnlock, hint, signs.is_locked ? c.accent : c.text_faint,
                             signs.is_locked || is_in_row, "lock");
  } else x -= sign;  // signs of one sort stand below each other
  if (signs.can_reset) event.wants_reset = place(icon::kReset, "Back to the default", c.text_faint, true, "reset");
  if (signs.can_drive && is_in_row)
    event.wants_drive = place("\xC6\x92", "Drive it by an expression ...", c.text_faint, true, "drive");
  width = left + room - 2 * sign - (left + label_width);
  ImGui::SetCursorPos({left + label_width, top});
  ImGui::BeginGroup();
  return event;
}

void end_row() {
  ImGui::EndGroup();
  ImGui::PopID();
}

bool section(Workbench& editor, const std::string& key, const std::string& label, const std::string& doc, bool* wants_removal) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImGui::PushID(key.c_str());
  ImGui::Dummy({0, theme.px(4)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = theme.px(26), left = ImGui::GetCursorPosX(),
              top = ImGui::GetCursorPosY();
  ImGuiStorage& storage = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("folded");
  bool is_folded = storage.GetBool(id, false);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddLine({at.x, at.y}, {at.x + width, at.y}, c.line);
  ImGui::SetCursorPos({left, top + theme.px(4)});
  if (press_area("##section", {width - theme.px(24), height})) storage.SetBool(id, is_folded = !is_folded);
  note_place(editor, "section/" + key);
  const bool is_hovered = ImGui::IsItemHovered();
  if (is_hovered && !doc.empty()) card(editor, label, doc);
  const float middle = at.y + theme.px(4) + height / 2, r = theme.px(3.5f), x = at.x + r;
  const ImU32 colour = is_hovered ? c.accent : c.text_faint;
  if (is_folded) list.AddTriangleFilled({x - r / 2, middle - r}, {x - r / 2, middle + r}, {x + r, middle}, colour);
  else list.AddTriangleFilled({x - r, middle - r / 2}, {x + r, middle - r / 2}, {x, middle + r}, colour);
  ImFont* font = theme.fonts().strong;
  list.AddText(font, font->FontSize, {at.x + theme.px(14), middle - font->FontSize / 2}, c.text, label.c_str());
  if (wants_removal != nullptr) {
    ImGui::SetCursorPos({left + width - theme.px(20), top + theme.px(4)});
    *wants_removal = sign_button(editor, icon::kClose, "Remove this", c.text_faint, is_hovered);
    note_place(editor, "section/" + key + "/remove");
  }
  ImGui::SetCursorPos({left, top + height + theme.px(8)});
  ImGui::PopID();
  return !is_folded;
}

void heading(Workbench& editor, const std::string& name, const std::string& below, ImU32 colour) {
  const Theme& theme = editor.theme;
  ImGui::PushFont(theme.fonts().title);
  const std::string text = fitted(name, ImGui::GetContentRegionAvail().x);
  if (colour != 0) ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  if (colour != 0) ImGui::PopStyleColor();
  ImGui::PopFont();
  small_text(editor, below, theme.colours().text_soft);
  ImGui::Dummy({0, theme.px(4)});
}

void draw_ghost(Workbench& editor, const std::string& json, const std::string& note) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  small_text(editor, std::string(icon::kWarning) + "  " + note, c.warning);
  const float pad = theme.px(8), wrap = ImGui::GetContentRegionAvail().x - 2 * pad;
  ImFont* font = theme.fonts().small;
  constexpr std::size_t kMost = 2000;
  const std::string text = json.size() > kMost ? json.substr(0, kMost) + " ..." : json;
  const ImVec2 extent = font->CalcTextSizeA(font->FontSize, FLT_MAX, wrap, text.c_str());
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::Dummy({wrap + 2 * pad, extent.y + 2 * pad});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, ImGui::GetItemRectMax(), c.sunken, ImGui::GetStyle().FrameRounding);
  list.AddText(font, font->FontSize, {at.x + pad, at.y + pad}, c.text_faint, text.c_str(), nullptr, wrap);
}

}  // namespace bl::desktop
