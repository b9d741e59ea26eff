// Drafts in a room: steps, proposals, and the acceptance of the whole or of a part.
#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/room/refusals.h"
#include "core/room/room.h"

namespace bl::room {

namespace {

constexpr std::size_t kMostDrafts = 20, kMostSteps = 2000;

}  // namespace

// Of the speaker, and still open to changes.
Draft* Room::draft_of(const Said& said, const std::string& id) {
  const auto draft = drafts_.find(id);
  const bool is_own = draft != drafts_.end() && draft->second.seat() == said.seat && draft->second.state() == DraftState::open;
  return is_own ? &draft->second : nullptr;
}

Answer Room::change_draft(const Said& said) {
  const auto content = said.operation.content.read();
  if (!content) return refusal_of(Reason::bad, content.error());
  const Json name = (**content).is_object() ? (**content).value("draft", Json()) : Json();
  const Json title = (**content).is_object() ? (**content).value("title", Json("")) : Json();
  if (!name.is_string() || !title.is_string() || title.get_ref<const std::string&>().size() > kLongestName)
    return refuse(Reason::bad, "draft",
                  "expects the name of a draft, and a title of " + std::to_string(kLongestName) + " characters at most");
  const std::string id = name.get<std::string>();
  if (said.operation.kind == OperationKind::draft_begin) {
    const Rights rights = event_kinds().at("propose").rights;
    const Seat& seat = *state_.seat(said.seat);
    if (auto refusal = why_not(asking(said.seat), event_kinds().at("propose"))) return *refusal;
    if (rights.of(seat.role) == 0 || !is_identifier(id)) return refuse(Reason::bad, "draft", "`" + id + "` cannot be a name");
    if (drafts_.contains(id)) return refuse(Reason::conflict, "draft", "there is a draft `" + id + "` already");
    const auto own = std::count_if(drafts_.begin(), drafts_.end(), [&](const auto& one) {
      return one.second.seat() == said.seat && one.second.state() == DraftState::open;
    });
    if (static_cast<std::size_t>(own) >= kMostDrafts)
      return refuse(Reason::size, "draft", "a person has " + std::to_string(kMostDrafts) + " open drafts at most");
    const Draft draft(ledger_->registry(), id, said.seat, title.get<std::string>(), ledger_->last_seq());
    record_.drafts.push_back(draft.record());
    drafts_.emplace(id, draft);
    return done(said.now);
  }
  Draft* draft = draft_of(said, id);
  if (draft == nullptr) return refuse(Reason::gone, "draft", "there is no open draft `" + id + "` of yours");
  if (said.operation.kind == OperationKind::draft_drop) {
    draft->set_state(DraftState::dropped);
    record_.drafts.push_back(draft->record());
    return done(said.now);
  }
  if (said.operation.kind == OperationKind::draft_redo) return bring_back(said, *draft);
  const std::int64_t step = draft->take_back();
  if (step < 0) return refuse(Reason::gone, "draft", "the draft has no steps");
  record_.draft_steps.push_back({id, step, {}});
  return done(said.now);
}

// It is said once more: what its author may not do any more is not done.
Answer Room::bring_back(const Said& said, Draft& draft) {
  const auto* last = draft.last_taken_back();
  if (last == nullptr) return refuse(Reason::gone, "draft", "no step of the draft was taken back since the last one was added");
  const auto [number, command] = *last;
  const Scene& seen = draft.scene_on(scene(), ledger_->last_seq());
  if (auto refusal = why_not(asking(said.seat, true), command, seen)) return *refusal;
  if (auto done = draft.bring_back(scene(), ledger_->last_seq()); !done) return refusal_of_scene(done.error());
  record_.draft_steps.push_back({draft.id(), number, command});
  return done(said.now);
}

Answer Room::add_to_draft(const Said& said, const Command& command) {
  Draft* draft = draft_of(said, said.operation.draft);
  if (draft == nullptr) return refuse(Reason::gone, "draft", "there is no open draft `" + said.operation.draft + "` of yours");
  const Scene& seen = draft->scene_on(scene(), ledger_->last_seq());
  if (auto refusal = why_not(asking(said.seat, true), command, seen)) return *refusal;
  if (draft->steps().size() >= kMostSteps)
    return refuse(Reason::size, "draft", "a draft has " + std::to_string(kMostSteps) + " steps at most");
  if (auto added = draft->add(command, scene(), ledger_->last_seq()); !added) return refusal_of_scene(added.error());
  record_.draft_steps.push_back({draft->id(), static_cast<std::int64_t>(draft->steps().size()) - 1, command});
  return done(said.now);
}

const Scene& Room::scene_of(const std::string& draft) { return drafts_.at(draft).scene_on(scene(), ledger_->last_seq()); }

const Draft& Room::follow_draft(const std::string& id) {
  Draft& draft = drafts_.at(id);
  (void)draft.scene_on(scene(), ledger_->last_seq());
  return draft;
}

DraftSummary Room::summary_of(const std::string& id) {
  Draft& draft = drafts_.at(id);
  DraftSummary summary;
  const Scene& drafted = draft.scene_on(scene(), ledger_->last_seq());
  summary.misfits = draft.misfits();
  Scene trial = scene();
  SceneEdit edit(trial, ledger_->registry());
  for (const Command& step : draft.steps())
    if (!step.id.empty()) (void)bl::apply(edit, step);
  const std::set<Touch> touches(edit.touches().begin(), edit.touches().end());
  summary.touches.assign(touches.begin(), touches.end());
  const std::string own = RoomState::author_of_seat(draft.seat());
  // A place that was written itself, or one around it or inside it.
  for (const auto& [place, write] : writes_) {
    const bool is_others = write.seq > draft.base() && write.author != own;
    if (is_others && std::any_of(touches.begin(), touches.end(), [&place = place](const Touch& touch) {
          return place == touch || lies_inside(place, touch) || lies_inside(touch, place);
        }))
      summary.conflicts.push_back(
          {place, write.author, value_at(scene(), ledger_->registry(), place), value_at(drafted, ledger_->registry(), place)});
  }
  return summary;
}

// The steps become one command of whoever made the draft, in the log through whoever accepts it: one undo takes all of it back.
Answer Room::accept(const Said& said, const EventDefinition& kind, const std::map<std::string, Value>& arguments) {
  const std::string id = std::get<std::string>(arguments.at("draft"));
  const auto found = drafts_.find(id);
  const auto proposal = state_.proposals.find(id);
  if (found == drafts_.end() || proposal == state_.proposals.end() || proposal->second.state != ProposalState::proposed)
    return refuse(Reason::gone, "arguments/draft", "there is no open proposal `" + id + "`");
  const Draft& draft = found->second;
  std::set<double> keep;  // as they were said: some may be no number of a step
  if (const auto chosen = arguments.find("keep"); chosen != arguments.end())
    for (const double step : *std::get<Numbers>(chosen->second)) keep.insert(step);
  std::vector<Command> kept;
  Scene trial = scene();
  SceneEdit edit(trial, ledger_->registry());
  Json misfits = Json::array();
  for (std::size_t k = 0; k < draft.steps().size(); ++k) {
    const Command& step = draft.steps()[k];
    if (step.id.empty() || (!keep.empty() && !keep.contains(static_cast<double>(k)))) continue;
    if (auto fits = bl::apply(edit, step); !fits) misfits.push_back({{"step", k}, {"why", fits.error().text()}});
    kept.push_back(step);
  }
  if (kept.empty()) return refuse(Reason::bad, "arguments/keep", "keep at least one step, or reject the proposal");
  if (!misfits.empty())
    return refuse(Reason::conflict, "arguments/keep", "some steps do not fit the scene any more: leave them out",
                  {{"misfits", misfits}});
  const auto count = static_cast<std::int64_t>(kept.size());
  const Command whole = command<Batch>({std::move(kept)});
  Asking judging = asking(said.seat);
  judging.most_parts = kMostSteps;
  if (auto refusal = why_not(judging, whole, scene())) return *refusal;
  Submission submission{.command = whole, .author = RoomState::author_of_seat(draft.seat())};
  submission.label = "Draft " + id;  // not its title: those are words of a person, which can be erased
  if (auto put_in = put(std::move(submission), said.now, id, said.seat); !put_in) return refusal_of_scene(put_in.error());
  std::map<std::string, Value> told = arguments;
  told["kept"] = count;
  return enter_event(said, kind, std::move(told));
}

}  // namespace bl::room
