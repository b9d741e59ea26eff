// Adds a row to a table.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"
#include "core/session/table_rows.h"

namespace bl {

void AddRow::declare(CommandBuilder<AddRow>& c) {
  c.id("add_row").label("Add row").doc("Adds a row to a table of a node.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which table, written `typification.port`.");
  c.argument(&In::row, "row").required().doc("The row as an object, as in a scene file.");
  c.argument(&In::at, "at")
      .min(-1)
      .doc("The number of the new row, from 0; -1 or a larger number than there are rows adds it at the end.");
}

Inverse AddRow::apply(SceneEdit& edit, const In& in) {
  auto site = find_table(edit, in.node, in.port);
  if (!site) return site.error();
  const auto content = in.row.read();
  if (!content) return content.error().within(site->place);
  auto& rows = site->table.rows;
  const std::size_t at = in.at < 0 ? rows.size() : std::min(rows.size(), static_cast<std::size_t>(in.at));
  auto row = row_from_json(*site->port.port, **content, site->place + "/" + std::to_string(at));
  if (!row) return row.error();
  rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(at), std::move(*row));
  const std::string name = name_of_row(*site, at);
  if (!find_row(*site, name)) return Error{ErrorCode::duplicate, site->place, "there is a row `" + name + "` already"};
  edit.set_value(in.node, site->port.type->id, *site->port.port, Shared<Table>(std::move(site->table)));
  return std::vector{command<RemoveRow>({in.node, {site->path}, name})};
}

}  // namespace bl

BL_COMMAND(add_row, AddRow)
