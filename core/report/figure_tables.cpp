// The three writers of the tables; kinds and units come from the declarations of the ports.
#include "core/report/figure_tables.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/csv/csv_table.h"
#include "core/define/codec.h"
#include "core/define/no_value.h"
#include "core/reading/figures.h"
#include "core/reading/report_model.h"

namespace bl::report {

namespace {

const PortDefinition* port_of(const State& state, std::uint32_t node, std::string_view type, std::string_view port,
                              const Value*& value) {
  const auto ref = state.plan->find(node, PortPath{std::string(type), std::string(port), ""});
  if (!ref) return nullptr;
  value = &state.value(*ref);
  return &state.plan->port(*ref);
}

// Numbers are cells of numbers; what people chose or wrote is text.
csv::CsvCell cell_of(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  const double number = as_number(value);
  return std::isfinite(number) ? csv::CsvCell(number) : csv::CsvCell();
}

csv::CsvCell cell_of(const Scalar& field) {
  if (const auto* text = std::get_if<std::string>(&field)) return *text;
  if (const double* number = std::get_if<double>(&field)) return *number;
  return {};  // lists have no place in a cell
}

std::string csv_heading(std::string_view id, Unit unit) {
  const std::string_view symbol = info(unit).symbol;
  return std::string(id) + (symbol.empty() || unit == Unit::ratio || unit == Unit::count ? "" : " [" + std::string(symbol) + "]");
}

CsvFile nodes_file(const State& state, const FigureTable& table, const std::vector<std::uint32_t>& nodes) {
  std::vector<std::string> header{"id", "name"};
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const std::uint32_t node : nodes) rows.push_back({state.plan->nodes[node].id, state.plan->nodes[node].name});
  for (const FigureColumn& column : table.columns) {
    if (column.shown == Shown::json) continue;
    Unit unit = Unit::none;
    for (std::size_t r = 0; r < nodes.size(); ++r) {
      const Value* value = nullptr;
      const PortDefinition* port = port_of(state, nodes[r], table.type, column.port, value);
      if (port != nullptr && port->unit_from.empty()) unit = port->unit;
      rows[r].push_back(port == nullptr ? csv::CsvCell() : cell_of(*value));
    }
    header.push_back(csv_heading(column.port, unit));
  }
  return {std::string(table.id) + ".csv", write_csv(header, rows), !rows.empty()};
}

CsvFile part_file(const State& state, const FigureTable& table, const FigurePart& part, const std::vector<std::uint32_t>& nodes) {
  std::vector<std::string> header{"node"};
  std::vector<std::vector<csv::CsvCell>> rows;
  for (const std::uint32_t node : nodes) {
    const Value* value = nullptr;
    const PortDefinition* port = port_of(state, node, table.type, part.port, value);
    const auto* content = port == nullptr ? nullptr : std::get_if<Shared<Table>>(value);
    if (content == nullptr) continue;
    if (header.size() == 1)
      for (const ColumnDefinition& column : port->columns) header.push_back(csv_heading(column.id, column.unit));
    for (const TableRow& fields : (*content)->rows) {
      std::vector<csv::CsvCell>& row = rows.emplace_back();
      row.emplace_back(state.plan->nodes[node].id);
      for (const Scalar& field : fields) row.push_back(cell_of(field));
    }
  }
  return {std::string(part.id) + ".csv", write_csv(header, rows), !rows.empty()};
}

bool is_text(const PortDefinition& port) {
  return port.kind == ValueKind::text || port.kind == ValueKind::choice || port.kind == ValueKind::port;
}

// A column that is empty in all rows is left away, such as remarks where there are none.
std::vector<const FigureColumn*> page_columns(const State& state, const FigureTable& table,
                                              const std::vector<std::uint32_t>& nodes) {
  std::vector<const FigureColumn*> columns;
  for (const FigureColumn& column : table.columns) {
    if (column.shown != Shown::everywhere) continue;
    const bool says_something = std::any_of(nodes.begin(), nodes.end(), [&](std::uint32_t node) {
      const Value* value = nullptr;
      const PortDefinition* port = port_of(state, node, table.type, column.port, value);
      return port != nullptr && !figure_text(*value, *port, false).empty();
    });
    if (says_something) columns.push_back(&column);
  }
  return columns;
}

// What all nodes of many say of themselves, where it is the same, such as streets of which no network takes care; else empty.
std::string common_remark(const State& state, const FigureTable& table, const std::vector<std::uint32_t>& nodes) {
  constexpr std::size_t kMany = 6;
  const auto column =
      std::find_if(table.columns.begin(), table.columns.end(), [](const FigureColumn& c) { return c.heading == "Remark"; });
  if (nodes.size() < kMany || column == table.columns.end()) return "";
  const auto said = [&](std::uint32_t node) {
    const Value* value = nullptr;
    const PortDefinition* port = port_of(state, node, table.type, column->port, value);
    return port == nullptr ? std::string() : figure_text(*value, *port, false);
  };
  const std::string first = said(nodes.front());
  return std::all_of(nodes.begin(), nodes.end(), [&](std::uint32_t node) { return said(node) == first; }) ? first : "";
}

bool has_node_of(const State& state, std::string_view type) {
  return std::any_of(state.plan->nodes.begin(), state.plan->nodes.end(), [&](const auto& node) {
    return std::any_of(node.types.begin(), node.types.end(), [&](const TypePlan& of) { return of.definition->id == type; });
  });
}

void write_one(drawing::Markup& page, const State& state, const FigureTable& table, const std::vector<std::uint32_t>& nodes) {
  constexpr std::size_t kMostRows = 300;
  const std::vector<const FigureColumn*> columns = page_columns(state, table, nodes);
  if (columns.empty()) return;
  const std::string heading(table.heading);
  page.element("h2", heading, {{"id", std::string(table.id)}});
  if (!table.maker.empty() && !has_node_of(state, table.maker)) {
    std::string maker(table.maker);
    std::replace(maker.begin(), maker.end(), '_', ' ');
    page.element("p", "No " + maker + " takes care of " + (nodes.size() == 1 ? "it" : "them") +
                          ", so that there are no figures. " + (nodes.size() == 1 ? "The row is in " : "The rows are in ") +
                          std::string(table.id) + ".csv.");
    return;
  }
  if (const std::string remark = common_remark(state, table, nodes); !remark.empty()) {
    page.element("p",
                 "All " + std::to_string(nodes.size()) + ": " + remark + ". The rows are in " + std::string(table.id) + ".csv.");
    return;
  }
  page.open("div", {{"class", "wide"}, {"role", "region"}, {"aria-label", heading}, {"tabindex", "0"}}).open("table");
  std::string caption(table.caption);
  if (nodes.size() > kMostRows)
    caption += " The first " + std::to_string(kMostRows) + " of " + std::to_string(nodes.size()) + "; " + std::string(table.id) +
               ".csv has them all.";
  if (!caption.empty()) page.element("caption", caption);
  page.open("thead").open("tr").element("th", "Name", {{"scope", "col"}});
  std::vector<bool> texts;
  for (const FigureColumn* column : columns) {
    const Value* value = nullptr;
    const PortDefinition* port = port_of(state, nodes.front(), table.type, column->port, value);
    texts.push_back(port == nullptr || is_text(*port));
    page.element("th", column->heading, {{"scope", "col"}, {"class", texts.back() ? "t" : "n"}});
  }
  page.close().close().open("tbody");
  for (std::size_t r = 0; r < std::min(kMostRows, nodes.size()); ++r) {
    page.open("tr").element("th", state.plan->nodes[nodes[r]].name, {{"scope", "row"}});
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Value* value = nullptr;
      const PortDefinition* port = port_of(state, nodes[r], table.type, columns[c]->port, value);
      page.element("td", port == nullptr ? "" : figure_text(*value, *port, columns[c]->is_share),
                   {{"class", texts[c] ? "reason" : "n"}});
    }
    page.close();
  }
  page.close().close().close();
}

}  // namespace

std::vector<std::uint32_t> rows_of(const State& state, const FigureTable& table) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t n = 0; n < state.plan->nodes.size(); ++n) {
    const std::vector<TypePlan>& types = state.plan->nodes[n].types;
    if (std::any_of(types.begin(), types.end(), [&](const TypePlan& type) { return type.definition->id == table.type; }))
      nodes.push_back(n);
  }
  return nodes;
}

std::string figure_text(const Value& value, const PortDefinition& port, bool is_share) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  const double number = as_number(value);
  if (!std::isfinite(number) || means_none(port, number)) return "\xE2\x80\x93";
  if (port.unit == Unit::count && number == std::floor(number)) return reading::grouped(number);
  if (!port.unit_from.empty()) return reading::readable(number);
  if (is_share) return reading::percent(number);
  return port.unit == Unit::ratio ? reading::grouped(number, 2) : reading::quantity(number, port.unit);
}

void write_figure_tables(drawing::Markup& page, const State& state) {
  for (const FigureTable& table : figure_tables())
    if (const auto nodes = rows_of(state, table); !nodes.empty()) write_one(page, state, table, nodes);
}

std::vector<CsvFile> figure_files(const State& state) {
  std::vector<CsvFile> files;
  for (const FigureTable& table : figure_tables()) {
    const std::vector<std::uint32_t> nodes = rows_of(state, table);
    files.push_back(nodes_file(state, table, nodes));
    for (const FigurePart& part : table.parts) files.push_back(part_file(state, table, part, nodes));
  }
  return files;
}

Json figure_json(const State& state) {
  Json all = Json::object();
  for (const FigureTable& table : figure_tables()) {
    for (const std::uint32_t node : rows_of(state, table)) {
      Json row = {{"id", state.plan->nodes[node].id}, {"name", state.plan->nodes[node].name}};
      const auto add = [&](std::string_view id) {
        const Value* value = nullptr;
        if (const PortDefinition* port = port_of(state, node, table.type, id, value))
          row[std::string(id)] = value_to_json(*value, *port);
      };
      for (const FigureColumn& column : table.columns) add(column.port);
      for (const FigurePart& part : table.parts) add(part.port);
      all[std::string(table.id)].push_back(std::move(row));
    }
  }
  return all;
}

}  // namespace bl::report
