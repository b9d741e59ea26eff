// From tables of keys and JSON to what the panel draws.
#include "ui/desktop/panels/room_agenda.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/reading/figures.h"
#include "core/vote/ballot_json.h"

namespace bl::desktop {

namespace {

using View = std::map<std::string, JsonValue>;

const Json& agenda_json(const View& view, const std::string& key) {
  static const Json kNothing;
  const auto found = view.find(key);
  const auto json = found == view.end() ? Result<const Json*>(Error{}) : found->second.read();
  return json ? **json : kNothing;
}

const Json& agenda_part(const Json& json, const char* key) {
  static const Json kNothing;
  return json.is_object() && json.contains(key) ? json[key] : kNothing;
}

double agenda_number(const Json& json, const char* key, double otherwise = 0) {
  const Json& part = agenda_part(json, key);
  return part.is_number() ? part.get<double>() : otherwise;
}

std::int64_t agenda_integer(const Json& json, const char* key) {
  const Json& part = agenda_part(json, key);
  return part.is_number_integer() ? part.get<std::int64_t>() : 0;
}

bool agenda_flag(const Json& json, const char* key) {
  const Json& part = agenda_part(json, key);
  return part.is_boolean() && part.get<bool>();
}

std::string agenda_text(const Json& json) { return json.is_string() ? json.get<std::string>() : std::string(); }

std::vector<std::string> agenda_texts(const Json& json) {
  std::vector<std::string> texts;
  if (json.is_array())
    for (const Json& one : json)
      if (one.is_string()) texts.push_back(one.get<std::string>());
  return texts;
}

void read_seats(const Json& seats, Agenda& agenda) {
  if (!seats.is_object()) return;
  for (const auto& [key, one] : seats.items()) {
    if (key.empty() || key.size() > 9 || key.find_first_not_of("0123456789") != std::string::npos) continue;
    agenda.seats.push_back({.number = std::stoll(key),
                            .name = guest::text_in(one, "name"),
                            .role = guest::text_in(one, "role"),
                            .colour = guest::text_in(one, "colour"),
                            .card = guest::text_in(one, "card"),
                            .areas = agenda_texts(agenda_part(one, "areas")),
                            .is_here = agenda_flag(one, "here"),
                            .is_muted = agenda_flag(one, "muted")});
  }
  std::sort(agenda.seats.begin(), agenda.seats.end(),
            [](const AgendaSeat& a, const AgendaSeat& b) { return a.is_here != b.is_here ? a.is_here : a.number < b.number; });
}

std::optional<double> agenda_optional(const Json& json, const char* key) {
  const Json& part = agenda_part(json, key);
  return part.is_number() ? std::optional(part.get<double>()) : std::nullopt;
}

// What a ballot has to fit, checked as in the node. A kind that this program does not know has no options.
vote::Question question_in(const Json& json) {
  vote::Question asks;
  asks.kind = vote::kind_named(guest::text_in(json, "kind")).value_or(vote::Kind::yes_no);
  asks.points = agenda_integer(json, "points");
  asks.is_whole_ranking = agenda_flag(json, "whole");
  asks.least = agenda_number(json, "least");
  asks.most = agenda_number(json, "most", 1);
  Table options{{"id", "label"}, {}};
  if (const Json& list = agenda_part(json, "options"); list.is_array())
    for (const Json& one : list) options.rows.push_back({guest::text_in(one, "id"), guest::text_in(one, "label")});
  const auto whole = vote::question_of(asks, options);
  return whole ? *whole : asks;
}

AgendaVote vote_of(const std::string& id, const Json& json) {
  AgendaVote vote;
  vote.id = id;
  vote.question = guest::text_in(json, "question");
  vote.unit = guest::text_in(json, "unit");
  vote.asks = question_in(json);
  vote.is_open = agenda_flag(json, "open");
  vote.is_secret = agenda_flag(json, "secret");
  vote.count = agenda_integer(json, "count");
  vote.electorate = agenda_integer(json, "electorate");
  vote.leading = guest::text_in(json, "leading");
  vote.mean = agenda_optional(json, "mean");
  vote.median = agenda_optional(json, "median");
  if (const Json& mine = agenda_part(json, "mine"); !mine.is_null())
    if (const auto ballot = vote::ballot_from_json(vote.asks.kind, mine)) vote.mine = *ballot;
  if (const Json& result = agenda_part(json, "result"); result.is_array())
    for (const Json& row : result)
      vote.result.push_back({guest::text_in(row, "option"), guest::text_in(row, "label"), agenda_number(row, "points"),
                             agenda_number(row, "share")});
  return vote;
}

// A short value; a list or a table says nothing in a line.
std::string value_words(const Json& value) {
  if (value.is_number()) return reading::readable(value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
  return agenda_text(value);
}

std::string trial_words(const Json& trial) {
  const std::string state = guest::text_in(trial, "state");
  if (const std::string why = guest::text_in(trial, "why"); !why.empty()) return "The trial has failed: " + why;
  if (state == "waiting") return "The trial waits; " + std::to_string(agenda_integer(trial, "line")) + " come first.";
  if (state == "running") return "The trial runs. These figures still change.";
  if (state == "old") return "The model has changed since this trial.";
  if (state != "done") return "";
  return agenda_flag(trial, "is_settled") ? "This is the result of a trial."
                                          : "The trial has ended before the model was at rest.";
}

// What drafts and proposals have both: steps in words, what stands against them, and what has come of the trial.
void read_content(AgendaProposal& proposal, const Json& json, const char* steps) {
  // A step that was taken back has no words.
  const std::vector<std::string> words = agenda_texts(agenda_part(json, steps));
  for (std::size_t k = 0; k < words.size(); ++k)
    if (!words[k].empty()) proposal.steps.push_back({static_cast<std::int64_t>(k), words[k], {}});
  if (const Json& misfits = agenda_part(json, "misfits"); misfits.is_array())
    for (const Json& one : misfits)
      for (AgendaStep& step : proposal.steps)
        if (step.number == agenda_integer(one, "step")) step.misfit = guest::text_in(one, "why");
  if (const Json& conflicts = agenda_part(json, "conflicts"); conflicts.is_array())
    for (const Json& one : conflicts)
      proposal.conflicts.push_back({guest::text_in(one, "label"), guest::text_in(one, "by"),
                                    value_words(agenda_part(one, "live")), value_words(agenda_part(one, "draft"))});
  const Json& trial = agenda_part(json, "trial");
  proposal.trial = trial_words(trial);
  if (const Json& figures = agenda_part(trial, "figures"); figures.is_array())
    for (const Json& one : figures)
      proposal.figures.push_back(
          {guest::text_in(one, "name"), guest::text_in(one, "unit"), guest::text_in(agenda_part(one, "after"), "status"),
           agenda_optional(agenda_part(one, "before"), "value"), agenda_optional(agenda_part(one, "after"), "value")});
}

AgendaProposal draft_of(const std::string& draft, const Json& json) {
  AgendaProposal own;
  own.draft = draft;
  own.title = guest::text_in(json, "title");
  read_content(own, json, "steps");
  own.count = static_cast<std::int64_t>(own.steps.size());
  return own;
}

AgendaProposal proposal_of(const std::string& draft, const Json& json) {
  AgendaProposal proposal;
  proposal.draft = draft;
  proposal.title = guest::text_in(json, "title");
  proposal.why = guest::text_in(json, "why");
  proposal.seat = agenda_integer(json, "seat");
  proposal.kept = agenda_integer(json, "kept");
  proposal.count = agenda_integer(json, "steps");
  proposal.is_decided = guest::text_in(json, "state") != "proposed";
  proposal.is_accepted = guest::text_in(json, "state") == "accepted";
  read_content(proposal, json, "words");
  return proposal;
}

}  // namespace

std::string option_words(const AgendaVote& vote, const std::string& option) {
  for (const vote::Option& one : vote.asks.options)
    if (one.id == option) return one.label.empty() ? one.id : one.label;
  return option;
}

Agenda agenda_of(const guest::RoomGuest& room) {
  Agenda agenda;
  const View& shared = room.view("room");
  agenda.is_known = !shared.empty();
  const Json& phase = agenda_json(shared, "phase");
  agenda.phase = guest::text_in(phase, "name");
  for (const std::string& activity : agenda_texts(agenda_part(phase, "activities"))) agenda.may.insert(activity);
  agenda.forms = agenda_texts(agenda_part(phase, "forms"));
  agenda.ends_at = agenda_integer(phase, "ends_at");
  agenda.door = agenda_text(agenda_json(shared, "door"));
  agenda.layout = agenda_text(agenda_json(shared, "layout"));
  agenda.code = agenda_text(agenda_json(shared, "code"));
  read_seats(agenda_json(shared, "seats"), agenda);
  if (const Json& cards = agenda_json(shared, "cards"); cards.is_object())
    for (const auto& [id, card] : cards.items()) agenda.cards[id] = guest::text_in(card, "name");
  for (const auto& [id, content] : room.view("votes"))
    if (const auto json = content.read()) agenda.votes.push_back(vote_of(id, **json));
  std::stable_sort(agenda.votes.begin(), agenda.votes.end(),
                   [](const AgendaVote& a, const AgendaVote& b) { return a.is_open && !b.is_open; });
  for (const auto& [id, content] : room.view("proposals"))
    if (const auto json = content.read()) agenda.proposals.push_back(proposal_of(id, **json));
  std::stable_sort(agenda.proposals.begin(), agenda.proposals.end(),
                   [](const AgendaProposal& a, const AgendaProposal& b) { return !a.is_decided && b.is_decided; });
  for (const auto& [id, content] : room.view("drafts"))
    if (const auto json = content.read(); json && guest::text_in(**json, "state") == "open")
      agenda.drafts.push_back(draft_of(id, **json));
  for (const auto& [id, content] : room.view("comments")) {
    const auto json = content.read();
    if (!json || guest::text_in(**json, "state") != "open") continue;
    if (!guest::text_in(**json, "answer").empty() || !guest::text_in(**json, "parent").empty()) continue;
    agenda.comments.push_back({.id = id,
                               .text = guest::text_in(**json, "text"),
                               .node = guest::text_in(**json, "node"),
                               .seat = agenda_integer(**json, "seat"),
                               .plus = agenda_integer(**json, "plus"),
                               .minus = agenda_integer(**json, "minus")});
  }
  return agenda;
}

}  // namespace bl::desktop
