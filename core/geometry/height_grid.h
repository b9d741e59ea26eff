// Heights on a regular grid as text: three characters for each height, so that any height is found without reading the others.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/vector.h"

namespace bl::geometry {

/// Rows of text, the northernmost first; each height is a number of steps above the lowest one, in three characters.
struct HeightGrid {
  static constexpr double kMostSteps = 262143;  ///< 64³ - 1
  static constexpr std::string_view kNothing = "...";

  double west = 0, north = 0;  ///< centre of the first cell of the first row [m]
  double cell = 1;             ///< distance of neighbouring cells [m]
  double lowest = 0, step = 0.01;
  std::vector<std::string_view> rows;

  std::size_t columns() const { return rows.empty() ? 0 : rows.front().size() / 3; }
  /// The height of a cell [m]; nothing where there is none.
  std::optional<double> at(std::size_t row, std::size_t column) const;
  /// Bilinear between the four cells around the place. Nothing outside the centres of the outermost cells, and where cells that
  /// have a height weigh less than half.
  std::optional<double> sample(double x, double y) const;
  /// The lowest height along an outline [m]; nothing where none of its places has one.
  std::optional<double> lowest_along(std::span<const Point3> outline) const;
};

/// Every place of an outline at which a grid is looked at: corners, and between them four times in each of its cells.
template <class Visit>
void along(std::span<const Point3> outline, double cell, Visit visit) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const int steps = static_cast<int>(std::clamp(std::ceil(4 * distance(a, b) / cell), 1.0, 1e4));
    for (int k = 0; k < steps; ++k) visit(a + (b - a) * (static_cast<double>(k) / steps));
  }
}

/// A row of heights as text; what is not finite becomes kNothing, what lies beyond the range its nearest end.
std::string height_row(std::span<const double> heights, double lowest, double step);
/// The index of the first invalid character of a row, or its length.
std::size_t first_wrong_character(std::string_view row);

}  // namespace bl::geometry
