// Rows of the table as checked rows of a programme; every complaint names line and column.
#include "core/import/programme_csv.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/import/number_column.h"
#include "core/import/programme_columns.h"
#include "core/import/programme_joins.h"

namespace bl::importing {

namespace {

constexpr std::array kNumbers = {ProgrammeColumn::floor_area, ProgrammeColumn::floor_area_min, ProgrammeColumn::floor_area_max,
                                 ProgrammeColumn::count,      ProgrammeColumn::storey_height,  ProgrammeColumn::storeys,
                                 ProgrammeColumn::depth,      ProgrammeColumn::distance};
// Only volumes that stand in storeys follow these.
constexpr std::array kOfStanding = {ProgrammeColumn::shares, ProgrammeColumn::below_ground, ProgrammeColumn::depth,
                                    ProgrammeColumn::distance};
constexpr std::size_t kMostErrors = 20;  // that are listed; the others are counted
constexpr double kMostCellars = 20;      // as many as a footprint may have
constexpr double kMostStoreys = 200;     // more is a number in the wrong column
constexpr double kMostItems = 100000;    // of one row: more is a number in the wrong column
constexpr double kTallestStorey = 1000;  // [m]
constexpr double kLargestArea = 1e9;     // [m²] of one item
constexpr double kLeastDepth = 3, kLargestDepth = 1000, kLargestDistance = 200;  // [m]

std::vector<std::string> split_list(std::string_view text, std::string_view separators) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    const std::string_view part = csv::trimmed(text.substr(0, end));
    if (!part.empty()) parts.emplace_back(part);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return parts;
}

class ProgrammeImporter {
 public:
  explicit ProgrammeImporter(const ProgrammeOptions& options) : options_(options) {}
  ProgrammeReading read(std::string_view text);

 private:
  std::string field(const csv::CsvRecord& record, ProgrammeColumn column) const;
  std::string place(const csv::CsvRecord& record, ProgrammeColumn column) const;
  bool read_header(std::string_view text);
  Result<void> decide_decimals();
  Result<std::optional<double>> number(const csv::CsvRecord& record, ProgrammeColumn column) const;
  std::optional<double> told_number(const csv::CsvRecord& record, ProgrammeColumn column);
  int whole(const csv::CsvRecord& record, ProgrammeColumn column, int otherwise, double most, const std::string& what);
  std::optional<double> length(const csv::CsvRecord& record, ProgrammeColumn column, double least, double most,
                               const std::string& what);
  Result<void> check_width(const csv::CsvRecord& record) const;
  void read_row(const csv::CsvRecord& record);
  Result<void> settle_area(const csv::CsvRecord& record, ProgrammeRow& row);
  Result<void> read_standing(const csv::CsvRecord& record, ProgrammeRow& row) const;
  Result<void> read_open(const csv::CsvRecord& record, ProgrammeRow& row) const;
  Result<void> read_below_ground(const csv::CsvRecord& record, ProgrammeRow& row) const;
  void make_unique();
  void tell_storey_heights();
  void take(Error error) { errors_.push_back(std::move(error)); }
  void take(const Result<void>& done) {
    if (!done) errors_.push_back(done.error());
  }

  const ProgrammeOptions& options_;
  csv::CsvText csv_;
  ProgrammeHeader header_;
  std::array<char, kProgrammeColumns> decimals_{};
  std::vector<std::string> written_uses_;           // per row, before they were made unique
  std::vector<std::string> without_storey_height_;  // uses of rows that give none
  std::vector<Error> errors_;                       // in the order in which they were found
  ProgrammeImport import_;
};

std::string ProgrammeImporter::field(const csv::CsvRecord& record, ProgrammeColumn column) const {
  const auto& found = header_.at(column);
  return found && found->index < record.fields.size() ? record.fields[found->index] : std::string();
}

std::string ProgrammeImporter::place(const csv::CsvRecord& record, ProgrammeColumn column) const {
  const auto& found = header_.at(column);
  const std::string line = "line " + std::to_string(record.line);
  return found ? line + ", column " + std::to_string(found->index + 1) + " `" + found->header + "`" : line;
}

// The decimal mark of a column: the option, its own evidence, or else that of the other columns of the file.
Result<void> ProgrammeImporter::decide_decimals() {
  if (options_.decimal && *options_.decimal != '.' && *options_.decimal != ',')
    return Error{ErrorCode::parse, "decimal", "The decimal mark must be a point or a comma."};
  char of_file = 0;
  bool mixed = false;
  for (const ProgrammeColumn column : kNumbers) {
    const auto& found = header_.at(column);
    if (!found) continue;
    std::vector<NumberField> fields;
    for (std::size_t i = 1; i < csv_.records.size(); ++i)
      fields.push_back({csv_.records[i].line, field(csv_.records[i], column)});
    auto decimal = options_.decimal
                       ? Result<char>(*options_.decimal)
                       : column_decimal(fields, "column " + std::to_string(found->index + 1) + " `" + found->header + "`");
    if (!decimal) {
      take(decimal.error());
      continue;
    }
    decimals_[static_cast<std::size_t>(column)] = *decimal;
    if (*decimal == 0) continue;
    mixed = mixed || (of_file != 0 && of_file != *decimal);
    of_file = *decimal;
  }
  if (mixed) import_.notes.push_back("Some columns have decimal points and some decimal commas; each was read in its own way.");
  for (char& decimal : decimals_)
    if (decimal == 0 && !mixed) decimal = of_file;
  return {};
}

Result<std::optional<double>> ProgrammeImporter::number(const csv::CsvRecord& record, ProgrammeColumn column) const {
  const std::string text = field(record, column);
  if (text.empty()) return std::optional<double>();
  const auto index = static_cast<std::size_t>(column);
  const ProgrammeColumnInfo& info = programme_columns()[index];
  if (decimals_[index] == 0 && decimal_evidence(text) == DecimalEvidence::ambiguous)
    return Error{ErrorCode::parse, place(record, column),
                 "`" + text +
                     "` may be a fraction or thousands, and nothing else in the file tells which. Write it without thousands "
                     "mark, or give the option `decimal`: . or ,"};
  const auto value = parse_table_number(text, decimals_[index], info.unit, header_.at(column)->unit);
  if (value) return value;
  const std::string units = info.unit == Unit::count   ? "a whole number such as 3"
                            : info.unit == Unit::metre ? "a length such as 3.2 or 3.2 m"
                                                       : "an area such as 120, 120 m2 or 0.4 ha";
  return Error{ErrorCode::parse, place(record, column), "`" + text + "` is not understood. Write " + units + "."};
}

std::optional<double> ProgrammeImporter::told_number(const csv::CsvRecord& record, ProgrammeColumn column) {
  auto value = number(record, column);
  if (value) return *value;
  take(value.error());
  return std::nullopt;
}

int ProgrammeImporter::whole(const csv::CsvRecord& record, ProgrammeColumn column, int otherwise, double most,
                             const std::string& what) {
  const auto value = told_number(record, column);
  if (!value) return otherwise;
  if (*value >= 1 && *value <= most && *value == std::floor(*value)) return static_cast<int>(*value);
  take(Error{ErrorCode::out_of_range, place(record, column),
             what.substr(0, what.find('|')) + written_out(*value) + what.substr(what.find('|') + 1)});
  return otherwise;
}

std::optional<double> ProgrammeImporter::length(const csv::CsvRecord& record, ProgrammeColumn column, double least, double most,
                                                const std::string& what) {
  const auto value = told_number(record, column);
  if (value && !(*value >= least && *value <= most)) {
    take(Error{ErrorCode::out_of_range, place(record, column),
               "The " + what + " is " + written_out(*value) + " m. It must be from " + written_out(least) + " to " +
                   written_out(most) + " m, or empty."});
    return std::nullopt;
  }
  return value;
}

Result<void> ProgrammeImporter::check_width(const csv::CsvRecord& record) const {
  const std::size_t columns = csv_.records.front().fields.size();
  for (std::size_t i = columns; i < record.fields.size(); ++i)
    if (!record.fields[i].empty())
      return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                   "The row has " + std::to_string(record.fields.size()) + " fields, the header " + std::to_string(columns) +
                       ". Put fields with " +
                       (csv_.separator == ','   ? "a comma"
                        : csv_.separator == ';' ? "a semicolon"
                                                : "a tab") +
                       " inside them into double quotes" + (csv_.separator == ',' ? " (decimal commas too)." : ".")};
  return {};
}

// Area and its bounds: the target may be missing where both bounds are given.
Result<void> ProgrammeImporter::settle_area(const csv::CsvRecord& record, ProgrammeRow& row) {
  std::array<std::optional<double>, 3> areas;
  const std::array columns = {ProgrammeColumn::floor_area, ProgrammeColumn::floor_area_min, ProgrammeColumn::floor_area_max};
  for (std::size_t k = 0; k < 3; ++k) {
    auto value = number(record, columns[k]);
    if (!value) return value.error();
    areas[k] = *value;
    if (areas[k] && !(*areas[k] > 0 && *areas[k] <= kLargestArea))
      return Error{ErrorCode::out_of_range, place(record, columns[k]),
                   "The floor area is " + written_out(*areas[k]) + " m². It must be greater than zero and at most 1e9 m²."};
  }
  row.floor_area_min = areas[1];
  row.floor_area_max = areas[2];
  if (!areas[0] && areas[1] && areas[2]) {
    areas[0] = *areas[1] / 2 + *areas[2] / 2;
    import_.notes.push_back("Line " + std::to_string(record.line) + " has no floor area; the middle of its bounds was taken, " +
                            written_out(*areas[0]) + " m².");
  }
  if (!areas[0])
    return Error{ErrorCode::missing, place(record, ProgrammeColumn::floor_area),
                 "The floor area is empty. Give one, or remove the row."};
  row.floor_area = *areas[0];
  if ((areas[1] && *areas[1] > row.floor_area) || (areas[2] && *areas[2] < row.floor_area))
    return Error{ErrorCode::conflict, place(record, areas[1] && *areas[1] > row.floor_area ? columns[1] : columns[2]),
                 "The floor area " + written_out(row.floor_area) + " m² lies outside its own bounds (" +
                     (areas[1] ? written_out(*areas[1]) : "none") + " to " + (areas[2] ? written_out(*areas[2]) : "none") +
                     "). Correct one of them."};
  return {};
}

// Empty fields leave what rows without this column have.
Result<void> ProgrammeImporter::read_standing(const csv::CsvRecord& record, ProgrammeRow& row) const {
  const std::string written = field(record, ProgrammeColumn::standing), word = lower_case(written);
  if (word.empty()) return {};
  const std::vector<std::string> words = {"ground", "stack", "bridge"};
  if (std::find(words.begin(), words.end(), word) == words.end())
    return Error{ErrorCode::parse, place(record, ProgrammeColumn::standing),
                 "`" + written + "` is not understood" + (did_you_mean(word, words).empty() ? "." : did_you_mean(word, words)) +
                     " Write `ground` for what must stand on the ground, `stack` for what may stand on others, or `bridge` for "
                     "what may also hang between others."};
  row.standing = word;
  row.is_standing_said = true;
  return {};
}

Result<void> ProgrammeImporter::read_open(const csv::CsvRecord& record, ProgrammeRow& row) const {
  const std::string written = field(record, ProgrammeColumn::open), word = lower_case(written);
  const auto is_one = [&word](std::initializer_list<const char*> words) {
    return std::any_of(words.begin(), words.end(), [&word](const char* one) { return word == one; });
  };
  if (word.empty()) row.is_open = options_.is_open_space && options_.is_open_space(row.use);
  else if (is_one({"yes", "true", "1", "x", "open"})) row.is_open = true;
  else if (!is_one({"no", "false", "0", "-"}))
    return Error{
        ErrorCode::parse, place(record, ProgrammeColumn::open),
        "`" + written + "` is not understood. Write `yes` for ground that nobody builds on, `no` for floor area, or nothing."};
  return {};
}

// `yes`: the whole row lies in cellars; a number: its volumes have so many cellar storeys.
Result<void> ProgrammeImporter::read_below_ground(const csv::CsvRecord& record, ProgrammeRow& row) const {
  const std::string written = field(record, ProgrammeColumn::below_ground), word = lower_case(written);
  if (word.empty()) {
    row.is_below_ground = options_.is_standing && !row.is_open && options_.is_below_ground && options_.is_below_ground(row.use);
    return {};
  }
  if (word == "no" || word == "false" || word == "0" || word == "-") return {};
  if (word == "yes" || word == "true" || word == "x") row.is_below_ground = true;
  else {
    const auto storeys = parse_table_number(written, '.', Unit::count, "");
    if (!storeys || !(*storeys >= 1 && *storeys <= kMostCellars && *storeys == std::floor(*storeys)))
      return Error{ErrorCode::parse, place(record, ProgrammeColumn::below_ground),
                   "`" + written +
                       "` is not understood. Write `yes` for a row that lies in cellars as a whole, such as underground "
                       "parking, the number of cellar storeys below its volumes from 1 to 20, `no`, or nothing."};
    row.cellar_storeys = static_cast<int>(*storeys);
  }
  if (row.is_open)
    return Error{
        ErrorCode::conflict, place(record, ProgrammeColumn::below_ground),
        "`" + row.use + "` is open space, which has no cellar: leave this field empty, or write `no` in a column `open`."};
  return {};
}

// What is wrong with one part of a row does not hide what is wrong with the others.
void ProgrammeImporter::read_row(const csv::CsvRecord& record) {
  ProgrammeRow row;
  row.line = record.line;
  row.use = field(record, ProgrammeColumn::use);
  if (auto fits = check_width(record); !fits) {
    take(fits.error());
    import_.rows.push_back(std::move(row));
    return;
  }
  if (row.use.empty())
    take(Error{ErrorCode::missing, place(record, ProgrammeColumn::use), "The use is empty. Name it, or remove the row."});
  row.name = field(record, ProgrammeColumn::name);
  row.note = field(record, ProgrammeColumn::note);
  take(read_open(record, row));
  take(settle_area(record, row));
  row.count = whole(record, ProgrammeColumn::count, 1, kMostItems, "The count is |. It must be a whole number from 1 to 100000.");
  const auto height = told_number(record, ProgrammeColumn::storey_height);
  row.storey_height = height.value_or(options_.storey_height);
  if (!(row.storey_height > 0 && row.storey_height <= kTallestStorey))
    take(
        Error{ErrorCode::out_of_range, place(record, ProgrammeColumn::storey_height),
              "The storey height is " + written_out(row.storey_height) + " m. It must be greater than zero and at most 1000 m."});
  row.storeys = whole(record, ProgrammeColumn::storeys, 0, kMostStoreys,
                      "The number of storeys is |. It must be a whole number from 1 to 200, or empty.");
  row.depth = length(record, ProgrammeColumn::depth, kLeastDepth, kLargestDepth, "greatest depth of a building");
  row.distance = length(record, ProgrammeColumn::distance, 0, kLargestDistance, "distance between buildings");
  take(read_below_ground(record, row));
  if (!height && row.has_volumes()) without_storey_height_.push_back(row.use);
  row.adjacent_to = split_list(field(record, ProgrammeColumn::adjacent_to), "|;");
  row.tags = split_list(field(record, ProgrammeColumn::tags), "|;,");
  row.on = field(record, ProgrammeColumn::on);
  row.shares = field(record, ProgrammeColumn::shares);
  take(read_standing(record, row));
  if (row.has_volumes()) {
    import_.items += static_cast<std::size_t>(row.count);
    import_.floor_area += row.count * row.floor_area;
  }
  import_.rows.push_back(std::move(row));
}

// Later rows of a use get a number: shop, shop 2, shop 3; capitals make no difference.
void ProgrammeImporter::make_unique() {
  std::set<std::string> seen, written;
  for (const ProgrammeRow& row : import_.rows) written.insert(lower_case(row.use));
  for (ProgrammeRow& row : import_.rows) {
    written_uses_.push_back(row.use);
    if (!seen.insert(lower_case(row.use)).second) {
      int number = 2;
      std::string use = row.use + " 2";
      while (written.contains(lower_case(use))) use = row.use + " " + std::to_string(++number);
      written.insert(lower_case(use));
      import_.notes.push_back("Line " + std::to_string(row.line) + ": the use `" + row.use +
                              "` exists already; this one became `" + use + "`.");
      row.use = use;
    }
    if (row.name.empty()) row.name = row.use;
  }
}

// A height that nobody gave decides on storeys and volumes all the same.
void ProgrammeImporter::tell_storey_heights() {
  if (without_storey_height_.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < without_storey_height_.size() && i < 6; ++i)
    list += (i == 0 ? "`" : ", `") + without_storey_height_[i] + "`";
  if (without_storey_height_.size() > 6) list += ", ...";
  import_.notes.push_back("Rows without a storey height: " + std::to_string(without_storey_height_.size()) + " (" + list +
                          "). They have " + written_out(options_.storey_height) + " m.");
}

bool ProgrammeImporter::read_header(std::string_view text) {
  auto csv = csv::read_csv(text, options_.separator);
  if (!csv) {
    take(csv.error());
    return false;
  }
  csv_ = *std::move(csv);
  import_.separator = csv_.separator;
  import_.notes = csv_.notes;
  if (csv_.records.empty()) {
    take(Error{ErrorCode::missing, "line 1", "The table is empty. It needs a header with `use` and `floor_area_m2`, and rows."});
    return false;
  }
  auto header = match_programme_header(csv_.records.front(), options_.columns);
  if (!header) {
    take(header.error());
    return false;
  }
  header_ = *std::move(header);
  import_.notes.insert(import_.notes.end(), header_.notes.begin(), header_.notes.end());
  import_.warnings = header_.warnings;
  if (!options_.is_standing)
    for (const ProgrammeColumn column : kOfStanding)
      if (auto& found = header_.columns[static_cast<std::size_t>(column)]) {
        import_.warnings.push_back("Column " + std::to_string(found->index + 1) + " `" + found->header +
                                   "` was left out: only volumes that stand in storeys follow it.");
        found.reset();
      }
  if (csv_.records.size() > 1) return true;
  take(Error{ErrorCode::missing, "line " + std::to_string(csv_.records.front().line),
             "The table has a header but no rows. Add one row per use."});
  return false;
}

ProgrammeReading ProgrammeImporter::read(std::string_view text) {
  if (read_header(text)) {
    take(decide_decimals());
    for (std::size_t i = 1; i < csv_.records.size(); ++i) read_row(csv_.records[i]);
    tell_storey_heights();
    make_unique();
    const auto place_of = [this](std::size_t row, ProgrammeColumn column) { return place(csv_.records[row + 1], column); };
    join_rows(import_, written_uses_, place_of, errors_);
  }
  ProgrammeReading reading;
  if (errors_.empty()) {
    reading.programme = std::move(import_);
  } else if (errors_.size() > kMostErrors + 1) {
    const std::size_t more = errors_.size() - kMostErrors;
    errors_.resize(kMostErrors, Error{});
    take(Error{ErrorCode::parse, "", "There are " + std::to_string(more) + " more mistakes of the same table."});
  }
  for (Error& error : errors_) reading.errors.push_back(bounded(std::move(error)));
  return reading;
}

}  // namespace

ProgrammeReading read_programme_table(std::string_view text, const ProgrammeOptions& options) {
  return ProgrammeImporter(options).read(text);
}

Result<ProgrammeImport> read_programme_csv(std::string_view text, const ProgrammeOptions& options) {
  ProgrammeReading reading = read_programme_table(text, options);
  if (reading.programme) return *std::move(reading.programme);
  return reading.errors.front();
}

}  // namespace bl::importing
