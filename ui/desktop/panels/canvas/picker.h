// A small search box over a list of choices, at the cursor: type, arrows, Enter; what cannot be chosen says why.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <imgui.h>

#include "ui/desktop/look/theme.h"

namespace bl::desktop::canvas {

struct Board;

struct Choice {
  std::string id, label, detail;
  std::string why_not;  ///< shown grey, with this reason
  ImU32 colour = 0;     ///< of a small mark; 0: none
  int recency = 1000;   ///< the smaller the further up, where the search does not decide
  std::string more;     ///< further words that are searched
  std::string extra;    ///< for whoever made the list
};

struct Picker {
  std::string title, hint, empty_text;
  std::vector<Choice> choices;
  std::function<void(Board&, const Choice&)> taken;
  std::function<void(Board&, const Choice&)> looked_at;  ///< as the marked choice changes
  ImVec2 at;                                             ///< on the screen
  bool is_opening = false, is_open = false;

  std::string text;
  std::vector<std::size_t> shown;
  std::vector<float> heights;  ///< of the shown ones, in pixels
  float measured_for = -1;     ///< the width that they were measured for; less than 0: not yet
  std::size_t marked = 0;
  std::string filtered_for;
};

/// A description in two lines at most; what has no room in them ends with dots.
struct TwoLines {
  std::string first, second;
  bool is_cut = false;
};
TwoLines in_two_lines(const Theme& theme, const std::string& text, float width);

/// Opens with a list at a place on the screen.
void open_picker(Board& board, Picker picker);
/// Draws it while it is open; runs `taken` for what is chosen.
void draw_picker(Board& board);

}  // namespace bl::desktop::canvas
