// Both tables are put in order by the names of their rows.
#include "core/graph/table_differences.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>

#include "core/graph/touch.h"

namespace bl {

namespace {

using RowsByName = std::map<std::string_view, const TableRow*>;

std::optional<RowsByName> rows_by_name(const Table& table, std::size_t key) {
  RowsByName rows;
  for (const TableRow& row : table.rows) {
    const std::string& name = std::get<std::string>(row[key]);
    if (name.empty() || !rows.emplace(name, &row).second) return std::nullopt;
  }
  return rows;
}

// The names of rows that are in both tables, as they follow each other in this one.
std::vector<std::string_view> common_names(const Table& table, std::size_t key, const RowsByName& other) {
  std::vector<std::string_view> names;
  for (const TableRow& row : table.rows)
    if (const std::string& name = std::get<std::string>(row[key]); other.contains(name)) names.push_back(name);
  return names;
}

}  // namespace

std::string TableDifference::path() const { return column.empty() ? step_of(row) : step_of(row) + "/" + column; }

std::vector<TableDifference> table_differences(const PortDefinition& port, const Table& before, const Table& after) {
  if (before.rows == after.rows) return {};
  const auto keys = std::find_if(port.columns.begin(), port.columns.end(), [](const auto& column) { return column.is_key; });
  const auto key = static_cast<std::size_t>(keys - port.columns.begin());
  if (keys == port.columns.end()) return {{}};
  const auto old = rows_by_name(before, key), fresh = rows_by_name(after, key);
  if (!old || !fresh || common_names(before, key, *fresh) != common_names(after, key, *old)) return {{}};
  std::vector<TableDifference> differences;
  for (const auto& [name, row] : *old)
    if (!fresh->contains(name)) differences.push_back({std::string(name), ""});
  for (const TableRow& row : after.rows) {
    const std::string& name = std::get<std::string>(row[key]);
    const auto was = old->find(name);
    if (was == old->end()) {
      differences.push_back({name, ""});
      continue;
    }
    for (std::size_t c = 0; c < port.columns.size(); ++c)
      if ((*was->second)[c] != row[c]) differences.push_back({name, port.columns[c].id});
  }
  return differences;
}

}  // namespace bl
