// What is on the canvas: boxes of nodes, pills of whole sets, and lines of links, made from scene and view after changes only.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/graph/state.h"
#include "ui/desktop/panels/canvas/view_data.h"
#include "ui/desktop/panels/workbench.h"

namespace bl::desktop::canvas {

// Measures of boxes, in points at full size.
inline constexpr float kBoxWidth = 188, kHeadHeight = 28, kSectionHeight = 19, kRowHeight = 17, kBarHeight = 19,
                       kSparkHeight = 26, kStreamHeight = 20, kBoxFoot = 6, kGrid = 10, kPillHeight = 26, kFrameHead = 26;
inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

/// One port as a line in a section.
struct Row {
  std::size_t port = 0;
  std::string label;
};

/// One typification of a node.
struct Section {
  std::string type_id, label;
  const TypificationDefinition* type = nullptr;  ///< none: unknown here, kept as a ghost
  std::size_t category = 0;
  std::vector<Row> rows;
  bool has_bar = false;             ///< demand against volume
  bool is_stream = false;           ///< a reading or message with its age, in a line of its own
  std::size_t spark = kNoIndex;     ///< the port that is followed over time
  std::size_t in_state = kNoIndex;  ///< index among the node's types in the state
  std::vector<std::string> texts;   ///< of the rows, as of `texts_of`
  std::size_t texts_of = 0;         ///< the model's `state_revision` then
};

struct NodeBox {
  std::string id, name;
  Box box;  ///< as drawn: of its head alone where collapsed
  std::vector<Section> sections;
  bool is_collapsed = false, is_stored = false;  ///< stored: the view says where it lies
  bool is_hidden = false;                        ///< left out of the 3D view
  std::uint32_t in_state = kNoIndex;             ///< none before the first tick that knows it
  std::size_t use = kNoIndex;                    ///< of a SmartVolume: the tone of its use, or kNoUse

  bool is_ghost() const;
};

/// A whole set that links end at.
struct Pill {
  std::string key, label;
  Selection selection;
  std::vector<std::size_t> members;  ///< boxes
  Box box;
  bool is_stored = false;
};

/// A node or set outside of the entered frame that a link from inside leads to: a sign at the frame's edge.
struct Door {
  std::string id;  ///< of the node; the key of the set
  std::string label;
  Selection selection;
  bool is_set = false, is_left = false;  ///< a set; beside the left edge, because it lies on that side
  Box box;
};

/// What lines end at: boxes first, pills and doors after them.
struct Line {
  std::string id, kind, label;
  const LinkDefinition* definition = nullptr;  ///< none: unknown here, kept as a ghost
  std::size_t from = 0, to = 0;                ///< anchors
  bool is_muted = false, is_enabled = true, changes_from = false, changes_to = true;
  bool is_crossing = false;  ///< leads out of the entered frame, to a door
  float strength = 1;
  Family family;
  std::vector<ImVec2> dots, points;  ///< points: the curve, close enough to be drawn as stretches
  Box bounds;
  std::uint32_t in_state = kNoIndex;

  ImVec2 middle() const;
  ImVec2 at_share(float share) const;
};

class Model {
 public:
  /// Makes everything anew where the scene has changed, and finds indices again where the state has another plan.
  void update(const Workbench& editor);

  ViewData view;               ///< of the whole scene
  bool is_view_moved = false;  ///< a drag has moved comments in it; whatever changes the scene reads it again
  std::string entered;         ///< the frame that alone is shown; empty: all. Takes effect with the next update
  std::vector<NodeBox> boxes;  ///< ascending id
  std::vector<Pill> pills;
  std::vector<Door> doors;
  std::vector<Line> lines;             ///< ascending id
  std::vector<NodeBox> outside_boxes;  ///< what the entered frame does not hold; ascending id
  std::vector<Line> outside_lines;
  std::map<std::string, ImU32, std::less<>> families;  ///< of these lines, with their colours
  std::map<std::string, ImVec2> unstored_boxes;        ///< where boxes of the whole scene lie that the view says nothing of
  std::map<std::string, ImVec2> unstored_sets;         ///< the same of pills, by their key
  std::size_t undrawn = 0;                             ///< links of unknown kinds whose ends cannot be read
  std::size_t revision = 0;                            ///< grows with each change of the scene
  std::size_t state_revision = 0;                      ///< grows with each state that is seen, and with each change of the scene

  std::size_t anchors() const { return boxes.size() + pills.size() + doors.size(); }
  const Box& anchor(std::size_t k) const {
    if (k < boxes.size()) return boxes[k].box;
    return is_door(k) ? doors[k - boxes.size() - pills.size()].box : pills[k - boxes.size()].box;
  }
  bool is_door(std::size_t anchor) const { return anchor >= boxes.size() + pills.size(); }
  /// Is it on the canvas, seen from the entered frame?
  bool shows_frame(const std::string& id) const { return entered.empty() || (id != entered && view.is_within(id, entered)); }
  bool shows_comment(const std::string& id) const { return entered.empty() || view.holds_comment(entered, id); }
  /// What a link's end says that is laid to this anchor.
  Selection selection_of(std::size_t anchor) const;
  std::size_t find_box(const std::string& id) const;   ///< boxes.size() where there is none
  std::size_t find_line(const std::string& id) const;  ///< lines.size() where there is none
  /// Around all that is shown; a small box where there is nothing.
  Box bounds() const;
  /// Around what is in the frame, with its head; nothing in an empty frame.
  bool frame_box(const std::string& id, Box& out, int depth = 0) const;
  /// Where the automatic layout puts everything, whatever the view says: boxes first, pills after them. Of the whole scene: not
  /// while a frame is entered.
  std::vector<ImVec2> automatic_places(const Workbench& editor) const;
  /// Draws the curves anew, after boxes have moved.
  void trace_lines();

 private:
  void make_boxes(const Workbench& editor);
  void number_uses(const Workbench& editor);
  void make_lines(const Workbench& editor);
  void place(const Workbench& editor);
  void make_room(const std::set<std::string>& fresh);
  void note_unstored();
  void narrow();
  void place_doors(const std::vector<ImVec2>& origins);
  void find_indices(const Workbench& editor);
  std::size_t anchor_of(const Workbench& editor, const Selection& selection);

  std::uint64_t document_ = 0;  ///< whose places these are; 0: of none
  std::size_t log_size_ = 0, node_count_ = 0;
  bool is_dark_ = false;  ///< of the theme that gave the lines their colours
  std::string view_text_, narrowed_to_;
  // Held, so that another state or plan never lies at the same address.
  std::shared_ptr<const State> state_;
  std::shared_ptr<const Plan> plan_;
  std::map<std::string, ImVec2> kept_;  ///< where boxes without an entry were put; they stay there as long as the scene is open
};

/// The key of a set in the view: its typification and tag, or its ids.
std::string key_of(const Selection& selection);
/// "all SmartVolumes", "#living", "3 nodes".
std::string text_of(const Workbench& editor, const Selection& selection);

}  // namespace bl::desktop::canvas
