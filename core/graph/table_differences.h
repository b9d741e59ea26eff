// Where two tables of a port differ, row by row and column by column.
#pragma once

#include <string>
#include <vector>

#include "core/define/definition.h"

namespace bl {

/// A field; or, without a column, a row that only one of the tables has.
struct TableDifference {
  std::string row;  ///< the text in its key column
  std::string column;

  /// The whole table differs: its rows have no names, a name occurs in more than one row, or rows have changed places.
  bool is_whole() const { return row.empty(); }
  /// Inside the table: `housing/floor_area`; slashes and tildes of a name as in RFC 6901.
  std::string path() const;
};

/// Removed rows, then changed fields and new rows in the order of `after`. Empty where the two are equal.
std::vector<TableDifference> table_differences(const PortDefinition& port, const Table& before, const Table& after);

}  // namespace bl
