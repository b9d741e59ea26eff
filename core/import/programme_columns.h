// Finds out which column of a table is which part of a programme, from its header row.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/unit.h"
#include "core/csv/csv_reader.h"

namespace bl::importing {

enum class ProgrammeColumn {
  use,
  name,
  floor_area,
  floor_area_min,
  floor_area_max,
  count,
  storey_height,
  adjacent_to,
  tags,
  standing,
  storeys,
  open,
  on,
  shares,
  below_ground,
  depth,
  distance,
  note
};
constexpr std::size_t kProgrammeColumns = 18;

/// The name of a column and its aliases. Names are compared in the form of normal_header.
struct ProgrammeColumnInfo {
  ProgrammeColumn column;
  std::string_view name;                  ///< as in options and messages: "floor_area_m2"
  Unit unit;                              ///< Unit::none for text
  std::vector<std::string_view> aliases;  ///< without unit, the main one first
};
const std::array<ProgrammeColumnInfo, kProgrammeColumns>& programme_columns();

/// A header without unit: lower case, one `_` for what is neither letter nor digit; and the unit that it named.
struct NormalHeader {
  std::string name;
  std::string unit;          ///< "m2", "ha": from brackets or a last word; empty where there is none
  std::string unknown_unit;  ///< text in brackets that is no unit
};
NormalHeader normal_header(std::string_view header);

struct FoundColumn {
  std::size_t index = 0;  ///< in the record, from 0
  std::string header;     ///< as in the file
  std::string unit;       ///< of numbers that come without one
};

struct ProgrammeHeader {
  std::array<std::optional<FoundColumn>, kProgrammeColumns> columns;
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< of columns whose names are near to one of ours
  const std::optional<FoundColumn>& at(ProgrammeColumn column) const { return columns[static_cast<std::size_t>(column)]; }
};

/// `chosen` maps our names to headers of the file and goes before the aliases.
Result<ProgrammeHeader> match_programme_header(const csv::CsvRecord& record, const std::map<std::string, std::string>& chosen);

}  // namespace bl::importing
