// A change that is tried beside a session: the scene with it and the scene without it tick from the same state, until both
// settle.
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "core/graph/simulation.h"

namespace bl::host {

/// Nothing of it comes back into the session. The same state and scene give the same trial, whoever lets it go on and in whatever
/// steps. The scene without the change ticks as well, because the session itself may not have come to rest: what differs between
/// the two is due to the change alone.
class Trial {
 public:
  static constexpr std::int64_t kMostTicks = 3000;

  /// `from`: a state that nobody changes any more, under the scene of the session. `placed`: ports that the change sets to a
  /// place.
  Trial(const Registry& registry, std::shared_ptr<const State> from, const Scene& changed,
        const std::set<std::pair<std::string, std::string>>& placed);
  /// Goes on by so many ticks at most. Returns whether it is over.
  bool go_on(std::int64_t ticks);
  bool is_over() const { return is_over_; }
  bool is_settled() const { return ticks_ > 0 && without().is_settled() && with().is_settled(); }
  std::int64_t ticks() const { return ticks_; }
  const State& without() const { return *without_.state(); }
  const State& with() const { return *with_.state(); }

 private:
  Simulation without_, with_;
  std::int64_t ticks_ = 0;
  bool is_over_ = false;
};

}  // namespace bl::host
