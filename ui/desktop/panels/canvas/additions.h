// What the search box offers: new nodes and roles, link kinds that fit, linked nodes, and nodes to go to.
#pragma once

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// Typifications as new nodes at a place, and as roles for the chosen node; link kinds that fit between several chosen ones.
void open_addition(Board& board, ImVec2 screen);
/// A new node of one role; its box's head lies at `at` on the plane.
void add_node(Board& board, const std::string& type, ImVec2 at);
/// Link kinds between two bodies; those that do not fit say why.
void open_link_menu(Board& board, std::size_t from, std::size_t to, ImVec2 screen);
/// A link kind and the role of a new node at its other end.
void open_drop_menu(Board& board, std::size_t from, ImVec2 screen);
/// Nodes by name, id or role; going through them shows them.
void open_find(Board& board);

}  // namespace bl::desktop::canvas
