// What every bench needs: medians, clocks, contenders that take turns, peaks of memory, and a word on the machine.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/median.h"
#include "core/geometry/domain.h"
#include "core/geometry/power_cells.h"
#include "core/graph/state.h"

namespace bl::cli::bench {

/// Wall time of one call.
double median_seconds(int repeat, const std::function<void()>& work);

/// Seconds that this process has computed, all of its threads together: on a machine that others use as well it says more than
/// the wall clock as long as one thread works.
double processor_time();

/// Seconds by both clocks.
struct Clocks {
  double wall = 0, processor = 0;
  /// What a figure for so many threads is taken from: processor time of one, wall time of several.
  double of(int threads) const { return threads == 1 ? processor : wall; }
};
Clocks clocks_now();

struct Contender {
  std::function<void()> work;
  Clocks median, least;                ///< of one call
  std::function<void()> prepare = {};  ///< before each call, not measured; empty: nothing
};
/// All contenders in turn, `rounds` times, so that a load that comes and goes meets them all alike. A turn is as many calls as
/// take `turn_seconds`, at least one. `next` is asked before each turn; false stops it with what there is.
void take_turns(std::vector<Contender>& contenders, int rounds, double turn_seconds, const std::function<bool()>& next);

/// Bytes by which the process grew at most while the work was done; nothing where the system does not tell. What was freed before
/// is given back first.
std::optional<double> peak_bytes(const std::function<void()>& work);

/// Processor, cores, load, compiler: one line.
std::string machine_line();

/// The sites of a state as the geometry knows them, in ascending id.
std::vector<geometry::PowerSite> sites_of(const State& state);
/// The boundary of the state's one solver; nothing where there are several plots, or none.
std::optional<geometry::Domain> domain_of(const State& state);

}  // namespace bl::cli::bench
