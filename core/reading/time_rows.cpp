// Sums times by what people ask for, and puts them in order.
#include "core/reading/time_rows.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "core/reading/figures.h"

namespace bl::reading {

namespace {

// Means of one tick.
struct Means {
  Means(const TimeTable& table, TimeSpan span)
      : is_recent(span == TimeSpan::recent),
        ticks(is_recent ? table.ticks.recent_evaluations : static_cast<double>(table.ticks.evaluations)) {}
  double of(double whole, double recent) const { return ticks > 0 ? (is_recent ? recent : whole) / ticks : 0; }
  double seconds(const WorkTime& time) const { return of(time.seconds, time.recent_seconds); }

  bool is_recent;
  double ticks;
};

// Several threads take more seconds than the clock; in the tick they count as much as the part that they fill.
double factor_of(const Means& means, double in_threads, const WorkTime& part) {
  const double by_clock = means.seconds(part);
  return in_threads > by_clock && in_threads > 0 ? by_clock / in_threads : 1;
}

class RowMaker {
 public:
  RowMaker(const TimeTable& table, TimeGrouping grouping, TimeSpan span)
      : table_(table), grouping_(grouping), means_(table, span), tick_(means_.seconds(table.ticks)) {}

  std::vector<TimeRow> made() {
    if (grouping_ != TimeGrouping::nodes) add_links();
    if (grouping_ != TimeGrouping::links) add_roles();
    for (auto& [kind, row] : by_kind_) rows_.push_back(row);
    std::stable_sort(rows_.begin(), rows_.end(), [](const TimeRow& a, const TimeRow& b) {
      return std::pair(a.seconds, a.beside) > std::pair(b.seconds, b.beside);
    });
    return std::move(rows_);
  }

 private:
  void add(TimeRow one, const WorkTime& time, double factor, const WorkTime* beside) {
    if (time.evaluations == 0) return;
    one.seconds = means_.seconds(time);
    one.share = tick_ > 0 ? one.seconds * factor / tick_ : 0;
    one.evaluations = means_.of(static_cast<double>(time.evaluations), time.recent_evaluations);
    one.pairs = means_.of(static_cast<double>(time.pairs), time.recent_pairs);
    one.beside = beside == nullptr ? 0 : means_.seconds(*beside);
    one.total_seconds = time.seconds;
    if (grouping_ != TimeGrouping::kinds) return rows_.push_back(one);
    const auto [row, is_new] = by_kind_.try_emplace({one.is_link(), one.kind == nullptr ? std::string() : one.kind->id}, one);
    if (is_new) return;
    TimeRow& sum = row->second;
    ++sum.members;
    sum.seconds += one.seconds;
    sum.share += one.share;
    sum.evaluations += one.evaluations;
    sum.pairs += one.pairs;
    sum.beside += one.beside;
    sum.total_seconds += one.total_seconds;
  }

  void add_links() {
    double all = 0;
    for (const WorkTime& time : table_.links) all += means_.seconds(time);
    const double factor = factor_of(means_, all, table_.parts[static_cast<std::size_t>(TickPart::links)]);
    for (std::uint32_t l = 0; l < table_.links.size(); ++l)
      add({.kind = table_.plan->links[l].definition, .index = l}, table_.links[l], factor, nullptr);
  }

  void add_roles() {
    const Plan& plan = *table_.plan;
    double all = 0;
    for (const auto& [node, type, time] : roles())
      if (plan.nodes[node].types[type].definition->sets.empty()) all += means_.seconds(*time);
    const double factor = factor_of(means_, all, table_.parts[static_cast<std::size_t>(TickPart::roles)]);
    std::map<std::pair<std::uint32_t, std::uint32_t>, const WorkTime*> beside;
    for (std::size_t a = 0; a < plan.analyses.size(); ++a)
      beside[{plan.analyses[a].node, plan.analyses[a].type}] = &table_.beside[a];
    for (const auto& [node, type, time] : roles()) {
      const TypificationDefinition& definition = *plan.nodes[node].types[type].definition;
      const auto own = beside.find({node, type});
      TimeRow row{.kind = &definition, .index = node};
      row.part = definition.sets.empty() ? TickPart::roles : TickPart::sets;
      row.is_analysis = own != beside.end();
      add(row, *time, definition.sets.empty() ? factor : 1, row.is_analysis ? own->second : nullptr);
    }
  }

  // Those that have been evaluated: node, type, time.
  std::vector<std::tuple<std::uint32_t, std::uint32_t, const WorkTime*>> roles() const {
    std::vector<std::tuple<std::uint32_t, std::uint32_t, const WorkTime*>> roles;
    const std::vector<std::uint32_t>& first = table_.plan->dependents->sets->first_type;
    for (std::uint32_t n = 0; n < first.size(); ++n) {
      const std::size_t end = n + 1 < first.size() ? first[n + 1] : table_.roles.size();
      for (std::size_t k = first[n]; k < end; ++k)
        if (table_.roles[k].evaluations > 0) roles.emplace_back(n, static_cast<std::uint32_t>(k - first[n]), &table_.roles[k]);
    }
    return roles;
  }

  const TimeTable& table_;
  TimeGrouping grouping_;
  Means means_;
  double tick_;
  std::vector<TimeRow> rows_;
  std::map<std::pair<bool, std::string>, TimeRow> by_kind_;
};

std::string kind_label(const TimeRow& row) { return row.kind == nullptr ? "Unknown kind" : row.kind->label; }

}  // namespace

std::vector<TimeRow> time_rows(const TimeTable& table, TimeGrouping grouping, TimeSpan span) {
  return RowMaker(table, grouping, span).made();
}

std::string label_of(const TimeTable& table, TimeGrouping grouping, const TimeRow& row) {
  if (grouping == TimeGrouping::kinds) return kind_label(row);
  if (row.is_link()) return table.plan->links[row.index].id;
  const NodePlan& node = table.plan->nodes[row.index];
  return node.name.empty() ? node.id : node.name;
}

std::string kind_text(TimeGrouping grouping, const TimeRow& row) {
  if (grouping != TimeGrouping::kinds) return kind_label(row);
  const std::string count = grouped(row.members) + "\xC2\xA0";
  const bool is_one = row.members == 1;
  if (row.is_analysis) return count + (is_one ? "analysis" : "analyses");
  if (row.part == TickPart::sets) return count + (is_one ? "role over a set" : "roles over sets");
  return counted(row.members, row.is_link() ? "link" : "role");
}

double tick_seconds(const TimeTable& table, TimeSpan span) { return Means(table, span).seconds(table.ticks); }

double part_seconds(const TimeTable& table, TickPart part, TimeSpan span) {
  return Means(table, span).seconds(table.parts[static_cast<std::size_t>(part)]);
}

const char* label_of(TickPart part) {
  constexpr std::array<const char*, kTickParts> kLabels = {"Commands", "Links", "Ports", "Roles", "Sets", "Publishing"};
  return kLabels[static_cast<std::size_t>(part)];
}

const char* doc_of(TickPart part) {
  constexpr std::array<const char*, kTickParts> kDocs = {
      "What people have changed is compiled.",
      "Links read the state and make their proposals.",
      "The proposals to each port are combined, with limits and locks.",
      "Roles of single nodes are evaluated, where an input has changed.",
      "Roles over sets of nodes are evaluated, such as solvers and sums, and their replies are written.",
      "The new state is checked, hashed and handed on.",
  };
  return kDocs[static_cast<std::size_t>(part)];
}

}  // namespace bl::reading
