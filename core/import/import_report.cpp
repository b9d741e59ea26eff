// Counts and the CSV form of import reports, there and back.
#include "core/import/import_report.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/csv/csv_table.h"

namespace bl::importing {

std::string_view name_of(ImportOutcome outcome) {
  switch (outcome) {
    case ImportOutcome::taken: return "taken";
    case ImportOutcome::repaired: return "repaired";
    case ImportOutcome::skipped: return "skipped";
  }
  return "";
}

void ImportReport::take(std::string kind, std::string id, std::string reason, std::string detail, std::size_t count) {
  rows_.push_back({ImportOutcome::taken, std::move(kind), std::move(id), std::move(reason), std::move(detail), count, {}, {}});
}
void ImportReport::repair(std::string kind, std::string id, std::string reason, std::string detail) {
  rows_.push_back({ImportOutcome::repaired, std::move(kind), std::move(id), std::move(reason), std::move(detail), 1, {}, {}});
}
void ImportReport::skip(std::string kind, std::string id, std::string reason, std::string detail, std::size_t count) {
  rows_.push_back({ImportOutcome::skipped, std::move(kind), std::move(id), std::move(reason), std::move(detail), count, {}, {}});
}

void ImportReport::drop(const std::map<std::size_t, std::string>& unused) {
  for (const auto& [index, reason] : unused) {
    ImportRow& row = rows_[index];
    if (!row.made.empty() || row.outcome == ImportOutcome::skipped) continue;
    row.outcome = ImportOutcome::skipped;
    row.reason += ": " + reason;
  }
  for (const auto& [index, leader] : leaders_) {
    ImportRow& row = rows_[index];
    if (rows_[leader].outcome != ImportOutcome::skipped || row.outcome == ImportOutcome::skipped || !row.made.empty()) continue;
    row.outcome = ImportOutcome::skipped;
    row.reason += ": nothing became of that";
  }
  count_corners();
}

void ImportReport::set_corners(ImportCorners corners) {
  corners_ = std::move(corners);
  count_corners();
}

void ImportReport::count_corners() {
  rows_.resize(rows_.size() - corner_rows_);
  const std::size_t before = rows_.size();
  std::vector<bool> is_taken(corners_.number, false);
  for (const auto& [row, used] : corners_.users)
    if (rows_[row].outcome != ImportOutcome::skipped)
      for (const std::uint32_t corner : used) is_taken[corner] = true;
  const auto count = static_cast<std::size_t>(std::count(is_taken.begin(), is_taken.end(), true));
  if (count > 0) take(corners_.kind, "", corners_.taken, "", count);
  if (count < corners_.number) skip(corners_.kind, "", corners_.skipped, "", corners_.number - count);
  corner_rows_ = rows_.size() - before;
}

void ImportReport::mend(std::size_t row, const std::string& detail) {
  ImportRow& mended = rows_[row];
  if (mended.outcome == ImportOutcome::taken) mended.outcome = ImportOutcome::repaired;
  mended.detail += (mended.detail.empty() ? "" : ", ") + detail;
}

void ImportReport::remark(std::size_t row, const std::string& detail) {
  rows_[row].detail += (rows_[row].detail.empty() ? "" : "; ") + detail;
}

std::size_t ImportReport::count(ImportOutcome outcome, std::string_view kind) const {
  std::size_t sum = 0;
  for (const ImportRow& row : rows_)
    if (row.outcome == outcome && (kind.empty() || row.kind == kind)) sum += row.count;
  return sum;
}

std::size_t ImportReport::total(std::string_view kind) const {
  return count(ImportOutcome::taken, kind) + count(ImportOutcome::repaired, kind) + count(ImportOutcome::skipped, kind);
}

std::map<std::tuple<ImportOutcome, std::string, std::string>, std::size_t> ImportReport::counts() const {
  std::map<std::tuple<ImportOutcome, std::string, std::string>, std::size_t> sums;
  for (const ImportRow& row : rows_) sums[{row.outcome, row.kind, row.reason}] += row.count;
  return sums;
}

namespace {

const std::vector<std::string>& csv_header() {
  static const std::vector<std::string> header{"file", "outcome", "kind", "id", "reason", "detail", "count", "x", "y", "made"};
  return header;
}

// Millimetres are finer than anybody looks.
csv::CsvCell metres(double number) { return std::round(number * 1000) / 1000 + 0.0; }

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> list;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) list.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return list;
}

std::optional<ImportRow> row_of(const csv::CsvRecord& record) {
  if (record.fields.size() != csv_header().size()) return std::nullopt;
  ImportRow row;
  const std::string& outcome = record.fields[1];
  if (outcome == "repaired") row.outcome = ImportOutcome::repaired;
  else if (outcome == "skipped") row.outcome = ImportOutcome::skipped;
  else if (outcome != "taken") return std::nullopt;
  row.kind = csv::text_of_harmless(record.fields[2]);
  row.id = csv::text_of_harmless(record.fields[3]);
  row.reason = csv::text_of_harmless(record.fields[4]);
  row.detail = csv::text_of_harmless(record.fields[5]);
  const std::string& count = record.fields[6];
  const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), row.count);
  if (problem != std::errc() || end != count.data() + count.size()) return std::nullopt;
  const auto x = parse_number(record.fields[7]), y = parse_number(record.fields[8]);
  if (x && y) row.place = {*x, *y};
  else if (!record.fields[7].empty() || !record.fields[8].empty()) return std::nullopt;
  row.made = words(csv::text_of_harmless(record.fields[9]));
  return row;
}

}  // namespace

std::string import_csv(const ImportReports& reports) {
  std::vector<std::vector<csv::CsvCell>> cells;
  for (const auto& [file, report] : reports)
    for (const ImportRow& row : report.rows()) {
      std::string made;
      for (const std::string& id : row.made) made += (made.empty() ? "" : " ") + id;
      cells.push_back({file, name_of(row.outcome), row.kind, row.id, row.reason, row.detail, row.count,
                       row.place ? metres((*row.place)[0]) : csv::CsvCell(), row.place ? metres((*row.place)[1]) : csv::CsvCell(),
                       made});
    }
  return write_csv(csv_header(), cells);
}

Result<ImportReports> read_import_csv(std::string_view text) {
  auto csv = csv::read_csv(text, ',');
  if (!csv) return csv.error();
  if (csv->records.empty() || csv->records.front().fields != csv_header())
    return Error{ErrorCode::parse, "line 1", "This is no import report: its header is not that of one."};
  if (!text.ends_with('\n'))
    return Error{ErrorCode::parse, "line " + std::to_string(csv->records.back().line),
                 "The report ends within this line: is it complete?"};
  ImportReports reports;
  for (std::size_t r = 1; r < csv->records.size(); ++r) {
    const csv::CsvRecord& record = csv->records[r];
    auto row = row_of(record);
    if (!row)
      return Error{ErrorCode::parse, "line " + std::to_string(record.line),
                   "This is no row of an import report: it was changed."};
    std::string file = csv::text_of_harmless(record.fields[0]);
    if (reports.empty() || reports.back().first != file) reports.emplace_back(std::move(file), ImportReport());
    reports.back().second.add(std::move(*row));
  }
  return reports;
}

}  // namespace bl::importing
