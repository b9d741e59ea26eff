// Where the time of the ticks goes, as rows for people: by kind, by node or by link, the slowest first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/graph/tick_times.h"

namespace bl::reading {

enum class TimeGrouping { kinds, nodes, links };
/// Of the last ticks, so that what is slow now stands first; or of all ticks that were measured.
enum class TimeSpan { recent, all };

/// Figures are those of one tick, as a mean.
struct TimeRow {
  const TypeDefinition* kind = nullptr;  ///< nullptr: links of kinds that this program does not know
  TickPart part = TickPart::links;       ///< in which it is evaluated: links, roles, or sets
  bool is_analysis = false;              ///< worked out beside the ticks
  std::uint32_t index = 0;               ///< of the node or link in the plan; of no meaning where `members` are many
  std::uint32_t members = 1;             ///< nodes in this role, or links of this kind, that took part
  double seconds = 0;                    ///< of all threads
  double share = 0;                      ///< of the tick as the clock sees it; all rows of a grouping together reach 1 at most
  double evaluations = 0, pairs = 0;
  double beside = 0;         ///< seconds of an analysis on a thread of its own
  double total_seconds = 0;  ///< of all ticks that were measured

  bool is_link() const { return part == TickPart::links; }
  double each() const { return evaluations > 0 ? seconds / evaluations : 0; }
};

/// Those who have been evaluated at all. By descending time; what takes the same time by kind, then in the order of the plan.
/// A node has a row for each of its roles.
std::vector<TimeRow> time_rows(const TimeTable& table, TimeGrouping grouping, TimeSpan span);

std::string label_of(const TimeTable& table, TimeGrouping grouping, const TimeRow& row);
/// What the row is about besides its label: of a node its role, of a link its kind, of a kind how many there are, and of what
/// sort.
std::string kind_text(TimeGrouping grouping, const TimeRow& row);

/// Seconds of a tick and of its parts, as means.
double tick_seconds(const TimeTable& table, TimeSpan span);
double part_seconds(const TimeTable& table, TickPart part, TimeSpan span);
/// "Links", and what is done in it.
const char* label_of(TickPart part);
const char* doc_of(TickPart part);

}  // namespace bl::reading
