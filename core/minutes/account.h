// What a session file says of a session, in the order in which it happened.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/define/registry.h"
#include "core/journal/rows.h"
#include "core/room/answer.h"
#include "core/room/room_state.h"
#include "core/vote/count.h"

namespace bl::minutes {

/// An entry of the log, its tick, and when it came by the host's clock [ms since 1970]; 0: no time was kept.
struct Moment {
  std::int64_t seq = 0, tick = 0, at = 0;
};

/// Somebody's own ballot. Only votes that were never secret have any.
struct NamedBallot {
  std::string voter, answer;
};

/// A vote from its opening to its close. A vote that is opened again has a second round.
struct Round {
  std::string vote;
  std::int64_t number = 1;
  Moment opened = {};
  std::optional<Moment> closed = {};
  bool is_secret = false;
  /// Off where the vote is still open and shows its result only when closed: then there is no result here.
  bool is_shown = true;
  std::string question = {}, kind = {};
  std::int64_t electorate = 0;  ///< how many may vote; 0: not known
  std::int64_t seats = 0;       ///< people who had a seat when it was counted
  std::int64_t waiting = 0;     ///< secret ballots, or changes of them, that are stored and not yet counted
  std::size_t uncounted = 0;    ///< ballots that do not fit the question
  vote::Outcome outcome =
      {};  ///< as it was at the close; of an open vote at the end of the file. Without its refusals, which name voters
  std::vector<NamedBallot> ballots = {};
  std::string problem = {};  ///< why it could not be counted
};

struct PhaseSpan {
  room::Phase phase;
  Moment begin = {};
  std::optional<Moment> end = {};  ///< none: until the end of the file
};

/// A draft may be proposed again after it was rejected: then it has several of these.
struct Proposed {
  std::string draft;
  Moment moment = {};
  room::Proposal proposal = {};
  std::optional<Moment> decided = {};
};

struct Commented {
  std::string id;
  Moment moment = {};
  std::int64_t answered_by = 0;  ///< the seat of the last answer; 0: nobody
};

/// An indicator at the moment of a scenario.
struct SavedFigure {
  std::string name, unit, status;
  double value = 0;
};

struct Saved {
  std::string id;
  Moment moment = {};
  std::string scene = {};                 ///< the scene file after the entries up to this one
  std::vector<SavedFigure> figures = {};  ///< of the running state that was kept with it
  std::string file() const;
};

/// Nothing in here comes from a clock, and no names of persons: people have pseudonyms.
struct Account {
  std::string code, title;
  std::int64_t created = 0;  ///< [ms since 1970]
  int zone = 0;              ///< of the times in the minutes: so far ahead of UTC [min]
  room::RoomState state = {};
  std::map<std::int64_t, Moment> joined = {};  ///< by seat
  std::vector<PhaseSpan> phases = {};
  std::vector<Moment> marks = {};  ///< beside `state.marks`
  std::vector<Proposed> proposals = {};
  std::vector<Round> rounds = {};
  std::vector<Commented> comments = {};
  std::vector<Saved> scenarios = {};
  std::string last_scene = {};                ///< the scene file after all entries
  std::map<room::Reason, int> refusals = {};  ///< how many of each that are stored
  std::map<std::string, std::string> texts = {};
  std::optional<Moment> first = {}, last = {};  ///< of the entries that have a time
  std::string log = {};                         ///< as `replay` reads it
  std::string chain = {};                       ///< the hash of all entries
  std::size_t entries = 0;

  /// The words of a comment, a reason or a note: "[erased]" where they were erased, nothing where nothing was said.
  std::string words(const std::string& text) const;
  /// Of a title; logs of earlier programs hold some themselves.
  std::string title_words(const std::string& text) const { return texts.contains(text) ? words(text) : text; }
  /// "2026-03-01 09:30 UTC"; empty where no time was kept.
  std::string time_of(const Moment& moment) const;
  /// "tick 120, 2026-03-01 09:30 UTC".
  std::string when(const Moment& moment) const;
  /// "Heron (seat 1)"; seat 0 is the room itself.
  std::string who(std::int64_t seat) const;
  std::string pseudonym(std::int64_t seat) const;
};

/// How many have given the comment this rating: 1 agrees, -1 disagrees.
std::int64_t ratings_of(const room::Comment& comment, int rating);

/// Folds all entries again by the room that has made them (core/room). Damage is an error.
Result<Account> account_of(const journal::RoomRow& room, const journal::Loaded& loaded, const Registry& registry);

}  // namespace bl::minutes
