// The commands of the node canvas, with their keys.
#include <GLFW/glfw3.h>

#include "ui/desktop/panels/actions.h"
#include "ui/desktop/panels/canvas/additions.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/canvas.h"
#include "ui/desktop/panels/canvas/clipboard.h"
#include "ui/desktop/panels/canvas/context_menu.h"
#include "ui/desktop/panels/canvas/edits.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/panel_memory.h"

namespace bl::desktop {

using namespace canvas;

namespace {

constexpr double kZoomStep = 1.3;

Board& board_of(Workbench& e) { return e.canvas->board(); }

bool has_nodes(const Workbench& e) { return has_document(e) && !e.picks.nodes.empty(); }
bool has_several(const Workbench& e) { return has_document(e) && e.picks.nodes.size() > 1; }
// Comments and frames are chosen too, and are no part of the shared picks: what is really there is seen by the action.
bool has_choice(const Workbench& e) {
  return has_document(e) &&
         (has_picks(e) || !e.canvas->board().picked_comments.empty() || !e.canvas->board().picked_frames.empty());
}

bool can_remove(const Workbench& e) { return !e.is_beamer && has_choice(e); }
bool can_reconnect(const Workbench& e) { return !e.is_beamer && has_nodes(e); }

void remove(Workbench& e, bool reconnects) {
  bring_up_to_date(board_of(e));
  remove_chosen(board_of(e), reconnects);
}

bool has_choice_or_pin(const Workbench& e) { return has_choice(e) || (has_document(e) && !e.canvas->board().pinned.empty()); }

ImVec2 search_place(const Board& board) {
  if (board.menu.is_acting) return board.menu.at;
  const ImVec2 at = ImGui::GetIO().MousePos;
  return board.camera.pane().holds(at) ? at : board.camera.pane().centre();
}

void select_all(Workbench& e) {
  bring_up_to_date(board_of(e));
  e.picks.clear();
  const Model& model = board_of(e).model;
  for (const NodeBox& box : model.boxes) e.picks.nodes.insert(box.id);
  for (const auto& [id, comment] : model.view.comments)
    if (model.shows_comment(id)) board_of(e).picked_comments.insert(id);
}

void select_none(Workbench& e) {
  // Esc ends a drag or closes the menu, and no more. With keyboard navigation the menu is closed already when keys are looked at.
  if (board_of(e).drag.deed != DragMode::none || board_of(e).menu.is_open || board_of(e).families.is_open ||
      !memory_of(e).scrub.key.empty())
    return;
  // First what is chosen, then what is pinned.
  if (!has_choice(e)) board_of(e).pinned.clear();
  e.picks.clear();
  board_of(e).picked_comments.clear();
  board_of(e).picked_frames.clear();
}

void select_neighbours(Workbench& e) {
  const Model& model = board_of(e).model;
  std::set<std::string> more = e.picks.nodes;
  for (const Line& line : model.lines) {
    if (line.from >= model.boxes.size() || line.to >= model.boxes.size()) continue;
    const std::string &a = model.boxes[line.from].id, &b = model.boxes[line.to].id;
    if (e.picks.nodes.contains(a)) more.insert(b);
    if (e.picks.nodes.contains(b)) more.insert(a);
  }
  e.picks.nodes = more;
}

void edit_name(Workbench& e) {
  Board& board = board_of(e);
  if (!e.picks.nodes.empty()) begin_edit(board, Thing::node, *e.picks.nodes.begin());
  else if (!board.picked_comments.empty()) begin_edit(board, Thing::comment, *board.picked_comments.begin());
  else if (!board.picked_frames.empty()) begin_edit(board, Thing::frame, *board.picked_frames.begin());
}

// A link between two chosen nodes without the mouse; with one chosen, to a new node.
void link_chosen(Workbench& e) {
  Board& board = board_of(e);
  follow_choice(board);
  std::vector<std::size_t> ends;
  for (const std::string& id : board.choice_order)
    if (const std::size_t k = board.model.find_box(id); k < board.model.boxes.size()) ends.push_back(k);
  const ImVec2 at =
      board.camera.to_screen(ends.empty() ? board.camera.sight().centre() : board.model.anchor(ends.back()).centre());
  if (ends.size() == 2) open_link_menu(board, ends[0], ends[1], at);
  else if (ends.size() == 1)
    open_drop_menu(board, ends[0], board.camera.to_screen(board.model.anchor(ends[0]).high() + ImVec2(160, -60)));
  else e.notify(NoticeKind::told, "Choose two nodes to link them, or one to link it to a new one.");
}

template <Alignment kind>
void align(Workbench& e) {
  align_chosen(board_of(e), kind);
}

// `targets`: the context menus that it stands in as well.
void offer(std::vector<Action>& list, unsigned targets, Action action) {
  action.targets = targets;
  list.push_back(std::move(action));
}

// The same, with a line before it in menus.
void begin_group(std::vector<Action>& list, unsigned targets, Action action) {
  action.begins_group = true;
  offer(list, targets, std::move(action));
}

void select_members(Workbench& e) {
  Board& board = board_of(e);
  const Hit at = board.menu.is_acting ? board.menu.over : board.hovered;
  e.picks.clear();
  for (const Pill& pill : board.model.pills)
    if (pill.key == at.id)
      for (const std::size_t member : pill.members) e.picks.nodes.insert(board.model.boxes[member].id);
}

bool is_at_set(const Workbench& e) {
  if (!has_document(e)) return false;
  const Board& board = e.canvas->board();
  const Thing thing = board.menu.is_open || board.menu.is_acting ? board.menu.over.thing : board.hovered.thing;
  return thing == Thing::pill || thing == Thing::pill_edge;
}

bool has_one_link(const Workbench& e) { return has_document(e) && e.picks.links.size() == 1; }

// The actions from `first` on.
void into_submenu(std::vector<Action>& list, std::size_t first, const char* submenu) {
  for (std::size_t k = first; k < list.size(); ++k) list[k].submenu = submenu;
}

void dot_at_cursor(Workbench& e) {
  Board& board = board_of(e);
  add_dot(board, board.model.find_line(*e.picks.links.begin()), board.cursor());
}

void add_edit_commands(std::vector<Action>& list) {
  const Area area = Area::canvas;
  offer(list, on_ground | on_node, {"Canvas", "Add...", {GLFW_KEY_TAB}, {}, area, has_document, [](Workbench& e) {
                                      open_addition(board_of(e), search_place(board_of(e)));
                                    }});
  offer(list, on_node, {"Canvas", "Link...", {GLFW_KEY_L}, {}, area, has_nodes, link_chosen});
  offer(list, on_ground,
        {"Canvas", "Find...", {GLFW_KEY_F, true}, {}, area, has_document, [](Workbench& e) { open_find(board_of(e)); }});
  begin_group(list, on_node | on_comment | on_frame,
              {"Canvas", "Rename", {GLFW_KEY_ENTER}, {GLFW_KEY_F2}, area, has_choice, edit_name});
  begin_group(list, on_node | on_comment,
              {"Canvas", "Copy", {GLFW_KEY_C, true}, {}, area, has_choice, [](Workbench& e) { copy_chosen(board_of(e)); }});
  offer(list, on_node | on_comment,
        {"Canvas", "Cut", {GLFW_KEY_X, true}, {}, area, has_choice, [](Workbench& e) { cut_chosen(board_of(e)); }});
  offer(list, on_ground,
        {"Canvas", "Paste", {GLFW_KEY_V, true}, {}, area, has_document, [](Workbench& e) { paste(board_of(e)); }});
  offer(list, on_node | on_comment, {"Canvas", "Duplicate", {GLFW_KEY_D, true}, {}, area, has_choice, [](Workbench& e) {
                                       duplicate_chosen(board_of(e), {30, 30});
                                     }});
  // Wherever it was chosen: in 3D and in the lists as well.
  begin_group(list, on_node | on_link | on_comment | on_frame,
              {"Canvas", "Delete", {GLFW_KEY_DELETE}, {}, Area::none, can_remove, [](Workbench& e) { remove(e, false); }});
  list.back().yields_to_fields = true;
  offer(list, on_node,
        {"Canvas", "Delete and reconnect", {GLFW_KEY_DELETE, true}, {}, Area::none, can_reconnect, [](Workbench& e) {
           remove(e, true);
         }});
  list.back().yields_to_fields = true;
  begin_group(list, on_node | on_link,
              {"Canvas", "Mute", {GLFW_KEY_M}, {}, area, has_picks, [](Workbench& e) { mute_chosen(board_of(e)); }});
  offer(list, on_node | on_link,
        {"Canvas",
         "Solo",
         {GLFW_KEY_Q},
         {},
         area,
         has_document,
         [](Workbench& e) { solo_chosen(board_of(e)); },
         false,
         [](const Workbench& e) { return has_document(e) && !e.canvas->board().soloed.empty(); }});
  begin_group(list, on_ground, {"Canvas", "Select all", {GLFW_KEY_A, true}, {}, area, has_document, select_all});
  list.push_back({"Canvas", "Select nothing", {GLFW_KEY_ESCAPE}, {}, area, has_choice_or_pin, select_none});
  offer(list, on_node, {"Canvas", "Select neighbours too", {GLFW_KEY_N}, {}, area, has_nodes, select_neighbours});
  offer(list, on_set, {"Canvas", "Select the members of the set", {}, {}, area, is_at_set, select_members});
  offer(list, on_link, {"Canvas", "Add a dot to the link", {}, {}, area, has_one_link, dot_at_cursor});
}

void add_arrangement_commands(std::vector<Action>& list) {
  const Area area = Area::canvas;
  begin_group(list, on_node,
              {"Canvas", "Collapse", {GLFW_KEY_H}, {}, area, has_nodes, [](Workbench& e) { collapse_chosen(board_of(e)); }});
  offer(list, on_node | on_comment | on_frame,
        {"Canvas", "Frame", {GLFW_KEY_G, true}, {}, area, has_choice, [](Workbench& e) { frame_chosen(board_of(e)); }});
  offer(list, on_ground, {"Canvas", "Comment", {GLFW_KEY_C, false, true}, {}, area, has_document, [](Workbench& e) {
                            add_comment(board_of(e), board_of(e).cursor());
                          }});
  const std::size_t first = list.size();
  begin_group(list, on_node,
              {"Canvas", "Align left", {GLFW_KEY_LEFT, false, false, true}, {}, area, has_several, align<Alignment::left>});
  offer(list, on_node,
        {"Canvas", "Align right", {GLFW_KEY_RIGHT, false, false, true}, {}, area, has_several, align<Alignment::right>});
  offer(list, on_node, {"Canvas", "Align top", {GLFW_KEY_UP, false, false, true}, {}, area, has_several, align<Alignment::top>});
  offer(list, on_node,
        {"Canvas", "Align bottom", {GLFW_KEY_DOWN, false, false, true}, {}, area, has_several, align<Alignment::bottom>});
  offer(list, on_node, {"Canvas", "Align centres", {}, {}, area, has_several, align<Alignment::centre>});
  offer(list, on_node, {"Canvas", "Align middles", {}, {}, area, has_several, align<Alignment::middle>});
  offer(list, on_node, {"Canvas", "Distribute across", {GLFW_KEY_D, false, true}, {}, area, has_several, [](Workbench& e) {
                          distribute_chosen(board_of(e), true);
                        }});
  offer(list, on_node, {"Canvas", "Distribute down", {GLFW_KEY_D, false, true, true}, {}, area, has_several, [](Workbench& e) {
                          distribute_chosen(board_of(e), false);
                        }});
  into_submenu(list, first, "Align");
  begin_group(list, on_ground | on_node,
              {"Canvas", "Lay out selection, or all", {GLFW_KEY_L, false, true}, {}, area, has_document, [](Workbench& e) {
                 lay_out_chosen(board_of(e));
               }});
  begin_group(list, on_ground,
              {"Canvas",
               "Snap to grid",
               {GLFW_KEY_S, false, true},
               {},
               area,
               has_document,
               [](Workbench& e) { board_of(e).snaps = !board_of(e).snaps; },
               false,
               [](const Workbench& e) { return has_document(e) && e.canvas->board().snaps; }});
  offer(list, on_ground,
        {"Canvas",
         "Minimap",
         {GLFW_KEY_M, false, true},
         {},
         area,
         has_document,
         [](Workbench& e) { board_of(e).shows_minimap = !board_of(e).shows_minimap; },
         false,
         [](const Workbench& e) { return has_document(e) && e.canvas->board().shows_minimap; }});
}

void add_sight_commands(std::vector<Action>& list) {
  const Area area = Area::canvas;
  list.push_back(
      {"Canvas", "Menu of what is chosen", {GLFW_KEY_MENU}, {GLFW_KEY_F10, false, true}, area, has_document, [](Workbench& e) {
         open_menu_of_choice(board_of(e));
       }});
  begin_group(list, on_frame | on_node,
              {"Canvas",
               "Enter the frame",
               {GLFW_KEY_I},
               {},
               area,
               [](const Workbench& e) { return has_document(e) && !frame_to_enter(e.canvas->board()).empty(); },
               [](Workbench& e) { enter_frame(board_of(e), frame_to_enter(board_of(e))); }});
  offer(list, on_ground,
        {"Canvas",
         "Leave the frame",
         {GLFW_KEY_U},
         {},
         area,
         [](const Workbench& e) { return has_document(e) && !e.canvas->board().model.entered.empty(); },
         [](Workbench& e) { leave_frame(board_of(e)); }});
  const std::size_t first = list.size();
  begin_group(
      list, on_node | on_link | on_frame | on_comment,
      {"Canvas", "Fit selection, or all", {GLFW_KEY_F}, {}, area, has_document, [](Workbench& e) { e.canvas->fit(false); }});
  offer(list, on_ground,
        {"Canvas", "Fit all", {GLFW_KEY_HOME}, {GLFW_KEY_A}, area, has_document, [](Workbench& e) { e.canvas->fit(true); }});
  begin_group(list, 0,
              {"Canvas",
               "Zoom in",
               {GLFW_KEY_EQUAL, true},
               {GLFW_KEY_KP_ADD, true},
               area,
               has_document,
               [](Workbench& e) { board_of(e).camera.glide_to_zoom(board_of(e).camera.zoom() * kZoomStep); },
               true});
  list.push_back({"Canvas",
                  "Zoom out",
                  {GLFW_KEY_MINUS, true},
                  {GLFW_KEY_KP_SUBTRACT, true},
                  area,
                  has_document,
                  [](Workbench& e) { board_of(e).camera.glide_to_zoom(board_of(e).camera.zoom() / kZoomStep); },
                  true});
  list.push_back({"Canvas", "Full size", {GLFW_KEY_0, true}, {}, area, has_document, [](Workbench& e) {
                    board_of(e).camera.glide_to_zoom(1);
                  }});
  into_submenu(list, first, "Zoom");
}

// The arrows go from node to node.
void add_walking_commands(std::vector<Action>& list) {
  const auto walk = [](const char* label, int key, void (*run)(Workbench&)) {
    return Action{"Canvas", label, {key}, {}, Area::canvas, has_document, run, true};
  };
  const std::size_t first = list.size();
  begin_group(list, 0, walk("Go left", GLFW_KEY_LEFT, [](Workbench& e) { step_choice(board_of(e), {-1, 0}); }));
  list.push_back(walk("Go right", GLFW_KEY_RIGHT, [](Workbench& e) { step_choice(board_of(e), {1, 0}); }));
  list.push_back(walk("Go up", GLFW_KEY_UP, [](Workbench& e) { step_choice(board_of(e), {0, -1}); }));
  list.push_back(walk("Go down", GLFW_KEY_DOWN, [](Workbench& e) { step_choice(board_of(e), {0, 1}); }));
  into_submenu(list, first, "Go");
}

}  // namespace

void add_canvas_actions(std::vector<Action>& list) {
  add_edit_commands(list);
  add_arrangement_commands(list);
  add_sight_commands(list);
  add_walking_commands(list);
}

}  // namespace bl::desktop
