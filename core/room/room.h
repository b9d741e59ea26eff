// A session with many people: each operation is checked, applied and answered exactly once.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/define/json_text.h"
#include "core/room/drafts.h"
#include "core/room/operation.h"
#include "core/room/record.h"
#include "core/room/rights.h"
#include "core/room/secrets.h"
#include "core/session/ledger.h"

namespace bl::room {

/// A running state that was kept with a scenario.
struct KeptState {
  std::int64_t tick = 0;
  std::string hash;
};

struct RoomOptions {
  Allowances allowances = {};
  RandomBytes random = system_random_bytes;
  /// The running state of a scenario, where whoever holds the room has kept one. Without it no scenario can be returned to.
  std::function<std::optional<KeptState>(const std::string& scenario)> kept_state = {};
};

/// When something is said: the tick that will read it, and the host's clock, which decides about pens only and is stored for the
/// minutes.
struct Now {
  std::int64_t tick = 0;
  std::int64_t at = 0;  ///< [ms since 1970]
};

/// Something that was decided in front of all: a proposal that was accepted, a vote that was closed, a phase that was begun, a
/// way back, or what the minutes call a decision.
struct Decision {
  std::int64_t seq = 0, seat = 0;  ///< its entry, and who has decided
  std::int64_t at = 0;             ///< when, by the host's clock [ms since 1970]
  std::string kind = {};           ///< `proposal`, `vote`, `phase`, `restart`, `rewind` or `mark`
  std::string what = {};  ///< the draft, the node of the vote, the scenario; of `phase` and `mark` their words or their text
  bool operator==(const Decision&) const = default;
};

/// A seat that somebody gets.
struct Invitation {
  Role role = Role::participant;
  std::set<std::string> areas = {};
  std::string card = {};
  bool is_by_code = false;                             ///< by the code that everybody sees, not by an invitation of their own
  std::string name = {}, contact = {}, language = {};  ///< of the person, where they have said so; never part of the log
  std::int64_t consent_at = 0;
};
struct Admission {
  std::int64_t seat = 0;
  std::string token;  ///< opens the seat again; it is given once
};

/// The room of one ledger. It knows no clock, no socket and no disk: what has to be stored comes out of take_record(), and nobody
/// may be told of an answer before the record that it stands in is on the disk. Not for several threads.
class Room {
 public:
  /// The ledger must outlive the room, and from now on only the room changes it.
  Room(Ledger& ledger, RoomOptions options);
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  // Coming back from what was stored, before anything else is said.
  /// The next entry of the log. An error where it does not fit.
  Result<void> replay(const EntryRecord& record);
  /// All other rows, after the entries.
  void restore(const Record& rows);

  // People.
  /// Refused where the door is shut to whoever comes by the code, or the room is full.
  std::variant<Admission, Refusal> admit(const Invitation& invitation, Now now);
  /// The seat that a token opens; 0 where it opens none.
  std::int64_t seat_of_token(std::string_view token) const;
  /// A run of that seat is there: the number of its last operation that was answered. `last_known`: of the last one that the page
  /// has an answer for, which is the truth where a refusal was not stored before a crash. -1 where the run is somebody else's.
  std::int64_t greet(std::int64_t seat, const std::string& run, std::int64_t last_known);
  /// Of each run of that seat, the number of its last operation on a draft that was answered. After a start of the program it may
  /// be a later one, of something else.
  std::map<std::string, std::int64_t> last_of_drafts(std::int64_t seat) const;
  void note_presence(std::int64_t seat, bool is_here, Now now);
  /// Lets time pass: a pen whose holder does not answer, or has left, goes to whoever asked first.
  void pass(Now now);
  /// Could pass() do anything, sooner or later?
  bool waits_for_time() const;
  static constexpr std::int64_t kPenAnswer = 20000, kPenLeave = 30000;  // [ms]

  // What they say.
  Answer submit(std::int64_t seat, const Operation& operation, Now now);
  /// Readings and connections of devices of this machine, which need no seat.
  Result<void> submit_device(const Submission& submission, Now now);

  // What there is.
  const RoomState& state() const { return state_; }
  const Scene& scene() const { return ledger_->scene(); }
  /// The number of the last entry that has changed the scene; 0 where none has.
  std::int64_t scene_seq() const { return scene_seq_; }
  /// The entries after which the scene was as it is now, as ascending spans of their numbers: a rewind to one of them takes
  /// nothing back. Of the last kLookedBack entries that have changed the scene.
  std::vector<std::pair<std::int64_t, std::int64_t>> unchanged_since() const;
  static constexpr std::size_t kLookedBack = 1000;
  const std::map<std::string, Draft>& drafts() const { return drafts_; }
  /// A draft whose scene follows the head of the log, with what of it fits; it must be there.
  const Draft& follow_draft(const std::string& draft);
  /// Its scene.
  const Scene& scene_of(const std::string& draft);
  /// What a draft changes, and with whom it meets; the draft must be there.
  DraftSummary summary_of(const std::string& draft);
  /// The author of the last change of the place, or of the nearest place around it; empty where nobody has changed it.
  std::string last_writer(Touch place) const;
  /// The last ones, the newest first: what somebody who comes late has missed.
  const std::deque<Decision>& decisions() const { return decisions_; }
  static constexpr std::size_t kKeptDecisions = 5;
  /// How the step of a rewind is called; the number of the last entry that stays follows.
  static constexpr std::string_view kBackLabel = "Back to entry ";
  /// The scenario to whose running state the session has to go back, if what was said since the last call asks for that.
  std::string take_restart() { return std::exchange(restart_, {}); }
  /// The words of a comment, a reason, a note; nothing where there are none of that name.
  const TextRecord* text(const std::string& id) const;
  /// The same as words. Logs of earlier programs hold some titles themselves: of those it gives what it was asked.
  std::string words(const std::string& id) const;
  /// What has to be stored since the last call, in the order in which it was said.
  Record take_record() { return std::exchange(record_, {}); }

 private:
  struct Run {
    std::int64_t seat = 0, last = 0, last_of_draft = 0;
    std::deque<std::pair<std::int64_t, Answer>> answers;  // the last ones, ascending
    std::pair<std::int64_t, std::int64_t> gesture;        // the sender's number, and the ledger's
  };
  struct Said {
    std::int64_t seat;
    const Operation& operation;
    Now now;
    Source source() const { return {operation.run, operation.id}; }
    Author author() const { return RoomState::author_of_seat(seat); }
  };
  struct Write {
    std::int64_t seq = 0;
    std::string author;
  };

  /// How to take back an entry.
  struct WayBack {
    std::int64_t seq = 0;
    std::vector<Command> commands;
    std::int64_t same_as = -1;  ///< it has gone back itself: the scene after it is the one after this entry; -1: it has not
  };

  Answer decide(const Said& said);
  Answer say_command(const Said& said);
  Answer say_event(const Said& said);
  Answer take_back(const Said& said);
  Answer rewind(const Said& said);
  Answer restart(const Said& said, const EventDefinition& kind, const std::map<std::string, Value>& arguments);
  /// What takes back everything since that entry, in the order to apply.
  std::variant<std::vector<Command>, Refusal> way_back_to(std::int64_t seq) const;
  /// The index in `inverses_` of the last entry that has led to the scene after this one; -1: it is as it was before all of them.
  std::ptrdiff_t place_after(std::int64_t seq) const;
  /// What that entry has done.
  std::vector<Command> commands_of(std::size_t place) const;
  /// The entry to which this one has gone back; -1 where it has not.
  std::int64_t goes_back_to(const LogEntry& entry) const;
  Answer change_draft(const Said& said);
  Answer add_to_draft(const Said& said, const Command& command);
  Answer bring_back(const Said& said, Draft& draft);
  Answer accept(const Said& said, const EventDefinition& kind, const std::map<std::string, Value>& arguments);
  Answer enter_event(const Said& said, const EventDefinition& kind, std::map<std::string, Value> arguments);
  Answer cast_secretly(const Said& said, const Command& command);

  Result<Command> read_command(const Operation& operation) const;
  std::optional<Refusal> why_stale(const Operation& operation) const;
  std::int64_t gesture_of(const Said& said);
  Guard guard();
  /// Submits on behalf of the room itself or of somebody, without a check.
  Result<void> put(Submission submission, Now now, const std::string& draft = {}, std::int64_t by = 0);
  Result<void> note(const EventDefinition& kind, const std::map<std::string, Value>& arguments, const Author& author, Now now,
                    const Source& source);
  void note_as_room(const std::string& event, const std::map<std::string, Value>& arguments, Now now);
  void follow(const LogEntry& entry);
  void remember(const EntryRecord& record);
  Result<void> fold(const LogEntry& entry, std::string_view event, const Json& arguments);
  void store_texts(const EventDefinition& kind, std::map<std::string, Value>& arguments, std::int64_t seat);
  void after_event(const std::string& event, const std::map<std::string, Value>& arguments, const Said& said);
  void write_secret_ballots(const std::string& vote, Now now);
  void erase(std::int64_t seat);
  static bool is_of_draft(const Operation& operation);
  void answer(Run& run, const Operation& operation, const Answer& answer);
  Acknowledgement done(const Now& now) const { return {ledger_->last_seq(), now.tick}; }
  Asking asking(std::int64_t seat, bool is_in_draft = false) const {
    return {ledger_->registry(), state_, options_.allowances, seat, is_in_draft};
  }
  Draft* draft_of(const Said& said, const std::string& id);

  Ledger* ledger_;
  RoomOptions options_;
  RoomState state_;
  Record record_;
  std::map<std::string, Run> runs_;
  std::map<std::string, std::int64_t> tokens_;  // by digest
  std::map<std::string, Draft> drafts_;
  std::map<std::string, TextRecord> texts_;
  std::map<std::string, std::string> ballot_keys_;                          // by vote
  std::map<std::string, std::map<std::string, JsonValue>> secret_ballots_;  // by vote, then ballot: not yet in the log
  std::map<Touch, Write> writes_;                                           // the last entry that has written a place
  std::deque<WayBack> inverses_;                                            // of the last entries, ascending
  std::map<std::string, std::int64_t> asked_at_;                            // by area: since when somebody asks for its pen
  std::map<std::int64_t, std::int64_t> left_at_;                            // by seat: since when it is empty
  std::deque<Decision> decisions_;
  // Of the entry that is being made.
  std::vector<Touch> touches_;
  std::vector<Command> inverse_;
  std::string restart_;
  std::int64_t text_count_ = 0, scene_seq_ = 0;
};

}  // namespace bl::room
