// Charts on ImGui's draw list: lines over ticks, bars with a mark, small lines without axes.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/unit.h"
#include "ui/desktop/look/theme.h"

namespace bl::desktop {

struct Series {
  std::string label;
  ImU32 colour = 0;
  std::span<const double> values;
};

struct Chart {
  std::string title;
  Unit unit = Unit::none;
  bool is_share = false;  ///< numbers are shares, shown as per cent
  bool is_log = false;
  std::span<const double> ticks;  ///< along the bottom, as many as each series has values
  std::vector<Series> series;
  double mark = 0;  ///< a dashed line at this height, such as a tolerance; 0: none
  std::string mark_label;
};

/// With axes, the last values as a legend, and a read-out under the mouse.
void line_chart(const Theme& theme, const char* id, ImVec2 size, const Chart& chart);

/// A bar from the left: filled up to `share`, with an upright mark at `mark` (both of the whole width; no mark where negative).
void bar(const Theme& theme, ImVec2 from, ImVec2 to, double share, double mark, ImU32 colour);

/// A line without axes.
void spark_line(const Theme& theme, ImVec2 from, ImVec2 to, std::span<const double> values, ImU32 colour);

/// A number of a chart with its unit: "12 400 m³", "0.42 %".
std::string chart_number(const Chart& chart, double value);

}  // namespace bl::desktop
