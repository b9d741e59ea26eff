// Three digits of base 64 per height, the digits of RFC 4648.
#include "core/geometry/height_grid.h"

#include <algorithm>
#include <cmath>

namespace bl::geometry {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

std::optional<double> HeightGrid::at(std::size_t row, std::size_t column) const {
  if (row >= rows.size() || 3 * column + 3 > rows[row].size()) return std::nullopt;
  const int a = digit(rows[row][3 * column]), b = digit(rows[row][3 * column + 1]), c = digit(rows[row][3 * column + 2]);
  if (a < 0 || b < 0 || c < 0) return std::nullopt;
  return lowest + step * (4096 * a + 64 * b + c);
}

std::optional<double> HeightGrid::sample(double x, double y) const {
  const double u = (x - west) / cell, v = (north - y) / cell;
  if (rows.empty() || columns() == 0 || !(u >= 0) || !(v >= 0) || !(u <= static_cast<double>(columns() - 1)) ||
      !(v <= static_cast<double>(rows.size() - 1)))
    return std::nullopt;
  const double column = std::floor(u), row = std::floor(v);
  double sum = 0, weight = 0;
  for (const int i : {0, 1})
    for (const int k : {0, 1}) {
      const double w = (i == 0 ? 1 - (v - row) : v - row) * (k == 0 ? 1 - (u - column) : u - column);
      if (w <= 0) continue;
      const auto height = at(static_cast<std::size_t>(row) + i, static_cast<std::size_t>(column) + k);
      if (!height) continue;
      sum += w * *height;
      weight += w;
    }
  if (weight < 0.5) return std::nullopt;
  return sum / weight;
}

std::optional<double> HeightGrid::lowest_along(std::span<const Point3> outline) const {
  std::optional<double> least;
  along(outline, cell, [&](const Point3& place) {
    if (const auto height = sample(place.x, place.y)) least = std::min(least.value_or(*height), *height);
  });
  return least;
}

std::string height_row(std::span<const double> heights, double lowest, double step) {
  std::string row;
  row.reserve(3 * heights.size());
  for (const double height : heights) {
    if (!std::isfinite(height)) {
      row += HeightGrid::kNothing;
      continue;
    }
    const auto steps = static_cast<int>(std::clamp(std::round((height - lowest) / step), 0.0, HeightGrid::kMostSteps));
    row += kDigits[static_cast<std::size_t>(steps / 4096)];
    row += kDigits[static_cast<std::size_t>(steps / 64 % 64)];
    row += kDigits[static_cast<std::size_t>(steps % 64)];
  }
  return row;
}

std::size_t first_wrong_character(std::string_view row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const bool is_nothing = row.substr(i - i % 3, 3) == HeightGrid::kNothing;
    if (!is_nothing && digit(row[i]) < 0) return i;
  }
  return row.size();
}

}  // namespace bl::geometry
