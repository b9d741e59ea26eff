// What the parts of the canvas share: the editor, what is on the plane, where it is looked at, and what the person is doing.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ui/desktop/panels/canvas/camera.h"
#include "ui/desktop/panels/canvas/glances.h"
#include "ui/desktop/panels/canvas/live.h"
#include "ui/desktop/panels/canvas/model.h"
#include "ui/desktop/panels/canvas/picker.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop::canvas {

/// What lies under the cursor.
enum class Thing {
  nothing,
  node,
  node_edge,
  pill,
  pill_edge,
  door,
  link,
  dot,
  comment,
  comment_corner,
  frame,
  minimap,
  chip,
  crumb,
  card_cross
};
/// A box or a pill, inside or at its edge.
inline bool is_body(Thing thing) {
  return thing == Thing::node || thing == Thing::node_edge || thing == Thing::pill || thing == Thing::pill_edge;
}
/// Whatever a link can be laid to.
inline bool takes_links(Thing thing) { return is_body(thing) || thing == Thing::door; }

struct Hit {
  Thing thing = Thing::nothing;
  std::string id;         ///< of the node, link, comment or frame; the family of a chip
  std::size_t index = 0;  ///< of the anchor, dot, chip or crumb
  bool operator==(const Hit&) const = default;
};

/// What a held mouse button does.
enum class DragMode { none, pan, box, move, link, relink, cut, dot, comment_corner, minimap };

/// A drag from press to release. Nothing is submitted before the end: one drag is one step, and Esc leaves no trace.
struct Drag {
  DragMode deed = DragMode::none;
  Hit grabbed;
  int button = 0;
  ImVec2 begin;                                  ///< in the plane
  bool is_far = false;                           ///< moved beyond a click's tremble
  bool is_double = false;                        ///< the second press of a double click, unless it goes far
  bool copies = false, leaves = false;           ///< with Alt; with Shift
  bool adds = false, toggles = false;            ///< box selection with Shift; with Ctrl
  std::set<std::string> base_nodes, base_links;  ///< what was chosen before a box selection
  std::set<std::string> base_comments, base_frames;
  std::size_t revision = 0;          ///< of the model; a scene that changes meanwhile ends the drag
  std::vector<ImVec2> swipe;         ///< of a cut
  std::set<std::string> cut;         ///< links that it crosses
  std::vector<std::size_t> anchors;  ///< that move
  std::vector<std::string> comments;
  std::vector<std::pair<std::string, std::size_t>> dots;
  std::vector<Box> old_anchors, old_comments;
  std::vector<ImVec2> old_dots;
  ImVec2 shift;                                   ///< how far they have been moved
  std::vector<std::pair<ImVec2, ImVec2>> guides;  ///< that they have snapped to
};

/// A text that is being edited in its place.
struct InlineEdit {
  Thing thing = Thing::nothing;
  std::string id;
  std::string text;
  bool is_fresh = true;
};

/// The context menu of what lies under it.
struct ContextMenu {
  Hit over;
  ImVec2 at;  ///< on the screen
  bool is_opening = false, is_open = false;
  bool is_acting = false;         ///< one of its actions runs: what it adds goes where the menu was opened
  bool is_asked_again = false;    ///< the right button went down beside the open menu
  std::size_t marked = kNoIndex;  ///< among what is offered
};

/// The switches of families as a list, where the pane is too small for them.
struct FamilyList {
  bool is_folded = false;  ///< one button stands for all switches
  bool is_opening = false, is_open = false;
  std::vector<std::pair<std::string, Box>> rows;  ///< where they are on the screen
};

/// A part of the breadcrumb: a frame that one is in, and where its name is on the screen.
struct Crumb {
  std::string frame, label;  ///< no frame: the whole canvas
  Box box;
};

struct Board {
  explicit Board(Workbench& the_editor) : editor(the_editor) {}

  Workbench& editor;
  Camera camera;
  Model model;
  Live live;
  Glances glances;
  Picker picker;
  ContextMenu menu;
  Drag drag;
  InlineEdit edit;
  Hit hovered;
  double hovered_since = 0;
  std::set<std::string, std::less<>> hidden_families;  ///< the person's own, not the scene's
  std::set<std::string> picked_comments, picked_frames;
  std::vector<std::string> choice_order;             ///< chosen nodes, the first that was chosen first
  std::vector<std::string> pinned;                   ///< nodes whose cards stay
  std::vector<std::pair<std::string, Box>> crosses;  ///< of pinned cards: their nodes, and where they are closed
  std::set<std::string> soloed;                      ///< links that solo has muted
  std::vector<std::pair<std::string, Box>> chips;    ///< families and where their switches are; one without a name for all
  FamilyList families;
  std::vector<Crumb> crumbs;                  ///< outermost first; none outside of frames
  std::vector<std::string> way_in;            ///< the entered frame and those around it, outermost first
  std::map<std::string, Camera::Pose> poses;  ///< where the canvas was looked at when it was left for another frame
  Box minimap;                                ///< on the screen; no size where it is not shown
  bool shows_minimap = true, snaps = true, is_reset = true;
  double space_since = -1;  ///< Space is held, perhaps to pan
  bool has_space_panned = false;
  std::string find_text;
  std::function<void(Board&)> after_frame;  ///< what has to wait until nothing is being walked over
  std::uint64_t document = 0;               ///< whose board it is

  const Theme& theme() const { return editor.theme; }
  bool is_hidden(const Line& line) const { return hidden_families.contains(line.family.label); }
  /// Where the cursor is, in the plane, or where the menu was opened that acts; the middle of the pane where it is elsewhere.
  ImVec2 cursor() const;
};

/// Brings the order of choosing up to what is chosen now; what was chosen at once stands in the order of ids.
void follow_choice(Board& board);

/// What lies at a place on the screen.
Hit hit_at(const Board& board, ImVec2 at);

}  // namespace bl::desktop::canvas
