// The check of rights: command × role × area × phase × range.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/define/registry.h"
#include "core/graph/scene.h"
#include "core/graph/touch.h"
#include "core/room/answer.h"
#include "core/room/event_builder.h"
#include "core/room/room_state.h"

namespace bl::room {

/// What whoever opened the room has allowed in it.
struct Allowances {
  bool scripts = false;  ///< scripts may be added and changed
  bool live = false;     ///< nodes may name files and connections to the outside
};

/// Limits of what one command may hold. They bound what a single person can make everybody else wait for.
inline constexpr std::size_t kMostNodes = 20000, kMostParts = 200, kMostSeats = 200, kLongestView = 262144,
                             kLongestViewPatch = 4096, kLongestScript = 262144, kLongestText = 2000, kLongestName = 40;

/// Who asks, and where.
struct Asking {
  const Registry& registry;
  const RoomState& state;
  Allowances allowances;
  std::int64_t seat = 0;
  bool is_in_draft = false;
  std::size_t most_parts = kMostParts;  ///< of one batch
};

/// Why this person may not submit the command to this scene; nothing where they may, or where the scene will refuse it anyway.
/// It is tried on a copy of the scene; a batch is checked part by part, each in the scene that the parts before it make.
std::optional<Refusal> why_not(const Asking& asking, const Command& command, const Scene& scene);
/// Why this person may not cause the event.
std::optional<Refusal> why_not(const Asking& asking, const EventDefinition& event);
/// Why an undo or redo may not make this change: it would change what the person may not change any more. `after` is the scene
/// with the change.
std::optional<Refusal> why_no_undo(const Asking& asking, const Scene& before, const Scene& after,
                                   const std::vector<Touch>& touches);

}  // namespace bl::room
