// The tick: links read S(t) and propose, proposals are resolved, nodes and solvers evaluate, S(t+1) is published.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/graph/packed_state.h"
#include "core/graph/phases.h"
#include "core/graph/state.h"

namespace bl {

/// Seconds spent in the phases of one tick; for benches, never read by the tick.
struct PhaseTimes {
  double links = 0, nodes = 0, solve = 0, commit = 0;
};

class Simulation {
 public:
  /// `now` gives seconds for PhaseTimes; without it they stay 0. It cannot influence the result.
  Simulation(const Registry& registry, int threads, double (*now)() = nullptr);

  /// The state that set_scene() would give; nothing is changed.
  std::shared_ptr<const State> with_scene(const Scene& scene,
                                          const std::set<std::pair<std::string, std::string>>& placed = {}) const;
  /// Compiles the scene and keeps the parts of the running state that still fit. `placed`: ports that people have just set to a
  /// place.
  void set_scene(const Scene& scene, const std::set<std::pair<std::string, std::string>>& placed = {});
  /// Continues from a saved state of the current scene.
  Result<void> restore_state(const SavedState& saved);
  /// Continues from a state that was put away, with its plan.
  Result<void> unpack(const PackedState& packed);
  /// Continues from an earlier state of this scene, as far as it still fits the scene.
  void return_to(std::shared_ptr<const State> earlier);
  /// Restores `earlier` with its plan, as it was before set_scene(), if no tick has run since.
  void put_back(std::shared_ptr<const State> earlier) { take(std::move(earlier)); }
  /// A state for display before its next tick. It contains the results that nodes compute from their own settings and that no
  /// tick has computed yet, such as the shape of a boundary in a scene that was just opened, or edited while the clock stands.
  /// Where there are none, it is the state itself. No tick continues from it.
  std::shared_ptr<const State> shown(std::shared_ptr<const State> state);
  /// Evaluates everything in each tick, whether it has changed or not, with nothing kept from tick to tick. The result is the
  /// same; tests compare the two.
  void evaluate_everything(bool is_on) { evaluates_everything_ = is_on; }
  /// Adds the times of the ticks to `times`, which must live until another one is named, or none. It cannot influence the result.
  void measure(TickTimes* times) { measured_ = times; }
  /// One tick. False where the work was stopped on the way (core/base/stop): then the state is that from before step().
  bool step();

  /// Would the next ticks only count on? So it is after a tick at rest that has changed nothing and left nothing to do.
  bool is_idle() const { return is_idle_; }
  /// So many idle ticks at once: the state is the one that step() would give, tick by tick.
  void pass(std::int64_t ticks);

  /// The last published state; it stays valid and unchanged as long as a pointer to it exists.
  std::shared_ptr<const State> state() const { return state_; }
  const PhaseTimes& times() const { return times_; }
  /// Of all ticks so far.
  const TickCounts& counts() const { return counts_; }
  ThreadPool& pool() { return pool_; }

 private:
  // A state that no step() has made: whether it is idle, the next tick finds out.
  void take(std::shared_ptr<const State> state) {
    state_ = std::move(state);
    is_idle_ = false;
  }

  const Registry* registry_;
  ThreadPool pool_;
  double (*now_)();
  std::shared_ptr<const State> state_;
  PhaseTimes times_;
  TickTimes* measured_ = nullptr;
  TickCounts counts_;
  bool evaluates_everything_ = false, is_idle_ = false;
  SetMemos memos_;
  LinkMemos link_memos_;
  AnalysisRunner runner_;
};

}  // namespace bl
