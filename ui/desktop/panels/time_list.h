// The rows of the tab Time: where the time of the ticks goes, grouped and sorted as people want it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/reading/time_rows.h"

namespace bl::desktop {

enum class TimeColumn { name, kind, seconds, share, evaluations, pairs, each, beside, total };

class TimeList {
 public:
  /// Reads the times again where they are others.
  void follow(const std::shared_ptr<const TimeTable>& table);
  /// None before the first tick that was measured.
  const TimeTable* table() const { return table_.get(); }
  const std::vector<reading::TimeRow>& rows();

  void choose(reading::TimeGrouping grouping);
  void sort(TimeColumn column, bool is_descending);
  reading::TimeGrouping grouping() const { return grouping_; }
  /// Are there analyses, which take time beside the ticks?
  bool has_beside() const { return table_ && !table_->beside.empty(); }
  /// The nodes or links that a row stands for.
  std::vector<std::string> ids_of(const reading::TimeRow& row) const;

 private:
  std::shared_ptr<const TimeTable> table_;
  std::vector<reading::TimeRow> rows_;
  reading::TimeGrouping grouping_ = reading::TimeGrouping::kinds;
  TimeColumn column_ = TimeColumn::seconds;
  bool is_descending_ = true, is_stale_ = true;
};

}  // namespace bl::desktop
