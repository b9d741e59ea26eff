// Frames that are entered: what is shown then, the way back up, and what joins the frame. Each person's own, no part of the
// scene.
#pragma once

#include <string>

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// Brings the model up to the scene. Leaves frames that have gone, and frames that do not hold all that is chosen.
void bring_up_to_date(Board& board);
/// The chosen frame, or the innermost one around the chosen node that is not entered yet; empty where there is none.
std::string frame_to_enter(const Board& board);
/// Shows only what lies in the frame; empty: everything. Further in or out, wherever one is.
void enter_frame(Board& board, const std::string& frame);
void leave_frame(Board& board);
/// Leaves to where the thing behind a door is seen, and chooses it.
void go_through(Board& board, std::size_t door);
/// Leaves frames until the node is among what is shown.
void leave_to_node(Board& board, const std::string& node);

/// Into `patch` of the view: what is new lies in the entered frame. `list` is "nodes" or "comments".
void join_entered(const Board& board, Json& patch, const char* list, const std::string& id);

/// Where the parts of the breadcrumb go, along the upper edge; how much height they take [pixels].
float place_crumbs(Board& board);
void draw_crumbs(Board& board);
void draw_doors(Board& board);

}  // namespace bl::desktop::canvas
