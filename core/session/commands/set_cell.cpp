// Sets one field of a table, so that people can change other rows at the same time.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/session/table_rows.h"

namespace bl {

void SetCell::declare(CommandBuilder<SetCell>& c) {
  c.id("set_cell").label("Set field").doc("Sets one field of a table of a node.");
  c.argument(&In::node, "node").required().doc("Id of the node.");
  c.argument(&In::port, "port").required().doc("Which table, written `typification.port`.");
  c.argument(&In::row, "row")
      .required()
      .doc("The text in the table's key column, or the number of the row, from 0, where it has none.");
  c.argument(&In::column, "column").required().doc("Which column.");
  c.argument(&In::value, "value").doc("The new value as in a scene file; null for the default.");
}

Inverse SetCell::apply(SceneEdit& edit, const In& in) {
  auto site = find_table(edit, in.node, in.port);
  if (!site) return site.error();
  const auto row = find_row(*site, in.row);
  if (!row) return row.error();
  const std::string place = site->place + "/" + in.row;
  const std::size_t column = site->table.column(in.column);
  if (column == site->table.columns.size())
    return Error{ErrorCode::unknown_field, place,
                 "the table has no column `" + in.column + "`" + did_you_mean(in.column, site->table.columns)};
  const auto value = in.value.read();
  if (!value) return value.error().within(place + "/" + in.column);
  const PortDefinition& port = *site->port.port;
  Json content = row_to_json(port, site->table.rows[*row]);
  const Json before = content.contains(in.column) ? content[in.column] : Json();
  if (in.value.is_null()) content.erase(in.column);
  else content[in.column] = **value;
  auto changed = row_from_json(port, content, place);
  if (!changed) return changed.error();
  site->table.rows[*row] = std::move(*changed);
  const std::string name = name_of_row(*site, *row);
  if (name != in.row && find_row(*site, name).ok() == false)
    return Error{ErrorCode::duplicate, place, "there is a row `" + name + "` already"};
  edit.set_value(in.node, site->port.type->id, port, Shared<Table>(std::move(site->table)));
  return std::vector{command<SetCell>({in.node, {site->path}, name, in.column, JsonValue::of(before)})};
}

}  // namespace bl

BL_COMMAND(set_cell, SetCell)
