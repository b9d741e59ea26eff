// Boxes of nodes: far away a name and a colour, nearer their sections, nearest all values.
#include "ui/desktop/panels/canvas/bars.h"
#include "ui/desktop/panels/canvas/draw.h"
#include "ui/desktop/panels/canvas/sections.h"
#include "ui/desktop/panels/canvas/tension.h"
#include "ui/desktop/panels/stream_text.h"
#include "ui/desktop/view/colouring.h"

namespace bl::desktop::canvas {

namespace {

// Below the first zoom a box is a name; below the second, fewer values are written larger.
constexpr double kNameZoom = 0.42, kTextZoom = 0.6;
constexpr float kRounding = 5, kPad = 9, kHeadText = 13, kSectionText = 10.5f, kRowText = 11.5f, kLeastText = 9, kLeastHead = 11;
constexpr double kLeastSpan = 0.02;  // of a spark-line, as a share of its value

struct Ink {
  Board& board;
  ImDrawList& list;
  const Colours& c;
  float k;  // pixels for one unit of the plane
  double zoom;

  ImVec2 at(float x, float y) const { return board.camera.to_screen(ImVec2(x, y)); }
};

void draw_bar_ground(const Ink& ink, ImVec2 low, ImVec2 high, float share, AccountTone tone) {
  ink.list.AddRectFilled(low, high, ink.c.sunken);
  ink.list.AddRectFilled(low, {low.x + (high.x - low.x) * share, high.y},
                         faded(colour_of_account(ink.board.theme(), tone), 0.85f));
}

void draw_bar_of(const Ink& ink, const BarFigures& bar, ImVec2 low, ImVec2 high) {
  const auto x_of = [&](double v) { return low.x + (high.x - low.x) * bar.share(v); };
  draw_bar_ground(ink, low, high, bar.share(bar.account.volume), bar.tone);
  // What was asked for, and what limits leave of it where that is less.
  const float reach = std::max(1.0f, 1.5f * ink.k);
  const double asked = bar.account.asked, limited = bar.account.limited;
  ink.list.AddRectFilled({x_of(asked) - reach, low.y - reach}, {x_of(asked), high.y + reach}, ink.c.text);
  if (bar.is_limited) ink.list.AddRectFilled({x_of(limited) - reach, low.y}, {x_of(limited), high.y}, ink.c.warning);
}

void draw_spark(const Ink& ink, const Spark& samples, ImVec2 low, ImVec2 high, ImU32 colour) {
  double least = samples.front().second, most = least;
  for (const auto& [time, value] : samples) least = std::min(least, value), most = std::max(most, value);
  // A value that stands still is a straight line in the middle, not its own rounding magnified.
  const double span = std::max(most - least, kLeastSpan * std::max(std::abs(most), 1e-9));
  // Up to the last sample: where nothing happens, the line stands.
  const double middle = (least + most) / 2, now = samples.back().first;
  std::vector<ImVec2> points;
  for (const auto& [time, value] : samples) {
    const double x = std::clamp(1 - (now - time) / kSparkSeconds, 0.0, 1.0);
    const double y = std::clamp(0.5 - (value - middle) / span, 0.0, 1.0);
    points.push_back({low.x + static_cast<float>(x) * (high.x - low.x), low.y + static_cast<float>(y) * (high.y - low.y)});
  }
  points.push_back({high.x, points.back().y});
  ink.list.AddPolyline(points.data(), static_cast<int>(points.size()), faded(colour, 0.9f), 0, std::max(1.0f, 1.2f * ink.k));
  ink.list.AddCircleFilled(points.back(), std::max(1.5f, 2 * ink.k), colour, 8);
}

// A sign that is read without its colour: an upright triangle.
void draw_warning(const Ink& ink, ImVec2 middle, float size, ImU32 colour) {
  ink.list.AddTriangleFilled({middle.x, middle.y - size}, {middle.x + size, middle.y + 0.8f * size},
                             {middle.x - size, middle.y + 0.8f * size}, colour);
  ink.list.AddRectFilled({middle.x - 0.12f * size, middle.y - 0.4f * size}, {middle.x + 0.12f * size, middle.y + 0.5f * size},
                         ink.c.node);
}

void draw_row(const Ink& ink, const NodeBox& box, const Section& section, std::size_t row, float y, float size) {
  const float left = box.box.at.x + kPad, right = box.box.high().x - kPad;
  const std::string& text = section.texts[row];
  const float width = std::min(text_width(ink.board, size, text), 112 * ink.k);
  bool is_tense = false;
  if (box.in_state != kNoIndex && section.in_state != kNoIndex)
    is_tense = tension_share(ink.board.editor.state(), {box.in_state, static_cast<std::uint16_t>(section.in_state),
                                                        static_cast<std::uint16_t>(section.rows[row].port)}) > kMarkedTension;
  const ImVec2 at = ink.at(left, y + 1.5f), end = ink.at(right, y);
  if (is_tense) draw_warning(ink, {end.x - width - 8 * ink.k, at.y + 0.55f * size}, 4 * ink.k, ink.c.warning);
  draw_text(ink.board, at, size, ink.c.text_soft, section.rows[row].label, end.x - at.x - width - 14 * ink.k);
  draw_text(ink.board, {end.x - width, at.y}, size, is_tense ? ink.c.warning : ink.c.text, text, width + 1);
}

void draw_section_head(const Ink& ink, const NodeBox& box, const Section& section, float y) {
  const ImU32 tone = colour_of(ink.board, section);
  const ImVec2 low = ink.at(box.box.at.x, y), high = ink.at(box.box.high().x, y + kSectionHeight - 2);
  ink.list.AddRectFilled(low, high, mixed(ink.c.node, tone, 0.22f));
  ink.list.AddRectFilled(low, {low.x + 3 * ink.k, high.y}, tone);
  if (ink.zoom >= kTextZoom)
    draw_text(ink.board, ink.at(box.box.at.x + kPad, y + 2), kSectionText * ink.k, mixed(ink.c.text, tone, 0.25f), section.label,
              (kBoxWidth - 2 * kPad) * ink.k);
}

void draw_bar_line(const Ink& ink, const NodeBox& box, float y) {
  const float left = box.box.at.x + kPad, right = box.box.high().x - kPad;
  const BarFigures bar = bar_figures(ink.board.editor, box);
  float text_right = right;
  if (ink.zoom >= kTextZoom) {
    const std::string text = bar.text();
    const float size = 10 * ink.k, width = text_width(ink.board, size, text);
    const ImVec2 end = ink.at(right, y + 3);
    draw_text(ink.board, {end.x - width, end.y}, size, ink.c.text_soft, text);
    text_right = right - width / ink.k - 7;
  }
  draw_bar_of(ink, bar, ink.at(left, y + 6), ink.at(std::max(text_right, left + 24), y + 12));
}

// The last reading or message: its value at the left, its age and quality at the right, in the colour of its standing.
void draw_stream_line(const Ink& ink, const NodeBox& box, const Section& section, float y) {
  if (ink.zoom < kTextZoom || box.in_state == kNoIndex || section.in_state == kNoIndex) return;
  const Workbench& editor = ink.board.editor;
  const auto stream = stream_of(editor, editor.state(), box.in_state, section.in_state);
  if (!stream) return;
  const ImVec2 low = ink.at(box.box.at.x + 6, y + 2), high = ink.at(box.box.high().x - 6, y + kStreamHeight - 1);
  const ImU32 colour = colour_of(editor.theme, stream->standing);
  ink.list.AddRectFilled(low, high, mixed(ink.c.sunken, colour, stream->standing == StreamStanding::silent ? 0.0f : 0.16f),
                         3 * ink.k);
  const float size = kRowText * ink.k, middle = (low.y + high.y) / 2, top = middle - 0.6f * size, gap = 5 * ink.k;
  draw_standing(ink.list, editor.theme, {low.x + 8 * ink.k, middle}, 3.2f * ink.k, stream->standing);
  const float begin = low.x + 16 * ink.k, end = high.x - gap;
  const float value = text_width(ink.board, size, stream->value);
  // Where there is no room for all, the sign and the colour stand for the quality.
  std::string rest = stream->age;
  if (!stream->quality.empty()) {
    const std::string longer = rest + (rest.empty() ? "" : ", ") + stream->quality;
    if (begin + value + gap + text_width(ink.board, size, longer) <= end || rest.empty()) rest = longer;
  }
  const float room = end - begin, taken = std::min(text_width(ink.board, size, rest), std::max(0.45f * room, room - value - gap));
  draw_text(ink.board, {begin, top}, size, ink.c.text, stream->value, room - taken - gap);
  draw_text(ink.board, {end - taken, top}, size,
            stream->standing == StreamStanding::good ? ink.c.text_soft : mixed(colour, ink.c.text, 0.25f), rest, taken + 1);
}

// From further away fewer rows, in a size that can still be read: the residual is the first to go, for the bar shows it too.
float draw_rows(const Ink& ink, const NodeBox& box, const Section& section, float y) {
  const float foot = y + kRowHeight * static_cast<float>(section.rows.size());
  const float size = std::max(kRowText * ink.k, kLeastText * ink.board.theme().scale());
  const float step = std::max(kRowHeight, 1.25f * size / ink.k);
  std::size_t room = static_cast<std::size_t>((foot - y) / step + 0.05f);
  const bool is_short = room < section.rows.size();
  for (std::size_t row = 0; row < section.rows.size() && room > 0; ++row) {
    if (is_short && section.type->ports[section.rows[row].port].is_residual) continue;
    draw_row(ink, box, section, row, y, size);
    y += step;
    --room;
  }
  return foot;
}

float draw_section(const Ink& ink, const NodeBox& box, Section& section, std::size_t number, float y) {
  draw_section_head(ink, box, section, y);
  y += kSectionHeight;
  if (section.type == nullptr) {
    if (ink.zoom >= kTextZoom)
      draw_text(ink.board, ink.at(box.box.at.x + kPad, y + 1), kRowText * ink.k, ink.c.text_faint,
                "unknown here: kept unchanged, not run", (kBoxWidth - 2 * kPad) * ink.k);
    return y + kRowHeight;
  }
  if (section.has_bar) draw_bar_line(ink, box, y), y += kBarHeight;
  if (section.is_stream) draw_stream_line(ink, box, section, y), y += kStreamHeight;
  refresh_texts(ink.board.editor, box, section, ink.board.model.state_revision);
  y = draw_rows(ink, box, section, y);
  if (section.spark != kNoIndex) {
    const Spark spark = ink.board.live.spark(box.id, number);
    const ImVec2 low = ink.at(box.box.at.x + kPad, y + 4), high = ink.at(box.box.high().x - kPad, y + kSparkHeight - 4);
    ink.list.AddLine({low.x, high.y}, high, faded(ink.c.line, 0.8f));
    if (spark.size() > 1) draw_spark(ink, spark, low, high, colour_of(ink.board, section));
    y += kSparkHeight;
  }
  return y;
}

bool is_result(const PortDefinition& port) { return port.is_computed && !port.is_residual; }

// An eye that is crossed out: the 3D view leaves the node out. `right`: where it ends. Returns the width that it takes.
float draw_hidden_badge(const Ink& ink, const NodeBox& box, ImVec2 right, float size) {
  if (!box.is_hidden || size < 5) return 0;
  ImFont* font = ink.board.theme().fonts().body;
  const float width = font->CalcTextSizeA(size, 1e9f, 0, icon::kHidden).x;
  ink.list.AddText(font, size, {right.x - width, right.y - 0.5f * size}, ink.c.text_soft, icon::kHidden);
  return width + 0.4f * size;
}

// Far away: the name as large as fits, on the colour of the first role.
void draw_as_name(const Ink& ink, NodeBox& box, const Glance& glance, const Box& screen) {
  const ImU32 tone = glance.tone;
  const float round = screen.size.x > 40 ? 3.0f : 0.0f, stripe = std::max(2.0f, 6 * ink.k), bar = std::max(2.0f, 12 * ink.k);
  ink.list.AddRectFilled(screen.low(), screen.high(), mixed(ink.c.node, tone, 0.14f), round);
  ink.list.AddRectFilled(screen.low(), {screen.low().x + stripe, screen.high().y}, tone, round, ImDrawFlags_RoundCornersLeft);
  if (glance.has_bar && !box.is_collapsed)
    draw_bar_ground(ink, {screen.low().x + stripe + 2, screen.high().y - bar - 2}, screen.high() - ImVec2(3, 2), glance.bar_share,
                    glance.bar_tone);
  if (screen.size.x < 34) return;
  const float badge = std::max(12 * ink.k, 9 * ink.board.theme().scale());
  draw_hidden_badge(
      ink, box, {screen.high().x - 4, box.is_collapsed ? screen.centre().y : screen.high().y - bar - 3 - 0.5f * badge}, badge);
  const float pixels = name_height(ink.board, box);
  const float pad = std::max(5.0f, 10 * ink.k);
  // A collapsed box is a bar of the height of its name.
  if (box.is_collapsed) {
    const float taken = box.is_hidden ? 1.4f * badge : 0;
    draw_text(ink.board, {screen.low().x + pad, screen.centre().y - 0.59f * pixels}, pixels, ink.c.text, box.name,
              screen.size.x - pad - 3 - taken);
    return;
  }
  const ImVec4 clip(screen.low().x, screen.low().y, screen.high().x - 2, screen.high().y - bar - 2);
  ImFont* font = ink.board.theme().canvas_font(pixels);
  ink.list.AddText(font, pixels, {screen.low().x + pad, screen.low().y + 3}, ink.c.text, box.name.c_str(), nullptr,
                   screen.size.x - pad - 3, &clip);
  // Its first result at the foot, where there is room for it.
  if (screen.size.x < 58 || screen.size.y < 52 || box.sections.empty() || box.sections.front().type == nullptr) return;
  Section& section = box.sections.front();
  const float foot = screen.high().y - bar - 5 - pixels, room = screen.size.x - pad - 4;
  if (section.is_stream && box.in_state != kNoIndex && section.in_state != kNoIndex) {
    const Workbench& editor = ink.board.editor;
    if (const auto stream = stream_of(editor, editor.state(), box.in_state, section.in_state))
      draw_text(ink.board, {screen.low().x + pad, foot}, 0.85f * pixels,
                mixed(colour_of(editor.theme, stream->standing), ink.c.text, 0.3f), stream->value, room);
    return;
  }
  refresh_texts(ink.board.editor, box, section, ink.board.model.state_revision);
  std::size_t row = 0;
  while (row < section.rows.size() && !is_result(section.type->ports[section.rows[row].port])) ++row;
  if (row < section.texts.size())
    draw_text(ink.board, {screen.low().x + pad, foot}, 0.85f * pixels, ink.c.text_soft, section.texts[row], room);
}

void draw_head(const Ink& ink, const NodeBox& box, double tension, bool has_error) {
  const Box screen = ink.board.camera.to_screen(Box{box.box.at, {kBoxWidth, kHeadHeight}});
  const float round = kRounding * ink.k;
  ink.list.AddRectFilled(screen.low(), screen.high(), ink.c.node_head, round,
                         box.is_collapsed ? ImDrawFlags_RoundCornersAll : ImDrawFlags_RoundCornersTop);
  ink.list.AddRectFilled(screen.low(), {screen.low().x + 4 * ink.k, screen.high().y}, tone_of(ink.board, box), round,
                         box.is_collapsed ? ImDrawFlags_RoundCornersLeft : ImDrawFlags_RoundCornersTopLeft);
  float room = (kBoxWidth - 2 * kPad) * ink.k;
  const float y = screen.centre().y;
  float x = screen.high().x - 13 * ink.k;
  if (has_error) {
    ink.list.AddCircleFilled({x, y}, 6 * ink.k, ink.c.bad, 16);
    draw_text(ink.board, {x - 1.6f * ink.k, y - 6.2f * ink.k}, 11 * ink.k, ink.c.on_accent, "!");
    x -= 16 * ink.k, room -= 16 * ink.k;
  }
  if (tension > kMarkedTension) draw_warning(ink, {x, y}, 5.5f * ink.k, ink.c.warning), x -= 16 * ink.k, room -= 16 * ink.k;
  if (box.is_collapsed) x -= 10 * ink.k * static_cast<float>(box.sections.size());
  room -= draw_hidden_badge(ink, box, {x + 6 * ink.k, y}, 13 * ink.k);
  if (box.is_collapsed)
    for (const Section& section : box.sections) {
      room -= 10 * ink.k;
      ink.list.AddCircleFilled(
          {screen.high().x - 10 * ink.k - (static_cast<float>(&section - box.sections.data())) * 10 * ink.k, y}, 3 * ink.k,
          colour_of(ink.board, section), 10);
    }
  const float size = readable_height(kHeadText * ink.k, kLeastHead * ink.board.theme().scale(), 0.8f * screen.size.y);
  draw_text(ink.board, {screen.low().x + kPad * ink.k, y - 0.59f * size}, size, box.is_ghost() ? ink.c.text_faint : ink.c.text,
            box.name, room);
}

// `stands_out`: it is chosen or pointed at.
void draw_outline(const Ink& ink, const NodeBox& box, const Box& screen, bool has_error, bool stands_out) {
  const bool is_picked = stands_out && ink.board.editor.picks.nodes.contains(box.id), is_hovered = stands_out && !is_picked;
  const float round = ink.zoom < kNameZoom ? (screen.size.x > 40 ? 3.0f : 0.0f) : kRounding * ink.k;
  const float scale = ink.board.theme().scale();
  // Thousands of small boxes are told apart by the ground between them.
  if (!stands_out && !has_error && screen.size.x < 40) return;
  const ImU32 colour = is_picked    ? ink.c.accent
                       : has_error  ? ink.c.bad
                       : is_hovered ? mixed(ink.c.line, ink.c.accent, 0.6f)
                                    : ink.c.line;
  ink.list.AddRect(screen.low(), screen.high(), colour, round, 0, (is_picked ? 2.0f : 1.0f) * scale);
}

// Who else in the room has chosen it.
void draw_holder(const Ink& ink, const Box& screen, const Other& other) {
  const float scale = ink.board.theme().scale(), size = 11 * scale, gap = 3 * scale;
  const ImVec2 low = screen.low() - ImVec2(gap, gap), high = screen.high() + ImVec2(gap, gap);
  ink.list.AddRect(low, high, other.colour, 4 * scale, 0, 2 * scale);
  const float width = text_width(ink.board, size, other.name);
  ink.list.AddRectFilled({low.x, low.y - size - 2 * gap}, {low.x + width + 2 * gap, low.y}, other.colour, 2 * scale);
  draw_text(ink.board, {low.x + gap, low.y - size - gap}, size, IM_COL32(255, 255, 255, 255), other.name);
}

// Places to pull a link from.
void draw_handles(const Ink& ink, const Box& screen, bool is_at_edge) {
  const float radius = (is_at_edge ? 5.0f : 3.5f) * ink.board.theme().scale();
  const ImVec2 middle = screen.centre();
  for (const ImVec2 p : {ImVec2(screen.low().x, middle.y), ImVec2(screen.high().x, middle.y), ImVec2(middle.x, screen.low().y),
                         ImVec2(middle.x, screen.high().y)}) {
    ink.list.AddCircleFilled(p, radius, ink.c.canvas, 16);
    ink.list.AddCircle(p, radius, ink.c.accent, 16, 1.5f);
  }
}

void draw_whole(const Ink& ink, NodeBox& box, const Box& screen) {
  const State& state = ink.board.editor.state();
  const bool is_known = box.in_state != kNoIndex;
  const std::string error = is_known ? error_of(state, box.in_state) : "";
  const float round = kRounding * ink.k;
  ink.list.AddRectFilled(screen.low() + ImVec2(0, 2 * ink.k), screen.high() + ImVec2(0, 3 * ink.k), IM_COL32(0, 0, 0, 38), round);
  ink.list.AddRectFilled(screen.low(), screen.high(), ink.c.node, round);
  draw_head(ink, box, is_known ? worst_tension(state, box.in_state) : 0, !error.empty());
  float y = box.box.at.y + kHeadHeight;
  if (!box.is_collapsed)
    for (std::size_t k = 0; k < box.sections.size(); ++k) y = draw_section(ink, box, box.sections[k], k, y);
  if (!error.empty() && ink.zoom >= kTextZoom)
    draw_text(ink.board, {screen.low().x, screen.high().y + 3 * ink.k}, 10.5f * ink.k, ink.c.bad, error, 2 * screen.size.x);
}

void draw_node(const Ink& ink, NodeBox& box, const Glance& glance, bool stands_out) {
  const Box screen = ink.board.camera.to_screen(box.box);
  if (ink.zoom < kNameZoom) draw_as_name(ink, box, glance, screen);
  else draw_whole(ink, box, screen);
  draw_outline(ink, box, screen, glance.has_error, stands_out);
  if (const Other* other = ink.board.editor.holder_of(box.id)) draw_holder(ink, screen, *other);
}

}  // namespace

float name_height(const Board& board, const NodeBox& box) {
  const Box screen = board.camera.to_screen(box.box);
  const float scale = board.theme().scale(), least = std::min(8 * scale, screen.size.x / 4.6f);
  const float pixels = std::clamp(screen.size.x / 5.4f, least, std::max(least, 12.5f * scale));
  return box.is_collapsed ? std::min(pixels, 0.92f * screen.size.y) : pixels;
}

float text_width(const Board& board, float pixels, std::string_view text) {
  ImFont* font = board.theme().canvas_font(pixels);
  return font->CalcTextSizeA(pixels, 1e9f, 0, text.data(), text.data() + text.size()).x;
}

float draw_text(const Board& board, ImVec2 at, float pixels, ImU32 colour, std::string_view text, float room) {
  if (pixels < 4 || text.empty() || room <= 0) return 0;
  ImFont* font = board.theme().canvas_font(pixels);
  const char *begin = text.data(), *end = begin + text.size();
  float width = font->CalcTextSizeA(pixels, 1e9f, 0, begin, end).x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (width <= room + 0.5f) {
    list.AddText(font, pixels, at, colour, begin, end);
    return width;
  }
  constexpr std::string_view kDots = "\xe2\x80\xa6";
  const float dots = font->CalcTextSizeA(pixels, 1e9f, 0, kDots.data(), kDots.data() + kDots.size()).x;
  const char* rest = begin;
  width = font->CalcTextSizeA(pixels, std::max(1.0f, room - dots), 0, begin, end, &rest).x;
  list.AddText(font, pixels, at, colour, begin, rest);
  list.AddText(font, pixels, {at.x + width, at.y}, colour, kDots.data(), kDots.data() + kDots.size());
  return width + dots;
}

ImU32 colour_of(const Board& board, const Section& section) {
  if (section.type == nullptr) return board.theme().colours().text_faint;
  const ImU32 tone = board.theme().category(section.category);
  // The categories are light inks; on a light ground they need depth.
  return board.theme().is_dark() ? tone : mixed(tone, IM_COL32(40, 44, 60, 255), 0.3f);
}

ImU32 tone_of(const Board& board, const NodeBox& box) {
  if (box.use == kNoIndex)
    return box.sections.empty() ? board.theme().colours().text_faint : colour_of(board, box.sections.front());
  const ImU32 tone = colour_of_use(board.theme(), box.use);
  return board.theme().is_dark() ? tone : mixed(tone, IM_COL32(40, 44, 60, 255), 0.15f);
}

void draw_nodes(Board& board) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const Ink ink{board, list, board.theme().colours(), board.camera.factor(), board.camera.zoom()};
  const Box sight = board.camera.sight().grown(20);
  const Picks& picks = board.editor.picks;
  std::vector<NodeBox>& boxes = board.model.boxes;
  // What is chosen or pointed at lies above the rest.
  std::vector<std::size_t> upper;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (!boxes[k].box.touches(sight)) continue;
    if (picks.nodes.contains(boxes[k].id) || picks.lit_node == boxes[k].id) upper.push_back(k);
    else draw_node(ink, boxes[k], board.glances.of(k), false);
  }
  for (const std::size_t k : upper) draw_node(ink, boxes[k], board.glances.of(k), true);
  const Thing thing = board.hovered.thing;
  if (is_body(thing) && board.drag.deed == DragMode::none && board.hovered.index < board.model.anchors() && ink.zoom > 0.15)
    draw_handles(ink, board.camera.to_screen(board.model.anchor(board.hovered.index)),
                 thing == Thing::node_edge || thing == Thing::pill_edge);
}

}  // namespace bl::desktop::canvas
