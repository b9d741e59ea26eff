// Axes are cut where the figures end, at 1, 2 or 5 times a power of ten; what has three decades or more is ruled by decades.
#include "core/drawing/line_chart.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/drawing/furniture.h"
#include "core/drawing/pictures.h"
#include "core/reading/figures.h"

namespace bl::drawing {

namespace {

using drawing::pixels;

// One panel alone is wider, as its legend has to find room.
constexpr double kPanelWidth = 400, kOnePanelWidth = 640;
constexpr double kHeight = 292, kTop = 68, kBottom = 46, kLeft = 56, kRight = 28;
constexpr const char* kRule = "#d9d5ca";

// One logarithmic axis: where it begins and ends, and what is written on it.
struct Axis {
  double low = 1, high = 10;
  std::vector<double> marks;
  /// 0 at the low end, 1 at the high end.
  double share(double value) const { return std::log10(std::clamp(value, low, high) / low) / std::log10(high / low); }
};

// The next number of 1, 2 and 5 times powers of ten, down or up.
double round_down(double value) { return drawing::round_length(value * (1 + 1e-9)); }
double round_up(double value) {
  const double below = round_down(value);
  if (below >= value * (1 - 1e-9)) return below;
  return std::max(round_down(2 * below), round_down(2.5 * below));
}

using Pick = double ChartLine::Point::*;

// `also`: a figure that is to be seen as well.
Axis axis_of(std::span<const ChartPanel> panels, Pick pick, double also) {
  double low = 1e300, high = 0;
  const auto take = [&](double value) {
    if (!(value > 0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  take(also);
  for (const ChartPanel& panel : panels) {
    for (const ChartLine& line : panel.lines) {
      for (const ChartLine::Point& point : line.points) {
        if (point.x > 0 && point.y > 0) take(point.*pick);
      }
    }
  }
  if (!(high > 0)) return {};
  Axis axis{round_down(low), round_up(high), {}};
  if (axis.high <= axis.low) axis.high = 10 * axis.low;
  const double decades = std::log10(axis.high / axis.low);
  const int stride = decades > 8 ? 2 : 1;
  for (int power = static_cast<int>(std::floor(std::log10(axis.low))); power <= std::ceil(std::log10(axis.high)); ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double mark = digit * std::pow(10.0, power);
      if (mark < axis.low * (1 - 1e-9) || mark > axis.high * (1 + 1e-9)) continue;
      if (decades > 2.4 ? digit == 1 && power % stride == 0 : true) axis.marks.push_back(mark);
    }
  }
  return axis;
}

std::string mark_text(double value) {
  if (value >= 0.0099) return reading::grouped(value, value >= 0.99 ? 0 : value >= 0.099 ? 1 : 2);
  static constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const double power = std::floor(std::log10(value) + 1e-9), leading = std::round(value / std::pow(10.0, power));
  std::string text = (leading == 1 ? "" : std::to_string(static_cast<int>(leading)) + "·") + "10⁻";
  for (const char digit : std::to_string(static_cast<int>(-power))) text += kDigits[digit - '0'];
  return text;
}

class PanelDrawing {
 public:
  PanelDrawing(Markup& svg, const ChartPanel& panel, const Axis& x, double left, double width)
      : svg_(svg),
        panel_(panel),
        left_(left + kLeft),
        right_(left + width - kRight),
        x_(x),
        y_(axis_of(std::span(&panel, 1), &ChartLine::Point::y, panel.limit)) {}

  void draw() {
    draw_axes();
    if (panel_.limit > 0) draw_limit();
    for (const ChartLine& line : panel_.lines) draw_line(line);
  }

 private:
  Pixel place(const ChartLine::Point& point) const {
    return {left_ + (right_ - left_) * x_.share(point.x), kHeight - kBottom - (kHeight - kBottom - kTop) * y_.share(point.y)};
  }

  void draw_axes() {
    PathText rules;
    for (const double mark : y_.marks) {
      const double y = place({x_.low, mark}).y;
      rules.polyline({{left_, y}, {right_, y}}, false);
      svg_.element("text", mark_text(mark), {{"x", pixels(left_ - 7)}, {"y", pixels(y + 3.5)}, {"class", "figure end"}});
    }
    for (const double mark : x_.marks) {
      const double x = place({mark, y_.low}).x, foot = kHeight - kBottom;
      rules.polyline({{x, foot}, {x, foot + 4}}, false);
      svg_.element("text", mark_text(mark), {{"x", pixels(x)}, {"y", pixels(foot + 16)}, {"class", "figure"}});
    }
    svg_.path(rules, {{"fill", "none"}, {"stroke", kRule}, {"stroke-width", ".8"}});
    svg_.element("text", panel_.title, {{"x", pixels(left_)}, {"y", pixels(kTop - 12)}, {"class", "name start"}});
    svg_.element("text", panel_.x_label, {{"x", pixels(right_)}, {"y", pixels(kHeight - 12)}, {"class", "figure end"}});
  }

  void draw_limit() {
    const double y = place({x_.low, panel_.limit}).y;
    PathText line;
    line.polyline({{left_, y}, {right_, y}}, false);
    svg_.path(line, {{"fill", "none"}, {"stroke", drawing::hex(drawing::kInk)}, {"stroke-dasharray", "2 3"}});
    svg_.element("text", panel_.limit_label, {{"x", pixels(right_)}, {"y", pixels(y - 4)}, {"class", "figure end"}});
  }

  void draw_line(const ChartLine& line) {
    std::vector<Pixel> points;
    for (const ChartLine::Point& point : line.points) {
      if (point.x > 0 && point.y > 0) points.push_back(place(point));
    }
    PathText path;
    path.polyline(points, false);
    svg_.path(path, {{"fill", "none"},
                     {"stroke", line.colour},
                     {"stroke-width", "1.8"},
                     {"stroke-linejoin", "round"},
                     {"stroke-dasharray", line.dashes}});
    if (points.size() > 12) return;  // each figure is a dot while dots can be told apart
    for (const Pixel& point : points) {
      svg_.leaf("circle", {{"cx", pixels(point.x)}, {"cy", pixels(point.y)}, {"r", "2.2"}, {"fill", line.colour}});
    }
  }

  Markup& svg_;
  const ChartPanel& panel_;
  double left_, right_;
  Axis x_, y_;
};

void draw_legend(Markup& svg, const std::vector<ChartLine>& lines) {
  double x = kLeft;
  for (const ChartLine& line : lines) {
    PathText sample;
    sample.polyline({{x, 24}, {x + 24, 24}}, false);
    svg.path(sample, {{"fill", "none"}, {"stroke", line.colour}, {"stroke-width", "2.2"}, {"stroke-dasharray", line.dashes}});
    svg.element("text", line.label, {{"x", pixels(x + 30)}, {"y", "27.5"}, {"class", "figure start"}});
    x += 30 + drawing::text_width(line.label, 10) + 16;
  }
}

}  // namespace

std::string draw_chart(const Chart& chart) {
  Markup svg;
  const double width = chart.panels.size() == 1 ? kOnePanelWidth : kPanelWidth;
  drawing::open_picture(svg, width * static_cast<double>(chart.panels.size()), kHeight, chart.id, chart.title, chart.description);
  if (!chart.panels.empty()) draw_legend(svg, chart.panels.front().lines);
  // Side by side, the panels are read across.
  const Axis x = axis_of(chart.panels, &ChartLine::Point::x, 0);
  double left = 0;
  for (const ChartPanel& panel : chart.panels) {
    PanelDrawing(svg, panel, x, left, width).draw();
    left += width;
  }
  svg.close();
  return svg.str() + "\n";
}

}  // namespace bl::drawing
