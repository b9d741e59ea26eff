// First what the role may do at all in this phase; then what the command touches, on a copy of the scene.
#include "core/room/rights.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/room/grounds.h"
#include "core/session/commands.h"

namespace bl::room {

namespace {

Refusal no(Reason why, std::string place, std::string text) { return {why, std::move(place), std::move(text), {}}; }

// What is the same for all that somebody says.
std::optional<Refusal> why_not_at_all(const Asking& asking, const Rights& rights, const std::string& what) {
  const Seat* seat = asking.state.seat(asking.seat);
  if (seat == nullptr) return no(Reason::right, "", "you have no seat in this room");
  if (asking.state.is_closed) return no(Reason::closed, "", "the session is over");
  if (seat->is_muted) return no(Reason::locked, "", "the facilitator has muted you");
  if (!rights.is_by_parts && rights.of(seat->role) == 0)
    return no(Reason::right, "", "a " + std::string(name_of(seat->role)) + " may not " + what);
  return std::nullopt;
}

std::optional<Refusal> why_not_now(const Asking& asking, const Seat& seat, Activity activity) {
  const bool is_leading = seat.role == Role::facilitator || seat.role == Role::recorder || seat.role == Role::device;
  if (is_leading || activity == Activity::any || asking.state.phase.activities.contains(activity)) return std::nullopt;
  static constexpr const char* kWhat[] = {"", "change the scene", "work on drafts", "comment", "vote"};
  Refusal refusal = no(Reason::phase, "", std::string("in this phase nobody can ") + kWhat[static_cast<std::size_t>(activity)]);
  refusal.args = JsonValue::of({{"activity", kActivityNames[static_cast<std::size_t>(activity)]}});
  return refusal;
}

template <class T>
const T* argument(const Command& command, const char* name) {
  const auto found = command.arguments.find(name);
  return found == command.arguments.end() ? nullptr : std::get_if<T>(&found->second);
}

// How large a single thing may be, whoever says it.
std::optional<Refusal> why_too_large(const Command& command, const Scene& scene) {
  if (command.id == "add_node" && scene.nodes.size() >= kMostNodes)
    return no(Reason::size, "nodes", "the scene has " + std::to_string(kMostNodes) + " nodes already, and a room holds no more");
  if (const auto* text = argument<std::string>(command, "text"); text != nullptr && text->size() > kLongestScript)
    return no(Reason::size, "text", "a script has " + std::to_string(kLongestScript) + " characters at most");
  if (const auto* name = argument<std::string>(command, "name"); name != nullptr && name->size() > kLongestText)
    return no(Reason::size, "name", "a name has " + std::to_string(kLongestText) + " characters at most");
  return std::nullopt;
}

// One command that holds no others, on the scene as it is; afterwards the scene is as it leaves it.
std::optional<Refusal> judge_one(const Asking& asking, const Seat& seat, const Command& command, Scene& scene) {
  const CommandDefinition& definition = *asking.registry.command(command.id);
  if (auto not_at_all =
          why_not_at_all(asking, definition.rights, definition.label.empty() ? command.id : lower_first(definition.label)))
    return not_at_all;
  const Activity activity = asking.is_in_draft ? Activity::draft : definition.rights.activity;
  if (auto not_now = why_not_now(asking, seat, activity)) return not_now;
  if (auto too_large = why_too_large(command, scene)) return too_large;
  // Before it is applied: a script runs when it is read.
  if (definition.rights.of(seat.role) == static_cast<Grounds>(Ground::if_allowed) && !asking.allowances.scripts)
    return no(Reason::right, "scripts", "this room was opened without scripts");
  const Scene before = scene;
  SceneEdit edit(scene, asking.registry);
  if (!bl::apply(edit, command)) return std::nullopt;  // the scene will say why
  return why_ungrounded(asking, definition.rights.of(seat.role), command, {before, scene, edit.touches()});
}

std::optional<Refusal> judge_parts(const Asking& asking, const Seat& seat, const Command& command, Scene& scene) {
  const CommandDefinition* definition = asking.registry.command(command.id);
  if (definition == nullptr) return no(Reason::bad, "command", "there is no command `" + command.id + "`");
  if (!definition->rights.is_by_parts) return judge_one(asking, seat, command, scene);
  const auto* parts = argument<CommandList>(command, "commands");
  if (parts == nullptr) return no(Reason::bad, "commands", "expects a list of commands");
  if ((*parts)->size() > asking.most_parts)
    return no(Reason::size, "commands", "a batch has " + std::to_string(asking.most_parts) + " commands at most");
  for (std::size_t k = 0; k < (*parts)->size(); ++k) {
    const Command& part = (**parts)[k];
    const std::string place = "commands/" + std::to_string(k);
    const CommandDefinition* inner = asking.registry.command(part.id);
    if (inner != nullptr && inner->rights.is_by_parts) return no(Reason::bad, place, "a batch holds no batches here");
    if (inner != nullptr && inner->rights.activity == Activity::vote)
      return no(Reason::bad, place, "a ballot is given by itself");
    if (auto refusal = judge_parts(asking, seat, part, scene)) {
      refusal->place = refusal->place.empty() ? place : place + "/" + refusal->place;
      return refusal;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Refusal> why_not(const Asking& asking, const Command& command, const Scene& scene) {
  static constexpr Rights kNothingInParticular{.is_by_parts = true};
  if (auto not_at_all = why_not_at_all(asking, kNothingInParticular, "")) return not_at_all;
  Scene trial = scene;
  return judge_parts(asking, *asking.state.seat(asking.seat), command, trial);
}

std::optional<Refusal> why_not(const Asking& asking, const EventDefinition& event) {
  if (auto not_at_all = why_not_at_all(asking, event.rights, lower_first(event.label))) return not_at_all;
  return why_not_now(asking, *asking.state.seat(asking.seat), event.rights.activity);
}

std::optional<Refusal> why_no_undo(const Asking& asking, const Scene& before, const Scene& after,
                                   const std::vector<Touch>& touches) {
  static constexpr Rights kOwnWork{
      .designer = Ground::in_area | Ground::own | Ground::on_card | Ground::own_in_view | Ground::if_allowed,
      .stakeholder = Ground::own | Ground::on_card,
      .participant = Ground::own | Ground::on_card};
  if (auto not_at_all = why_not_at_all(asking, kOwnWork, "undo")) return not_at_all;
  const Seat& seat = *asking.state.seat(asking.seat);
  if (auto not_now = why_not_now(asking, seat, Activity::change)) return not_now;
  return why_ungrounded(asking, kOwnWork.of(seat.role), {}, {before, after, touches});
}

}  // namespace bl::room
