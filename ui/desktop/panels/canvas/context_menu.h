// Context menus of the canvas: what can be done with what lies under the cursor, taken from the one list of actions.
#pragma once

#include <vector>

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop {
struct Action;
}

namespace bl::desktop::canvas {

/// Opens it over a thing, and chooses that thing where it is not chosen yet. Switches and the minimap have none.
void open_menu(Board& board, const Hit& over, ImVec2 screen);
/// The same from the keyboard: over what is chosen, or over the ground.
void open_menu_of_choice(Board& board);
/// What the open menu offers now.
std::vector<const Action*> offered(const Board& board);
/// Draws it while it is open, and runs what is taken from it.
void draw_menu(Board& board);

}  // namespace bl::desktop::canvas
