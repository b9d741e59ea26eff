// The parts of the tab Room.
#pragma once

#include <string>

#include "ui/desktop/panels/panel_memory.h"
#include "ui/desktop/panels/room_agenda.h"

namespace bl::desktop {

/// What the parts of the tab share in a frame.
struct RoomDesk {
  Workbench& editor;
  guest::RoomGuest& room;
  const Agenda& agenda;
  bool leads = false;   ///< this person is a facilitator
  std::string why_not;  ///< why nothing can be said now; empty where it can

  /// A button, greyed with the reason where `why` is not empty, or where nothing can be said. `key`: for note_place.
  bool button(const std::string& label, const std::string& key, const std::string& why = "") const;
  /// A button that asks before: whether people have said yes.
  bool sure_button(const std::string& label, const std::string& key, const std::string& question, const std::string& yes) const;
  /// A line to type into; its text lives as long as the document is open.
  std::string& text(const std::string& field) const;
  void heading(const char* words) const;
  void quiet(const std::string& words) const;
  /// What has this label comes on the same line, where the column is wide enough for it.
  void same_line_for(const std::string& label) const;
  std::string seat_name(std::int64_t seat) const;
  void say(const std::string& event, const JsonValue& arguments) const { room.say_event(event, arguments); }
};

/// Who has which pen, and what one can do about it.
void draw_pens(Workbench& editor, guest::RoomGuest& room);
/// Votes with their ballots and results; facilitators open and close them.
void draw_votes(const RoomDesk& desk);
/// The form of one's own ballot.
void draw_ballot(const RoomDesk& desk, const AgendaVote& vote);

/// The own drafts: to begin one, to work in it, to propose and to discard it.
void draw_drafts(const RoomDesk& desk);
/// What has come of a draft that the server tries: its figures, and its plan beside the one of now; and what others have changed
/// since.
void draw_trial(const RoomDesk& desk, const AgendaProposal& draft);

// Of facilitators:
/// Phase and pace.
void draw_leading(const RoomDesk& desk);
/// The phases that they have planned, and how the room and its computer are.
void draw_plan(const RoomDesk& desk);
void draw_health(const RoomDesk& desk);
/// A vote from a template.
void draw_new_vote(const RoomDesk& desk);
/// What waits for a decision, and what was decided.
void draw_proposals(const RoomDesk& desk);
void draw_comments(const RoomDesk& desk);
/// Door, beamer, minutes and the end.
void draw_house(const RoomDesk& desk);
/// Of facilitators, below somebody's name.
void draw_seat_menu(const RoomDesk& desk, const AgendaSeat& seat);
/// The address with its QR code.
void draw_address(const RoomDesk& desk);

}  // namespace bl::desktop
