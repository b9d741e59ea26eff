// What has come of a draft that is tried beside the room, as pages are shown it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "core/define/json_text.h"
#include "core/define/payload.h"
#include "core/graph/state.h"

namespace bl::wire {

/// Figures without and with the draft, and the plan with it.
struct TrialPicture {
  JsonValue figures = "[]";
  std::map<std::string, std::string> plan = {};  ///< as the view `plan` has it
};
/// A pure function of the two states. The figures are those of all indicators of either, by id.
TrialPicture picture_of(const State& without, const State& with);

enum class TrialState : std::uint8_t { waiting, running, done, old };
inline constexpr std::string_view kTrialStateNames[] = {"waiting", "running", "done", "old"};

struct DraftTrial {
  TrialState state = TrialState::waiting;
  std::int64_t line = 0;  ///< of one that waits: how many come first
  std::int64_t ticks = 0;
  std::int64_t seq = 0;  ///< the last change of the room's scene that it knows
  bool is_settled = false;
  std::string why = {};  ///< it failed
  std::shared_ptr<const TrialPicture> picture = {};
};

/// All trials of a room, and who looks at what.
struct DraftTrials {
  std::map<std::string, DraftTrial> trials = {};                 ///< by draft
  std::map<std::int64_t, std::set<std::string>> looked_at = {};  ///< by seat
};

/// The key `trial` of a draft; null where it has not been tried.
Json trial_to_json(const DraftTrials* all, const std::string& draft);

}  // namespace bl::wire
