// Where things lie: align, distribute, lay out anew, frames and comments. Only the view changes.
#pragma once

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

enum class Alignment { left, right, top, bottom, centre, middle };
void align_chosen(Board& board, Alignment alignment);
/// Equal gaps between the chosen nodes.
void distribute_chosen(Board& board, bool is_across);
/// The automatic layout for the chosen nodes, or for all.
void lay_out_chosen(Board& board);
/// A frame around what is chosen; chosen frames, and those all of whose nodes are chosen, lie in it as they are.
void frame_chosen(Board& board);
/// Makes a change of the view remove the frames as well that it leaves without content: nobody could see or reach them.
void drop_emptied_frames(const Board& board, Json& patch);
/// A comment at a place in the plane, ready to be written.
void add_comment(Board& board, ImVec2 at);
/// Opens the editing of a name or text in its place.
void begin_edit(Board& board, Thing thing, const std::string& id);
void draw_inline_edit(Board& board);
/// Chooses the nearest node in a direction from the chosen one.
void step_choice(Board& board, ImVec2 direction);
/// Shows all that is on the canvas, as far as possible with nothing under the minimap.
void fit_all(Board& board, bool is_soft);
/// Brings it into sight if it is outside.
void show_node(Board& board, const std::string& id);
/// The box around the chosen nodes and comments, if any.
std::optional<Box> box_of_choice(const Board& board);

}  // namespace bl::desktop::canvas
