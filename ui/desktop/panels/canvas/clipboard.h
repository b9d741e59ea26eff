// Copies of nodes with the links among them, as JSON text that other windows understand.
#pragma once

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// The chosen nodes and comments with the links that begin and end among them; empty where nothing is chosen.
std::string clip_of_choice(const Board& board);
/// Adds what a clip holds under new ids, as one step, and chooses it. With `is_shift`, `place` says how far the copy lies from
/// what was copied, else where its middle comes to lie. Foreign text is refused with a sentence.
bool paste_clip(Board& board, const std::string& text, ImVec2 place, bool is_shift);

void copy_chosen(Board& board);
void cut_chosen(Board& board);
void paste(Board& board);
void duplicate_chosen(Board& board, ImVec2 shift);

}  // namespace bl::desktop::canvas
