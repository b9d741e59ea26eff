// One frame of the canvas: brings the model up to the scene, answers to the mouse, and draws layer upon layer.
#include "ui/desktop/panels/canvas/canvas.h"

#include <nlohmann/json.hpp>

#include "ui/desktop/look/buttons.h"
#include "ui/desktop/panels/canvas/arrangement.h"
#include "ui/desktop/panels/canvas/board.h"
#include "ui/desktop/panels/canvas/context_menu.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/canvas/mouse.h"
#include "ui/desktop/panels/canvas/stored_places.h"

namespace bl::desktop {

using canvas::Board;
using canvas::Box;

Canvas::Canvas(Workbench& editor) : board_(std::make_unique<Board>(editor)) {}
Canvas::~Canvas() = default;

namespace {

// Another scene: nothing of the last one is left behind.
void follow_document(Board& board) {
  if (board.document == board.editor.document->id()) return;
  board.document = board.editor.document->id();
  board.is_reset = true;
  board.drag = {};
  board.edit = {};
  board.hovered = {};
  board.pinned.clear();
  board.soloed.clear();
  board.picked_comments.clear();
  board.picked_frames.clear();
  board.model.entered.clear();
  board.way_in.clear();
  board.poses.clear();
}

// What has gone from the scene is no longer chosen.
void forget_gone(Board& board) {
  const Scene& scene = board.editor.scene();
  const auto& view = board.model.view;
  std::erase_if(board.editor.picks.nodes, [&](const std::string& id) { return !scene.nodes.contains(id); });
  std::erase_if(board.editor.picks.links, [&](const std::string& id) { return !scene.links.contains(id); });
  std::erase_if(board.picked_comments, [&](const std::string& id) { return !view.comments.contains(id); });
  std::erase_if(board.picked_frames, [&](const std::string& id) { return !view.frames.contains(id); });
  std::erase_if(board.pinned, [&](const std::string& id) { return !scene.nodes.contains(id); });
  // What undo, or somebody else, lets speak again is no part of the solo any more.
  std::erase_if(board.soloed, [&](const std::string& id) {
    const auto link = scene.links.find(id);
    return link == scene.links.end() || !link->second.is_muted;
  });
}

}  // namespace

void canvas::follow_choice(Board& board) {
  const auto& nodes = board.editor.picks.nodes;
  auto& order = board.choice_order;
  std::erase_if(order, [&](const std::string& id) { return !nodes.contains(id); });
  if (order.size() == nodes.size()) return;
  const std::set<std::string> known(order.begin(), order.end());
  for (const std::string& id : nodes)
    if (!known.contains(id)) order.push_back(id);
}

namespace {

void draw_layers(Board& board) {
  board.glances.update(board);
  draw_ground(board);
  draw_frames_and_comments(board);
  draw_lines(board);
  draw_pills(board);
  draw_doors(board);
  draw_nodes(board);
  draw_line_labels(board);
  draw_deed(board);
  draw_overlays(board);
  draw_cards(board);
}

}  // namespace

void Canvas::draw(ImVec2 size) {
  Board& board = *board_;
  Workbench& editor = board.editor;
  if (!editor.document || !editor.moment || size.x < 8 || size.y < 8) return;
  if (ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) editor.point_at(Area::canvas);
  follow_document(board);
  board.camera.set_pane({ImGui::GetWindowPos(), size}, editor.theme.scale(), editor.now);
  if (board.camera.is_gliding()) editor.go_on();
  const std::size_t revision = board.model.revision;
  bring_up_to_date(board);
  if (canvas::store_places(board)) bring_up_to_date(board);
  place_overlays(board);
  if (board.is_reset) fit_all(board, false);
  board.is_reset = false;
  if (revision != board.model.revision) forget_gone(board);
  follow_choice(board);
  board.live.update(editor, board.model);
  // Takes the mouse from the moment of a press, so that a drag goes on outside the pane.
  ImGui::SetCursorScreenPos(ImGui::GetWindowPos());
  press_area("plane", size,
             ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  handle_mouse(board, ImGui::IsItemHovered());
  draw_layers(board);
  draw_inline_edit(board);
  draw_picker(board);
  draw_menu(board);
  draw_family_list(board);
  if (auto later = std::move(board.after_frame); later) {
    board.after_frame = nullptr;
    later(board);
  }
}

void Canvas::fit(bool all) {
  if (!board_->editor.document) return;
  canvas::bring_up_to_date(*board_);
  const auto chosen = all ? std::nullopt : canvas::box_of_choice(*board_);
  if (chosen) board_->camera.fit(*chosen, true);
  else canvas::fit_all(*board_, true);
}

void Canvas::store_places() {
  if (!board_->editor.document) return;
  canvas::bring_up_to_date(*board_);
  canvas::store_places(*board_);
}

void Canvas::show(const std::string& node) { canvas::show_node(*board_, node); }

std::optional<Command> Canvas::joining(const std::string& node) const {
  Json patch = Json::object();
  canvas::join_entered(*board_, patch, "nodes", node);
  if (patch.empty()) return std::nullopt;
  return command<SetView>({JsonValue::of(patch), false});
}

std::optional<ImVec2> Canvas::screen_of(const std::string& node) const {
  const std::size_t k = board_->model.find_box(node);
  if (k >= board_->model.boxes.size()) return std::nullopt;
  const Box& box = board_->model.boxes[k].box;
  return board_->camera.to_screen(ImVec2(box.centre().x, box.at.y + canvas::kHeadHeight / 2));
}

std::optional<ImVec2> Canvas::handle_of(const std::string& node) const {
  const std::size_t k = board_->model.find_box(node);
  if (k >= board_->model.boxes.size()) return std::nullopt;
  const Box& box = board_->model.boxes[k].box;
  return board_->camera.to_screen(ImVec2(box.high().x, box.centre().y));
}

std::optional<ImVec2> Canvas::screen_of_link(const std::string& link) const {
  const std::size_t k = board_->model.find_line(link);
  if (k >= board_->model.lines.size()) return std::nullopt;
  return board_->camera.to_screen(board_->model.lines[k].middle());
}

double Canvas::zoom() const { return board_->camera.zoom(); }
ImVec2 Canvas::to_plane(ImVec2 screen) const { return board_->camera.to_plane(screen); }
ImVec2 Canvas::to_screen(ImVec2 plane) const { return board_->camera.to_screen(plane); }

}  // namespace bl::desktop
