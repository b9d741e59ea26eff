// Drafts: private lists of commands, applied to a copy of the scene that follows what everybody else does.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/room/record.h"
#include "core/session/commands.h"

namespace bl::room {

enum class DraftState : std::uint8_t { open, proposed, accepted, dropped };
inline constexpr std::string_view kDraftStateNames[] = {"open", "proposed", "accepted", "dropped"};

/// A step that does not fit the scene any more, and why.
struct Misfit {
  std::int64_t step = 0;
  Error error;
};

class Draft {
 public:
  Draft(const Registry& registry, std::string id, std::int64_t seat, std::string title, std::int64_t base)
      : registry_(&registry), id_(std::move(id)), title_(std::move(title)), seat_(seat), base_(base) {}

  const std::string& id() const { return id_; }
  const std::string& title() const { return title_; }
  void set_title(std::string title) { title_ = std::move(title); }
  std::int64_t seat() const { return seat_; }
  std::int64_t base() const { return base_; }
  DraftState state() const { return state_; }
  void set_state(DraftState state) { state_ = state; }
  /// A step that was taken back is empty; numbers of steps never change.
  const std::vector<Command>& steps() const { return steps_; }
  std::int64_t step_count() const;

  /// The scene with the steps that fit it. `seq` is the number of the last entry of `head`.
  const Scene& scene_on(const Scene& head, std::int64_t seq);
  /// Of the last scene_on().
  const std::vector<Misfit>& misfits() const { return misfits_; }
  /// The ports that its steps set to a place, by node and path.
  const std::set<std::pair<std::string, std::string>>& placed() const { return placed_; }
  /// Another number after each change of its steps.
  std::int64_t revision() const { return revision_; }
  /// Adds a step; on an error nothing changes.
  Result<void> add(const Command& command, const Scene& head, std::int64_t seq);
  /// Takes the last step back; its number, or -1 where there is none.
  std::int64_t take_back();
  /// The step that was taken back last, with its number; null where there is none. A new step makes an end of them.
  const std::pair<std::int64_t, Command>* last_taken_back() const { return taken_back_.empty() ? nullptr : &taken_back_.back(); }
  /// Brings it back under its number; an error where it does not fit any more, and then nothing changes.
  Result<void> bring_back(const Scene& head, std::int64_t seq);
  /// A stored step, in any order.
  void restore(std::int64_t number, Command command);

  DraftRecord record() const { return {id_, seat_, base_, title_, std::string(kDraftStateNames[static_cast<int>(state_)])}; }

 private:
  const Registry* registry_;
  std::string id_, title_;
  std::int64_t seat_ = 0, base_ = 0, follows_ = -1, revision_ = 0;
  DraftState state_ = DraftState::open;
  Result<void> apply_to_scene(const Command& command, const Scene& head, std::int64_t seq);

  std::vector<Command> steps_;
  std::vector<std::pair<std::int64_t, Command>> taken_back_;  // the last one first to come back
  Scene scene_;
  std::vector<Misfit> misfits_;
  std::set<std::pair<std::string, std::string>> placed_;
};

/// A place that a draft changes and somebody has changed since the draft was begun.
struct DraftConflict {
  Touch place;
  std::string author;                ///< who
  std::optional<JsonValue> live;     ///< the value that it has now; nothing where the place is gone, or holds no single value
  std::optional<JsonValue> drafted;  ///< and the one that it has with the draft
};
/// What a proposal holds, for whoever decides: the places that it changes, and those of them that others have changed meanwhile.
struct DraftSummary {
  std::vector<Touch> touches;
  std::vector<DraftConflict> conflicts;
  std::vector<Misfit> misfits;
};

}  // namespace bl::room
