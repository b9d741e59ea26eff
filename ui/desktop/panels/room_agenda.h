// What a room shows its people, read from its views: phase, votes, proposals, comments, seats.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/guest/room_guest.h"

namespace bl::desktop {

struct AgendaSeat {
  std::int64_t number = 0;
  std::string name, role, colour, card;
  std::vector<std::string> areas;
  bool is_here = false, is_muted = false;
};

struct AgendaVote {
  std::string id, question, kind, unit;
  double least = 0, most = 1;
  bool is_open = false, is_secret = false;
  std::int64_t count = 0, electorate = 0;
  std::string mine;                                    ///< of yes or no, and of a slider; empty: none, or secret
  std::vector<std::pair<std::string, double>> result;  ///< options with their shares; empty while it is hidden
};

struct AgendaProposal {
  std::string draft, title, why;
  std::int64_t seat = 0;
  std::vector<std::string> steps, conflicts, misfits;  ///< steps in words; what others have changed; what fits no more
};

struct AgendaComment {
  std::string id, text, node;
  std::int64_t seat = 0, plus = 0, minus = 0;
};

struct Agenda {
  std::string phase, door, layout, code;
  std::set<std::string> may;                 ///< activities that the phase allows
  std::vector<std::string> forms;            ///< what visitors may add in this phase
  std::int64_t ends_at = 0;                  ///< of the phase [ms since 1970]; 0: no timer
  bool is_known = false;                     ///< the room has shown something
  std::map<std::string, std::string> cards;  ///< role cards of the scene: id and name
  std::vector<AgendaSeat> seats;             ///< who is here first
  std::vector<AgendaVote> votes;             ///< open ones first
  std::vector<AgendaProposal> proposals;     ///< without a decision
  std::vector<AgendaComment> comments;       ///< without an answer
};

/// What a server says is read with care: what is missing or has another form is as if nobody had said it.
Agenda agenda_of(const guest::RoomGuest& room);

}  // namespace bl::desktop
