// What pages are shown of a room: small tables of keys and JSON, made by the server, of which only changes are sent.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/graph/state.h"
#include "core/room/room.h"
#include "core/wire/draft_trial.h"

namespace bl::wire {

/// Keys with their content as JSON text.
using View = std::map<std::string, std::string>;

/// What views are made of: the state of a tick that is published, and the room at that moment.
struct ViewSources {
  const State& state;
  room::Room& room;
  std::string code, title;
  const DraftTrials* trials = nullptr;  ///< none where no draft is tried
  const std::map<std::string, std::string>* invites =
      nullptr;  ///< by role: the key of its invitation; none where nobody is invited
  const std::map<std::int64_t, std::shared_ptr<const View>>* past = nullptr;  ///< as `PastPlans`; none where nothing is kept
};

/// The names of all views. Of these, `card`, `votes`, `comments`, `drafts`, `draft_steps`, `draft_plans`, `keys` and `lead` are
/// different for each seat.
inline constexpr std::string_view kViewNames[] = {"room",     "plan",      "figures",   "card",        "votes",
                                                  "comments", "proposals", "drafts",    "draft_steps", "draft_plans",
                                                  "keys",     "shapes",    "decisions", "past",        "lead"};
bool is_view(std::string_view name);
bool is_of_seat(std::string_view view);
/// Whether it is the same as long as the scene's state is, whatever happens in the room.
bool is_of_state(std::string_view view);

/// One view, as this seat sees it; empty for an unknown name.
/// Is the view of a seat the same for this one as for everybody who has done nothing? Such a view is made once for all of them.
bool is_as_for_all(std::string_view name, const ViewSources& sources, std::int64_t seat);
/// Do only events change the view, and no command, tick or connection?
bool is_of_events(std::string_view name);
View make_view(std::string_view name, const ViewSources& sources, std::int64_t seat);

/// What has changed from `before` to `now` as a `state` message; nothing where nothing has. Without `before` all of it.
std::optional<std::string> changes_of(std::string_view name, const View* before, const View& now, std::int64_t tick,
                                      std::int64_t seq);

}  // namespace bl::wire
