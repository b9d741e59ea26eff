// The layers of the canvas, from the ground up; each draws what is in sight.
#pragma once

#include <string_view>

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// Text of a height in pixels, cut with "…" where it is wider than `room`; returns its width.
float draw_text(const Board& board, ImVec2 at, float pixels, ImU32 colour, std::string_view text, float room = 1e9f);
/// As high as it would be in the plane, or as high as can be read, as far as there is room.
inline float readable_height(float natural, float least, float room) { return std::max(natural, std::min(least, room)); }
/// Of the name on a box that is looked at from far away, and of the text of a comment, in pixels.
float name_height(const Board& board, const NodeBox& box);
float comment_height(const Board& board, const Comment& comment);
/// Is the line longer on the screen than a text of this width? If not, the text would hide it.
bool is_longer_than(const Board& board, const Line& line, float pixels);
float text_width(const Board& board, float pixels, std::string_view text);
/// The colour of a typification's section.
ImU32 colour_of(const Board& board, const Section& section);

/// The colour of a box as a whole: of a volume's use, else of its first role.
ImU32 tone_of(const Board& board, const NodeBox& box);
/// Why a link whose kind is known does not run; empty where it does.
std::string link_error(const Board& board, const Line& line);

void draw_ground(Board& board);
void draw_frames_and_comments(Board& board);
void draw_lines(Board& board);
/// Names and last changes of links, and why they fail; above all lines.
void draw_line_labels(Board& board);
void draw_pills(Board& board);
void draw_nodes(Board& board);
/// What a drag in progress shows: box, new link, swipe, guides.
void draw_deed(Board& board);
/// Where the switches of the families go, in rows along the upper edge, or one button where they would take too much of it, and
/// where the minimap goes; what is fitted into sight stays clear of them.
void place_overlays(Board& board);
/// Switches the links of a family off or on; without a name, opens the list of all.
void press_chip(Board& board, const std::string& family);
/// The switches as a list, while it is open.
void draw_family_list(Board& board);
/// Switches of families, the minimap, hints where the canvas is empty.
void draw_overlays(Board& board);
/// Cards of hovered and pinned nodes and links.
void draw_cards(Board& board);

}  // namespace bl::desktop::canvas
