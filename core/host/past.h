// The ticks of a session that a rewind can reach: the last states whole, older ones packed now and then, those between computed
// again.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/graph/packed_state.h"
#include "core/graph/simulation.h"

namespace bl::host {

class Past {
 public:
  using Placed = std::set<std::pair<std::string, std::string>>;

  /// How many of the last states are kept whole: fewer where they have many nodes, down to the least. While all of them move, a
  /// node takes some 7 kB in each.
  static constexpr std::size_t kWholeStates = 20, kLeastWhole = 3, kMostWholeNodes = 60000;
  /// Of older states each one that comes so many ticks after the one before is kept: packed, where a tick has made it and nobody
  /// has set a scene since. Meshes of the others belong to older settings, which packing cannot bring back: where one of these
  /// has to be kept, because there was none better for twice as long, it stays whole.
  static constexpr std::int64_t kPackedEvery = 20;
  /// Beyond these the oldest are given up: ten minutes at twenty ticks a second, and what all may take that is kept.
  static constexpr std::size_t kMostPacked = 600, kMostBytes = std::size_t{400} << 20;

  explicit Past(std::size_t most_bytes = kMostBytes) : most_bytes_(most_bytes) {}

  /// Before a tick: the scene that is set now, in the state with this tick.
  void set_scene(std::int64_t tick, const Scene& scene, Placed placed);
  /// Before a tick, after set_scene(): the state with which it begins.
  void add(std::shared_ptr<const State> state);

  bool empty() const { return stretches_.empty(); }
  /// The first tick that can be reached; there must be one.
  std::int64_t oldest() const { return stretches_.front().first; }
  /// The last tick up to `tick` that a state was added for, or the oldest one.
  std::int64_t reachable(std::int64_t tick) const;
  /// The state with which this tick began, where it is at hand.
  std::shared_ptr<const State> whole(std::int64_t tick) const;
  /// Brings the simulation to the state with which this tick began.
  Result<void> recompute(std::int64_t tick, Simulation& simulation) const;
  /// About how much memory the kept states, plans and scenes take, each beside the one before it: states that are packed, and of
  /// all plans and scenes what they do not share.
  std::size_t bytes() const { return key_bytes_ + whole_bytes_ + scene_bytes_; }
  /// Have ticks been given up, so that there were others before oldest()?
  bool has_given_up() const { return has_given_up_; }
  /// Gives up this tick and those after it.
  void forget_from(std::int64_t tick);

 private:
  struct Whole {
    std::shared_ptr<const State> state;
    bool is_key = false;   // kept when it leaves the last states
    bool is_made = false;  // by a tick, and as that left it
    std::size_t bytes = 0;        // of its plan, beside that of the state before
    std::size_t scene_bytes = 0;  // of its scene, where no change has brought it about
  };
  struct Key {
    std::int64_t tick = 0;
    std::size_t bytes = 0;
    std::optional<PackedState> packed;
    std::shared_ptr<const State> whole;  // where it is not packed
    const Plan& plan() const { return packed ? *packed->plan() : *whole->plan; }
  };
  struct SceneChange {
    std::int64_t tick = 0;
    Scene scene;
    Placed placed;
    std::size_t bytes = 0;
  };
  /// Ticks without a gap.
  struct Stretch {
    std::int64_t first = 0, last = 0;
  };

  bool is_set_over(std::int64_t tick) const { return !changes_.empty() && changes_.back().tick == tick; }
  const Plan* last_plan() const;
  const Scene* last_scene() const;
  void keep(const Whole& one);
  void let_go_of_oldest_whole();
  void give_up_oldest();

  std::deque<Stretch> stretches_;
  std::deque<Whole> whole_;
  std::deque<Key> keys_;
  std::deque<SceneChange> changes_;
  std::shared_ptr<const State> last_kept_;  // the state that the last of `keys_` was made from
  std::int64_t last_key_ = 0;               // the last tick whose state is kept, or will be
  bool begins_anew_ = true;                 // the next state does not follow from the ticks before it
  bool has_given_up_ = false;
  std::size_t most_bytes_;
  std::size_t key_bytes_ = 0, whole_bytes_ = 0, scene_bytes_ = 0;
  std::size_t since_key_ = 0;  // bytes of plans and scenes since the last tick whose state is kept
};

}  // namespace bl::host
