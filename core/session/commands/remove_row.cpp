// Removes a row of a table.
#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/table_rows.h"

namespace bl {

void RemoveRow::declare(CommandBuilder<RemoveRow>& c) {
  c.id("remove_row").label("Remove row").doc("Removes a row of a table of a node.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which table, written `typification.port`.");
  c.argument(&In::row, "row")
      .required()
      .doc("The text in the table's key column, or the number of the row, from 0, where it has none.");
}

Inverse RemoveRow::apply(SceneEdit& edit, const In& in) {
  auto site = find_table(edit, in.node, in.port);
  if (!site) return site.error();
  const auto row = find_row(*site, in.row);
  if (!row) return row.error();
  auto& rows = site->table.rows;
  std::vector inverse{command<AddRow>(
      {in.node, {site->path}, JsonValue::of(row_to_json(*site->port.port, rows[*row])), static_cast<std::int64_t>(*row)})};
  rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(*row));
  edit.set_value(in.node, site->port.type->id, *site->port.port, Shared<Table>(std::move(site->table)));
  return inverse;
}

}  // namespace bl

BL_COMMAND(remove_row, RemoveRow)
