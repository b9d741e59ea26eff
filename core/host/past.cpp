// A state between two packed ones comes about as it did: from the one before, with the scenes that were set meanwhile.
#include "core/host/past.h"

#include <algorithm>

namespace bl::host {

namespace {

// Of a whole state, for each node that it does not share with another one kept.
constexpr std::size_t kBytesOfNode = 7000;

std::size_t unshared_nodes(const State& state, const State* before) {
  if (before == nullptr || before->nodes.size() != state.nodes.size()) return state.nodes.size();
  std::size_t count = 0;
  each_difference(before->nodes, state.nodes, [&](std::uint32_t) { ++count; });
  return count;
}

std::size_t most_whole(const State& state) {
  return std::clamp(Past::kMostWholeNodes / std::max<std::size_t>(1, state.nodes.size()), Past::kLeastWhole, Past::kWholeStates);
}

}  // namespace

void Past::set_scene(std::int64_t tick, const Scene& scene, Placed placed) {
  changes_.push_back({tick, scene, std::move(placed)});
  // No tick reads it, and it is the only part that scenes do not share.
  changes_.back().scene.view.clear();
}

void Past::add(std::shared_ptr<const State> state) {
  const std::int64_t tick = state->tick;
  const bool is_made = !begins_anew_ && !is_set_over(tick);
  if (!begins_anew_ && stretches_.back().last == tick) {
    // The tick has failed and begins again.
    whole_.back().state = std::move(state);
    whole_.back().is_made = whole_.back().is_made && is_made;
    return;
  }
  const bool goes_on = !begins_anew_ && stretches_.back().last + 1 == tick;
  const std::int64_t since = tick - last_key_;
  const bool is_key = !goes_on || since >= 2 * kPackedEvery || (since >= kPackedEvery && is_made);
  const std::size_t most = most_whole(*state);
  whole_.push_back({std::move(state), is_key, is_made});
  begins_anew_ = false;
  if (is_key) last_key_ = tick;
  if (goes_on) stretches_.back().last = tick;
  else stretches_.push_back({tick, tick});
  while (whole_.size() > most) {
    if (whole_.front().is_key) keep(whole_.front());
    whole_.pop_front();
  }
}

void Past::keep(const Whole& one) {
  const State& state = *one.state;
  Key key{.tick = state.tick, .bytes = 0, .packed = {}, .whole = nullptr};
  if (one.is_made) {
    const bool follows = last_kept_ && !keys_.empty() && keys_.back().packed;
    key.packed.emplace(state, follows ? last_kept_.get() : nullptr, follows ? &*keys_.back().packed : nullptr);
    key.bytes = key.packed->bytes();
  } else {
    key.whole = one.state;
    key.bytes = kBytesOfNode * unshared_nodes(state, last_kept_.get());
  }
  keys_.push_back(std::move(key));
  last_kept_ = one.state;
  bytes_ += keys_.back().bytes;
  while (keys_.size() > kMostPacked || (keys_.size() > 1 && bytes_ > kMostBytes)) give_up_oldest();
}

void Past::give_up_oldest() {
  // What the next one shares with it stays, and is little.
  bytes_ -= keys_.front().bytes;
  keys_.pop_front();
  const std::int64_t first = keys_.front().tick;
  while (stretches_.front().last < first) stretches_.pop_front();
  stretches_.front().first = std::max(stretches_.front().first, first);
  while (!changes_.empty() && changes_.front().tick <= first) changes_.pop_front();
}

std::int64_t Past::reachable(std::int64_t tick) const {
  for (auto stretch = stretches_.rbegin(); stretch != stretches_.rend(); ++stretch)
    if (stretch->first <= tick) return std::min(tick, stretch->last);
  return oldest();
}

std::shared_ptr<const State> Past::whole(std::int64_t tick) const {
  const auto found = std::find_if(whole_.rbegin(), whole_.rend(), [&](const Whole& one) { return one.state->tick == tick; });
  return found == whole_.rend() ? nullptr : found->state;
}

Result<void> Past::recompute(std::int64_t tick, Simulation& simulation) const {
  if (auto state = whole(tick)) {
    simulation.put_back(std::move(state));
    return {};
  }
  // The last one before it: a packed state knows no tensions and no remarks, which the ticks after it say again.
  auto from =
      std::lower_bound(keys_.begin(), keys_.end(), tick, [](const Key& key, std::int64_t wanted) { return key.tick < wanted; });
  const auto stretch =
      std::find_if(stretches_.begin(), stretches_.end(), [&](const Stretch& s) { return s.first <= tick && tick <= s.last; });
  if (stretch == stretches_.end()) return Error{ErrorCode::not_found, "rewind", "tick " + std::to_string(tick) + " is not kept"};
  if (stretch->first < tick) --from;
  if (from->whole) simulation.put_back(from->whole);
  else if (auto done = simulation.unpack(*from->packed); !done) return done;
  auto change = std::upper_bound(changes_.begin(), changes_.end(), from->tick,
                                 [](std::int64_t key, const SceneChange& one) { return key < one.tick; });
  while (true) {
    for (; change != changes_.end() && change->tick == simulation.state()->tick; ++change)
      simulation.set_scene(change->scene, change->placed);
    if (simulation.state()->tick >= tick) return {};
    if (!simulation.step()) return Error{ErrorCode::cancelled, "rewind", "the work was stopped on the way"};
  }
}

void Past::forget_from(std::int64_t tick) {
  while (!whole_.empty() && whole_.back().state->tick >= tick) whole_.pop_back();
  while (!keys_.empty() && keys_.back().tick >= tick) {
    bytes_ -= keys_.back().bytes;
    keys_.pop_back();
    last_kept_ = nullptr;
  }
  while (!changes_.empty() && changes_.back().tick >= tick) changes_.pop_back();
  while (!stretches_.empty() && stretches_.back().first >= tick) stretches_.pop_back();
  if (!stretches_.empty()) stretches_.back().last = std::min(stretches_.back().last, tick - 1);
  begins_anew_ = true;
}

}  // namespace bl::host
