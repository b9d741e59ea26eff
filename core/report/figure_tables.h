// What a state says of everything but its volumes: one list of tables, from which page, CSV files and JSON are all made.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/define/json_text.h"
#include "core/drawing/markup.h"
#include "core/graph/state.h"

namespace bl::report {

/// Where a figure is shown: everywhere; in files for programs; in JSON alone, because it is a list of points or the like.
enum class Shown { everywhere, files, json };

struct FigureColumn {
  std::string_view port, heading;
  Shown shown = Shown::everywhere;
  bool is_share = false;  ///< a ratio of a whole, which people read in percent
};

/// A table inside of each node, which is a file of its own beside the one of the nodes.
struct FigurePart {
  std::string_view id, port;
};

/// All nodes of one typification, one row each.
struct FigureTable {
  std::string_view id;       ///< the file without its ending, and the key in JSON
  std::string_view type;     ///< of the nodes
  std::string_view heading;  ///< on the page
  std::string_view caption;
  std::vector<FigureColumn> columns;
  std::vector<FigurePart> parts;
  std::string_view maker = {};  ///< the type of nodes that make these figures, where they are all zero without one
};

/// In the order of the page. That every port exists is a law: a renamed one fails a test, and does not become an empty column.
std::span<const FigureTable> figure_tables();

/// Nodes of the state that have a row, ascending.
std::vector<std::uint32_t> rows_of(const State& state, const FigureTable& table);
/// A figure as people read it: with its unit, a dash where it is none.
std::string figure_text(const Value& value, const PortDefinition& port, bool is_share);

/// All tables that have rows, for the page.
void write_figure_tables(drawing::Markup& page, const State& state);

struct CsvFile {
  std::string name, text;
  bool has_rows = false;
};
/// Files of all tables and their parts; also those that have no rows, so that nothing older is left behind under their names.
std::vector<CsvFile> figure_files(const State& state);
/// The same by table: {"streets": [{"id", "name", ports...}, ...], ...}; tables without rows are left out.
Json figure_json(const State& state);

}  // namespace bl::report
