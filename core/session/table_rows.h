// Rows of a table of a node: found by the text of its key column, or by their number where it has none.
#pragma once

#include <cstddef>
#include <string>

#include "core/session/support.h"

namespace bl {

struct TableSite {
  PortSite port;
  std::string path;   ///< `typification.port`
  std::string place;  ///< as errors name it
  Table table;        ///< a copy to change
};
Result<TableSite> find_table(const SceneEdit& edit, const std::string& node, const PortChoice& port);

/// The number of the row, or an error. `row` is the text in the key column, or a number from 0.
Result<std::size_t> find_row(const TableSite& site, const std::string& row);
/// The name of the row in commands.
std::string name_of_row(const TableSite& site, std::size_t row);

/// The commands that turn a table of a node into another one. They change single rows and fields where the rows have names, else
/// the whole port. `path` is `typification.port`.
std::vector<Command> table_commands(const std::string& node, const std::string& path, const PortDefinition& port,
                                    const Table& before, const Table& after);

}  // namespace bl
