// Picks the columns and rows of a recorded table, and puts them in order of their times.
#include "core/live/recording.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/live/message.h"
#include "core/live/time_text.h"

namespace bl::live {

namespace {

struct Columns {
  std::size_t value = 0, time = 0;
  std::optional<std::size_t> day_time;                       // a second column with the time of the day
  bool are_days_digits = false;                              // 20030131 is a day, and no number of seconds
  std::vector<std::pair<std::size_t, std::string>> filters;  // column, what has to stand there
};

const std::string& field_of(const csv::CsvRecord& record, std::size_t column) {
  static const std::string kNothing;
  return column < record.fields.size() ? record.fields[column] : kNothing;
}

Result<std::size_t> column_of(const csv::CsvRecord& header, const std::string& name) {
  const auto found = std::find(header.fields.begin(), header.fields.end(), name);
  if (found != header.fields.end()) return static_cast<std::size_t>(found - header.fields.begin());
  return Error{ErrorCode::not_found, "line " + std::to_string(header.line),
               "the table has no column " + in_quotes(name) + did_you_mean(name, header.fields)};
}

bool is_counted(const csv::CsvRecord& record, const Columns& columns) {
  return std::all_of(columns.filters.begin(), columns.filters.end(),
                     [&](const auto& filter) { return field_of(record, filter.first) == filter.second; });
}

// The first column that holds dates; else one that is called as columns of times are.
Result<std::size_t> time_column(const csv::CsvText& csv) {
  const csv::CsvRecord& header = csv.records.front();
  if (csv.records.size() > 1)
    for (std::size_t c = 0; c < header.fields.size(); ++c) {
      const std::string& first = field_of(csv.records[1], c);
      if (!parse_number(first) && seconds_of_time(first)) return c;
    }
  for (const char* name : {"time", "epoch", "timestamp", "seconds", "t"})
    for (std::size_t c = 0; c < header.fields.size(); ++c)
      if (lower_case(header.fields[c]) == name) return c;
  return Error{ErrorCode::not_found, "line " + std::to_string(header.line),
               "no column holds times such as `2003-01-31T12:00:00Z`: name it, as in `replay:table.csv?time=column#readings`"};
}

Result<Columns> columns_of(const csv::CsvText& csv, const address::LiveAddress& address) {
  const csv::CsvRecord& header = csv.records.front();
  Columns columns;
  const auto value = column_of(header, address.column);
  if (!value) return value.error();
  columns.value = *value;
  const std::size_t plus = std::min(address.time.find('+'), address.time.size());
  const auto time = address.time.empty() ? time_column(csv) : column_of(header, address.time.substr(0, plus));
  if (!time) return time.error();
  columns.time = *time;
  if (plus < address.time.size()) {
    const auto day_time = column_of(header, address.time.substr(plus + 1));
    if (!day_time) return day_time.error();
    columns.day_time = *day_time;
  }
  for (const auto& [name, text] : address.filters) {
    const auto column = column_of(header, name);
    if (!column) return column.error();
    columns.filters.emplace_back(*column, text);
  }
  return columns;
}

// One row of digits may be a day or a number; a column in which every row is a day holds days.
bool are_days_digits(const csv::CsvText& csv, const Columns& columns) {
  bool has_any = false;
  for (std::size_t r = 1; r < csv.records.size(); ++r) {
    if (!is_counted(csv.records[r], columns)) continue;
    if (!seconds_of_digits(field_of(csv.records[r], columns.time))) return false;
    has_any = true;
  }
  return has_any;
}

Result<double> time_of(const csv::CsvRecord& record, const Columns& columns) {
  const std::string& text = field_of(record, columns.time);
  auto seconds = columns.are_days_digits ? seconds_of_digits(text) : seconds_of_time(text);
  if (seconds && columns.day_time && !columns.are_days_digits && parse_number(text))
    return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                 in_quotes(text) +
                     " is no day to which a time of the day could be added: write days as `2003-01-31` or, in all "
                     "rows, as `20030131`"};
  if (!seconds)
    return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                 in_quotes(text) + " is no time such as `2003-01-31 12:00`"};
  if (columns.day_time) {
    const std::string& clock = field_of(record, *columns.day_time);
    const auto added = seconds_of_day(clock);
    if (!added)
      return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                   in_quotes(clock) + " is no hour and no time of a day"};
    *seconds += *added;
  }
  return *seconds;
}

}  // namespace

Result<Recording> read_recording(std::string_view text, const address::LiveAddress& address) {
  const auto csv = csv::read_csv(text);
  if (!csv) return csv.error();
  if (csv->records.empty()) return Error{ErrorCode::missing, "line 1", "the table is empty"};
  auto columns = columns_of(*csv, address);
  if (!columns) return columns.error();
  columns->are_days_digits = are_days_digits(*csv, *columns);
  Recording recording;
  for (std::size_t r = 1; r < csv->records.size(); ++r) {
    const csv::CsvRecord& record = csv->records[r];
    if (!is_counted(record, *columns)) {
      ++recording.filtered;
      continue;
    }
    const auto seconds = time_of(record, *columns);
    if (!seconds) return seconds.error();
    const std::string& shown = field_of(record, columns->value);
    if (shown.empty()) {
      ++recording.empty;
      continue;
    }
    const auto number = parse_number(shown);
    std::string time = field_of(record, columns->time);
    if (columns->day_time) time += " " + field_of(record, *columns->day_time);
    recording.readings.push_back(
        {*seconds, number.value_or(0),
         number ? "" : "line " + std::to_string(record.line) + " of the table: " + in_quotes(shown) + " is no number",
         std::move(time)});
  }
  std::stable_sort(recording.readings.begin(), recording.readings.end(),
                   [](const RecordedReading& a, const RecordedReading& b) { return a.seconds < b.seconds; });
  if (recording.readings.empty())
    return Error{ErrorCode::missing, "",
                 "no row of the table holds a reading" +
                     (address.filters.empty()
                          ? std::string()
                          : " of the " + address.filters.begin()->first + " " + in_quotes(address.filters.begin()->second))};
  return recording;
}

std::int64_t tick_of(const Recording& recording, const RecordedReading& reading, double tick_length) {
  constexpr double kLast = 1e15;  // far beyond any run, and exact in a double
  const double ticks = std::floor((reading.seconds - recording.readings.front().seconds) / tick_length + 0.5);
  return 1 + static_cast<std::int64_t>(std::min(ticks, kLast));
}

}  // namespace bl::live
