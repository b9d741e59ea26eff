// Lines of links and pills of sets.
#include <array>

#include "ui/desktop/panels/canvas/draw.h"

namespace bl::desktop::canvas {

namespace {

constexpr double kLabelZoom = 0.72, kFigureZoom = 0.5, kPulseSeconds = 0.9, kPulseZoom = 0.14;
constexpr float kDash = 7, kDashGap = 5;
constexpr std::size_t kReasonLetters = 44;

struct Stroke {
  ImU32 colour = 0;
  float width = 1;
  bool is_lit = false;
};

bool is_lit(const Board& board, const Line& line) {
  const Picks& picks = board.editor.picks;
  if (picks.links.contains(line.id) || picks.lit_link == line.id) return true;
  if (board.hovered.thing == Thing::pill || board.hovered.thing == Thing::pill_edge)
    return line.from == board.hovered.index || line.to == board.hovered.index;
  const auto& boxes = board.model.boxes;
  const auto is_shown = [&](std::size_t anchor) { return anchor < boxes.size() && boxes[anchor].id == picks.lit_node; };
  return !picks.lit_node.empty() && (is_shown(line.from) || is_shown(line.to));
}

Stroke stroke_of(const Board& board, const Line& line) {
  const Colours& c = board.theme().colours();
  const float zoom = static_cast<float>(board.camera.zoom());
  Stroke stroke{line.definition == nullptr ? c.text_faint : line.family.colour,
                (1 + 1.6f * line.strength) * std::clamp(zoom, 0.45f, 1.5f) * board.theme().scale(), is_lit(board, line)};
  float opacity = !line.is_enabled ? 0.28f : line.is_muted ? 0.6f : 0.82f;
  if (board.editor.picks.links.contains(line.id)) stroke.colour = c.accent, stroke.width *= 1.35f, opacity = 1;
  else if (stroke.is_lit) stroke.width *= 1.3f, opacity = std::min(1.0f, opacity + 0.2f);
  if (board.drag.cut.contains(line.id)) stroke.colour = c.bad, opacity = 1;
  stroke.colour = faded(stroke.colour, opacity);
  return stroke;
}

void draw_dashed(ImDrawList& list, const std::vector<ImVec2>& points, const Stroke& stroke, float dash, float gap) {
  float left = dash;
  bool is_on = true;
  for (std::size_t k = 1; k < points.size(); ++k) {
    ImVec2 from = points[k - 1];
    float rest = length(points[k] - from);
    const ImVec2 way = unit_vector(points[k] - from);
    while (rest > 0) {
      const float step = std::min(rest, left);
      const ImVec2 to = from + way * step;
      if (is_on) list.AddLine(from, to, stroke.colour, stroke.width);
      rest -= step, left -= step, from = to;
      if (left <= 0) is_on = !is_on, left = is_on ? dash : gap;
    }
  }
}

void draw_arrow(ImDrawList& list, ImVec2 tip, ImVec2 from, float size, ImU32 colour) {
  const ImVec2 way = unit_vector(tip - from), side{-way.y, way.x};
  list.AddTriangleFilled(tip, tip - way * size + side * (0.5f * size), tip - way * size - side * (0.5f * size), colour);
}

// The point from which an arrow at the end of the curve comes.
ImVec2 before_tip(const std::vector<ImVec2>& points, bool at_end, float reach) {
  const ImVec2 tip = at_end ? points.back() : points.front();
  for (std::size_t k = 0; k < points.size(); ++k) {
    const ImVec2 p = at_end ? points[points.size() - 1 - k] : points[k];
    if (length(p - tip) > reach) return p;
  }
  return at_end ? points.front() : points.back();
}

// A chip of text that the line runs through.
void draw_chip(Board& board, ImVec2 middle, const std::string& text, float pixels, ImU32 ink, ImU32 edge) {
  const float width = text_width(board, pixels, text), pad = 0.4f * pixels;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 low{middle.x - width / 2 - pad, middle.y - 0.72f * pixels},
      high{middle.x + width / 2 + pad, middle.y + 0.72f * pixels};
  list.AddRectFilled(low, high, faded(board.theme().colours().canvas, 0.92f), 0.4f * pixels);
  if (edge != 0) list.AddRect(low, high, edge, 0.4f * pixels);
  draw_text(board, {low.x + pad, middle.y - 0.6f * pixels}, pixels, ink, text);
}

void draw_pulse(Board& board, const Line& line, const LinkPulse& pulse, float width) {
  const double age = board.editor.now - pulse.pulse_at;
  if (pulse.pulse_at < 0 || age > kPulseSeconds || board.camera.zoom() < kPulseZoom) return;
  board.editor.go_on();
  // Where a link writes in every tick, its pulse goes on running; it fades once the writing ends.
  const double share = std::fmod(board.editor.now, kPulseSeconds) / kPulseSeconds;
  const float light = static_cast<float>(1 - age / kPulseSeconds);
  const bool is_back = line.changes_from && !line.changes_to;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 colour = faded(mixed(line.family.colour, board.theme().colours().text, 0.45f), light);
  const auto spot = [&](double at) {
    list.AddCircleFilled(board.camera.to_screen(line.at_share(static_cast<float>(at))),
                         width * 1.2f + static_cast<float>(std::min(1.0, board.camera.zoom())), colour, 10);
  };
  if (line.changes_to) spot(share);
  if (line.changes_from && (is_back || line.changes_to)) spot(1 - share);
}

void draw_labels(Board& board, const Line& line, const Stroke& stroke, const std::string& error) {
  const Colours& c = board.theme().colours();
  const double zoom = board.camera.zoom();
  const float k = board.camera.factor();
  const ImVec2 middle = board.camera.to_screen(line.middle());
  const LinkPulse* pulse = board.live.pulse(line.id);
  std::string text;
  if (zoom > kLabelZoom || stroke.is_lit) text = line.label;
  if (line.is_muted && !text.empty()) text += " (muted)";
  if (!line.is_enabled && !text.empty()) text += " (off)";
  const bool shows_figure = line.is_enabled && pulse != nullptr && !pulse->text.empty();
  if ((zoom > kFigureZoom || stroke.is_lit) && shows_figure) text += (text.empty() ? "" : "  ") + pulse->text;
  const float pixels = std::max(10.5f * k, (stroke.is_lit ? 10.5f : 8.5f) * board.theme().scale());
  if (!error.empty()) {
    const float radius = std::max(3.0f, 6 * k);
    ImGui::GetWindowDrawList()->AddCircleFilled(middle, radius, line.definition == nullptr ? c.text_faint : c.bad, 16);
    if (zoom <= kFigureZoom && !stroke.is_lit) return;
    // The whole reason stands beside a link that is pointed at; else its beginning is enough.
    std::string reason = line.label + ": " + error;
    if (!stroke.is_lit && reason.size() > kReasonLetters) reason = line.label + ": not running";
    draw_chip(board, {middle.x, middle.y + radius + 0.8f * pixels}, reason, pixels,
              line.definition == nullptr ? c.text_faint : c.bad, 0);
    return;
  }
  if (text.empty()) return;
  const bool is_over = !is_longer_than(board, line, text_width(board, pixels, text) + 0.8f * pixels);
  // Shorter than its label, the line would vanish under it; where it is pointed at, the label stands below.
  if (is_over && !stroke.is_lit) return;
  draw_chip(board, {middle.x, middle.y + (is_over ? 1.3f * pixels : 0)}, text, pixels, stroke.is_lit ? c.text : c.text_soft,
            stroke.is_lit ? stroke.colour : 0);
}

void draw_line(Board& board, const Line& line, std::vector<ImVec2>& points) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Stroke stroke = stroke_of(board, line);
  const float k = board.camera.factor();
  points.clear();
  for (const ImVec2& p : line.points) points.push_back(board.camera.to_screen(p));
  if (line.is_muted || line.definition == nullptr)
    draw_dashed(list, points, stroke, kDash * board.theme().scale(), kDashGap * board.theme().scale());
  else list.AddPolyline(points.data(), static_cast<int>(points.size()), stroke.colour, 0, stroke.width);
  const float arrow = std::max(4.0f, 5 + 2 * stroke.width) * std::clamp(k, 0.5f, 1.4f);
  if (k > 0.12f) {
    if (line.changes_to) draw_arrow(list, points.back(), before_tip(points, true, arrow), arrow, stroke.colour);
    if (line.changes_from) draw_arrow(list, points.front(), before_tip(points, false, arrow), arrow, stroke.colour);
  }
  for (const ImVec2& dot : line.dots) list.AddCircleFilled(board.camera.to_screen(dot), std::max(2.0f, 4 * k), stroke.colour, 12);
  if (const LinkPulse* pulse = board.live.pulse(line.id)) draw_pulse(board, line, *pulse, stroke.width);
}

}  // namespace

std::string link_error(const Board& board, const Line& line) {
  if (line.in_state == kNoIndex) return "";
  const State& state = board.editor.state();
  const auto& running = state.links[line.in_state].error;
  const auto& error = running ? running : state.plan->links[line.in_state].error;
  return error ? error->message : "";
}

bool is_longer_than(const Board& board, const Line& line, float pixels) {
  float left = pixels / board.camera.factor();
  for (std::size_t k = 1; k < line.points.size() && left >= 0; ++k) left -= length(line.points[k] - line.points[k - 1]);
  return left < 0;
}

void draw_lines(Board& board) {
  const Box sight = board.camera.sight().grown(40);
  std::vector<ImVec2> points;
  std::vector<const Line*> seen;
  for (const Line& line : board.model.lines)
    if (line.bounds.touches(sight) && !board.is_hidden(line)) seen.push_back(&line);
  for (const Line* line : seen) draw_line(board, *line, points);
}

void draw_line_labels(Board& board) {
  const Box sight = board.camera.sight().grown(40);
  for (const bool lit : {false, true})
    for (const Line& line : board.model.lines) {
      if (!line.bounds.touches(sight) || board.is_hidden(line)) continue;
      const Stroke stroke = stroke_of(board, line);
      if (stroke.is_lit == lit)
        draw_labels(board, line, stroke, line.definition == nullptr ? "kept as it is, not run" : link_error(board, line));
    }
}

void draw_pills(Board& board) {
  const Colours& c = board.theme().colours();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float k = board.camera.factor();
  const Box sight = board.camera.sight().grown(20);
  for (std::size_t p = 0; p < board.model.pills.size(); ++p) {
    const Pill& pill = board.model.pills[p];
    const std::size_t anchor = board.model.boxes.size() + p;
    const bool is_hovered =
        (board.hovered.thing == Thing::pill || board.hovered.thing == Thing::pill_edge) && board.hovered.index == anchor;
    const auto& lit = board.editor.picks;
    const bool is_lit =
        is_hovered || std::any_of(board.model.lines.begin(), board.model.lines.end(), [&](const Line& line) {
          return (line.from == anchor || line.to == anchor) && (lit.lit_link == line.id || lit.links.contains(line.id));
        });
    const bool is_named = !pill.selection.is_query();
    if (is_lit || is_named)
      for (const std::size_t member : pill.members) {
        const Box box = board.camera.to_screen(board.model.boxes[member].box);
        const ImVec2 from = board.camera.to_screen(pill.box).centre();
        list.AddLine(from, box.centre(), faded(c.accent, is_lit ? 0.22f : 0.12f), 1.0f);
        if (is_lit) list.AddRect(box.low() - ImVec2(3, 3), box.high() + ImVec2(3, 3), faded(c.accent, 0.8f), 5, 0, 2);
      }
    if (!pill.box.touches(sight)) continue;
    const Box screen = board.camera.to_screen(pill.box);
    const float round = screen.size.y / 2;
    list.AddRectFilled(screen.low(), screen.high(), mixed(c.canvas, c.accent, 0.14f), round);
    list.AddRect(screen.low(), screen.high(), is_lit ? c.accent : mixed(c.line, c.accent, 0.35f), round, 0, is_lit ? 2.0f : 1.2f);
    // Three dots for "many".
    if (board.camera.zoom() > 0.3)
      for (int dot = 0; dot < 3; ++dot)
        list.AddCircleFilled(
            screen.low() + ImVec2((11 + 4.5f * static_cast<float>(dot % 2)) * k, (9 + 4.0f * static_cast<float>(dot)) * k),
            1.8f * k, c.accent, 8);
    // Too small to be written in, it is named below.
    const float pixels = 11.5f * k, least = 9.5f * board.theme().scale();
    if (board.camera.zoom() < kPulseZoom) continue;
    if (pixels < 0.85f * least)
      draw_text(board, {screen.low().x, screen.high().y + 2}, least, c.text_soft, pill.label, std::max(90.0f, screen.size.x));
    else
      draw_text(board, {screen.low().x + 22 * k, screen.centre().y - 0.6f * pixels}, pixels, c.text, pill.label,
                screen.size.x - 26 * k);
  }
}

}  // namespace bl::desktop::canvas
