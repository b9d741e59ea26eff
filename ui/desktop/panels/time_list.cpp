// Sorts rows of times; those that are equal in a column keep the slowest first.
#include "ui/desktop/panels/time_list.h"

#include <algorithm>
#include <tuple>

namespace bl::desktop {

namespace {

double figure_of(const reading::TimeRow& row, TimeColumn column) {
  switch (column) {
    case TimeColumn::share: return row.share;
    case TimeColumn::evaluations: return row.evaluations;
    case TimeColumn::pairs: return row.pairs;
    case TimeColumn::each: return row.each();
    case TimeColumn::beside: return row.beside;
    case TimeColumn::total: return row.total_seconds;
    case TimeColumn::name:
    case TimeColumn::kind:
    case TimeColumn::seconds: break;
  }
  return row.seconds;
}

}  // namespace

void TimeList::follow(const std::shared_ptr<const TimeTable>& table) {
  if (table_ == table) return;
  table_ = table;
  is_stale_ = true;
}

void TimeList::choose(reading::TimeGrouping grouping) {
  grouping_ = grouping;
  is_stale_ = true;
}

void TimeList::sort(TimeColumn column, bool is_descending) {
  column_ = column;
  is_descending_ = is_descending;
  is_stale_ = true;
}

const std::vector<reading::TimeRow>& TimeList::rows() {
  if (!is_stale_) return rows_;
  is_stale_ = false;
  rows_.clear();
  if (!table_) return rows_;
  rows_ = reading::time_rows(*table_, grouping_, reading::TimeSpan::recent);
  const auto sort_by = [&](const auto& key) {
    std::stable_sort(rows_.begin(), rows_.end(), [&](const reading::TimeRow& a, const reading::TimeRow& b) {
      return is_descending_ ? key(b) < key(a) : key(a) < key(b);
    });
  };
  if (column_ == TimeColumn::name)
    sort_by([&](const reading::TimeRow& row) { return reading::label_of(*table_, grouping_, row); });
  else if (column_ == TimeColumn::kind && grouping_ == reading::TimeGrouping::kinds)
    sort_by([](const reading::TimeRow& row) { return std::tuple(row.part, row.is_analysis, row.members); });
  else if (column_ == TimeColumn::kind) sort_by([&](const reading::TimeRow& row) { return reading::kind_text(grouping_, row); });
  else sort_by([&](const reading::TimeRow& row) { return figure_of(row, column_); });
  return rows_;
}

std::vector<std::string> TimeList::ids_of(const reading::TimeRow& row) const {
  const Plan& plan = *table_->plan;
  const bool is_one = grouping_ != reading::TimeGrouping::kinds;
  std::vector<std::string> ids;
  if (row.is_link()) {
    if (is_one) return {plan.links[row.index].id};
    for (const LinkPlan& link : plan.links)
      if (link.definition == row.kind) ids.push_back(link.id);
    return ids;
  }
  if (is_one) return {plan.nodes[row.index].id};
  for (const NodePlan& node : plan.nodes)
    if (std::any_of(node.types.begin(), node.types.end(), [&](const TypePlan& type) { return type.definition == row.kind; }))
      ids.push_back(node.id);
  return ids;
}

}  // namespace bl::desktop
