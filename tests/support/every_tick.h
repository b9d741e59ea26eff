// Runs a scene twice, once evaluated on change and once with everything evaluated, and compares every tick.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {

/// Everything that a state says to people, beside what its hash holds.
void expect_same(const State& changed, const State& everything);

using States = std::vector<std::shared_ptr<const State>>;

/// The state after each tick; `act` is what people do before it, the same for everybody who has come to the same scene.
template <class Act>
States states_of(const std::string& text, int ticks, int threads, bool evaluates_everything, const Act& act) {
  World world = World::from_text(text, threads);
  world.session().evaluate_everything(evaluates_everything);
  States states;
  for (int tick = 0; tick < ticks; ++tick) {
    act(world, tick);
    world.tick();
    states.push_back(world.session().state());
  }
  return states;
}

/// One world after the other: the thread sanitizer cannot see into the library that follows rays, which both would call at a
/// time.
template <class Act>
void expect_the_same_states(const std::string& text, int ticks, int threads, const Act& act) {
  const States changed = states_of(text, ticks, threads, false, act), everything = states_of(text, ticks, 1, true, act);
  for (std::size_t t = 0; t < changed.size() && !testing::Test::HasFatalFailure(); ++t) {
    SCOPED_TRACE("tick " + std::to_string(changed[t]->tick));
    expect_same(*changed[t], *everything[t]);
  }
}

}  // namespace bl
