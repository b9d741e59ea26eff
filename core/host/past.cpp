// A state between two packed ones comes about as it did: from the one before, with the scenes that were set meanwhile.
#include "core/host/past.h"

#include <algorithm>

#include "core/graph/held_bytes.h"

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

// Of what is kept last, without the changes that no state has seen yet.
const Plan* Past::last_plan() const {
  if (!whole_.empty()) return whole_.back().state->plan.get();
  return keys_.empty() ? nullptr : &keys_.back().plan();
}

const Scene* Past::last_scene() const {
  const Plan* plan = last_plan();
  return plan != nullptr ? &plan->scene : nullptr;
}

void Past::set_scene(std::int64_t tick, const Scene& scene, Placed placed) {
  const std::size_t bytes = held_bytes(scene, last_scene());
  changes_.push_back({tick, scene, std::move(placed), bytes});
  // No tick reads it, and it is the only part that scenes do not share.
  changes_.back().scene.view.clear();
  scene_bytes_ += bytes;
  since_key_ += bytes;
}

void Past::add(std::shared_ptr<const State> state) {
  const std::int64_t tick = state->tick;
  const bool is_made = !begins_anew_ && !is_set_over(tick);
  if (!begins_anew_ && stretches_.back().last == tick) {
    // The tick has failed and begins again.
    Whole& again = whole_.back();
    const std::size_t more = held_bytes(*state->plan, again.state->plan.get());
    again.bytes += more;
    whole_bytes_ += more;
    again.state = std::move(state);
    again.is_made = again.is_made && is_made;
    return;
  }
  const bool goes_on = !begins_anew_ && stretches_.back().last + 1 == tick;
  const std::int64_t since = tick - last_key_;
  const std::size_t most = most_whole(*state);
  const std::size_t bytes = held_bytes(*state->plan, last_plan());
  const std::size_t scene_bytes = begins_anew_ && !is_set_over(tick) ? held_bytes(state->plan->scene, last_scene()) : 0;
  since_key_ += bytes + scene_bytes;
  // What much has come about since can be given up in parts only where states are kept in between.
  const bool is_key = !goes_on || since >= 2 * kPackedEvery || (since >= kPackedEvery && is_made) || since_key_ > most_bytes_ / 8;
  whole_bytes_ += bytes + scene_bytes;
  whole_.push_back({std::move(state), is_key, is_made, bytes, scene_bytes});
  begins_anew_ = false;
  if (is_key) last_key_ = tick, since_key_ = 0;
  if (goes_on) stretches_.back().last = tick;
  else stretches_.push_back({tick, tick});
  while (true) {
    const bool is_full = this->bytes() > most_bytes_;
    if (whole_.size() > most) let_go_of_oldest_whole();
    else if (keys_.size() > kMostPacked || (is_full && keys_.size() > 1)) give_up_oldest();
    else if (is_full && whole_.size() > kLeastWhole) let_go_of_oldest_whole();
    else break;
  }
}

void Past::let_go_of_oldest_whole() {
  if (whole_.front().is_key) keep(whole_.front());
  whole_bytes_ -= whole_.front().bytes + whole_.front().scene_bytes;
  whole_.pop_front();
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
  key.bytes += one.scene_bytes + held_bytes(*state.plan, keys_.empty() ? nullptr : &keys_.back().plan());
  keys_.push_back(std::move(key));
  last_kept_ = one.state;
  key_bytes_ += keys_.back().bytes;
}

void Past::give_up_oldest() {
  // What the next one shares with it stays, and is that of one state, plan and scene at most.
  key_bytes_ -= keys_.front().bytes;
  keys_.pop_front();
  has_given_up_ = true;
  const std::int64_t first = keys_.front().tick;
  while (stretches_.front().last < first) stretches_.pop_front();
  stretches_.front().first = std::max(stretches_.front().first, first);
  for (; !changes_.empty() && changes_.front().tick <= first; changes_.pop_front()) scene_bytes_ -= changes_.front().bytes;
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
  for (; !whole_.empty() && whole_.back().state->tick >= tick; whole_.pop_back())
    whole_bytes_ -= whole_.back().bytes + whole_.back().scene_bytes;
  for (; !keys_.empty() && keys_.back().tick >= tick; keys_.pop_back()) {
    key_bytes_ -= keys_.back().bytes;
    last_kept_ = nullptr;
  }
  for (; !changes_.empty() && changes_.back().tick >= tick; changes_.pop_back()) scene_bytes_ -= changes_.back().bytes;
  while (!stretches_.empty() && stretches_.back().first >= tick) stretches_.pop_back();
  if (!stretches_.empty()) stretches_.back().last = std::min(stretches_.back().last, tick - 1);
  begins_anew_ = true;
}

}  // namespace bl::host
