// Imports sites with their weights and demands from a CSV table.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"

namespace bl::importing {

/// One row; an empty field is nothing.
struct SiteRow {
  std::size_t line = 0;                                  ///< of the file, from 1
  std::string name;                                      ///< what people call it; empty where the table has no such column
  Point3 position;                                       ///< [m]
  std::optional<double> weight;                          ///< [m²]; a column `radius` gives its square
  std::optional<double> demand, demand_min, demand_max;  ///< [m³]; of the whole group where there is one
  std::string group;                                     ///< rows with the same text stand together; empty: alone
};

struct SiteTable {
  std::vector<SiteRow> rows;
  bool has_weights = false, has_demands = false, has_groups = false;  ///< is there such a column?
  std::size_t header_line = 1;
  std::vector<std::string> notes;
};

/// Columns x, y, z, weight (or radius), demand, demand_min, demand_max, group, name, in any order; x, y and z are required.
/// A column that is none of these is an error.
Result<SiteTable> read_site_table(std::string_view text);

/// "x, y, z, weight, ...": the names that a header may have, for sentences.
std::string site_table_columns();

}  // namespace bl::importing
