// Two logarithmic charts over the ticks: errors against the tolerance, and moves against the limit of calm.
#include <algorithm>
#include <cmath>

#include "core/drawing/furniture.h"
#include "core/drawing/pictures.h"
#include "core/reading/figures.h"

namespace bl::drawing {

namespace {

constexpr double kErrorChartWidth = 1000, kAxesLeft = 74, kAxesRight = 150;
constexpr std::size_t kMostPoints = 450;

struct Series {
  std::string label, colour, dashes;
  double reading::ErrorSample::*value;
};

struct TickAxes {
  double top = 0, height = 0;
  double lowest = 0, highest = 0;  ///< powers of ten
  double first_tick = 0, last_tick = 1;
  double x(double tick) const {
    return kAxesLeft + (kErrorChartWidth - kAxesLeft - kAxesRight) * (tick - first_tick) / std::max(1.0, last_tick - first_tick);
  }
  double y(double value) const {
    const double power = std::log10(std::max(value, 1e-300));
    return top + height * (highest - std::clamp(power, lowest, highest)) / (highest - lowest);
  }
};

// The largest sample of each stretch, so that no peak is lost where ticks are many.
std::vector<reading::ErrorSample> thinned(const std::vector<reading::ErrorSample>& history) {
  const std::size_t stride = history.size() / kMostPoints + 1;
  std::vector<reading::ErrorSample> out;
  for (std::size_t i = 0; i < history.size(); i += stride) {
    reading::ErrorSample most = history[i];
    for (std::size_t k = i; k < std::min(i + stride, history.size()); ++k) {
      most.worst_error = std::max(most.worst_error, history[k].worst_error);
      most.mean_error = std::max(most.mean_error, history[k].mean_error);
      most.largest_move = std::max(most.largest_move, history[k].largest_move);
    }
    out.push_back(most);
  }
  return out;
}

TickAxes chart_of(const std::vector<reading::ErrorSample>& samples, const std::vector<Series>& series, double limit, double top,
                  double height) {
  double low = limit, high = limit;
  for (const reading::ErrorSample& sample : samples)
    for (const Series& line : series) {
      const double value = sample.*line.value;
      if (!std::isfinite(value) || value <= 0) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  // Six decades are as much as a reader can tell apart; what is smaller runs along the bottom.
  const double highest = std::ceil(std::log10(high) + 0.05), lowest = std::max(std::floor(std::log10(low) - 0.05), highest - 6);
  return {top, height, lowest, highest, static_cast<double>(samples.front().tick), static_cast<double>(samples.back().tick)};
}

void draw_axes(Markup& svg, const TickAxes& chart, const std::string& title, bool is_share) {
  PathText rules;
  for (double power = chart.lowest; power <= chart.highest; power += 1) {
    const double y = chart.y(std::pow(10.0, power)), value = std::pow(10.0, power + (is_share ? 2 : 0));
    rules.polyline({{kAxesLeft, y}, {kErrorChartWidth - kAxesRight, y}}, false);
    const std::string figure =
        reading::grouped(value, power + (is_share ? 2 : 0) >= 0 ? 0 : static_cast<int>(-power - (is_share ? 2 : 0))) +
        (is_share ? "\xC2\xA0%" : "\xC2\xA0m");
    svg.element("text", figure, {{"x", pixels(kAxesLeft - 8)}, {"y", pixels(y + 3.5)}, {"class", "figure end"}});
  }
  svg.path(rules, {{"fill", "none"}, {"stroke", "#d9d5ca"}, {"stroke-width", ".8"}});
  svg.element("text", title, {{"x", pixels(kAxesLeft)}, {"y", pixels(chart.top - 10)}, {"class", "name start"}});
  const double span = chart.last_tick - chart.first_tick, step = std::max(1.0, round_length(span / 5));
  for (double tick = std::ceil(chart.first_tick / step) * step; tick <= chart.last_tick; tick += step)
    svg.element("text", reading::grouped(tick),
                {{"x", pixels(chart.x(tick))}, {"y", pixels(chart.top + chart.height + 15)}, {"class", "figure"}});
}

void draw_limit(Markup& svg, const TickAxes& chart, double limit, const std::string& label) {
  if (!(limit > 0)) return;
  PathText line;
  line.polyline({{kAxesLeft, chart.y(limit)}, {kErrorChartWidth - kAxesRight, chart.y(limit)}}, false);
  svg.path(line, {{"fill", "none"}, {"stroke", hex(kInk)}, {"stroke-width", "1"}, {"stroke-dasharray", "2 3"}});
  svg.element("text", label,
              {{"x", pixels(kErrorChartWidth - kAxesRight - 4)}, {"y", pixels(chart.y(limit) - 4)}, {"class", "figure end"}});
}

void draw_series(Markup& svg, const TickAxes& chart, const std::vector<reading::ErrorSample>& samples,
                 const std::vector<Series>& series, bool is_share) {
  double last_label = -1e9;
  for (const Series& line : series) {
    std::vector<Pixel> points;
    for (const reading::ErrorSample& sample : samples)
      if (std::isfinite(sample.*line.value))
        points.push_back({chart.x(static_cast<double>(sample.tick)), chart.y(sample.*line.value)});
    if (points.empty()) continue;
    PathText path;
    path.polyline(points, false);
    svg.path(path, {{"fill", "none"},
                    {"stroke", line.colour},
                    {"stroke-width", "1.8"},
                    {"stroke-linejoin", "round"},
                    {"stroke-dasharray", line.dashes}});
    const Pixel end = points.back();
    svg.leaf("circle", {{"cx", pixels(end.x)}, {"cy", pixels(end.y)}, {"r", "2.6"}, {"fill", line.colour}});
    const double value = samples.back().*line.value, y = std::max(end.y + 3.5, last_label + 13);
    svg.element("text", line.label + " " + (is_share ? reading::percent(value) : reading::quantity(value, Unit::metre)),
                {{"x", pixels(end.x + 8)}, {"y", pixels(y)}, {"class", "figure start"}});
    last_label = y;
  }
}

}  // namespace

Picture draw_error_chart(const reading::ReportModel& model, const std::vector<reading::ErrorSample>& history) {
  if (history.empty()) return {empty_picture("errors", "Error over the ticks", "No ticks were recorded."), ""};
  const std::vector<reading::ErrorSample> samples = thinned(history);
  const std::vector<Series> errors = {{"worst", "#aa3311", "", &reading::ErrorSample::worst_error},
                                      {"mean", "#225599", "6 2.5", &reading::ErrorSample::mean_error}};
  const std::vector<Series> moves = {{"move", "#117733", "", &reading::ErrorSample::largest_move}};
  const double tolerance = std::max(model.tolerance, 1e-9);
  const double limit = model.move_limit > 0 ? model.move_limit : 0.01;
  const TickAxes upper = chart_of(samples, errors, tolerance, 38, 190), lower = chart_of(samples, moves, limit, 292, 110);
  Markup svg;
  open_picture(svg, kErrorChartWidth, 442, "errors", "Error over the ticks",
               "Worst error " + reading::percent(history.back().worst_error) + " and mean error " +
                   reading::percent(history.back().mean_error) + " at tick " + std::to_string(history.back().tick) +
                   "; the tolerance is " + reading::percent(model.tolerance) + ".");
  draw_axes(svg, upper, "Error of the volumes, share of the demand", true);
  draw_limit(svg, upper, tolerance, "tolerance " + reading::percent(model.tolerance));
  draw_series(svg, upper, samples, errors, true);
  draw_axes(svg, lower, "Largest move of a node in a tick", false);
  draw_limit(svg, lower, model.move_limit, "limit of calm " + reading::quantity(model.move_limit, Unit::metre));
  draw_series(svg, lower, samples, moves, false);
  svg.element("text", "tick",
              {{"x", pixels(kErrorChartWidth - kAxesRight + 16)},
               {"y", pixels(lower.top + lower.height + 15)},
               {"class", "figure start"}});
  svg.close();
  std::string caption =
      "The negotiation, tick by tick, on logarithmic scales: settled is when all errors are below the tolerance and all moves "
      "below their limit for several ticks in a row.";
  if (samples.size() < history.size())
    caption += " Each point shows the largest value of " + std::to_string(history.size() / kMostPoints + 1) + " ticks.";
  return {svg.str(), caption};
}

}  // namespace bl::drawing
