// Headers by alias, numbers by column, rows with their lines.
#include "core/import/site_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/import/number_column.h"
#include "core/import/programme_columns.h"

namespace bl::importing {

namespace {

enum SiteColumn : std::size_t { kX, kY, kZ, kWeight, kRadius, kDemand, kLeast, kMost, kGroup, kName, kColumns };

struct ColumnInfo {
  Unit unit;                              // Unit::none for text
  const char* sample;                     // for the sentence about a field that is not understood
  std::vector<std::string_view> aliases;  // in the form of normal_header; our own name first
};

const std::array<ColumnInfo, kColumns>& site_columns() {
  static const std::array<ColumnInfo, kColumns> columns = {{
      {Unit::metre, "a length such as 3.2 or 3.2 m", {"x", "easting", "position_x", "pos_x", "x_coordinate", "coordinate_x"}},
      {Unit::metre, "a length such as 3.2 or 3.2 m", {"y", "northing", "position_y", "pos_y", "y_coordinate", "coordinate_y"}},
      {Unit::metre, "a length such as 3.2 or 3.2 m", {"z", "elevation", "position_z", "pos_z", "z_coordinate", "coordinate_z"}},
      {Unit::square_metre, "an area such as 25 or 25 m2", {"weight", "weights", "w", "power_weight"}},
      {Unit::metre, "a length such as 3.2 or 3.2 m", {"radius", "r"}},
      {Unit::cubic_metre,
       "a volume such as 1200 or 1200 m3",
       {"demand", "demands", "volume", "demanded_volume", "wanted_volume", "target_volume", "target"}},
      {Unit::cubic_metre,
       "a volume such as 1200 or 1200 m3",
       {"demand_min", "min_demand", "demand_minimum", "minimum_demand", "volume_min", "min_volume", "min"}},
      {Unit::cubic_metre,
       "a volume such as 1200 or 1200 m3",
       {"demand_max", "max_demand", "demand_maximum", "maximum_demand", "volume_max", "max_volume", "max"}},
      {Unit::none, "", {"group", "groups", "group_id", "building", "stand"}},
      {Unit::none, "", {"name", "id", "site", "label"}},
  }};
  return columns;
}

std::string_view own_name(std::size_t column) { return site_columns()[column].aliases.front(); }

// Of the header, shortened so that a line that is no header at all stays readable.
std::string fields_in_words(const std::vector<std::string>& fields) {
  std::string list;
  for (std::size_t i = 0; i < fields.size() && i < 12; ++i) list += (i > 0 ? ", `" : "`") + fields[i].substr(0, 40) + "`";
  return fields.size() > 12 ? list + ", ..." : list;
}

class SiteImporter {
 public:
  Result<SiteTable> read(std::string_view text);

 private:
  Result<void> match_header();
  Result<void> take(std::size_t column, std::size_t index);
  Result<void> decide_decimals();
  Result<std::optional<double>> number(const csv::CsvRecord& record, std::size_t column) const;
  Result<SiteRow> read_row(const csv::CsvRecord& record) const;
  std::string place(const csv::CsvRecord& record, std::size_t column) const;

  csv::CsvText csv_;
  std::array<std::optional<FoundColumn>, kColumns> found_;
  std::array<char, kColumns> decimals_{};
};

std::string SiteImporter::place(const csv::CsvRecord& record, std::size_t column) const {
  const std::string line = "line " + std::to_string(record.line);
  return found_[column] ? line + ", column " + std::to_string(found_[column]->index + 1) + " `" + found_[column]->header + "`"
                        : line;
}

Result<void> SiteImporter::take(std::size_t column, std::size_t index) {
  const std::string& header = csv_.records.front().fields[index];
  const std::string here =
      "line " + std::to_string(csv_.records.front().line) + ", column " + std::to_string(index + 1) + " `" + header + "`";
  if (found_[column])
    return Error{ErrorCode::duplicate, here,
                 "The columns `" + found_[column]->header + "` and `" + header + "` are both read as " +
                     std::string(own_name(column)) + ": rename or remove one."};
  const NormalHeader normal = normal_header(header);
  const Unit unit = site_columns()[column].unit;
  const UnitInfo* given = normal.unit.empty() ? nullptr : find_unit(normal.unit);
  const bool is_wrong = !normal.unknown_unit.empty() || (given != nullptr && given->dimension != info(unit).dimension);
  if (unit != Unit::none && is_wrong)
    return Error{ErrorCode::wrong_unit, here,
                 "The unit `" + (given ? normal.unit : normal.unknown_unit) + "` is not read for " +
                     std::string(own_name(column)) + ": give it in " + std::string(info(unit).symbol) + "."};
  found_[column] = FoundColumn{index, header, normal.unit};
  return {};
}

Result<void> SiteImporter::match_header() {
  const csv::CsvRecord& header = csv_.records.front();
  const std::string line = "line " + std::to_string(header.line);
  const auto is_number = [](const std::string& field) { return parse_table_number(field, 0, Unit::none, "").has_value(); };
  if (std::any_of(header.fields.begin(), header.fields.end(), is_number))
    return Error{ErrorCode::missing, line,
                 "The first line holds numbers: put a header above it, such as x,y,z,weight,demand (accepted are " +
                     site_table_columns() + ")."};
  for (std::size_t i = 0; i < header.fields.size(); ++i) {
    const std::string name = normal_header(header.fields[i]).name;
    std::size_t column = 0;
    for (; column < kColumns; ++column) {
      const auto& aliases = site_columns()[column].aliases;
      if (std::find(aliases.begin(), aliases.end(), name) != aliases.end()) break;
    }
    if (column == kColumns && header.fields[i].empty()) continue;  // rows may not have anything there, see read_row
    if (column == kColumns) {
      std::vector<std::string> names;
      for (std::size_t k = 0; k < kColumns; ++k) names.emplace_back(own_name(k));
      const std::string near = nearest_name(name, names);
      return Error{ErrorCode::unknown_field, line + ", column " + std::to_string(i + 1),
                   "`" + header.fields[i].substr(0, 40) + "` is no column of sites" +
                       (near.empty() ? "" : " (did you mean `" + near + "`?)") + "; accepted are " + site_table_columns() + "."};
    }
    if (auto taken = take(column, i); !taken) return taken.error();
  }
  for (const std::size_t column : {kX, kY, kZ})
    if (!found_[column])
      return Error{ErrorCode::missing, line,
                   "There is no column " + std::string(own_name(column)) + " among " + fields_in_words(header.fields) +
                       "; accepted are " + site_table_columns() + "."};
  if (found_[kWeight] && found_[kRadius])
    return Error{ErrorCode::conflict, line, "Both weight and radius are given: keep one (the weight is the radius squared)."};
  return {};
}

// The decimal mark of each column: its own evidence, or else that of the other columns. Between commas that separate
// fields a lone point can only be a decimal point, since groups of thousands would need quotes about decimal commas.
Result<void> SiteImporter::decide_decimals() {
  char of_file = csv_.separator == ',' ? '.' : '\0';
  for (std::size_t column = 0; column < kColumns; ++column) {
    if (!found_[column] || site_columns()[column].unit == Unit::none) continue;
    std::vector<NumberField> fields;
    for (std::size_t i = 1; i < csv_.records.size(); ++i)
      if (found_[column]->index < csv_.records[i].fields.size())
        fields.push_back({csv_.records[i].line, csv_.records[i].fields[found_[column]->index]});
    const auto decimal =
        column_decimal(fields, "column " + std::to_string(found_[column]->index + 1) + " `" + found_[column]->header + "`");
    if (!decimal) return decimal.error();
    decimals_[column] = *decimal;
    if (*decimal != 0) of_file = *decimal;
  }
  for (char& decimal : decimals_)
    if (decimal == 0) decimal = of_file;
  return {};
}

Result<std::optional<double>> SiteImporter::number(const csv::CsvRecord& record, std::size_t column) const {
  if (!found_[column] || found_[column]->index >= record.fields.size()) return std::optional<double>();
  const std::string& text = record.fields[found_[column]->index];
  if (text.empty()) return std::optional<double>();
  if (decimals_[column] == 0 && decimal_evidence(text) == DecimalEvidence::ambiguous)
    return Error{ErrorCode::parse, place(record, column),
                 "`" + text + "` may be a fraction or thousands, and nothing else in the table tells which: write more digits."};
  const auto value = parse_table_number(text, decimals_[column], site_columns()[column].unit, found_[column]->unit);
  if (!value)
    return Error{ErrorCode::parse, place(record, column),
                 "`" + text.substr(0, 40) + "` is not understood: write " + site_columns()[column].sample + "."};
  return value;
}

Result<SiteRow> SiteImporter::read_row(const csv::CsvRecord& record) const {
  const std::vector<std::string>& header = csv_.records.front().fields;
  for (std::size_t i = 0; i < record.fields.size(); ++i)
    if (!record.fields[i].empty() && (i >= header.size() || header[i].empty()))
      return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                   "The row has " + std::to_string(record.fields.size()) + " fields, the header " +
                       std::to_string(header.size()) +
                       ": give each field a column, and write numbers of rows split by commas with decimal points."};
  std::array<std::optional<double>, kColumns> values;
  for (std::size_t column = 0; column < kColumns; ++column) {
    if (site_columns()[column].unit == Unit::none) continue;
    const auto value = number(record, column);
    if (!value) return value.error();
    values[column] = *value;
  }
  for (const std::size_t column : {kX, kY, kZ})
    if (!values[column])
      return Error{ErrorCode::missing, place(record, column),
                   "The site has no " + std::string(own_name(column)) + ": fill the field, or remove the row."};
  const auto text = [&](std::size_t column) {
    return found_[column] && found_[column]->index < record.fields.size() ? record.fields[found_[column]->index] : std::string();
  };
  SiteRow row{record.line,     text(kName),     {*values[kX], *values[kY], *values[kZ]},
              values[kWeight], values[kDemand], values[kLeast],
              values[kMost],   text(kGroup)};
  if (values[kRadius] && *values[kRadius] < 0)
    return Error{ErrorCode::out_of_range, place(record, kRadius), "A radius is 0 m or more, found " + text(kRadius) + "."};
  if (values[kRadius]) row.weight = *values[kRadius] * *values[kRadius];
  return row;
}

Result<SiteTable> SiteImporter::read(std::string_view text) {
  auto csv = csv::read_csv(text);
  if (!csv) return csv.error();
  csv_ = std::move(*csv);
  if (csv_.records.empty())
    return Error{ErrorCode::missing, "line 1",
                 "The table is empty: it needs a header such as x,y,z,weight,demand and one row for each site."};
  if (auto matched = match_header(); !matched) return matched.error();
  if (auto decided = decide_decimals(); !decided) return decided.error();
  SiteTable table;
  table.header_line = csv_.records.front().line;
  table.notes = csv_.notes;
  table.has_weights = found_[kWeight] || found_[kRadius];
  table.has_demands = found_[kDemand] || found_[kLeast] || found_[kMost];
  table.has_groups = found_[kGroup].has_value();
  for (std::size_t i = 1; i < csv_.records.size(); ++i) {
    auto row = read_row(csv_.records[i]);
    if (!row) return row.error();
    table.rows.push_back(std::move(*row));
  }
  return table;
}

}  // namespace

std::string site_table_columns() {
  std::string list;
  for (std::size_t column = 0; column < kColumns; ++column) list.append(column == 0 ? "" : ", ").append(own_name(column));
  return list;
}

Result<SiteTable> read_site_table(std::string_view text) { return SiteImporter().read(text); }

}  // namespace bl::importing
