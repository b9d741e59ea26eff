// Heights on a regular grid as text: three characters for each height, so that any height is found without reading the others.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
};

/// A row of heights as text; what is not finite becomes kNothing, what lies beyond the range its nearest end.
std::string height_row(std::span<const double> heights, double lowest, double step);
/// The index of the first invalid character of a row, or its length.
std::size_t first_wrong_character(std::string_view row);

}  // namespace bl::geometry
