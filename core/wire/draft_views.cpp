// Steps of a draft as words, what has changed beneath it, and its trial beside the room.
#include "core/wire/draft_views.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/define/codec.h"
#include "core/host/step_labels.h"
#include "core/reading/figures.h"
#include "core/room/refusals.h"
#include "core/wire/plan_view.h"
#include "core/wire/step_words.h"
#include "core/wire/view_parts.h"

namespace bl::wire {

namespace {

Json misfits_of(const std::vector<room::Misfit>& misfits) {
  Json list = Json::array();
  for (const room::Misfit& misfit : misfits) list.push_back({{"step", misfit.step}, {"why", misfit.error.text()}});
  return list;
}

// A number from what the scene has to what a step sets: `: 1000 to 4000 m³`. Empty where it is not about one number.
std::string change_of(const ViewSources& sources, const Command& step) {
  const auto text = [&](const char* name) {
    const auto found = step.arguments.find(name);
    const auto* value = found == step.arguments.end() ? nullptr : std::get_if<std::string>(&found->second);
    return value == nullptr ? std::string() : *value;
  };
  Touch place;
  std::string unit;
  Json after;
  if (step.id == "set_link_strength" && step.arguments.contains("strength")) {
    place = {ScenePart::link, text("id"), "strength"};
    after = std::get<double>(step.arguments.at("strength"));
  } else if (step.id == "set_port") {
    const auto path = parse_port_path(text("port"));
    const auto port = path ? full_registry().port(*path) : Result<const PortDefinition*>(Error{});
    const auto value = step.arguments.find("value");
    const auto* json = value == step.arguments.end() ? nullptr : std::get_if<JsonValue>(&value->second);
    if (!port || json == nullptr || !json->read()) return "";
    place = {ScenePart::node, text("node"), "types/" + step_of(path->typification) + "/" + step_of(path->port)};
    unit = info((*port)->unit).pretty;
    after = **json->read();
  }
  if (!after.is_number()) return "";
  const auto before = room::value_at(sources.room.scene(), full_registry(), place);
  const double now = after.get<double>();
  const std::string set = reading::readable(now), measure = unit.empty() ? "" : " " + unit;
  if (!before || !(*before->read())->is_number()) return ": " + set + measure;
  const double past = (*before->read())->get<double>();
  // A small change is in digits that people need not read elsewhere.
  const bool is_told = reading::readable(past) != set;
  return ": " + (is_told ? reading::readable(past) : shortest(past)) + " to " + (is_told ? set : shortest(now)) + measure;
}

// The id of a link says nothing to people.
std::string with_link_named(std::string label, const std::string& id, const Scene& scene) {
  const std::string end = "\xC2\xB7 " + id;
  if (scene.links.contains(id) && !scene.nodes.contains(id) && label.ends_with(end))
    label.replace(label.size() - id.size(), id.size(), name_of_link(scene, id));
  return label;
}

std::string words_of_step(const ViewSources& sources, const Command& step) {
  const Scene& scene = sources.room.scene();
  const auto id = step.arguments.find("id");
  const auto* name = id == step.arguments.end() ? nullptr : std::get_if<std::string>(&id->second);
  const std::string label = host::label_of_step(full_registry(), step, scene);
  return (name == nullptr ? label : with_link_named(label, *name, scene)) + change_of(sources, step);
}

// A step that was taken back has no words, and keeps its number. `words`: in English, for whoever has no others.
void put_steps(Json& json, const char* words, const ViewSources& sources, const room::Draft& draft) {
  json[words] = Json::array();
  json["said"] = Json::array();
  for (const Command& step : draft.steps()) {
    json[words].push_back(step.id.empty() ? "" : words_of_step(sources, step));
    json["said"].push_back(step.id.empty() ? Json() : said_of_step(sources, draft, step));
  }
}

Json conflicts_of(const ViewSources& sources, const room::Draft& draft, const room::DraftSummary& summary) {
  const auto content = [](const std::optional<JsonValue>& value) { return value ? Json(**value->read()) : Json(); };
  Json list = Json::array();
  for (const room::DraftConflict& conflict : summary.conflicts)
    list.push_back({{"place", text_of(conflict.place)},
                    {"label", host::label_of_place(conflict.place, sources.room.scene())},
                    {"said", said_of_place(sources, draft, conflict.place)},
                    {"by", seat_name(sources.room.state(), conflict.author)},
                    {"live", content(conflict.live)},
                    {"draft", content(conflict.drafted)}});
  return list;
}

}  // namespace

View proposals_view(const ViewSources& sources) {
  View view;
  const room::RoomState& state = sources.room.state();
  for (const auto& [id, proposal] : state.proposals) {
    Json json = {{"seat", proposal.seat},
                 {"title", sources.room.words(proposal.title)},
                 {"why", text_of(sources.room, proposal.why)},
                 {"state", room::kProposalStateNames[static_cast<std::size_t>(proposal.state)]},
                 {"steps", proposal.steps},
                 {"kept", proposal.kept}};
    if (!proposal.answer.empty()) json["answer"] = text_of(sources.room, proposal.answer);
    const auto draft = sources.room.drafts().find(id);
    if (draft != sources.room.drafts().end()) put_steps(json, "words", sources, draft->second);
    if (draft != sources.room.drafts().end() && proposal.state == room::ProposalState::proposed) {
      const room::DraftSummary summary = sources.room.summary_of(id);
      json["conflicts"] = conflicts_of(sources, draft->second, summary);
      json["misfits"] = misfits_of(summary.misfits);
    }
    json["trial"] = trial_to_json(sources.trials, id);
    put(view, id, json);
  }
  return view;
}

View drafts_view(const ViewSources& sources, std::int64_t seat) {
  View view;
  for (const auto& [id, draft] : sources.room.drafts()) {
    if (draft.seat() != seat || draft.state() == room::DraftState::dropped) continue;
    const room::DraftSummary summary = sources.room.summary_of(id);
    Json json = {{"title", draft.title()},
                 {"state", room::kDraftStateNames[static_cast<std::size_t>(draft.state())]},
                 {"conflicts", conflicts_of(sources, draft, summary)},
                 {"misfits", misfits_of(summary.misfits)},
                 {"trial", trial_to_json(sources.trials, id)}};
    put_steps(json, "steps", sources, draft);
    put(view, id, json);
  }
  return view;
}

// The commands of the seat's own drafts, for windows, which make the scene of a draft themselves. A step that was taken back has
// none. `/RUN` is the number of the last operation on a draft in that run that the steps take into account, so that a window
// knows which of its own steps are told: steps can have the same words, and answers can come in another order. No draft has an
// empty name.
View draft_steps_view(const ViewSources& sources, std::int64_t seat) {
  View view;
  bool is_any_open = false;
  for (const auto& [id, draft] : sources.room.drafts()) {
    if (draft.seat() != seat || draft.state() != room::DraftState::open) continue;
    is_any_open = true;
    const std::vector<Command>& steps = draft.steps();
    for (std::size_t k = 0; k < steps.size(); ++k)
      if (!steps[k].id.empty()) put(view, id + "/" + std::to_string(k), command_to_json(full_registry(), steps[k]));
  }
  if (is_any_open)
    for (const auto& [run, last] : sources.room.last_of_drafts(seat)) put(view, "/" + run, last);
  return view;
}

// Of the drafts that pages of this seat look at, those that it may see: its own, and what was proposed.
View draft_plans_view(const ViewSources& sources, std::int64_t seat) {
  View view;
  if (sources.trials == nullptr) return view;
  const auto looked_at = sources.trials->looked_at.find(seat);
  if (looked_at == sources.trials->looked_at.end()) return view;
  for (const std::string& id : looked_at->second) {
    const auto draft = sources.room.drafts().find(id);
    const auto trial = sources.trials->trials.find(id);
    if (draft == sources.room.drafts().end() || trial == sources.trials->trials.end() || !trial->second.picture) continue;
    if (draft->second.seat() != seat && !sources.room.state().proposals.contains(id)) continue;
    for (const auto& [key, content] : trial->second.picture->plan) view[id + "/" + key] = content;
  }
  return view;
}

}  // namespace bl::wire
