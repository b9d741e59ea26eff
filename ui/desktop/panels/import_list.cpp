// Filters and sorts pointers; twenty thousand rows take some milliseconds, and only after a change.
#include "ui/desktop/panels/import_list.h"

#include <algorithm>
#include <iterator>

#include "core/base/text.h"
#include "core/import/assumed_height.h"

namespace bl::desktop {

namespace {

// Skipped ones are what people look for, then those that were mended.
int rank_of(importing::ImportOutcome outcome) { return 2 - static_cast<int>(outcome); }

bool holds(const std::string& text, const std::string& lower) { return lower_case(text).find(lower) != std::string::npos; }

// Ids with numbers in them as people count: features/9 before features/10.
bool comes_before(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (is_digit(a[i]) && is_digit(b[k])) {
      std::size_t end_a = i, end_b = k;
      while (end_a < a.size() && is_digit(a[end_a])) ++end_a;
      while (end_b < b.size() && is_digit(b[end_b])) ++end_b;
      if (end_a - i != end_b - k) return end_a - i < end_b - k;
      if (const int order = a.compare(i, end_a - i, b, k, end_b - k); order != 0) return order < 0;
      i = end_a, k = end_b;
      continue;
    }
    if (a[i] != b[k]) return a[i] < b[k];
    ++i, ++k;
  }
  return a.size() - i < b.size() - k;
}

bool is_before(const ImportEntry& a, const ImportEntry& b, ImportColumn column) {
  switch (column) {
    case ImportColumn::outcome: return rank_of(a.row->outcome) < rank_of(b.row->outcome);
    case ImportColumn::kind: return a.row->kind < b.row->kind;
    case ImportColumn::id: return comes_before(a.row->id, b.row->id);
    case ImportColumn::reason: return why_of(*a.row) < why_of(*b.row);
    case ImportColumn::detail: return special_of(*a.row) < special_of(*b.row);
    case ImportColumn::place: return a.row->place < b.row->place;
    case ImportColumn::file: return *a.file < *b.file;
  }
  return false;
}

// "2 repeated points dropped" and "3 repeated points dropped" are one group: digits go, and what is in brackets with them.
std::string without_numbers(const std::string& text) {
  std::string out;
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (depth == 0 && !(c >= '0' && c <= '9') && !(c == ' ' && (out.empty() || out.back() == ' '))) out += c;
    if (c == ')' && depth > 0) --depth;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

// The same for all rows of a group.
std::string group_text(const importing::ImportRow& row) {
  if (row.outcome == importing::ImportOutcome::repaired && !row.detail.empty()) {
    // The height itself differs from row to row.
    std::string text = row.detail;
    for (const std::string_view assumed : {importing::kHeightOfNeighbours, importing::kHeightAssumed})
      if (const std::size_t at = text.find(assumed); at != std::string::npos) text.resize(at + assumed.size());
    return without_numbers(text);
  }
  for (const std::string_view assumed : {importing::kHeightOfNeighbours, importing::kHeightAssumed})
    if (row.detail.find(assumed) != std::string::npos) return row.reason + ", " + std::string(assumed);
  return row.reason;
}

}  // namespace

std::string why_of(const importing::ImportRow& row) {
  return row.outcome == importing::ImportOutcome::repaired && !row.detail.empty() ? row.detail : row.reason;
}

std::string special_of(const importing::ImportRow& row) {
  return row.outcome == importing::ImportOutcome::repaired && !row.detail.empty() ? "taken as " + row.reason : row.detail;
}

void ImportList::follow(const importing::ImportReports& reports, std::uint64_t document, std::uint64_t revision) {
  if (document_ == document && revision_ == revision) return;
  document_ = document;
  revision_ = revision;
  all_.clear();
  groups_.clear();
  std::fill(std::begin(counts_), std::end(counts_), 0);
  files_ = reports.size();
  has_places_ = false;
  std::map<std::tuple<importing::ImportOutcome, std::string, std::string>, std::size_t> sums;
  for (const auto& [file, report] : reports) {
    for (const importing::ImportRow& row : report.rows()) {
      all_.push_back({&file, &row});
      counts_[static_cast<std::size_t>(row.outcome)] += row.count;
      has_places_ |= row.place.has_value();
      sums[{row.outcome, row.kind, group_text(row)}] += row.count;
    }
  }
  for (const auto& [key, count] : sums) groups_.push_back({std::get<0>(key), std::get<1>(key), std::get<2>(key), count});
  std::stable_sort(groups_.begin(), groups_.end(), [](const ImportGroup& a, const ImportGroup& b) {
    return a.outcome != b.outcome ? rank_of(a.outcome) < rank_of(b.outcome) : a.count > b.count;
  });
  group_ = groups_.size();
  outcome_ = -1;
  is_stale_ = true;
}

bool ImportList::passes(const ImportEntry& entry) const {
  const importing::ImportRow& row = *entry.row;
  if (outcome_ >= 0 && static_cast<int>(row.outcome) != outcome_) return false;
  if (group_ < groups_.size()) {
    const ImportGroup& group = groups_[group_];
    if (row.outcome != group.outcome || row.kind != group.kind || group_text(row) != group.reason) return false;
  }
  return search_.empty() || holds(row.id, search_) || holds(row.detail, search_) || holds(row.reason, search_) ||
         holds(row.kind, search_) || holds(*entry.file, search_);
}

const std::vector<ImportEntry>& ImportList::shown() {
  if (!is_stale_) return shown_;
  is_stale_ = false;
  shown_.clear();
  std::copy_if(all_.begin(), all_.end(), std::back_inserter(shown_), [this](const ImportEntry& e) { return passes(e); });
  if (is_sorted_)
    std::stable_sort(shown_.begin(), shown_.end(), [this](const ImportEntry& a, const ImportEntry& b) {
      return is_descending_ ? is_before(b, a, column_) : is_before(a, b, column_);
    });
  return shown_;
}

void ImportList::choose_outcome(int outcome) {
  outcome_ = outcome_ == outcome ? -1 : outcome;
  group_ = groups_.size();
  is_stale_ = true;
}

void ImportList::choose_group(std::size_t group) {
  group_ = group_ == group ? groups_.size() : group;
  outcome_ = -1;
  is_stale_ = true;
}

void ImportList::search(const std::string& text) {
  const std::string lower = lower_case(text);
  if (lower == search_) return;
  search_ = lower;
  is_stale_ = true;
}

void ImportList::sort(ImportColumn column, bool is_descending) {
  column_ = column;
  is_descending_ = is_descending;
  is_sorted_ = is_stale_ = true;
}

}  // namespace bl::desktop
