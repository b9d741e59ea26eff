// Filters the list of actions by what lies under the menu; a click, or arrows and Enter, run one.
#include "ui/desktop/panels/canvas/context_menu.h"

#include <GLFW/glfw3.h>

#include "ui/desktop/panels/actions.h"

namespace bl::desktop::canvas {

namespace {

constexpr const char* kName = "canvas menu";
constexpr float kBetween = 36;  // labels and keys

// Nothing for what has no menu.
unsigned target_of(Thing thing) {
  switch (thing) {
    case Thing::nothing:
    case Thing::door: return on_ground;
    case Thing::node:
    case Thing::node_edge: return on_node;
    case Thing::pill:
    case Thing::pill_edge: return on_set;
    case Thing::link:
    case Thing::dot: return on_link;
    case Thing::comment:
    case Thing::comment_corner: return on_comment;
    case Thing::frame: return on_frame;
    default: return 0;
  }
}

// What is done from the menu is done to what lies under it, and to whatever is chosen along with it.
void choose_under(Board& board, const Hit& over) {
  Picks& picks = board.editor.picks;
  const unsigned target = target_of(over.thing);
  std::set<std::string>* chosen = target == on_node      ? &picks.nodes
                                  : target == on_link    ? &picks.links
                                  : target == on_comment ? &board.picked_comments
                                  : target == on_frame   ? &board.picked_frames
                                                         : nullptr;
  if (chosen == nullptr || chosen->contains(over.id)) return;
  picks.clear();
  board.picked_comments.clear();
  board.picked_frames.clear();
  chosen->insert(over.id);
}

std::string title_of(const Board& board, const Hit& over) {
  const ViewData& view = board.model.view;
  switch (target_of(over.thing)) {
    case on_node: {
      const std::size_t count = board.editor.picks.nodes.size();
      return count > 1 ? std::to_string(count) + " nodes" : board.editor.name_of(over.id);
    }
    case on_link: {
      const std::size_t line = board.model.find_line(over.id);
      return line < board.model.lines.size() ? board.model.lines[line].label : over.id;
    }
    case on_frame: return view.frames.contains(over.id) ? view.frames.at(over.id).name : "";
    case on_set:
      for (const Pill& pill : board.model.pills)
        if (pill.key == over.id) return pill.label;
      return "";
    default: return "";
  }
}

// One line: what it does, and its key at the right. Whether it was taken.
bool draw_item(const Board& board, const Action& action, float width, bool is_marked, bool& is_pointed_at) {
  const Colours& c = board.theme().colours();
  const std::string keys = text_of(action.chord);
  const bool is_on = action.is_on != nullptr && action.is_on(board.editor);
  const bool is_taken = ImGui::Selectable(action.label, is_marked, 0, {width, 0});
  is_pointed_at = ImGui::IsItemHovered() && (ImGui::GetIO().MouseDelta.x != 0 || ImGui::GetIO().MouseDelta.y != 0);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 extent = ImGui::CalcTextSize(keys.c_str());
  const float y = (low.y + high.y - extent.y) / 2, right = high.x - board.theme().px(6);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText({right - extent.x, y}, c.text_faint, keys.c_str());
  if (is_on) list.AddText({right - extent.x - board.theme().px(22), y}, c.accent, icon::kCheck);
  return is_taken;
}

float width_of(const Board& board, const std::vector<const Action*>& items) {
  float width = board.theme().px(200);
  for (const Action* item : items)
    width = std::max(width, ImGui::CalcTextSize(item->label).x + ImGui::CalcTextSize(text_of(item->chord).c_str()).x +
                                board.theme().px(kBetween));
  return width;
}

// A line goes wherever a group begins between two items, whether its first member is offered or not.
bool begins_group(const std::vector<const Action*>& items, std::size_t k) {
  return k > 0 && std::any_of(items[k - 1] + 1, items[k] + 1, [](const Action& a) { return a.begins_group; });
}

// Beside the place that it is opened for, and wholly inside the window.
void place_menu(const Board& board, const std::vector<const Action*>& items) {
  const ImGuiStyle& style = ImGui::GetStyle();
  ImVec2 size{width_of(board, items) + 2 * style.WindowPadding.x,
              2 * style.WindowPadding.y + static_cast<float>(items.size() + 1) * ImGui::GetTextLineHeightWithSpacing()};
  for (std::size_t k = 0; k < items.size(); ++k) size.y += begins_group(items, k) ? style.ItemSpacing.y + 1 : 0;
  const ImVec2 most = ImGui::GetIO().DisplaySize - size;
  const ImVec2 at = board.menu.at;
  ImGui::SetNextWindowPos({std::max(0.0f, std::min(at.x, most.x)), std::max(0.0f, std::min(at.y, most.y))});
}

// The place in the list that is taken in this frame, or the number of items.
std::size_t draw_items(Board& board, const std::vector<const Action*>& items) {
  ContextMenu& menu = board.menu;
  const float width = width_of(board, items);
  std::size_t taken = items.size();
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (begins_group(items, k)) ImGui::Separator();
    ImGui::PushID(static_cast<int>(k));
    bool is_pointed_at = false;
    if (draw_item(board, *items[k], width, k == menu.marked, is_pointed_at)) taken = k;
    if (is_pointed_at) menu.marked = k;
    ImGui::PopID();
  }
  return taken;
}

}  // namespace

void open_menu(Board& board, const Hit& over, ImVec2 screen) {
  if (target_of(over.thing) == 0) return;
  choose_under(board, over);
  board.menu = {};
  board.menu.over = over;
  board.menu.at = screen;
  board.menu.is_opening = true;
}

void open_menu_of_choice(Board& board) {
  const Model& model = board.model;
  Hit over;
  ImVec2 at = board.camera.to_screen(board.cursor());
  Box box;
  if (const auto& nodes = board.editor.picks.nodes; !nodes.empty() && model.find_box(*nodes.begin()) < model.boxes.size()) {
    const std::size_t k = model.find_box(*nodes.begin());
    over = {Thing::node, *nodes.begin(), k};
    at = board.camera.to_screen(model.boxes[k].box.at + ImVec2(kBoxWidth / 2, kHeadHeight));
  } else if (const auto& links = board.editor.picks.links;
             !links.empty() && model.find_line(*links.begin()) < model.lines.size()) {
    const std::size_t k = model.find_line(*links.begin());
    over = {Thing::link, *links.begin(), k};
    at = board.camera.to_screen(model.lines[k].middle());
  } else if (!board.picked_comments.empty() && model.view.comments.contains(*board.picked_comments.begin())) {
    over = {Thing::comment, *board.picked_comments.begin(), 0};
    at = board.camera.to_screen(model.view.comments.at(over.id).box.centre());
  } else if (!board.picked_frames.empty() && model.frame_box(*board.picked_frames.begin(), box)) {
    over = {Thing::frame, *board.picked_frames.begin(), 0};
    at = board.camera.to_screen(box.at + ImVec2(24, 24));
  }
  const Box pane = board.camera.pane();
  open_menu(board, over, {std::clamp(at.x, pane.low().x, pane.high().x), std::clamp(at.y, pane.low().y, pane.high().y)});
  board.menu.marked = 0;
}

std::vector<const Action*> offered(const Board& board) {
  std::vector<const Action*> items;
  const unsigned target = target_of(board.menu.over.thing);
  for (const Action& action : actions())
    if ((action.targets & target) != 0 && (action.can == nullptr || action.can(board.editor))) items.push_back(&action);
  return items;
}

void draw_menu(Board& board) {
  ContextMenu& menu = board.menu;
  if (menu.is_opening) {
    ImGui::OpenPopup(kName);
    place_menu(board, offered(board));
  }
  menu.is_opening = false;
  const bool was_open = menu.is_open;
  menu.is_open = ImGui::BeginPopup(kName, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                              ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  if (!menu.is_open) {
    // A right click beside an open menu closes it with the press, and opens the next one as it is let go.
    if (menu.is_asked_again && ImGui::IsMouseReleased(1)) {
      menu.is_asked_again = false;
      const ImVec2 at = ImGui::GetIO().MousePos;
      if (board.camera.pane().holds(at)) open_menu(board, hit_at(board, at), at);
    }
    return;
  }
  const auto items = offered(board);
  if (const std::string title = title_of(board, menu.over); !title.empty()) {
    ImGui::PushFont(board.theme().fonts().small);
    ImGui::TextDisabled("%s", title.c_str());
    ImGui::PopFont();
  }
  std::size_t taken = draw_items(board, items);
  const std::size_t count = items.size();
  if (was_open && count > 0) {
    if (ImGui::IsKeyPressed(GLFW_KEY_DOWN)) menu.marked = menu.marked < count ? (menu.marked + 1) % count : 0;
    if (ImGui::IsKeyPressed(GLFW_KEY_UP)) menu.marked = (std::min(menu.marked, count) + count - 1) % count;
    if (ImGui::IsKeyPressed(GLFW_KEY_ENTER, false) && menu.marked < count) taken = menu.marked;
  }
  menu.is_asked_again = ImGui::IsMouseClicked(1) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (taken < count)
    // It may change the scene, or open the next list: after all of this has been drawn.
    board.after_frame = [action = items[taken]](Board& b) {
      b.menu.is_acting = true;
      action->run(b.editor);
      b.menu.is_acting = false;
    };
  if (taken < count || count == 0 || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace bl::desktop::canvas
