// Two simulations side by side.
#include "core/host/trial.h"

namespace bl::host {

namespace {

// One tick; false where the work was stopped.
bool tick(Simulation& simulation) {
  if (!simulation.is_idle()) return simulation.step();
  simulation.pass(1);
  return true;
}

}  // namespace

Trial::Trial(const Registry& registry, std::shared_ptr<const State> from, const Scene& changed,
             const std::set<std::pair<std::string, std::string>>& placed)
    : without_(registry, 1), with_(registry, 1) {
  without_.put_back(from);
  with_.put_back(std::move(from));
  with_.set_scene(changed, placed);
}

// Where nothing would ever move again, more ticks do not help a rule that is broken.
bool Trial::go_on(std::int64_t ticks) {
  for (; ticks > 0 && !is_over_; --ticks) {
    if (!tick(without_) || !tick(with_)) break;
    ++ticks_;
    is_over_ = is_settled() || ticks_ >= kMostTicks || (without_.is_idle() && with_.is_idle());
  }
  return is_over_;
}

}  // namespace bl::host
