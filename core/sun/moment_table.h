// The moments of a study as rows of a table: how they travel from the sun to studies and links. Works with any table that has
// named columns and rows of numbers and texts, so that the algorithms need not know the declarative layer.
#pragma once

#include <array>
#include <variant>
#include <vector>

#include "core/sun/sun_day.h"

namespace bl::sun {

/// Directions and seconds; columns are looked for once, because a year has tens of thousands of rows. Empty without all columns.
template <class Table>
std::vector<SunMoment> moments_in(const Table& table) {
  const std::array<std::size_t, 4> at{table.column("x"), table.column("y"), table.column("z"), table.column("seconds")};
  std::vector<SunMoment> moments;
  for (const std::size_t column : at)
    if (column == table.columns.size()) return moments;
  moments.reserve(table.rows.size());
  for (const auto& row : table.rows) {
    const auto number = [&](std::size_t k) {
      const double* content = std::get_if<double>(&row[at[k]]);
      return content != nullptr ? *content : 0.0;
    };
    moments.push_back({.toward = {number(0), number(1), number(2)}, .seconds = number(3)});
  }
  return moments;
}

}  // namespace bl::sun
