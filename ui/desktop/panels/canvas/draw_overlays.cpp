// What lies above the plane: switches of families, minimap, hints, and cards.
#include <GLFW/glfw3.h>

#include "core/reading/figures.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/entered.h"
#include "ui/desktop/panels/canvas/sections.h"
#include "ui/desktop/panels/canvas/tension.h"

namespace bl::desktop::canvas {

namespace {

constexpr std::size_t kMostCardRows = 14, kMostPinnedRows = 8, kMostVoices = 4;
constexpr double kCardSeconds = 0.3;
constexpr float kChipText = 11, kChipHeight = 22, kChipStep = 26;
// More of the pane than this is not given away to switches.
constexpr int kMostChipRows = 2;
constexpr float kMostChipShare = 0.25f;
constexpr const char* kFamilyList = "canvas families";

ImU32 colour_of_family(const Board& board, const std::string& label) {
  const auto found = board.model.families.find(label);
  return found == board.model.families.end() ? board.theme().colours().text_faint : found->second;
}

void switch_family(Board& board, const std::string& label) {
  if (!board.hidden_families.erase(label)) board.hidden_families.insert(label);
}

// What the one button says that stands for all switches.
std::string folded_label(const Board& board) {
  const auto& families = board.model.families;
  const auto hidden = std::count_if(families.begin(), families.end(),
                                    [&](const auto& family) { return board.hidden_families.contains(family.first); });
  return hidden == 0 ? "Links" : "Links, " + std::to_string(hidden) + " off";
}

void draw_folded_chips(Board& board) {
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float scale = board.theme().scale();
  const Box& chip = board.chips.front().second;
  const bool is_lit = board.hovered.thing == Thing::chip || board.families.is_open;
  list.AddRectFilled(chip.low(), chip.high(), faded(c.panel, 0.9f), 11 * scale);
  list.AddRect(chip.low(), chip.high(), is_lit ? c.accent : c.line, 11 * scale);
  draw_text(board, chip.low() + ImVec2(10, 4.5f) * scale, kChipText * scale, c.text_soft, folded_label(board));
  const ImVec2 tip{chip.high().x - 13 * scale, chip.centre().y + 2.5f * scale};
  list.AddTriangleFilled(tip, tip + ImVec2(-4, -5) * scale, tip + ImVec2(4, -5) * scale, c.text_soft);
}

void draw_chips(Board& board) {
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float scale = board.theme().scale(), pixels = kChipText * scale;
  if (board.families.is_folded) return draw_folded_chips(board);
  for (const auto& [label, chip] : board.chips) {
    const bool is_off = board.hidden_families.contains(label);
    const bool is_hovered = board.hovered.thing == Thing::chip && board.hovered.id == label;
    list.AddRectFilled(chip.low(), chip.high(), faded(c.panel, 0.9f), 11 * scale);
    list.AddRect(chip.low(), chip.high(), is_hovered ? c.accent : c.line, 11 * scale);
    const ImVec2 dot = chip.low() + ImVec2(12, 11) * scale;
    if (is_off) list.AddCircle(dot, 4 * scale, c.text_faint, 12);
    else list.AddCircleFilled(dot, 4 * scale, colour_of_family(board, label), 12);
    draw_text(board, chip.low() + ImVec2(21, 4.5f) * scale, pixels, is_off ? c.text_faint : c.text_soft, label);
    if (is_off)
      list.AddLine(chip.low() + ImVec2(20 * scale, 11 * scale), chip.high() - ImVec2(7 * scale, 11 * scale), c.text_faint);
  }
}

// In the lower left corner, where the pane has room to spare for it.
void place_minimap(Board& board) {
  const Box& pane = board.camera.pane();
  const float scale = board.theme().scale();
  board.minimap = {};
  if (board.shows_minimap && board.model.boxes.size() > 1 && pane.size.x >= 380 * scale && pane.size.y >= 300 * scale)
    board.minimap = {{pane.low().x + 10 * scale, pane.high().y - 110 * scale}, ImVec2(150, 100) * scale};
  board.camera.set_corner(board.minimap.size.x > 0 ? board.minimap.size + ImVec2(16, 16) * scale : ImVec2(0, 0));
}

void draw_minimap(Board& board) {
  if (!(board.minimap.size.x > 0)) return;
  const float scale = board.theme().scale();
  const ImVec2 size = board.minimap.size;
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Box all = board.model.bounds().grown(60);
  const float k = std::min(size.x / all.size.x, size.y / all.size.y);
  const ImVec2 origin = board.minimap.centre() - all.centre() * k;
  list.AddRectFilled(board.minimap.low(), board.minimap.high(), faded(c.sunken, 0.88f), 4 * scale);
  list.PushClipRect(board.minimap.low(), board.minimap.high(), true);
  for (std::size_t n = 0; n < board.model.anchors(); ++n) {
    const Box& box = board.model.anchor(n);
    const bool is_box = n < board.model.boxes.size();
    const NodeBox* node = is_box ? &board.model.boxes[n] : nullptr;
    ImU32 tone = node == nullptr ? c.text_faint : faded(board.glances.of(n).tone, 0.75f);
    if (node != nullptr && board.editor.picks.nodes.contains(node->id)) tone = c.accent;
    const ImVec2 low = origin + box.low() * k, high = origin + box.high() * k;
    list.AddRectFilled(low, {std::max(high.x, low.x + 1), std::max(high.y, low.y + 1)}, tone);
  }
  const Box sight = board.camera.sight();
  list.AddRect(origin + sight.low() * k, origin + sight.high() * k, c.accent, 0, 0, 1.5f);
  list.PopClipRect();
  list.AddRect(board.minimap.low(), board.minimap.high(), c.line, 4 * scale);
}

void draw_hints(Board& board) {
  const Colours& c = board.theme().colours();
  const Box& pane = board.camera.pane();
  const float scale = board.theme().scale();
  if (board.model.boxes.empty()) {
    const std::string first = "Nothing here yet", second = "Press Tab, or double-click, to add a node";
    const ImVec2 middle = pane.centre();
    draw_text(board, middle - ImVec2(text_width(board, 17 * scale, first) / 2, 24 * scale), 17 * scale, c.text_soft, first);
    draw_text(board, middle - ImVec2(text_width(board, 13 * scale, second) / 2, -2 * scale), 13 * scale, c.text_faint, second);
  }
  if (board.model.undrawn > 0)
    draw_text(board, {pane.low().x + 12 * scale, board.camera.pane().low().y + 64 * scale}, 11 * scale, c.warning,
              reading::counted(board.model.undrawn, "link") + " of an unknown kind: kept unchanged, not drawn");
}

struct CardRow {
  std::string label, value;
  ImU32 colour = 0;
};

// Where it was drawn.
Box draw_card(Board& board, const Box& beside, const std::string& title, const std::vector<CardRow>& rows, bool is_pinned) {
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float scale = board.theme().scale(), pixels = 12 * scale, step = 17 * scale, pad = 10 * scale;
  float width = text_width(board, 13 * scale, title) + (is_pinned ? 20 * scale : 0);
  for (const CardRow& row : rows)
    width = std::max(width, text_width(board, pixels, row.label) +
                                (row.value.empty() ? 0 : 18 * scale + text_width(board, pixels, row.value)));
  width = std::min(width, 380 * scale);
  const Box& pane = board.camera.pane();
  const ImVec2 size{width + 2 * pad, 2 * pad + 20 * scale + step * static_cast<float>(rows.size())};
  ImVec2 at{beside.high().x + 12 * scale, beside.low().y};
  if (at.x + size.x > pane.high().x) at.x = beside.low().x - size.x - 12 * scale;
  at.x = std::clamp(at.x, pane.low().x + 4, std::max(pane.low().x + 4, pane.high().x - size.x - 4));
  at.y = std::clamp(at.y, pane.low().y + 4, std::max(pane.low().y + 4, pane.high().y - size.y - 4));
  list.AddRectFilled(at + ImVec2(0, 3), at + size + ImVec2(0, 4), IM_COL32(0, 0, 0, 60), 6 * scale);
  list.AddRectFilled(at, at + size, c.raised, 6 * scale);
  list.AddRect(at, at + size, is_pinned ? c.accent : c.line, 6 * scale);
  draw_text(board, at + ImVec2(pad, pad - 2 * scale), 13 * scale, c.text, title, width - (is_pinned ? 20 * scale : 0));
  float y = at.y + pad + 20 * scale;
  for (const CardRow& row : rows) {
    const float value = row.value.empty() ? 0 : std::min(text_width(board, pixels, row.value), 0.6f * width);
    draw_text(board, {at.x + pad, y}, pixels, row.colour != 0 ? row.colour : c.text_soft, row.label, width - value);
    if (!row.value.empty()) draw_text(board, {at.x + pad + width - value, y}, pixels, c.text, row.value, value + 1);
    y += step;
  }
  return {at, size};
}

// What is wrong comes first: a pinned card is short.
void add_troubles(const Board& board, const NodeBox& box, std::vector<CardRow>& rows) {
  const State& state = board.editor.state();
  const Colours& c = board.theme().colours();
  if (const std::string error = error_of(state, box.in_state); !error.empty()) rows.push_back({error, "", c.bad});
  for (const Pull& pull : pulls_of(state, box.in_state)) {
    rows.push_back({"Tension on " + pull.text, "", c.warning});
    const auto voices = voices_at(state, pull.port);
    for (std::size_t k = 0; k < voices.size() && k < kMostVoices; ++k) rows.push_back({"   " + voices[k], ""});
    if (voices.size() > kMostVoices) rows.push_back({"   and " + std::to_string(voices.size() - kMostVoices) + " more", ""});
  }
}

std::vector<CardRow> rows_of(const Board& board, const NodeBox& box) {
  const Workbench& editor = board.editor;
  const Colours& c = board.theme().colours();
  std::vector<CardRow> rows;
  if (box.in_state == kNoIndex) rows.push_back({"Computed from the next tick on.", "", c.text_faint});
  else add_troubles(board, box, rows);
  if (box.is_hidden) rows.push_back({"Hidden from the 3D view; Shift+H shows it", "", c.warning});
  for (const Section& section : box.sections) {
    rows.push_back({section.label, section.type == nullptr ? "unknown here" : "", colour_of(board, section)});
    if (section.type == nullptr) continue;
    std::size_t count = 0;
    for (std::size_t p = 0; p < section.type->ports.size() && count < kMostCardRows; ++p) {
      const PortDefinition& port = section.type->ports[p];
      if (is_derived(port.kind) || port.kind == ValueKind::table) continue;
      const Value* value = value_of(editor, box, section, p);
      if (value == nullptr || (!port.is_computed && *value == port.default_value)) continue;
      rows.push_back({label_of(port), text_of(editor, box, section, p)});
      ++count;
    }
  }
  return rows;
}

// Stays beside its node, inside the pane, until its cross is pressed.
void draw_pinned_card(Board& board, const NodeBox& box) {
  const Colours& c = board.theme().colours();
  std::vector<CardRow> rows = rows_of(board, box);
  if (rows.size() > kMostPinnedRows) {
    const std::size_t left = rows.size() - kMostPinnedRows + 1;
    rows.resize(kMostPinnedRows - 1);
    rows.push_back({"and " + std::to_string(left) + " more: point at the node", "", c.text_faint});
  }
  const Box card = draw_card(board, board.camera.to_screen(box.box), box.name + "  (" + box.id + ")", rows, true);
  const float scale = board.theme().scale(), arm = 3.5f * scale;
  const Box cross{{card.high().x - 24 * scale, card.low().y + 3 * scale}, ImVec2(20, 20) * scale};
  const bool is_hovered = board.hovered.thing == Thing::card_cross && board.hovered.id == box.id;
  const ImU32 ink = is_hovered ? c.accent : c.text_soft;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (const float side : {-1.0f, 1.0f})
    list.AddLine(cross.centre() + ImVec2(-arm, -arm * side), cross.centre() + ImVec2(arm, arm * side), ink, 1.5f * scale);
  board.crosses.emplace_back(box.id, cross);
}

void draw_link_card(Board& board, const Line& line) {
  const Workbench& editor = board.editor;
  const Colours& c = board.theme().colours();
  const auto found = editor.scene().links.find(line.id);
  if (found == editor.scene().links.end()) return;  // another panel has just removed it
  const LinkRecord& link = found->second;
  std::vector<CardRow> rows{{text_of(editor, board.model.selection_of(line.from)) + "  \xe2\x86\x92  " +
                                 text_of(editor, board.model.selection_of(line.to)),
                             ""}};
  rows.push_back({"strength", reading::readable(link.strength)});
  for (const auto& [parameter, value] : link.parameters)
    if (const PortDefinition* port = line.definition == nullptr ? nullptr : line.definition->find_port(parameter)) {
      const auto* text = std::get_if<std::string>(&value);
      rows.push_back({parameter, text != nullptr ? *text : reading::quantity(as_number(value), port->unit)});
    }
  if (link.is_muted) rows.push_back({"muted: shown, but its proposals do not count", "", c.warning});
  if (!link.is_enabled) rows.push_back({"off: not evaluated", "", c.warning});
  if (const LinkPulse* pulse = board.live.pulse(line.id); pulse != nullptr && !pulse->text.empty())
    rows.push_back({"last change", pulse->text});
  if (line.definition == nullptr)
    rows.push_back({"This kind is unknown to the program: the link is kept unchanged and does not run.", "", c.text_faint});
  if (const std::string error = link_error(board, line); !error.empty()) rows.push_back({error, "", c.bad});
  const ImVec2 at = ImGui::GetIO().MousePos;
  draw_card(board, {at, {8, 8}}, line.label + "  (" + line.id + ")", rows, false);
}

void draw_frame_card(Board& board, const std::string& id) {
  const auto frame = board.model.view.frames.find(id);
  Box box;
  if (frame == board.model.view.frames.end() || !board.model.frame_box(id, box)) return;
  std::size_t count = 0;
  for (const NodeBox& node : board.model.boxes) count += board.model.view.holds_node(id, node.id) ? 1 : 0;
  const Box head = board.camera.to_screen({box.at, {box.size.x, kFrameHead}});
  draw_card(board, {{std::min(ImGui::GetIO().MousePos.x, head.high().x), head.low().y}, {8, head.size.y}},
            frame->second.name.empty() ? "Frame" : frame->second.name,
            {{reading::counted(count, "node"), ""}, {"Double-click or I enters, F2 renames", ""}}, false);
}

}  // namespace

void place_overlays(Board& board) {
  const float scale = board.theme().scale();
  board.chips.clear();
  const Box& pane = board.camera.pane();
  const float crumbs = place_crumbs(board);
  const ImVec2 begin = pane.low() + ImVec2(10 * scale, crumbs + 10 * scale);
  ImVec2 at = begin;
  int rows = 1;
  for (const auto& [label, colour] : board.model.families) {
    const float width = text_width(board, kChipText * scale, label) + 28 * scale;
    const bool is_full = at.x + width > pane.high().x - 10 * scale && at.x > pane.low().x + 11 * scale;
    if (is_full) at = {begin.x, at.y + kChipStep * scale}, ++rows;
    board.chips.emplace_back(label, Box{at, {width, kChipHeight * scale}});
    at.x += width + 6 * scale;
  }
  const auto foot = [&] { return at.y + (kChipHeight + 2) * scale - pane.low().y; };
  board.families.is_folded = board.chips.size() > 1 && (rows > kMostChipRows || foot() - crumbs > kMostChipShare * pane.size.y);
  if (board.families.is_folded) {
    at = begin;
    const float width = text_width(board, kChipText * scale, folded_label(board)) + 34 * scale;
    board.chips = {{"", Box{at, {width, kChipHeight * scale}}}};
  }
  board.camera.set_head(board.chips.empty() ? crumbs : foot());
  place_minimap(board);
}

void press_chip(Board& board, const std::string& family) {
  if (family.empty()) board.families.is_opening = true;
  else switch_family(board, family);
}

void draw_family_list(Board& board) {
  FamilyList& families = board.families;
  if (families.is_opening && !board.chips.empty()) {
    ImGui::OpenPopup(kFamilyList);
    const Box& chip = board.chips.front().second;
    ImGui::SetNextWindowPos({chip.low().x, chip.high().y + board.theme().px(4)});
  }
  families.is_opening = false;
  families.rows.clear();
  families.is_open = ImGui::BeginPopup(
      kFamilyList, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
  if (!families.is_open) return;
  for (const auto& [label, colour] : board.model.families) {
    bool is_on = !board.hidden_families.contains(label);
    ImGui::PushStyleColor(ImGuiCol_CheckMark, colour);
    if (ImGui::Checkbox(label.c_str(), &is_on)) switch_family(board, label);
    ImGui::PopStyleColor();
    const ImVec2 low = ImGui::GetItemRectMin();
    families.rows.emplace_back(label, Box{low, ImGui::GetItemRectMax() - low});
  }
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

void draw_overlays(Board& board) {
  draw_chips(board);
  draw_crumbs(board);
  draw_minimap(board);
  draw_hints(board);
}

void draw_cards(Board& board) {
  board.crosses.clear();
  for (const std::string& id : board.pinned)
    if (const std::size_t k = board.model.find_box(id); k < board.model.boxes.size())
      draw_pinned_card(board, board.model.boxes[k]);
  const Hit& hit = board.hovered;
  if (board.drag.deed != DragMode::none) return;
  if (board.editor.now - board.hovered_since < kCardSeconds) {
    if (hit.thing != Thing::nothing) board.editor.wake_at(board.hovered_since + kCardSeconds);
    return;
  }
  const bool is_pinned = std::find(board.pinned.begin(), board.pinned.end(), hit.id) != board.pinned.end();
  if ((hit.thing == Thing::node || hit.thing == Thing::node_edge) && !is_pinned && hit.index < board.model.boxes.size())
    draw_card(board, board.camera.to_screen(board.model.boxes[hit.index].box),
              board.model.boxes[hit.index].name + "  (" + hit.id + ")", rows_of(board, board.model.boxes[hit.index]), false);
  if (hit.thing == Thing::door && board.model.is_door(hit.index) && hit.index < board.model.anchors()) {
    const Door& door = board.model.doors[hit.index - board.model.boxes.size() - board.model.pills.size()];
    draw_card(board, board.camera.to_screen(door.box), door.label, {{"Outside of this frame: click to go there", ""}}, false);
  }
  if (hit.thing == Thing::frame) draw_frame_card(board, hit.id);
  if (hit.thing == Thing::link)
    if (const std::size_t k = board.model.find_line(hit.id); k < board.model.lines.size())
      draw_link_card(board, board.model.lines[k]);
}

}  // namespace bl::desktop::canvas
