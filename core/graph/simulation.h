// The tick: links read S(t) and propose, proposals are resolved, nodes and solvers evaluate, S(t+1) is published.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/graph/phases.h"
#include "core/graph/state.h"

namespace bl {

/// Seconds spent in the phases of one tick; for benches, never read by the tick.
struct PhaseTimes {
  double links = 0, resolve = 0, nodes = 0, solve = 0, commit = 0;
};

class Simulation {
 public:
  /// `now` gives seconds for PhaseTimes; without it they stay 0. It cannot influence the result.
  Simulation(const Registry& registry, int threads, double (*now)() = nullptr);

  /// What set_scene() would make of the state; nothing is changed.
  std::shared_ptr<const State> with_scene(const Scene& scene,
                                          const std::set<std::pair<std::string, std::string>>& placed = {}) const;
  /// Compiles the scene and keeps what of the running state still fits. `placed`: ports that people have just put somewhere.
  void set_scene(const Scene& scene, const std::set<std::pair<std::string, std::string>>& placed = {});
  /// Continues from a saved state of the current scene.
  Result<void> restore_state(const SavedState& saved);
  /// Goes on from an earlier state of this scene, as far as that still fits the scene.
  void return_to(std::shared_ptr<const State> earlier);
  /// Takes back what set_scene() has made of `earlier`, its plan among it, where the tick for which it was made has not been.
  void put_back(std::shared_ptr<const State> earlier) { state_ = std::move(earlier); }
  /// What is to be seen of a state before its next tick: with what nodes make of their own settings where no tick has asked them
  /// yet, such as the shape of a boundary in a scene that was just opened, or edited while the clock stands. The state itself
  /// where there is nothing of that kind. No tick goes on from it.
  std::shared_ptr<const State> shown(std::shared_ptr<const State> state);
  /// One tick. False where the work was stopped on the way (core/base/stop): then the state is that from before step().
  bool step();

  /// The last published state; stays valid and unchanged for as long as somebody holds it.
  std::shared_ptr<const State> state() const { return state_; }
  const PhaseTimes& times() const { return times_; }
  ThreadPool& pool() { return pool_; }

 private:
  const Registry* registry_;
  ThreadPool pool_;
  double (*now_)();
  std::shared_ptr<const State> state_;
  PhaseTimes times_;
  SetMemos memos_;
  AnalysisRunner runner_;
};

}  // namespace bl
