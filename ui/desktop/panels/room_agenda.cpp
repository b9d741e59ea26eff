// From tables of keys and JSON to what the panel draws.
#include "ui/desktop/panels/room_agenda.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/text.h"

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

AgendaVote vote_of(const std::string& id, const Json& json) {
  AgendaVote vote{.id = id,
                  .question = guest::text_in(json, "question"),
                  .kind = guest::text_in(json, "kind"),
                  .unit = guest::text_in(json, "unit"),
                  .least = agenda_number(json, "least"),
                  .most = agenda_number(json, "most", 1),
                  .is_open = agenda_flag(json, "open"),
                  .is_secret = agenda_flag(json, "secret"),
                  .count = agenda_integer(json, "count"),
                  .electorate = agenda_integer(json, "electorate"),
                  .mine = agenda_text(agenda_part(json, "mine")),
                  .result = {}};
  if (const Json& mine = agenda_part(json, "mine"); mine.is_number()) vote.mine = shortest(mine.get<double>());
  if (const Json& result = agenda_part(json, "result"); result.is_array())
    for (const Json& row : result) {
      const std::string label = guest::text_in(row, "label");
      vote.result.emplace_back(label.empty() ? guest::text_in(row, "option") : label, agenda_number(row, "share"));
    }
  return vote;
}

AgendaProposal proposal_of(const std::string& draft, const Json& json) {
  AgendaProposal proposal{.draft = draft,
                          .title = guest::text_in(json, "title"),
                          .why = guest::text_in(json, "why"),
                          .seat = agenda_integer(json, "seat"),
                          .steps = {},
                          .conflicts = {},
                          .misfits = {}};
  for (std::string& step : agenda_texts(agenda_part(json, "words")))
    if (!step.empty()) proposal.steps.push_back(std::move(step));
  if (const Json& conflicts = agenda_part(json, "conflicts"); conflicts.is_array())
    for (const Json& one : conflicts)
      proposal.conflicts.push_back(guest::text_in(one, "label") + " was changed by " + guest::text_in(one, "by"));
  if (const Json& misfits = agenda_part(json, "misfits"); misfits.is_array())
    for (const Json& one : misfits) proposal.misfits.push_back(guest::text_in(one, "why"));
  return proposal;
}

}  // namespace

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
    if (const auto json = content.read(); json && guest::text_in(**json, "state") == "proposed")
      agenda.proposals.push_back(proposal_of(id, **json));
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
