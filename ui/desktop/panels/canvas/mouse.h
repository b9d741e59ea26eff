// What the mouse does on the canvas: pointing, clicking, dragging, wheel.
#pragma once

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// `is_hovered`: nothing lies over the canvas where the cursor is.
void handle_mouse(Board& board, bool is_hovered);
/// Ends a drag without a trace.
void cancel_drag(Board& board);

// Of the drags alone.
void begin_drag(Board& board, int button);
void go_on_dragging(Board& board);
void end_drag(Board& board);

}  // namespace bl::desktop::canvas
