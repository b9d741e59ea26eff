// The state of a room as JSON, which its hash is made of.
#include "core/room/room_state.h"

#include <charconv>

#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/define/codec.h"
#include "core/room/room_state_json.h"

namespace bl::room {

namespace {

constexpr std::string_view kSeatAuthor = "seat ";

Json seat_to_json(const Seat& seat) {
  Json json = Json::object();
  json["role"] = kRoleNames[static_cast<std::size_t>(seat.role)];
  json["name"] = seat.name;
  json["colour"] = seat.colour;
  json["areas"] = seat.areas;
  if (!seat.card.empty()) json["card"] = seat.card;
  json["here"] = seat.is_here;
  if (seat.is_muted) json["muted"] = true;
  if (seat.is_removed) json["removed"] = true;
  if (seat.is_waiting) json["waits"] = true;
  return json;
}

Json area_to_json(const Area& area) {
  Json json = Json::object();
  json["nodes"] = selection_to_json(area.nodes);
  json["outline"] = Json::array();
  for (const Point3& corner : area.outline) json["outline"].push_back({corner.x, corner.y, corner.z});
  json["pen"] = area.pen;
  json["asking"] = area.asking;
  return json;
}

Json anchor_to_json(const Anchor& anchor) {
  Json json = Json::object();
  if (!anchor.node.empty()) json["node"] = anchor.node;
  if (!anchor.scenario.empty()) json["scenario"] = anchor.scenario;
  if (anchor.place) json["place"] = {anchor.place->x, anchor.place->y, anchor.place->z};
  if (anchor.tick) json["tick"] = *anchor.tick;
  return json;
}

Json comment_to_json(const Comment& comment) {
  Json json = Json::object();
  json["seat"] = comment.seat;
  json["text"] = comment.text;
  if (!comment.parent.empty()) json["parent"] = comment.parent;
  json["anchor"] = anchor_to_json(comment.anchor);
  json["ratings"] = Json::object();
  for (const auto& [seat, rating] : comment.ratings) json["ratings"][std::to_string(seat)] = rating;
  json["state"] = kCommentStateNames[static_cast<std::size_t>(comment.state)];
  if (!comment.answer.empty()) json["answer"] = comment.answer;
  return json;
}

Json proposal_to_json(const Proposal& proposal) {
  Json json = Json::object();
  json["seat"] = proposal.seat;
  json["title"] = proposal.title;
  json["why"] = proposal.why;
  json["state"] = kProposalStateNames[static_cast<std::size_t>(proposal.state)];
  json["steps"] = proposal.steps;
  if (proposal.by != 0) json["by"] = proposal.by;
  if (proposal.kept != 0) json["kept"] = proposal.kept;
  if (!proposal.answer.empty()) json["answer"] = proposal.answer;
  return json;
}

Json phase_to_json(const Phase& phase) {
  Json json = {{"name", phase.name}, {"activities", Json::array()}, {"forms", phase.forms}};
  for (const Activity activity : phase.activities)
    json["activities"].push_back(kActivityNames[static_cast<std::size_t>(activity)]);
  if (phase.ends_at != 0) json["ends_at"] = phase.ends_at;
  return json;
}

template <class Map, class Form>
Json map_to_json(const Map& map, Form form) {
  Json json = Json::object();
  for (const auto& [key, content] : map) {
    if constexpr (std::is_same_v<std::decay_t<decltype(key)>, std::string>) json[key] = form(content);
    else json[std::to_string(key)] = form(content);
  }
  return json;
}

}  // namespace

const Seat* RoomState::seat(std::int64_t number) const {
  const auto found = seats.find(number);
  return found == seats.end() || found->second.is_removed ? nullptr : &found->second;
}

std::int64_t RoomState::seat_of_author(std::string_view author) {
  if (!author.starts_with(kSeatAuthor)) return 0;
  author.remove_prefix(kSeatAuthor.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(author.data(), author.data() + author.size(), number);
  return error == std::errc() && end == author.data() + author.size() ? number : 0;
}

std::string RoomState::author_of_seat(std::int64_t seat) { return std::string(kSeatAuthor) + std::to_string(seat); }

Json to_json(const RoomState& state) {
  Json json = Json::object();
  json["seats"] = map_to_json(state.seats, seat_to_json);
  json["areas"] = map_to_json(state.areas, area_to_json);
  json["phase"] = phase_to_json(state.phase);
  json["comments"] = map_to_json(state.comments, comment_to_json);
  json["proposals"] = map_to_json(state.proposals, proposal_to_json);
  json["scenarios"] = map_to_json(state.scenarios, [](const Scenario& scenario) {
    return Json{{"name", scenario.name},
                {"note", scenario.note},
                {"seat", scenario.seat},
                {"seq", scenario.seq},
                {"tick", scenario.tick}};
  });
  json["marks"] = Json::array();
  for (const Mark& mark : state.marks)
    json["marks"].push_back(
        {{"seat", mark.seat}, {"seq", mark.seq}, {"tick", mark.tick}, {"kind", mark.kind}, {"text", mark.text}});
  json["votes"] = map_to_json(state.votes, [](const OpenVote& vote) {
    return Json{{"ends_at", vote.ends_at}, {"secret", vote.is_secret}};
  });
  if (!state.opened.empty()) json["opened"] = state.opened;
  json["makers"] = map_to_json(state.makers, [](std::int64_t seat) { return Json(seat); });
  json["layout"] = state.layout;
  json["rate"] = state.rate;
  if (state.epoch != 1) json["epoch"] = state.epoch;
  if (state.key_renewals != 0) json["key_renewals"] = state.key_renewals;
  json["door"] = kDoorNames[static_cast<std::size_t>(state.door)];
  json["paused"] = state.is_paused;
  json["closed"] = state.is_closed;
  if (state.shares_minutes) json["shares_minutes"] = true;  // hashes of earlier logs stay
  return json;
}

std::uint64_t hash_of(const RoomState& state) {
  Hash hash;
  hash.add(std::string_view(write_json_line(to_json(state))));
  return hash.value();
}

}  // namespace bl::room
