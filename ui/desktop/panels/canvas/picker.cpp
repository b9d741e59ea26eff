// Filters by the typed letters, walks by arrows, takes by Enter or click.
#include "ui/desktop/panels/canvas/picker.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include <GLFW/glfw3.h>
#include <imgui_stdlib.h>

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/look/fuzzy.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/inspector_cell.h"

namespace bl::desktop::canvas {

namespace {

constexpr const char* kPickerName = "canvas picker";
constexpr float kWidth = 380, kRow = 38, kLine = 15, kMostHeight = 400, kLeft = 24, kRight = 8;

void filter(Picker& picker) {
  picker.shown.clear();
  std::vector<std::pair<int, std::size_t>> scored;
  for (std::size_t k = 0; k < picker.choices.size(); ++k) {
    const Choice& choice = picker.choices[k];
    int score = 0;
    if (!picker.text.empty()) {
      score = std::max(fuzzy_score(picker.text, choice.label) * 2,
                       fuzzy_score(picker.text, choice.label + " " + choice.id + " " + choice.more));
      if (score < 0) continue;
    }
    scored.emplace_back(score, k);
  }
  std::stable_sort(scored.begin(), scored.end(), [&](const auto& a, const auto& b) {
    const Choice &x = picker.choices[a.second], &y = picker.choices[b.second];
    if (x.why_not.empty() != y.why_not.empty()) return x.why_not.empty();
    if (a.first != b.first) return a.first > b.first;
    return x.recency < y.recency;
  });
  for (const auto& [score, k] : scored) picker.shown.push_back(k);
  picker.marked = 0;
  picker.measured_for = -1;
  picker.filtered_for = picker.text;
}

const std::string& below_of(const Choice& choice) { return choice.why_not.empty() ? choice.detail : choice.why_not; }

float room_of(const Theme& theme, float width) { return width - theme.px(kLeft + kRight); }

float height_of(const Theme& theme, const Choice& choice, float width) {
  const TwoLines lines = in_two_lines(theme, below_of(choice), room_of(theme, width));
  return theme.px(kRow + (lines.second.empty() ? 0 : kLine));
}

// Of all shown choices, once for each list and width: breaking thousands of texts into lines takes longer than a frame.
void measure(Picker& picker, const Theme& theme, float width) {
  if (picker.measured_for == width) return;
  picker.heights.clear();
  for (const std::size_t k : picker.shown) picker.heights.push_back(height_of(theme, picker.choices[k], width));
  picker.measured_for = width;
}

// Whatever had to be cut, in full.
void draw_tip(const Theme& theme, const std::string& label, const std::string& below) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(theme.px(kWidth));
  ImGui::TextUnformatted(label.c_str());
  ImGui::TextUnformatted(below.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

// One choice: its name, and below it what it is, or why it cannot be had. Whether it was clicked.
bool draw_choice(Board& board, const Choice& choice, bool is_marked, bool& is_pointed_at) {
  const Theme& theme = board.theme();
  const Colours& c = theme.colours();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, room = room_of(theme, width);
  const TwoLines lines = in_two_lines(theme, below_of(choice), room);
  const ImVec2 size{width, theme.px(kRow + (lines.second.empty() ? 0 : kLine))};
  const bool is_clicked = press_area("choice", size);
  is_pointed_at = ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const bool can = choice.why_not.empty();
  if (is_marked) list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, can ? c.accent_soft : c.sunken, theme.px(4));
  if (choice.colour != 0)
    list.AddCircleFilled({at.x + theme.px(12), at.y + theme.px(13)}, theme.px(4), can ? choice.colour : c.text_faint, 12);
  const float left = at.x + theme.px(kLeft);
  const std::string label = fitted(choice.label, room);
  list.AddText(theme.fonts().body, theme.fonts().body->FontSize, {left, at.y + theme.px(3)}, can ? c.text : c.text_faint,
               label.c_str());
  ImFont* small = theme.fonts().small;
  const ImU32 soft = can ? c.text_soft : c.text_faint;
  list.AddText(small, small->FontSize, {left, at.y + theme.px(20)}, soft, lines.first.c_str());
  if (!lines.second.empty())
    list.AddText(small, small->FontSize, {left, at.y + theme.px(20 + kLine)}, soft, lines.second.c_str());
  if (ImGui::IsItemHovered() && (lines.is_cut || label != choice.label)) draw_tip(theme, choice.label, below_of(choice));
  return is_clicked;
}

void mark(Board& board, std::size_t place) {
  Picker& picker = board.picker;
  if (picker.shown.empty() || picker.marked == place) return;
  picker.marked = place;
  if (picker.looked_at) picker.looked_at(board, picker.choices[picker.shown[place]]);
}

// Up and Down walk the list while the text keeps the keyboard.
int walk(ImGuiInputTextCallbackData* data) {
  *static_cast<int*>(data->UserData) = data->EventKey == ImGuiKey_UpArrow ? -1 : 1;
  return 0;
}

bool draw_search(Board& board, int& step) {
  Picker& picker = board.picker;
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  const bool is_entered =
      ImGui::InputTextWithHint("##search", picker.hint.c_str(), &picker.text,
                               ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory, walk, &step);
  if (picker.text != picker.filtered_for || ImGui::IsWindowAppearing()) {
    filter(picker);
    if (!picker.shown.empty() && picker.looked_at && !picker.text.empty())
      picker.looked_at(board, picker.choices[picker.shown.front()]);
  }
  return is_entered;
}

// The list; the place of the choice that was clicked, or the number of shown ones.
std::size_t draw_list(Board& board, bool has_walked) {
  Picker& picker = board.picker;
  const Theme& theme = board.theme();
  std::size_t clicked = picker.shown.size();
  // As if it had a scroll bar: with one, lines are no longer than they were measured.
  const float width = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
  measure(picker, theme, width);
  const float height = std::clamp(std::accumulate(picker.heights.begin(), picker.heights.end(), theme.px(4)), theme.px(kRow + 4),
                                  theme.px(kMostHeight));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, 0});
  ImGui::BeginChild("list", {0, height}, false, ImGuiWindowFlags_NoNav);
  if (picker.shown.empty()) ImGui::TextDisabled("%s", picker.empty_text.c_str());
  float y = 0, skipped = 0;  // rows that are out of sight are one gap
  const float low = ImGui::GetScrollY(), high = low + height;
  const auto leave_gap = [&] {
    if (skipped > 0) ImGui::Dummy({1, skipped});
    skipped = 0;
  };
  for (std::size_t place = 0; place < picker.shown.size(); ++place) {
    const float row = picker.heights[place], top = std::exchange(y, y + row);
    const bool is_walked_to = place == picker.marked && has_walked;
    if (!is_walked_to && (top + row < low || top > high)) {
      skipped += row;
      continue;
    }
    leave_gap();
    ImGui::PushID(static_cast<int>(place));
    bool is_pointed_at = false;
    if (draw_choice(board, picker.choices[picker.shown[place]], place == picker.marked, is_pointed_at)) clicked = place;
    if (is_pointed_at) mark(board, place);
    if (is_walked_to) ImGui::SetScrollHereY(0.5f);
    ImGui::PopID();
  }
  leave_gap();
  ImGui::EndChild();
  ImGui::PopStyleVar();
  return clicked;
}

void place_window(Board& board) {
  const Theme& theme = board.theme();
  const ImVec2 screen = ImGui::GetIO().DisplaySize, size{theme.px(kWidth), theme.px(kMostHeight + 90)};
  const ImVec2 at{std::clamp(board.picker.at.x, 0.0f, std::max(0.0f, screen.x - size.x)),
                  std::clamp(board.picker.at.y, 0.0f, std::max(0.0f, screen.y - size.y))};
  ImGui::SetNextWindowPos(at);
  ImGui::SetNextWindowSize({size.x, 0});
}

}  // namespace

TwoLines in_two_lines(const Theme& theme, const std::string& text, float width) {
  const ImFont& font = *theme.fonts().small;
  const char *begin = text.c_str(), *end = begin + text.size();
  const char* turn = font.CalcWordWrapPositionA(1, begin, end, std::max(1.0f, width));
  TwoLines lines{{begin, turn}, "", false};
  while (turn < end && *turn == ' ') ++turn;
  if (turn == end) return lines;
  lines.second = turn;
  if (font.CalcTextSizeA(font.FontSize, 1e9f, 0, turn, end).x <= width) return lines;
  constexpr const char* kDots = "\xe2\x80\xa6";
  const float room = width - font.CalcTextSizeA(font.FontSize, 1e9f, 0, kDots).x;
  const char* rest = turn;
  font.CalcTextSizeA(font.FontSize, std::max(1.0f, room), 0, turn, end, &rest);
  lines.second = std::string(turn, rest) + kDots;
  lines.is_cut = true;
  return lines;
}

void open_picker(Board& board, Picker picker) {
  board.picker = std::move(picker);
  board.picker.is_opening = true;
  filter(board.picker);
}

void draw_picker(Board& board) {
  Picker& picker = board.picker;
  if (picker.is_opening) ImGui::OpenPopup(kPickerName);
  picker.is_opening = false;
  place_window(board);
  picker.is_open = ImGui::BeginPopup(
      kPickerName, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  if (!picker.is_open) return;
  if (!picker.title.empty()) {
    ImGui::PushFont(board.theme().fonts().small);
    ImGui::TextDisabled("%s", picker.title.c_str());
    ImGui::PopFont();
  }
  int step = 0;
  const bool is_entered = draw_search(board, step);
  const std::size_t count = picker.shown.size();
  if (step != 0 && count > 0) mark(board, (picker.marked + (step > 0 ? 1 : count - 1)) % count);
  std::size_t taken = draw_list(board, step != 0);
  if (is_entered && picker.marked < count) taken = picker.marked;
  const bool is_left = ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false);
  bool is_done = is_left;
  if (taken < count) {
    const Choice choice = picker.choices[picker.shown[taken]];
    if (choice.why_not.empty()) {
      is_done = true;
      // It may change the scene, or open the next list: after all of this has been drawn.
      board.after_frame = [choice, action = picker.taken](Board& b) { action(b, choice); };
    } else {
      board.editor.notify(NoticeKind::told, choice.why_not);
      ImGui::SetKeyboardFocusHere(-1);
    }
  }
  if (is_done) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace bl::desktop::canvas
