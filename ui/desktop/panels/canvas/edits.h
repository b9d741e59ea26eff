// Changes to nodes and links from the canvas, each one step that undo takes back whole.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ui/desktop/panels/canvas/board.h"

namespace bl::desktop::canvas {

/// Removes what is chosen: links, nodes with theirs, comments, frames (not what is in them). With `reconnects`, links of one
/// kind that met at a node that goes are joined.
void remove_chosen(Board& board, bool reconnects);
void remove_links(Board& board, const std::set<std::string>& links);
/// Mutes the chosen links and those of the chosen nodes; if all of them are muted, lets them speak again.
void mute_chosen(Board& board);
/// Mutes all links but those, and those that reach a chosen node through a set; once more gives back what it has muted.
void solo_chosen(Board& board);
/// Gives all links that end at one body to another, as far as they fit there.
void move_links(Board& board, std::size_t from, std::size_t to);
void collapse_chosen(Board& board);
/// A dot of the link at a place near it.
void add_dot(Board& board, std::size_t line, ImVec2 at);
void remove_dot(Board& board, std::size_t line, std::size_t dot);

/// Chosen links, and all that end at chosen nodes.
std::set<std::string> links_of_choice(const Board& board);

/// Ids that are neither in the scene nor given out before by the same one.
class FreshIds {
 public:
  explicit FreshIds(const Workbench& editor) : editor_(&editor) {}
  std::string of(const std::string& wish);

 private:
  const Workbench* editor_;
  std::set<std::string> given_;
};

/// Brings the model up to a change that was made in the middle of a frame. What was pointed at may be gone, or have another
/// number.
void update_now(Board& board);

/// One step under a name of its own, where the commands do not say what was meant.
bool submit_as(Board& board, const std::vector<Command>& commands, const std::string& label);
/// A change of the view as one of several commands; nothing where the patch is empty.
void add_view_patch(std::vector<Command>& commands, const Json& patch);

}  // namespace bl::desktop::canvas
