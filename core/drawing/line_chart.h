// Charts of benches: panels side by side with logarithmic axes and one legend for all of them, as SVG.
#pragma once

#include <string>
#include <vector>

#include "core/drawing/markup.h"

namespace bl::drawing {

struct ChartLine {
  std::string label, colour, dashes;
  struct Point {
    double x = 0, y = 0;
  };
  std::vector<Point> points;  ///< what is not positive is left out
};

struct ChartPanel {
  std::string title;             ///< what is shown, with its unit
  std::string x_label;           ///< with its unit
  std::vector<ChartLine> lines;  ///< the same labels in each panel: the legend is taken from the first
  double limit = 0;              ///< a dotted line at this height; 0: none
  std::string limit_label;
};

struct Chart {
  std::string id, title, description;
  std::vector<ChartPanel> panels;
};

/// One SVG file.
std::string draw_chart(const Chart& chart);

}  // namespace bl::drawing
