// What people say that changes no scene: events, and what the room itself does because of them.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/words.h"
#include "core/define/codec.h"
#include "core/room/refusals.h"
#include "core/room/room.h"

namespace bl::room {

namespace {

const Author kRoomItself{"room", AuthorKind::program};
constexpr const char* kPseudonyms[] = {"Heron",  "Otter", "Lynx", "Badger", "Kestrel", "Marten", "Plover",
                                       "Beaver", "Stork", "Hare", "Newt",   "Raven",   "Weasel", "Curlew",
                                       "Stoat",  "Wren",  "Ibex", "Carp",   "Vole",    "Owl"};
// Told apart by people who see few colours: Okabe and Ito, 2008.
constexpr const char* kColours[] = {"#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"};

template <class T>
T value_of(const std::map<std::string, Value>& arguments, const char* name, T otherwise) {
  const auto found = arguments.find(name);
  return found == arguments.end() ? otherwise : std::get<T>(found->second);
}

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::optional<Refusal> why_bad_words(const EventDefinition& kind, const std::map<std::string, Value>& arguments) {
  for (const auto& [name, value] : arguments) {
    const auto* text = std::get_if<std::string>(&value);
    if (text == nullptr) continue;
    const bool is_words = holds(kind.words, name) && !holds(kind.titles, name);
    const std::size_t most = is_words ? kLongestText : 200;
    if (text->size() > most)
      return refuse(Reason::size, "arguments/" + name, "has " + std::to_string(most) + " characters at most", {{"most", most}});
    if (!is_harmless(*text)) return refuse(Reason::bad, "arguments/" + name, "holds control characters or marks of direction");
  }
  return std::nullopt;
}

}  // namespace

Answer Room::say_event(const Said& said) {
  const auto content = said.operation.content.read();
  if (!content) return refusal_of(Reason::bad, content.error());
  if (!(**content).is_object()) return refuse(Reason::bad, "e", "expects an object with `event` and `arguments`");
  if (auto keys = check_keys(**content, {"event", "arguments"}, ""); !keys) return refusal_of(Reason::bad, keys.error());
  const Json name = (**content).value("event", Json());
  const auto kind = name.is_string() ? event_kinds().find(name.get_ref<const std::string&>()) : event_kinds().end();
  if (kind == event_kinds().end()) return refuse(Reason::bad, "event", "there is no such event");
  if (auto refusal = why_not(asking(said.seat), kind->second)) return *refusal;
  static const Json kNone = Json::object();
  auto arguments =
      ports_from_json(kind->second, (**content).contains("arguments") ? (**content)["arguments"] : kNone, "arguments");
  if (!arguments) return refusal_of(Reason::bad, arguments.error());
  for (auto& [argument, value] : *arguments)
    if (auto* text = std::get_if<std::string>(&value)) *text = composed(*text);
  if (auto refusal = why_bad_words(kind->second, *arguments)) return *refusal;
  if (kind->first == "decide_proposal" && value_of(*arguments, "is_accepted", false))
    return accept(said, kind->second, *arguments);
  if (kind->first == "restart") return restart(said, kind->second, *arguments);
  if (kind->first == "propose") {
    Draft* draft = draft_of(said, value_of<std::string>(*arguments, "draft", ""));
    if (draft == nullptr) return refuse(Reason::gone, "arguments/draft", "there is no such draft of yours");
    if (draft->step_count() == 0) return refuse(Reason::conflict, "arguments/draft", "a draft without steps proposes nothing");
    (*arguments)["steps"] = draft->step_count();
  }
  return enter_event(said, kind->second, std::move(*arguments));
}

// Tried on a copy first: an event that the room cannot take leaves no text behind.
Answer Room::enter_event(const Said& said, const EventDefinition& kind, std::map<std::string, Value> arguments) {
  std::vector<Value> values;
  for (const PortDefinition& port : kind.ports)
    values.push_back(arguments.contains(port.id) ? arguments.at(port.id) : port.default_value);
  RoomState trial = state_;
  if (auto fits = kind.apply(trial, values, {ledger_->last_seq() + 1, said.now.tick, said.seat, scene()}); !fits)
    return refusal_of_scene(fits.error());
  store_texts(kind, arguments, said.seat);
  if (auto noted = note(kind, arguments, said.author(), said.now, said.source()); !noted) return refusal_of_scene(noted.error());
  after_event(kind.id, arguments, said);
  return done(said.now);
}

void Room::store_texts(const EventDefinition& kind, std::map<std::string, Value>& arguments, std::int64_t seat) {
  for (const std::string& name : kind.words) {
    const auto words = arguments.find(name);
    if (words == arguments.end() || std::get<std::string>(words->second).empty()) continue;
    if (holds(kind.titles, name)) {
      const auto same = std::find_if(texts_.begin(), texts_.end(), [&](const auto& one) {
        const TextRecord& text = one.second;
        return text.seat == seat && text.kind == kind.id + "." + name && !text.is_erased &&
               text.body == std::get<std::string>(words->second);
      });
      if (same != texts_.end()) {
        words->second = same->first;
        continue;
      }
    }
    TextRecord text{.id = "text" + std::to_string(++text_count_),
                    .seat = seat,
                    .kind = kind.id + "." + name,
                    .body = std::get<std::string>(words->second)};
    words->second = text.id;
    record_.texts.push_back(text);
    texts_[text.id] = std::move(text);
  }
}

Result<void> Room::note(const EventDefinition& kind, const std::map<std::string, Value>& arguments, const Author& author, Now now,
                        const Source& source) {
  Json event = Json::object();
  event["event"] = kind.id;
  event["arguments"] = ports_to_json(kind, arguments);
  if (auto noted = ledger_->note_event(JsonValue::of(event), author, now.tick, source); !noted) return noted;
  record_.entries.push_back({ledger_->log().back(), now.at});
  if (auto folded = fold(ledger_->log().back(), kind.id, event["arguments"]); !folded) return folded;
  remember(record_.entries.back());
  return {};
}

void Room::note_as_room(const std::string& event, const std::map<std::string, Value>& arguments, Now now) {
  // The room says only what fits it.
  (void)note(event_kinds().at(event), arguments, kRoomItself, now, {});
}

Result<void> Room::fold(const LogEntry& entry, std::string_view event, const Json& arguments) {
  const auto kind = event_kinds().find(event);
  if (kind == event_kinds().end())
    return Error{ErrorCode::unknown_type, "event", "there is no event `" + std::string(event) + "`"};
  auto read = ports_from_json(kind->second, arguments, "arguments");
  if (!read) return read.error();
  std::vector<Value> values;
  for (const PortDefinition& port : kind->second.ports)
    values.push_back(read->contains(port.id) ? read->at(port.id) : port.default_value);
  return kind->second.apply(state_, values, {entry.seq, entry.tick, RoomState::seat_of_author(entry.author.id), scene()});
}

// --- What follows from an event -------------------------------------------------------------------------------------

void Room::after_event(const std::string& event, const std::map<std::string, Value>& arguments, const Said& said) {
  const auto name = [&](const char* argument) { return value_of<std::string>(arguments, argument, ""); };
  const auto set_open = [&](const std::string& vote, bool is_open) {
    (void)put({.command = command<SetPort>({vote, {"vote.is_open"}, JsonValue::of(is_open)}), .author = kRoomItself}, said.now);
  };
  if (event == "propose" || event == "decide_proposal") {
    const auto draft = drafts_.find(name("draft"));
    if (draft == drafts_.end()) return;
    draft->second.set_state(event == "propose"                          ? DraftState::proposed
                            : value_of(arguments, "is_accepted", false) ? DraftState::accepted
                                                                        : DraftState::open);
    record_.drafts.push_back(draft->second.record());
  } else if (event == "open_vote") {
    if (state_.votes.at(name("vote")).is_secret) {
      ballot_keys_[name("vote")] = hex_of(options_.random(32));
      record_.ballot_keys.push_back({name("vote"), ballot_keys_.at(name("vote"))});
    }
    set_open(name("vote"), true);
  } else if (event == "close_vote") {
    set_open(name("vote"), true);  // whatever was done to the node by hand: ballots that were taken are counted
    write_secret_ballots(name("vote"), said.now);
    set_open(name("vote"), false);
    if (ballot_keys_.erase(name("vote")) > 0) record_.ballot_keys.push_back({name("vote"), ""});
  } else if (event == "ask_pen") {
    const Area& area = state_.areas.at(name("area"));
    if (area.asking.empty()) asked_at_.erase(name("area"));
    else asked_at_.try_emplace(name("area"), said.now.at);
  } else if (event == "give_pen") {
    asked_at_.erase(name("area"));
    if (!state_.areas.at(name("area")).asking.empty()) asked_at_[name("area")] = said.now.at;
  } else if (event == "forget") {
    erase(value_of<std::int64_t>(arguments, "seat", 0));
  } else if (event == "remove_seat") {
    const std::int64_t seat = value_of<std::int64_t>(arguments, "seat", 0);
    std::erase_if(tokens_, [seat](const auto& token) { return token.second == seat; });
    record_.tokens.push_back({seat, ""});
  }
}

// The number of a seat stays, so that the fold of the log is the same; its name in the log is a pseudonym.
void Room::erase(std::int64_t seat) {
  std::erase_if(tokens_, [seat](const auto& token) { return token.second == seat; });
  record_.tokens.push_back({seat, ""});
  record_.persons.push_back({.seat = seat, .name = {}, .contact = {}, .language = {}, .consent_at = 0});
  for (auto& [id, text] : texts_) {
    if (text.seat != seat) continue;
    text.body = "[erased]";
    text.is_erased = true;
    record_.texts.push_back(text);
  }
  for (auto& [id, draft] : drafts_) {
    if (draft.seat() != seat || draft.title().empty()) continue;
    draft.set_title("[erased]");
    record_.drafts.push_back(draft.record());
  }
}

// --- Secret ballots -------------------------------------------------------------------------------------------------

namespace {

Command secret_cast(const std::string& vote, const std::string& id, const JsonValue& ballot) {
  return command<CastVote>({vote, "ballot " + id, ballot});
}

}  // namespace

// The ballot is stored under a name that says nothing without the key, and the log gets it without person, time and order.
Answer Room::cast_secretly(const Said& said, const Command& command) {
  const std::string vote = std::get<std::string>(command.arguments.at("node"));
  const std::string id = keyed_digest_of(ballot_keys_.at(vote), std::to_string(said.seat), 12);
  const auto ballot = command.arguments.find("ballot");
  const JsonValue content = ballot == command.arguments.end() ? JsonValue::null() : std::get<JsonValue>(ballot->second);
  auto& waiting = secret_ballots_[vote];
  const bool withdraws_waiting = content.is_null() && waiting.contains(id);
  if (!withdraws_waiting) {
    Scene trial = scene();
    SceneEdit edit(trial, ledger_->registry());
    if (auto fits = bl::apply(edit, secret_cast(vote, id, content)); !fits) return refusal_of_scene(fits.error());
  }
  waiting[id] = content;
  record_.secret_ballots.push_back({vote, id, content});
  static constexpr std::size_t kTogether = 3;
  if (waiting.size() >= kTogether) write_secret_ballots(vote, said.now);
  return done(said.now);
}

// In the order of their names, which is a shuffled one. A ballot that fits the question no more is told in the minutes.
void Room::write_secret_ballots(const std::string& vote, Now now) {
  const auto waiting = secret_ballots_.find(vote);
  if (waiting == secret_ballots_.end()) return;
  std::size_t misfits = 0;
  for (const auto& [id, ballot] : waiting->second) {
    const auto put_in =
        put({.command = secret_cast(vote, id, ballot), .author = Author("ballots", AuthorKind::program)}, {now.tick, 0});
    // Who has given a ballot and withdrawn it before it was written has none to withdraw.
    const bool is_missing = !put_in && !(ballot.is_null() && put_in.error().code == ErrorCode::not_found);
    misfits += is_missing ? 1 : 0;
  }
  secret_ballots_.erase(waiting);
  std::erase_if(record_.secret_ballots, [&vote](const SecretBallotRecord& ballot) { return ballot.vote == vote; });
  record_.ballots_in_log.push_back(vote);
  if (misfits == 0) return;
  const EventDefinition& mark = event_kinds().at("mark");
  std::map<std::string, Value> told{
      {"kind", std::string("ballots")},
      {"text", "Secret ballots of `" + vote +
                   "` that are not counted, because the question was changed after they were given: " + std::to_string(misfits)}};
  store_texts(mark, told, 0);
  (void)note(mark, told, kRoomItself, now, {});
}

// --- People ---------------------------------------------------------------------------------------------------------

std::variant<Admission, Refusal> Room::admit(const Invitation& invitation, Now now) {
  if (state_.is_closed) return refuse(Reason::closed, "", "the session is over");
  if (invitation.is_by_code && state_.door == Door::shut)
    return refuse(Reason::closed, "", "the door of this room is shut; ask the facilitator");
  // Words of the person's own; an invitation is no place for a letter.
  const std::string own_name = composed(invitation.name), contact = composed(invitation.contact);
  for (const std::string* text : {&own_name, &contact, &invitation.language})
    if (text->size() > 4 * kLongestName || !is_harmless(*text))
      return refuse(Reason::bad, "name",
                    "a name has " + std::to_string(kLongestName) + " characters at most, and no hidden marks");
  if (state_.seats.size() >= kMostSeats)
    return refuse(Reason::size, "", "the room has " + std::to_string(kMostSeats) + " seats, and all are taken");
  const bool only_watches = invitation.is_by_code && state_.door == Door::asks;
  const Role role = only_watches ? Role::viewer : invitation.role;
  const std::int64_t seat = state_.seats.empty() ? 1 : state_.seats.rbegin()->first + 1;
  const auto index = static_cast<std::size_t>(seat - 1);
  std::string name = kPseudonyms[index % std::size(kPseudonyms)];
  if (index >= std::size(kPseudonyms)) name += " " + std::to_string(index / std::size(kPseudonyms) + 1);
  std::map<std::string, Value> arguments{{"seat", seat},
                                         {"role", std::string(kRoleNames[static_cast<std::size_t>(role)])},
                                         {"name", name},
                                         {"colour", std::string(kColours[index % std::size(kColours)])},
                                         {"card", invitation.card}};
  // Who is to watch only, such as a beamer, waits for nothing.
  arguments["waits"] = only_watches && invitation.role != Role::viewer;
  arguments["areas"] = Shared<std::vector<std::string>>({invitation.areas.begin(), invitation.areas.end()});
  note_as_room("join", arguments, now);
  Admission admission{seat, hex_of(options_.random(16))};
  const std::string digest = digest_of(admission.token);
  tokens_[digest] = seat;
  record_.tokens.push_back({seat, digest});
  if (!own_name.empty() || !contact.empty() || !invitation.language.empty())
    record_.persons.push_back({seat, own_name, contact, invitation.language, invitation.consent_at});
  return admission;
}

std::int64_t Room::seat_of_token(std::string_view token) const {
  const auto found = tokens_.find(digest_of(token));
  return found == tokens_.end() || state_.seat(found->second) == nullptr ? 0 : found->second;
}

void Room::note_presence(std::int64_t seat, bool is_here, Now now) {
  const Seat* known = state_.seat(seat);
  if (known == nullptr || known->is_here == is_here) return;
  if (is_here) left_at_.erase(seat);
  else left_at_[seat] = now.at;
  note_as_room("presence", {{"seat", seat}, {"is_here", is_here}}, now);
}

bool Room::waits_for_time() const {
  return std::any_of(state_.areas.begin(), state_.areas.end(), [&](const auto& one) {
    const Area& area = one.second;
    return !area.asking.empty() || (area.pen != 0 && left_at_.contains(area.pen));
  });
}

void Room::pass(Now now) {
  std::vector<std::pair<std::string, std::int64_t>> given;
  for (const auto& [name, area] : state_.areas) {
    if (area.pen == 0) {  // it was laid down while somebody asked
      if (!area.asking.empty()) given.emplace_back(name, area.asking.front());
      continue;
    }
    const auto asked = asked_at_.find(name);
    const auto left = left_at_.find(area.pen);
    const bool is_silent = asked != asked_at_.end() && !area.asking.empty() && now.at - asked->second >= kPenAnswer;
    const bool is_gone = left != left_at_.end() && now.at - left->second >= kPenLeave;
    if (is_silent || is_gone) given.emplace_back(name, area.asking.empty() ? 0 : area.asking.front());
  }
  for (const auto& [name, seat] : given) {
    note_as_room("give_pen", {{"area", name}, {"seat", seat}}, now);
    asked_at_.erase(name);
    if (!state_.areas.at(name).asking.empty()) asked_at_[name] = now.at;
  }
}

}  // namespace bl::room
