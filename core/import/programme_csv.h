// Imports a programme of demands from a CSV table: uses, floor areas, counts, storey heights and wanted neighbours.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace bl::importing {

struct ProgrammeOptions {
  /// Our column → the header in the file, where that is called otherwise: {"use", "Room Name"}. Columns: use, name,
  /// floor_area_m2, floor_area_min_m2, floor_area_max_m2, count, storey_height_m, adjacent_to, tags,
  /// standing, storeys, open, on, shares, below_ground, depth_m, distance_m, note.
  std::map<std::string, std::string> columns;
  std::optional<char> separator;  ///< ',', ';' or '\t'; nothing: found out
  std::optional<char> decimal;    ///< '.' or ','; nothing: found out per column
  double storey_height = 3.2;     ///< of rows that give none [m]
  /// Is a use open space where its row does not say so? Empty: none is.
  std::function<bool(const std::string& use)> is_open_space;
  /// Does a use lie below the ground where its row does not say so? Empty: none does.
  std::function<bool(const std::string& use)> is_below_ground;
  /// Volumes stand in storeys; else columns that only such volumes follow are left out with a warning.
  bool is_standing = true;
};

/// One row: `count` alike items, each with its own floor area.
struct ProgrammeRow {
  std::size_t line = 0;                  ///< of the file, from 1
  std::string use;                       ///< unique in the import
  std::string name;                      ///< what people call it; the use where the file has no such column
  std::optional<double> floor_area_min;  ///< of ONE item [m²]
  double floor_area = 0;                 ///< of ONE item [m²]; `count` multiplies it
  std::optional<double> floor_area_max;  ///< of ONE item [m²]
  double storey_height = 0;              ///< [m]
  int storeys = 0;                       ///< that its volumes wish for; 0: nothing is said
  int count = 1;
  bool is_open = false;                  ///< open space: its areas are ground that nobody builds on, and its items are no volumes
  std::vector<std::string> adjacent_to;  ///< uses of this import
  std::vector<std::string> tags;
  std::string standing = "stack";  ///< what its volumes may stand on: "ground", "stack" (also on others) or "bridge"
  bool is_standing_said = false;   ///< by the row itself
  std::string on;                  ///< use of the row on whose roofs its volumes stand; empty: on the ground
  std::string shares;              ///< use of the row with whose volumes its own share a building; empty: with none
  int cellar_storeys = 0;          ///< below its volumes
  bool is_below_ground = false;    ///< the row lies in cellars: its items are no volumes and no floor area
  std::optional<double> depth;     ///< greatest depth of its buildings [m]
  std::optional<double> distance;  ///< clear distance of its buildings from others [m]
  std::string note;                ///< of the file

  bool has_volumes() const { return !is_open && !is_below_ground; }
};

struct ProgrammeImport {
  std::vector<ProgrammeRow> rows;
  // Of rows that have volumes.
  std::size_t items = 0;  ///< sum of the counts
  double floor_area = 0;  ///< sum of count · floor area [m²]
  char separator = ',';
  std::vector<std::string> notes;     ///< what was assumed, renamed or left out, one sentence each
  std::vector<std::string> warnings;  ///< what was left out and was probably meant, one sentence each
};

/// A table that was read: without a programme there are errors, all that were found.
struct ProgrammeReading {
  std::optional<ProgrammeImport> programme;
  std::vector<Error> errors;
};
ProgrammeReading read_programme_table(std::string_view text, const ProgrammeOptions& options = {});
/// The same with the first error alone.
Result<ProgrammeImport> read_programme_csv(std::string_view text, const ProgrammeOptions& options = {});

}  // namespace bl::importing
