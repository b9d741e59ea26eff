// Where the time of the ticks goes: by part of a tick, by link, and by role of a node. It is measured beside the result, for
// whoever asks; nothing that is evaluated can read it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/graph/analysis.h"
#include "core/graph/plan.h"

namespace bl {

/// The parts of a tick, in their order. `ports`: proposals are combined; `roles`: typifications without sets are evaluated.
enum class TickPart { commands, links, ports, roles, sets, publish };
inline constexpr std::size_t kTickParts = 6;

/// What one thing took. The recent sums are those of the last ticks: each tick counts 0.95 times as much as the one after it.
struct WorkTime {
  std::uint64_t evaluations = 0, pairs = 0;
  double seconds = 0;
  double recent_evaluations = 0, recent_pairs = 0, recent_seconds = 0;
  std::int64_t tick = 0;  ///< of those that were measured: the one that the recent sums count in full

  void add(std::int64_t now, double more_seconds, std::size_t more_evaluations, std::size_t more_pairs);
  /// The recent sums as the tick `now` sees them.
  void fade(std::int64_t now);
};

/// The times up to one tick; nobody changes it.
struct TimeTable {
  std::shared_ptr<const Plan> plan;
  WorkTime ticks;  ///< whole ticks; its evaluations are their number
  std::array<WorkTime, kTickParts> parts;
  std::vector<WorkTime> links;   ///< by link of the plan
  std::vector<WorkTime> roles;   ///< by type_index(); within the tick
  std::vector<WorkTime> beside;  ///< by analysis of the plan: on its own thread

  std::size_t type_index(std::size_t node, std::size_t type) const { return plan->dependents->sets->first_type[node] + type; }
};

/// Adds up the times of the ticks of one simulation. Whatever may be added by several threads has a slot of its own.
class TickTimes {
 public:
  /// `seconds`: a clock; only differences count.
  explicit TickTimes(double (*seconds)()) : now_(seconds) {}

  double now() const { return now_(); }
  // Of the tick. `began`: now() before the work.
  void begin_tick(const std::shared_ptr<const Plan>& plan);
  /// The part that has just ended; `roles` takes the share of the phase of nodes that split_nodes() has named, `ports` the rest.
  void end_part(TickPart part);
  void end_tick();
  void add_commands(double began);
  /// Seconds of all threads for nodes that are due, and those of them that went into typifications.
  void split_nodes(double all, double roles) { share_of_roles_ = all > 0 ? roles / all : 0; }
  void add_link(std::uint32_t link, double began, std::size_t pairs) { table_.links[link].add(tick_, now() - began, 1, pairs); }
  /// The seconds that were added.
  double add_role(std::uint32_t node, std::size_t type, double began, std::size_t evaluations) {
    const double seconds = now() - began;
    table_.roles[table_.type_index(node, type)].add(tick_, seconds, evaluations, 0);
    return seconds;
  }
  /// For the thread of an analysis, which may outlive this.
  std::shared_ptr<BesideTime> beside(std::size_t analysis) const { return clocks_[analysis]; }

  std::int64_t ticks() const { return tick_; }
  /// A copy as of the last tick.
  TimeTable table() const;

 private:
  void follow(const std::shared_ptr<const Plan>& plan);

  double (*now_)();
  TimeTable table_;
  std::int64_t tick_ = 0;
  double began_ = 0, last_ = 0, commands_ = 0, share_of_roles_ = 0;
  std::vector<std::shared_ptr<BesideTime>> clocks_;  // by analysis
};

/// Seconds now, where somebody measures.
inline double moment_of(const TickTimes* times) { return times == nullptr ? 0 : times->now(); }

}  // namespace bl
