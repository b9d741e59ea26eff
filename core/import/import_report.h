// The result for every element of an imported file: taken, repaired or skipped, each with its id and the reason.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace bl::importing {

enum class ImportOutcome { taken, repaired, skipped };
std::string_view name_of(ImportOutcome outcome);

/// One element, or many equal ones in one row (`count`), such as the untagged nodes of OpenStreetMap.
struct ImportRow {
  ImportOutcome outcome = ImportOutcome::taken;
  std::string kind;    ///< what it is in the file: "way", "Building", "feature"
  std::string id;      ///< in the file
  std::string reason;  ///< one of few texts, so that they can be counted: "building", "street", "its line is open"
  std::string detail;  ///< a detail about this element; may be empty
  std::size_t count = 1;
  std::optional<std::array<double, 2>> place;  ///< x and y of its middle [m, local]; nothing: it has none, or nobody knows it
  std::vector<std::string> made;               ///< ids of what was made of it, where somebody has made something
};

/// Many small elements without rows of their own, such as the nodes of OpenStreetMap that are corners of ways: one counts as
/// taken where a row that uses it is one that was taken.
struct ImportCorners {
  std::string kind;            ///< what they are in the file: "node"
  std::string taken, skipped;  ///< the reasons of both rows
  std::size_t number = 0;      ///< how many there are
  /// Each row that uses some, with the numbers of these, counted from 0.
  std::vector<std::pair<std::size_t, std::vector<std::uint32_t>>> users;
};

/// Every element of the file has exactly one row; repaired ones were taken, after something was mended.
class ImportReport {
 public:
  void take(std::string kind, std::string id, std::string reason, std::string detail = "", std::size_t count = 1);
  void repair(std::string kind, std::string id, std::string reason, std::string detail = "");
  void skip(std::string kind, std::string id, std::string reason, std::string detail = "", std::size_t count = 1);
  /// Elements that were read and then not used, by row, with the reason: rows of which nothing was made become skipped ones.
  /// What depends on them (`follow`, `set_corners`) is counted anew.
  void drop(const std::map<std::size_t, std::string>& unused);
  /// Marks an element that was taken only for another one: if that one is skipped, it is skipped as well.
  void follow(std::size_t row, std::size_t leader) { leaders_.emplace_back(row, leader); }
  /// Adds the rows of such elements. Nothing is added to the report after them.
  void set_corners(ImportCorners corners);
  void add(ImportRow row) { rows_.push_back(std::move(row)); }
  /// Sets the place of the element of the newest row.
  void locate(const std::optional<std::array<double, 2>>& place) { rows_.back().place = place; }
  void locate(std::size_t row, const std::optional<std::array<double, 2>>& place) { rows_[row].place = place; }
  /// Records the repairs of an element that was taken.
  void mend(std::size_t row, const std::string& detail);
  /// Adds a detail to the element of a row.
  void remark(std::size_t row, const std::string& detail);
  /// Records the nodes that were made of the element of a row.
  void made(std::size_t row, const std::string& id) { rows_[row].made.push_back(id); }

  const std::vector<ImportRow>& rows() const { return rows_; }
  /// Elements of a kind with that outcome; an empty kind means all.
  std::size_t count(ImportOutcome outcome, std::string_view kind = "") const;
  std::size_t total(std::string_view kind = "") const;
  /// Numbers by outcome, kind and reason, in that order.
  std::map<std::tuple<ImportOutcome, std::string, std::string>, std::size_t> counts() const;

 private:
  void count_corners();

  std::vector<ImportRow> rows_;
  std::vector<std::pair<std::size_t, std::size_t>> leaders_;  // rows, each with the one that it follows
  ImportCorners corners_;
  std::size_t corner_rows_ = 0;  // so many of the last rows speak of corners
};

/// Each file with the report about it.
using ImportReports = std::vector<std::pair<std::string, ImportReport>>;

/// The rows of several files as CSV: file, outcome, kind, id, reason, detail, count, x, y, made. Places are in local metres;
/// several ids in `made` have a blank between them.
std::string import_csv(const ImportReports& reports);
/// Reads such a CSV.
Result<ImportReports> read_import_csv(std::string_view text);

}  // namespace bl::importing
