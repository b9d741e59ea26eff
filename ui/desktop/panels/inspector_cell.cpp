// Typing and scrubbing in one field; an input of ImGui exists only while somebody types.
#include "ui/desktop/panels/inspector_cell.h"

#include <algorithm>
#include <utility>

#include <imgui_stdlib.h>

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/inspector_quantity.h"

namespace bl::desktop {

namespace {

constexpr float kScrubThreshold = 3;
constexpr int kFramesToFocus = 8;
constexpr std::size_t kLongText = 60;

void end_typing(PanelMemory& memory) { memory.typing = {}; }

void begin_typing(PanelMemory& memory, const std::string& key, const std::string& start) {
  memory.typing = {key, start, start, true, false, 0};
  if (memory.complaint_key == key) memory.complaint_key.clear();
}

// The input; whether it has been left with another text than it began with.
bool type_into(PanelMemory& memory, float width, bool is_long) {
  Typing& typing = memory.typing;
  if (std::exchange(typing.wants_focus, false)) ImGui::SetKeyboardFocusHere();
  if (is_long) {
    const ImVec2 size{width, ImGui::GetTextLineHeight() * 6 + 2 * ImGui::GetStyle().FramePadding.y};
    ImGui::InputTextMultiline("##typing", &typing.text, size, ImGuiInputTextFlags_CtrlEnterForNewLine);
  } else {
    ImGui::SetNextItemWidth(width);
    ImGui::InputText("##typing", &typing.text, ImGuiInputTextFlags_AutoSelectAll);
  }
  if (ImGui::IsItemActive()) typing.was_active = true;
  // ImGui would hand the only input its own focus back on Tab; here Tab means the next field.
  const bool is_tab = typing.was_active && !is_long && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab), false);
  const bool is_left = typing.was_active && (!ImGui::IsItemActive() || is_tab);
  const bool is_lost = !typing.was_active && ++typing.frames > kFramesToFocus;
  if (!is_left && !is_lost) return false;
  memory.wants_next = is_tab;
  return typing.text != typing.start;
}

void draw_frame(Workbench& editor, const std::string& shown, const CellLook& look, ImVec2 from, ImVec2 to, bool is_hot) {
  const Theme& theme = editor.theme;
  const Colours& c = theme.colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding, pad = theme.px(7);
  if (!look.is_fixed) list.AddRectFilled(from, to, is_hot ? mixed(c.sunken, c.accent, 0.12f) : c.sunken, rounding);
  if (look.fill && !look.is_fixed) {
    const auto share = static_cast<float>(std::clamp(*look.fill, 0.0, 1.0));
    list.PushClipRect(from, {from.x + share * (to.x - from.x), to.y}, true);
    list.AddRectFilled(from, to, mixed(c.sunken, c.accent, is_hot ? 0.38f : 0.26f), rounding);
    list.PopClipRect();
  }
  if (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible) list.AddRect(from, to, c.accent, rounding);
  const std::string text = fitted(shown.empty() ? look.hint : shown, to.x - from.x - (look.is_fixed ? 0 : 2 * pad));
  const ImU32 colour = shown.empty() ? c.text_faint : look.colour != 0 ? look.colour : c.text;
  const float inset = look.is_fixed ? 0 : pad;
  const float x = look.is_right ? to.x - inset - ImGui::CalcTextSize(text.c_str()).x : from.x + inset;
  list.AddText({x, from.y + ImGui::GetStyle().FramePadding.y}, colour, text.c_str());
}

// A drag of the field sideways; a press that does not move is a click.
void scrub(Workbench& editor, const std::string& key, CellEvent& event) {
  PanelMemory& memory = memory_of(editor);
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemActivated()) memory.scrub = {key, false, 0, 0, false};
  // Before anything else: with keyboard navigation Esc lets go of the item in the same frame.
  if (memory.scrub.key == key && memory.scrub.has_moved && !memory.scrub.is_abandoned &&
      ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
    editor.document->running().abandon(memory.scrub.gesture);
    memory.scrub.is_abandoned = true;
  }
  if (memory.scrub.key == key && memory.scrub.has_moved && !memory.scrub.is_abandoned && ImGui::IsItemDeactivated())
    editor.end_gesture(memory.scrub.gesture);
  if (memory.scrub.key != key || memory.scrub.is_abandoned || !ImGui::IsItemActive()) return;
  if (!memory.scrub.has_moved && ImGui::IsMouseDragging(0, kScrubThreshold)) {
    memory.scrub.has_moved = event.has_scrub_begun = true;
    memory.scrub.gesture = editor.new_gesture();
  }
  if (!memory.scrub.has_moved) return;
  event.is_scrubbing = true;
  event.scrubbed = static_cast<double>(io.MouseDelta.x) * (io.KeyShift ? 0.1 : io.KeyCtrl ? 10 : 1);
}

}  // namespace

void note_place(Workbench& editor, const std::string& key) {
  note_area(editor, key, ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

void note_area(Workbench& editor, const std::string& key, const ImVec2& a, const ImVec2& b) {
  PanelMemory& memory = memory_of(editor);
  if (memory.places_frame != ImGui::GetFrameCount()) memory.places.clear();
  memory.places_frame = ImGui::GetFrameCount();
  memory.places[key] = {a.x, a.y, b.x, b.y};
}

std::string fitted(const std::string& text, float width) {
  if (width <= 0 || text.empty()) return "";
  const std::size_t line_end = std::min(text.find('\n'), text.size());
  const std::string line = text.substr(0, std::min<std::size_t>(line_end, 400));
  if (line.size() == text.size() && ImGui::CalcTextSize(line.c_str()).x <= width) return text;
  ImFont* font = ImGui::GetFont();
  const float room = width - ImGui::CalcTextSize("\xE2\x80\xA6").x;
  const char* rest = nullptr;
  font->CalcTextSizeA(ImGui::GetFontSize(), std::max(1.0f, room), 0, line.c_str(), nullptr, &rest);
  return line.substr(0, static_cast<std::size_t>(rest - line.c_str())) + "\xE2\x80\xA6";
}

CellEvent cell(Workbench& editor, const std::string& key, const std::string& shown, const std::string& start, float width,
               const CellLook& look) {
  PanelMemory& memory = memory_of(editor);
  CellEvent event;
  const bool is_long = look.is_long && start.size() > kLongText;
  ImGui::PushID(key.c_str());
  if (!look.is_fixed && memory.wants_next && memory.typing.key.empty()) {
    memory.wants_next = false;
    begin_typing(memory, key, start);
  }
  if (memory.typing.key == key) {
    event.is_typed = type_into(memory, width, is_long);
    event.text = memory.typing.text;
    const bool is_over = event.is_typed || memory.wants_next || (memory.typing.was_active && !ImGui::IsItemActive()) ||
                         memory.typing.frames > kFramesToFocus;
    if (is_over) end_typing(memory);
  } else {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const bool is_pressed = press_area("##cell", {width, ImGui::GetFrameHeight()});
    event.is_hovered = ImGui::IsItemHovered();
    if (look.is_scrubbed && !look.is_fixed) {
      if (event.is_hovered || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
      scrub(editor, key, event);
    }
    const bool was_drag = memory.scrub.key == key && memory.scrub.has_moved;
    if (is_pressed && !look.is_fixed && !was_drag) begin_typing(memory, key, start);
    if (memory.scrub.key == key && !ImGui::IsItemActive()) memory.scrub = {};
    draw_frame(editor, shown, look, from, ImGui::GetItemRectMax(), !look.is_fixed && (event.is_hovered || event.is_scrubbing));
  }
  note_place(editor, key);
  ImGui::PopID();
  return event;
}

void complain(Workbench& editor, const std::string& key, const std::string& sentence) {
  PanelMemory& memory = memory_of(editor);
  memory.complaint_key = key;
  memory.complaint = sentence;
}

void draw_complaint(Workbench& editor, const std::string& key, float width) {
  const PanelMemory& memory = memory_of(editor);
  if (memory.complaint_key != key || memory.complaint.empty()) return;
  small_text(editor, std::string(icon::kError) + " " + memory.complaint + ". The old value stays.", editor.theme.colours().bad,
             width + 2 * editor.theme.px(20));
}

}  // namespace bl::desktop
