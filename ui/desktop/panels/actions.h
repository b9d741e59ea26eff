// Every command of the window, declared once: menus, keys, the command palette and the list of keys are made from it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ui/desktop/panels/workbench.h"

namespace bl::desktop {

/// A key with its modifiers; `key` is GLFW's number.
struct Chord {
  int key = 0;
  bool ctrl = false, shift = false, alt = false;
};
/// "Ctrl+Shift+Z"; empty for no key.
std::string text_of(const Chord& chord);
/// Was it pressed in this frame, with these modifiers and no others?
bool is_pressed(const Chord& chord, bool repeats = false);

/// What a context menu of the canvas stands over.
enum Target : unsigned { on_ground = 1, on_node = 2, on_link = 4, on_frame = 8, on_comment = 16, on_set = 32 };

struct Action {
  const char* menu;         ///< the menu that it stands in: "File", "Edit", "Add", "Canvas", "View", "Clock", "Help"
  const char* label;        ///< as the menu and the palette say it
  Chord chord, other = {};  ///< its keys; the second is a habit from elsewhere
  Area area = Area::none;   ///< keys count only while this area is the active one; none: everywhere
  bool (*can)(const Workbench&) = nullptr;  ///< nothing: always
  void (*run)(Workbench&) = nullptr;
  bool repeats = false;                       ///< a key that is held goes on
  bool (*is_on)(const Workbench&) = nullptr;  ///< for switches: shown with a mark
  bool is_always = false;                     ///< its keys count over open dialogs as well
  unsigned targets = 0;                       ///< the context menus that it stands in, where it can be done
  bool begins_group = false;                  ///< a line goes before it in menus
  const char* submenu = nullptr;              ///< of `menu`, where it stands in one; actions of one submenu stand together
  bool yields_to_fields = false;              ///< its keys are not meant for the choice while keys walk over fields
};

/// All actions, menu by menu, in the order of the menus.
std::span<const Action> actions();
/// Runs the actions whose keys were pressed; not while people type into a field.
void run_pressed_actions(Workbench& editor);
/// The menu bar. A menu that opens under the mouse does not act on the release that opened it; who goes on to an entry with the
/// button held, and lets go there, means it.
void draw_menus(Workbench& editor);

/// For `can`: there is a document; something is chosen.
bool has_document(const Workbench& editor);
bool has_picks(const Workbench& editor);

// Each area declares its own, in the file beside it.
void add_file_actions(std::vector<Action>& list);
void add_edit_actions(std::vector<Action>& list);
void add_canvas_actions(std::vector<Action>& list);
void add_view_actions(std::vector<Action>& list);
void add_clock_actions(std::vector<Action>& list);
void add_help_actions(std::vector<Action>& list);

}  // namespace bl::desktop
