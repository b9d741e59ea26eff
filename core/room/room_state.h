// What people have said about each other and about the session: the fold of the events of a room.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/vector.h"
#include "core/define/rights.h"
#include "core/define/value.h"

namespace bl::room {

/// A place at the table. It stays where its person comes and goes.
struct Seat {
  Role role = Role::viewer;
  std::string name = {};             ///< a pseudonym, such as an animal; the person's name is not part of the room
  std::string colour = {};           ///< such as `#1b9e77`
  std::set<std::string> areas = {};  ///< what a designer may change
  std::string card = {};             ///< node with the role card; empty: none
  bool is_here = false, is_muted = false, is_removed = false;
  bool is_waiting = false;  ///< came while the door asked, and has not been given a role yet
  bool operator==(const Seat&) const = default;
};

/// A part of the scene: nodes by name, type or tag, and those that stand inside an outline.
struct Area {
  Selection nodes = {};
  std::vector<Point3> outline = {};       ///< in plan; empty: none
  std::int64_t pen = 0;                   ///< the seat that alone may change it now; 0: all whose area it is
  std::vector<std::int64_t> asking = {};  ///< seats that have asked for the pen, the first one first
  bool operator==(const Area&) const = default;
};

struct Phase {
  std::string name = {};
  std::set<Activity> activities = {Activity::change, Activity::draft, Activity::comment, Activity::vote};
  std::set<std::string> forms = {};  ///< typifications whose nodes participants may add: a visitor's form
  std::int64_t ends_at = 0;          ///< what the timer shows [ms since 1970]; 0: no timer
  bool operator==(const Phase&) const = default;
};

/// What a comment is pinned to; a comment that names nothing is about the whole.
struct Anchor {
  std::string node = {}, scenario = {};
  std::optional<Vector3> place = {};
  std::optional<std::int64_t> tick = {};
  bool operator==(const Anchor&) const = default;
};

enum class CommentState : std::uint8_t { open, accepted, rejected };
inline constexpr std::string_view kCommentStateNames[] = {"open", "accepted", "rejected"};

/// Its words are not part of the room's state: `text` and `answer` name them, so that they can be erased.
struct Comment {
  std::int64_t seat = 0;
  std::string text = {}, parent = {};
  Anchor anchor = {};
  std::map<std::int64_t, int> ratings = {};  ///< by seat, -1 or 1
  CommentState state = CommentState::open;
  std::string answer = {};
  bool operator==(const Comment&) const = default;
};

enum class ProposalState : std::uint8_t { proposed, accepted, rejected, withdrawn };
inline constexpr std::string_view kProposalStateNames[] = {"proposed", "accepted", "rejected", "withdrawn"};

/// A draft that its owner has shown to the facilitator.
struct Proposal {
  std::int64_t seat = 0;
  std::string title = {}, why = {};  ///< `why` and `answer` name texts
  ProposalState state = ProposalState::proposed;
  std::int64_t by = 0;  ///< who decided
  std::string answer = {};
  std::int64_t steps = 0, kept = 0;  ///< of the accepted ones: how many steps it had, and how many were taken
  bool operator==(const Proposal&) const = default;
};

/// A state of the scene that people want to come back to.
struct Scenario {
  std::string name = {}, note = {};  ///< `note` names a text
  std::int64_t seat = 0, seq = 0, tick = 0;
  bool operator==(const Scenario&) const = default;
};

/// Something for the minutes: a decision, or whatever the recorder marks.
struct Mark {
  std::int64_t seat = 0, seq = 0, tick = 0;
  std::string kind = {}, text = {};
  bool operator==(const Mark&) const = default;
};

/// A vote that is open: who has voted, where the ballots themselves are secret.
struct OpenVote {
  std::int64_t ends_at = 0;  ///< what the timer shows [ms since 1970]; 0: no timer
  bool is_secret = false;
  bool operator==(const OpenVote&) const = default;
};

enum class Door : std::uint8_t { open, asks, shut };
inline constexpr std::string_view kDoorNames[] = {"open", "asks", "shut"};

struct RoomState {
  std::map<std::int64_t, Seat> seats = {};  ///< by number, from 1
  std::map<std::string, Area> areas = {};
  Phase phase = {};
  std::map<std::string, Comment> comments = {};
  std::map<std::string, Proposal> proposals = {};  ///< by draft
  std::map<std::string, Scenario> scenarios = {};
  std::vector<Mark> marks = {};
  std::map<std::string, OpenVote> votes = {};       ///< by node
  std::set<std::string> opened = {};                ///< votes that are or have been open, by node
  std::map<std::string, std::int64_t> makers = {};  ///< the seat that has added a node or link, by `nodes/…` or `links/…`
  std::string layout = {};                          ///< of the beamer
  double rate = 10;                                 ///< ticks a second
  std::int64_t epoch = 1;                           ///< grows with each return to a scenario: the ticks go back
  std::int64_t key_renewals = 0;                    ///< how often the keys of invitations were made anew
  Door door = Door::open;
  bool is_paused = false, is_closed = false;
  bool shares_minutes = false;  ///< of a closed room: whoever took part may open its minutes
  bool operator==(const RoomState&) const = default;

  const Seat* seat(std::int64_t number) const;
  /// The seat of an author of the log; 0 where it is none.
  static std::int64_t seat_of_author(std::string_view author);
  static std::string author_of_seat(std::int64_t seat);
};

/// A hash of all of it, so that two folds can be compared.
std::uint64_t hash_of(const RoomState& state);

}  // namespace bl::room
