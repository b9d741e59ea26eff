// Fields of the inspector: what stands in them is shown calmly, a click types into it, a drag scrubs it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

struct CellLook {
  ImU32 colour = 0;            ///< of the text; 0: the body's
  std::optional<double> fill;  ///< share of the soft range, for the slider behind the number
  bool is_scrubbed = false;    ///< can be dragged
  bool is_fixed = false;       ///< cannot be changed
  bool is_long = false;        ///< a text of several lines
  bool is_right = false;       ///< set at the right edge, as in columns of numbers
  const char* hint = "";       ///< shown where there is no text
};

/// What a person did with a cell in this frame.
struct CellEvent {
  bool is_typed = false;
  std::string text;  ///< what was typed
  bool has_scrub_begun = false, is_scrubbing = false;
  double scrubbed = 0;  ///< pixels in this frame, with Shift and Ctrl counted in
  bool is_hovered = false;
};

/// One field. `key` is its own among all fields that are seen; `shown` stands there, `start` is what typing starts from.
CellEvent cell(Workbench& editor, const std::string& key, const std::string& shown, const std::string& start, float width,
               const CellLook& look = {});

/// A search field that filters a list; gets the keyboard when its popup opens.
void filter_field(Workbench& editor, float width);
bool passes_filter(const std::string& filter, const std::string& text);

/// A switch with two states; whether it was switched.
bool switch_field(Workbench& editor, const std::string& key, bool is_on, bool is_mixed);
/// A field that opens a list; true while the list is open (then ImGui::EndPopup has to follow). `before`: how far to the left of
/// the field the list begins.
bool begin_list(Workbench& editor, const std::string& key, const std::string& shown, float width, ImU32 colour = 0,
                float before = 0);
/// An entry of such a list: label, and a quieter line below it.
bool list_entry(Workbench& editor, const std::string& label, const std::string& doc, bool is_chosen);
/// A small sign that can be pressed.
bool sign_button(Workbench& editor, const char* sign, const std::string& hint, ImU32 colour, bool is_shown = true);

/// Words and small boxes that flow from line to line; each may have a cross to take it away. Index of the one that was, or -1.
int chips(Workbench& editor, const std::string& key, const std::vector<std::string>& labels, bool is_fixed,
          int* clicked = nullptr);

/// The text, shortened with an ellipsis where it is wider than `width`.
std::string fitted(const std::string& text, float width);
/// Remembers where a field stands.
void note_place(Workbench& editor, const std::string& key);
/// The same of what is no field, from its upper left to its lower right corner.
void note_area(Workbench& editor, const std::string& key, const ImVec2& a, const ImVec2& b);
/// A card with a heading and quieter lines, at the mouse.
void card(Workbench& editor, const std::string& heading, const std::string& text, const std::string& facts = "");
void small_text(Workbench& editor, const std::string& text, ImU32 colour, float wrap_width = 0);
/// Refuses what was typed into a field, with a sentence that stays until the next try.
void complain(Workbench& editor, const std::string& key, const std::string& sentence);
void draw_complaint(Workbench& editor, const std::string& key, float width);

}  // namespace bl::desktop
