// A key that stands in more than one row names none of them.
#include "core/session/table_rows.h"

#include <algorithm>
#include <charconv>

#include <nlohmann/json.hpp>

#include "core/base/near_names.h"
#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/graph/table_differences.h"

namespace bl {

namespace {

// The column that names the rows, or their number where none does.
std::size_t key_column(const PortDefinition& port) {
  const auto key = std::find_if(port.columns.begin(), port.columns.end(), [](const auto& column) { return column.is_key; });
  return static_cast<std::size_t>(key - port.columns.begin());
}

}  // namespace

Result<TableSite> find_table(const SceneEdit& edit, const std::string& node, const PortChoice& port) {
  const auto site = find_setting(edit, node, port);
  if (!site) return site.error();
  TableSite found{
      *site, site->type->id + "." + site->port->id, "nodes/" + node + "/" + site->type->id + "/" + site->port->id, {}};
  const Value& value = set_value(edit.scene(), *site->node, *site->type, *site->port);
  const auto* table = std::get_if<Shared<Table>>(&value);
  if (table == nullptr) return Error{ErrorCode::wrong_kind, found.place, "`" + found.path + "` is no table"};
  found.table = **table;
  if (found.table.columns.empty())
    for (const ColumnDefinition& column : site->port->columns) found.table.columns.push_back(column.id);
  return found;
}

Result<std::size_t> find_row(const TableSite& site, const std::string& row) {
  const std::size_t key = key_column(*site.port.port);
  const auto& rows = site.table.rows;
  if (key == site.port.port->columns.size()) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(row.data(), row.data() + row.size(), number);
    if (error == std::errc() && end == row.data() + row.size() && number < rows.size()) return number;
    return Error{ErrorCode::not_found, site.place,
                 "there is no row `" + row + "`; rows count from 0, and there are " + std::to_string(rows.size())};
  }
  std::vector<std::string> names;
  std::size_t found = rows.size(), count = 0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    names.push_back(std::get<std::string>(rows[r][key]));
    if (names.back() != row) continue;
    found = r;
    ++count;
  }
  if (count == 1) return found;
  if (count > 1) return Error{ErrorCode::conflict, site.place, "`" + row + "` stands in " + std::to_string(count) + " rows"};
  return Error{ErrorCode::not_found, site.place, "there is no row `" + row + "`" + did_you_mean(row, names)};
}

std::string name_of_row(const TableSite& site, std::size_t row) {
  const std::size_t key = key_column(*site.port.port);
  return key == site.port.port->columns.size() ? std::to_string(row) : std::get<std::string>(site.table.rows[row][key]);
}

std::vector<Command> table_commands(const std::string& node, const std::string& path, const PortDefinition& port,
                                    const Table& before, const Table& after) {
  const std::size_t key = key_column(port);
  std::vector<Command> commands;
  const auto named = [&](const Table& table, const std::string& name) {
    return std::find_if(table.rows.begin(), table.rows.end(),
                        [&](const TableRow& row) { return std::get<std::string>(row[key]) == name; });
  };
  for (const TableDifference& difference : table_differences(port, before, after)) {
    if (difference.is_whole()) return {command<SetPort>({node, {path}, json_of(Shared<Table>(after), port)})};
    const auto row = named(after, difference.row);
    if (row == after.rows.end()) {
      commands.push_back(command<RemoveRow>({node, {path}, difference.row}));
    } else if (difference.column.empty()) {
      commands.push_back(command<AddRow>({node, {path}, JsonValue::of(row_to_json(port, *row)), row - after.rows.begin()}));
    } else {
      const Json fields = row_to_json(port, *row);
      const Json value = fields.contains(difference.column) ? fields[difference.column] : Json();
      commands.push_back(command<SetCell>({node, {path}, difference.row, difference.column, JsonValue::of(value)}));
    }
  }
  return commands;
}

}  // namespace bl
