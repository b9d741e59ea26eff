// Counts and the CSV form of import reports.
#include "core/exchange/import_report.h"

#include <utility>

#include "core/exchange/csv_table.h"

namespace bl {

std::string_view name_of(ImportOutcome outcome) {
  switch (outcome) {
    case ImportOutcome::taken: return "taken";
    case ImportOutcome::repaired: return "repaired";
    case ImportOutcome::skipped: return "skipped";
  }
  return "";
}

void ImportReport::take(std::string kind, std::string id, std::string reason, std::string detail, std::size_t count) {
  rows_.push_back({ImportOutcome::taken, std::move(kind), std::move(id), std::move(reason), std::move(detail), count});
}
void ImportReport::repair(std::string kind, std::string id, std::string reason, std::string detail) {
  rows_.push_back({ImportOutcome::repaired, std::move(kind), std::move(id), std::move(reason), std::move(detail), 1});
}
void ImportReport::skip(std::string kind, std::string id, std::string reason, std::string detail, std::size_t count) {
  rows_.push_back({ImportOutcome::skipped, std::move(kind), std::move(id), std::move(reason), std::move(detail), count});
}

void ImportReport::drop(const std::map<std::string, std::string>& unused) {
  for (ImportRow& row : rows_) {
    const auto found = unused.find(row.id);
    if (row.id.empty() || found == unused.end() || row.outcome == ImportOutcome::skipped) continue;
    row.outcome = ImportOutcome::skipped;
    row.reason += ": " + found->second;
  }
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

std::string import_csv(const std::vector<std::pair<std::string, ImportReport>>& reports) {
  const std::vector<std::string> header{"file", "outcome", "kind", "id", "reason", "detail", "count"};
  std::vector<std::vector<CsvCell>> cells;
  for (const auto& [file, report] : reports)
    for (const ImportRow& row : report.rows())
      cells.push_back({file, name_of(row.outcome), row.kind, row.id, row.reason, row.detail, row.count});
  return write_csv(header, cells);
}

}  // namespace bl
