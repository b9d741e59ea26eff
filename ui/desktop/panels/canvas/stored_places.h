// Which places of boxes the scene itself keeps: those that people have chosen, and from their first change on all that they see.
#pragma once

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// The automatic layout for everything, as a step of its own, whether places were stored before or not.
void lay_out_all(Board& board);
/// Puts the places that are seen, and stored nowhere, into the step that people have made last. Whether there were any.
bool store_places(Board& board);

}  // namespace bl::desktop::canvas
