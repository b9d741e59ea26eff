// What a room shows its people, read from its views: phase, votes, proposals, comments, seats.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/guest/room_guest.h"
#include "core/vote/ballot.h"
#include "core/vote/count.h"

namespace bl::desktop {

struct AgendaSeat {
  std::int64_t number = 0;
  std::string name, role, colour, card;
  std::vector<std::string> areas;
  bool is_here = false, is_muted = false;
};

struct AgendaVote {
  std::string id, question, unit;
  vote::Question asks;  ///< what a ballot has to fit
  bool is_open = false, is_secret = false;
  std::int64_t count = 0, electorate = 0;
  std::optional<vote::Ballot> mine;    ///< none where there is none, and where the vote is secret
  std::vector<vote::Tally> result;     ///< empty while it is hidden
  std::string leading;                 ///< an option
  std::optional<double> mean, median;  ///< of a slider, where the result is shown
};

struct AgendaStep {
  std::int64_t number = 0;    ///< in the draft, from 0
  std::string words, misfit;  ///< why it fits no more; empty where it fits
};
/// Somebody has changed since what the draft changes as well.
struct AgendaConflict {
  std::string label, by, live, drafted;  ///< values in words; empty where they are long
};
struct AgendaFigure {
  std::string name, unit, status;
  std::optional<double> before, after;
};
struct AgendaProposal {
  std::string draft, title, why;
  std::int64_t seat = 0, kept = 0, count = 0;  ///< whose it is; steps that were taken, of how many
  bool is_decided = false, is_accepted = false;
  std::vector<AgendaStep> steps;
  std::vector<AgendaConflict> conflicts;
  std::string trial;                  ///< how far it is tried, as a sentence; empty where it is not
  std::vector<AgendaFigure> figures;  ///< without it, and with it
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
  std::vector<AgendaProposal> proposals;     ///< those without a decision first
  std::vector<AgendaProposal> drafts;        ///< of this seat, which can still be changed; nobody else sees them
  std::vector<AgendaComment> comments;       ///< without an answer
};

/// The words of an option; those of a ballot of yes or no are fixed.
std::string option_words(const AgendaVote& vote, const std::string& option);
/// What a server says is read with care: what is missing or has another form is as if nobody had said it.
Agenda agenda_of(const guest::RoomGuest& room);

}  // namespace bl::desktop
