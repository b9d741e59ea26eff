// A session with everything that minutes tell, and its session file.
#pragma once

#include <string>

#include "core/journal/journal.h"
#include "tests/core/room/room_world.h"

namespace bl::minutes {

inline constexpr const char* kErasedName = "Beatrix Quillfeather";
inline constexpr const char* kErasedWords = "willow";

/// Two phases, three proposals of two drafts, an open and a secret vote, a vote that is opened again, comments, marks, a
/// scenario, refusals, and a person who was erased.
struct ToldSession {
  room::RoomWorld world;
  std::int64_t lead = 0, anna = 0, ben = 0, cem = 0;
  Scene at_scenario;  ///< when it was saved

  ToldSession() {
    world.at = 1772357400000;  // 2026-03-01 09:30 UTC
    lead = world.seat(Role::facilitator);
    const auto admitted = world.room().admit(
        {.role = Role::stakeholder, .name = kErasedName, .contact = "bea.q@example.org", .consent_at = world.at}, world.now());
    anna = std::get<room::Admission>(admitted).seat;
    world.store();
    ben = world.seat(Role::stakeholder);
    cem = world.seat(Role::participant);
    tell_first_phase();
    tell_second_phase();
    said(world.event(lead, "mark", R"({"kind": "task", "text": "=Ask the owner\nof the yard"})"));
    said(world.event(lead, "open_vote", R"({"vote": "poll"})"));
    said(ballot(cem, "poll", "\"yes\""));
    said(world.event(lead, "forget", R"({"seat": 2})"));
  }

  /// Stores everything in a new session file.
  void store(const std::string& path, const std::string& code = "BRKT") const {
    auto journal = journal::Journal::create(
        path, {.code = code, .title = "Quarter <north>", .scene = room::kTable, .created = 1772357000000}, full_registry(), {});
    ASSERT_TRUE(journal) << journal.error().text();
    const auto stored = (*journal)->commit(world.disk);
    ASSERT_TRUE(stored) << stored.error().text();
    ASSERT_TRUE((*journal)->close());
  }

 private:
  void said(const room::Answer& answer) {
    EXPECT_EQ(room::sentence(answer), "");
    world.tick += 10;
    world.at += 60000;
  }
  room::Answer ballot(std::int64_t seat, const char* poll, const char* answer) {
    return world.command(seat, command<CastVote>({poll, room::RoomState::author_of_seat(seat), {answer}}));
  }
  void tell_first_phase() {
    said(world.event(lead, "set_phase", R"({"name": "Look around"})"));
    said(world.event(lead, "mark", R"({"text": "The park stays"})"));
    said(world.event(anna, "comment", R"({"id": "c1", "text": "Keep the willow <here> & there", "node": "north"})"));
    said(world.event(ben, "comment", R"({"id": "a2", "text": "It is \"hollow\", see\nthe photo", "parent": "c1"})"));
    said(world.event(cem, "comment", R"({"id": "b3", "text": "Lower, please", "place": [[1, 2.5, 0]], "tick": 3})"));
    said(world.event(ben, "rate_comment", R"({"comment": "c1", "rating": 1})"));
    said(world.event(cem, "rate_comment", R"({"comment": "c1", "rating": -1})"));
    said(world.event(anna, "rate_comment", R"({"comment": "b3", "rating": 1})"));
    said(world.event(lead, "answer_comment", R"({"comment": "b3", "state": "accepted", "answer": "We follow it"})"));
    EXPECT_EQ(room::why(world.command(anna, room::set_demand("north", 5))), "right");
    EXPECT_EQ(room::why(world.command(cem, room::set_demand("north", 5))), "right");
    EXPECT_EQ(room::why(world.event(cem, "rate_comment", R"({"comment": "none", "rating": 1})")), "gone");
    said(world.event(lead, "open_vote", R"({"vote": "poll"})"));
    said(ballot(anna, "poll", "\"yes\""));
    said(ballot(ben, "poll", "\"no\""));
    said(ballot(anna, "poll", "\"no\""));
    said(world.event(lead, "close_vote", R"({"vote": "poll"})"));
  }
  void tell_second_phase() {
    said(world.event(lead, "set_phase", R"({"name": "Decide", "activities": ["draft", "vote"]})"));
    said(world.event(lead, "set_phase", R"({"name": "Decide", "activities": ["draft", "vote"], "ends_at": 1772400000000})"));
    said(world.say(anna, room::OperationKind::draft_begin, R"({"draft": "d"})"));
    said(world.command(anna, room::set_demand("north", 300), "d"));
    said(world.command(anna, room::set_demand("south", 650), "d"));
    said(world.event(anna, "propose", R"({"draft": "d", "title": "More light", "why": "The willow needs it"})"));
    said(world.event(lead, "decide_proposal", R"({"draft": "d", "is_accepted": true, "keep": [0], "answer": "In part"})"));
    said(world.say(ben, room::OperationKind::draft_begin, R"({"draft": "e"})"));
    said(world.command(ben, room::set_demand("south", 100), "e"));
    said(world.event(ben, "propose", R"({"draft": "e", "title": "Lower south"})"));
    said(world.event(lead, "decide_proposal", R"({"draft": "e", "answer": "Too low"})"));
    said(world.event(ben, "propose", R"({"draft": "e", "title": "Lower south again", "why": "Please"})"));
    said(world.event(lead, "save_scenario", R"({"id": "end", "name": "Before the vote", "note": "Much light"})"));
    at_scenario = world.scene();
    said(world.command(lead, room::set_demand("south", 512)));
    said(world.event(lead, "open_vote", R"({"vote": "secret_poll"})"));
    said(ballot(anna, "secret_poll", "\"yes\""));
    said(ballot(ben, "secret_poll", "\"no\""));
    said(ballot(cem, "secret_poll", "\"yes\""));
    said(ballot(anna, "secret_poll", "\"no\""));
    said(world.event(lead, "close_vote", R"({"vote": "secret_poll"})"));
  }
};

}  // namespace bl::minutes
