// The rows of import reports as people look at them: by outcome and reason, filtered by text, sorted by a column.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/import/import_report.h"

namespace bl::desktop {

enum class ImportColumn { outcome, kind, id, reason, detail, place, file };
inline constexpr int kImportColumns = 7;

/// One row, as it stands in the reports.
struct ImportEntry {
  const std::string* file = nullptr;
  const importing::ImportRow* row = nullptr;
};

/// Why an element stands where it does: what was mended of a repaired one, the reason of others.
std::string why_of(const importing::ImportRow& row);
/// What else there is to say: as what a repaired one was taken, the details of others.
std::string special_of(const importing::ImportRow& row);

/// Rows of which the same is to be said: without the numbers in it, and with a word on heights that were assumed.
struct ImportGroup {
  importing::ImportOutcome outcome = importing::ImportOutcome::taken;
  std::string kind, reason;
  std::size_t count = 0;  ///< elements, which may be more than rows
};

class ImportList {
 public:
  /// Reads the reports again where they are others; pointers into them are kept until the next change.
  void follow(const importing::ImportReports& reports, std::uint64_t document, std::uint64_t revision);
  const std::vector<ImportGroup>& groups() const { return groups_; }  ///< skipped first, the largest of each outcome first
  std::size_t count(importing::ImportOutcome outcome) const { return counts_[static_cast<std::size_t>(outcome)]; }
  std::size_t total() const { return counts_[0] + counts_[1] + counts_[2]; }
  /// The rows that pass what is chosen below, in the order that is wanted. Worked out anew after changes only.
  const std::vector<ImportEntry>& shown();

  void choose_outcome(int outcome);      ///< of ImportOutcome; -1: all. The same again: all
  void choose_group(std::size_t group);  ///< the same again: all
  void search(const std::string& text);
  void sort(ImportColumn column, bool is_descending);
  int outcome() const { return outcome_; }
  std::size_t group() const { return group_; }  ///< groups().size(): none
  bool has_places() const { return has_places_; }
  std::size_t files() const { return files_; }

 private:
  bool passes(const ImportEntry& entry) const;

  std::vector<ImportEntry> all_, shown_;
  std::vector<ImportGroup> groups_;
  std::size_t counts_[3] = {}, files_ = 0, group_ = 0;
  std::uint64_t document_ = 0, revision_ = 0;
  int outcome_ = -1;
  std::string search_;
  ImportColumn column_ = ImportColumn::outcome;
  bool is_descending_ = false, is_sorted_ = false, is_stale_ = true, has_places_ = false;
};

}  // namespace bl::desktop
