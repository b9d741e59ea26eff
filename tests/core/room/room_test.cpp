// What a room answers: once only, with a reason, and in the same way after a crash.
#include "tests/core/room/room_world.h"

namespace bl::room {
namespace {

TEST(Room, AnOperationIsAnsweredOnceAndTheSameAgain) {
  RoomWorld world;
  const auto seat = world.seat(Role::facilitator);
  const Operation rename{
      .run = "a", .id = 1, .content = R"({"command": "rename_node", "arguments": {"id": "north", "name": "N"}})"};
  const Answer first = world.send(seat, rename);
  EXPECT_EQ(sentence(first), "");
  EXPECT_EQ(world.send(seat, rename), first);
  EXPECT_EQ(world.ledger().log().size(), 2u) << "the seat, and the name once";
  Operation bad = rename;
  bad.id = 2;
  bad.content = R"({"command": "rename_node", "arguments": {"id": "nobody", "name": "N"}})";
  const Answer refused = world.send(seat, bad);
  EXPECT_EQ(sentence(refused), "gone nodes/nobody: there is no node `nobody`");
  EXPECT_EQ(world.send(seat, bad), refused);
  world.crash();
  EXPECT_EQ(world.send(seat, rename), first);
  EXPECT_EQ(world.send(seat, bad), refused);
  EXPECT_EQ(world.ledger().log().size(), 2u);
}

TEST(Room, AGapIsToldWithTheNumberThatIsMissing) {
  RoomWorld world;
  const auto seat = world.seat(Role::facilitator);
  const Answer answer = world.send(seat, {.run = "a", .id = 3, .content = "{}"});
  EXPECT_EQ(why(answer), "gap");
  EXPECT_EQ(std::get<Refusal>(answer).args.text(), R"({"next": 1})");
}

TEST(Room, ARunBelongsToItsSeat) {
  RoomWorld world;
  const auto anna = world.seat(Role::facilitator), ben = world.seat(Role::facilitator);
  EXPECT_EQ(world.room().greet(anna, "a", 0), 0);
  EXPECT_EQ(world.room().greet(ben, "a", 0), -1);
  EXPECT_EQ(why(world.send(ben, {.run = "a", .id = 1, .content = "{}"})), "right");
  EXPECT_EQ(world.room().greet(anna, "a", 4), 4) << "a refusal that was lost in a crash was answered all the same";
  EXPECT_EQ(why(world.send(anna, {.run = "a", .id = 5, .content = "{}"})), "bad");
}

TEST(Room, BadContentGetsAReasonWithItsPlace) {
  RoomWorld world;
  const auto seat = world.seat(Role::facilitator);
  const auto said = [&](const char* content) { return sentence(world.say(seat, OperationKind::command, content)); };
  EXPECT_EQ(said("{\"command\": "), "bad line 1, column 13: the text ends in the middle of a JSON value; the file is cut off");
  EXPECT_EQ(said(R"({"command": "dance"})"), "bad : unknown command `dance`");
  EXPECT_EQ(said(R"({"command": "set_port", "arguments": {"node": "north"}})"), "bad arguments: `set_port` needs `port`");
  EXPECT_EQ(said(R"({"command": "set_port", "arguments": {"node": "north", "port": "smart_volume.demand", "value": -1}})"),
            "range nodes/north/smart_volume/demand: must be between 0 and 1e+09 m³, found -1");
  EXPECT_EQ(sentence(world.event(seat, "dance")), "bad event: there is no such event");
  EXPECT_EQ(sentence(world.event(seat, "mark", R"({"words": "x"})")).substr(0, 19), "bad arguments/words");
  EXPECT_EQ(world.ledger().log().size(), 1u) << "nothing but the seat";
}

TEST(Room, WhatIsNoObjectIsRefusedWhateverItIsSaidAs) {
  RoomWorld world;
  const std::int64_t lead = world.seat(Role::facilitator);
  for (const OperationKind kind : {OperationKind::command, OperationKind::event, OperationKind::draft_begin})
    for (const char* content : {"1", "\"x\"", "[]", "null", "true", "[{}]"}) {
      const Answer answer = world.say(lead, kind, content);
      ASSERT_TRUE(std::holds_alternative<Refusal>(answer)) << content;
      EXPECT_EQ(std::get<Refusal>(answer).why, Reason::bad) << content;
    }
}

TEST(Room, WordsStandBesideTheLog) {
  RoomWorld world;
  const auto seat = world.seat(Role::participant);
  EXPECT_EQ(sentence(world.event(seat, "comment", R"({"id": "c1", "text": "Too dark here", "node": "north"})")), "");
  ASSERT_EQ(world.disk.texts.size(), 1u);
  EXPECT_EQ(world.disk.texts[0].body, "Too dark here");
  EXPECT_EQ(world.ledger().log().back().event->text(),
            R"({"event": "comment", "arguments": {"id": "c1", "text": "text1", "node": "north"}})");
  EXPECT_EQ(why(world.event(seat, "comment", R"({"id": "c2", "text": ")" + std::string(2001, 'x') + R"("})")), "size");
  EXPECT_EQ(why(world.event(seat, "comment", R"({"id": "c2", "text": "a\u202eb"})")), "bad");
  EXPECT_EQ(why(world.event(seat, "comment", R"({"id": "c1", "text": "again"})")), "conflict");
  EXPECT_EQ(world.disk.texts.size(), 1u);
}

TEST(Room, ForgettingAPersonLeavesTheFoldAsItIs) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), seat = world.seat(Role::participant);
  (void)world.event(seat, "comment", R"({"id": "c1", "text": "I am Ben"})");
  EXPECT_EQ(world.room().seat_of_token(world.tokens[seat]), seat);
  EXPECT_EQ(sentence(world.event(lead, "forget", R"({"seat": 2})")), "");
  EXPECT_EQ(world.room().seat_of_token(world.tokens[seat]), 0);
  EXPECT_EQ(world.disk.texts.back().body, "[erased]");
  const auto hash = hash_of(world.room().state());
  world.crash();
  EXPECT_EQ(hash_of(world.room().state()), hash);
  EXPECT_EQ(world.room().seat_of_token(world.tokens[seat]), 0);
}

TEST(Room, MinutesAreSharedOnlyWhereTheCloseSaysSo) {
  RoomWorld as_before, shared;
  for (RoomWorld* world : {&as_before, &shared}) (void)world->seat(Role::facilitator);
  EXPECT_EQ(sentence(as_before.event(1, "close_room")), "") << "as logs of earlier programs have it";
  EXPECT_FALSE(as_before.room().state().shares_minutes);
  EXPECT_EQ(sentence(shared.event(1, "close_room", R"({"shares_minutes": true})")), "");
  EXPECT_TRUE(shared.room().state().shares_minutes);
  EXPECT_NE(hash_of(shared.room().state()), hash_of(as_before.room().state()));
  shared.crash();
  EXPECT_TRUE(shared.room().state().shares_minutes);
}

TEST(Room, PhasesDecideWhatPeopleMayDo) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  const auto seat = world.seat(Role::stakeholder, {}, "card");
  EXPECT_EQ(sentence(world.event(lead, "set_phase", R"({"name": "Look", "activities": ["comment"]})")), "");
  const Answer refused = world.command(seat, set_demand("south", 600));
  EXPECT_EQ(sentence(refused), "phase : in this phase nobody can change the scene");
  EXPECT_EQ(why(world.command(lead, set_demand("south", 600))), "") << "who leads is not bound";
  EXPECT_EQ(why(world.event(seat, "comment", R"({"id": "c", "text": "x"})")), "");
  EXPECT_EQ(sentence(world.event(lead, "set_phase", R"({"activities": ["dance"]})")),
            "bad activities: expects `change`, `draft`, `comment` or `vote`, not `dance`");
}

TEST(Room, ACardHasItsRanges) {
  RoomWorld world;
  (void)world.seat(Role::facilitator);
  const auto seat = world.seat(Role::stakeholder, {}, "card");
  EXPECT_EQ(sentence(world.command(seat, set_demand("south", 600))), "");
  EXPECT_EQ(sentence(world.command(seat, set_demand("south", 950))),
            "range nodes/south/types/smart_volume/demand: goes from 500.0 to 900.0 on your role card");
  EXPECT_EQ(sentence(world.command(seat, set_demand("north", 600))),
            "right nodes/north/types/smart_volume/demand: is not on your role card");
  EXPECT_EQ(sentence(world.command(seat, command<SetLinkStrength>({"apart", 0.4}))), "");
  EXPECT_EQ(why(world.command(seat, command<SetLinkStrength>({"apart", 0.6}))), "range");
  // Also of a card that allows more than the value does: the page has a sentence for it.
  EXPECT_EQ(sentence(world.say(seat, OperationKind::command,
                               R"({"command": "set_link_strength", "arguments": {"id": "apart", "strength": 2.5}})")),
            "range arguments/strength: must be between 0 and 1, found 2.5");
  EXPECT_EQ(world.demand("south"), 600);
}

TEST(Room, AnAreaIsItsDesigners) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  ASSERT_EQ(sentence(world.event(lead, "define_area",
                                 R"({"area": "n", "outline": [[-20, 20, 0], [30, 20, 0], [30, 90, 0], [-20, 90, 0]]})")),
            "");
  const auto anna = world.seat(Role::designer, {"n"}), ben = world.seat(Role::designer, {"n"});
  EXPECT_EQ(sentence(world.command(anna, set_demand("north", 800))), "");
  EXPECT_EQ(sentence(world.command(anna, set_demand("south", 800))),
            "area nodes/south/types/smart_volume/demand: lies in none of your areas");
  const Command carry = command<SetPort>({"north", {"node.position"}, {"[0, -90, 0]"}});
  EXPECT_EQ(why(world.command(anna, carry)), "area") << "nobody carries things out of their area";
  EXPECT_EQ(why(world.command(anna, command<SetLinkStrength>({"inner", 0.5}))), "");
  EXPECT_EQ(why(world.command(anna, command<SetLinkStrength>({"apart", 0.5}))), "area") << "it moves the south as well";
  const Command add = command<AddNode>({"new", {R"({"position": [0, 60, 0], "types": {"smart_volume": {}}})"}});
  EXPECT_EQ(sentence(world.command(anna, add)), "");
  EXPECT_EQ(why(world.command(ben, command<RemoveNode>({"new"}))), "right") << "it is Anna's";
  EXPECT_EQ(sentence(world.event(ben, "ask_pen", R"({"area": "n"})")), "");
  EXPECT_EQ(sentence(world.command(anna, set_demand("north", 700))),
            "area nodes/north/types/smart_volume/demand: Lynx holds the pen of the area n");
  EXPECT_EQ(sentence(world.event(anna, "ask_pen", R"({"area": "n"})")), "");
  EXPECT_EQ(world.room().state().areas.at("n").pen, ben);
  world.at += Room::kPenAnswer;
  world.room().pass(world.now());
  EXPECT_EQ(world.room().state().areas.at("n").pen, anna) << "its holder does not answer";
  world.room().note_presence(anna, false, world.now());
  world.at += Room::kPenLeave;
  world.room().pass(world.now());
  EXPECT_EQ(world.room().state().areas.at("n").pen, 0) << "its holder has left";
  world.room().note_presence(anna, true, world.now());
  EXPECT_EQ(sentence(world.event(anna, "ask_pen", R"({"area": "n"})")), "");
  EXPECT_EQ(sentence(world.event(ben, "ask_pen", R"({"area": "n"})")), "");
  EXPECT_EQ(sentence(world.event(anna, "give_pen", R"({"area": "n"})")), "");
  EXPECT_TRUE(world.room().waits_for_time());
  world.room().pass(world.now());
  EXPECT_EQ(world.room().state().areas.at("n").pen, ben) << "it was laid down while somebody asked";
  EXPECT_FALSE(world.room().waits_for_time());
}

TEST(Room, AStaleConditionNamesWhoAndWhat) {
  RoomWorld world;
  const auto anna = world.seat(Role::facilitator), ben = world.seat(Role::facilitator);
  (void)world.command(anna, set_demand("north", 500));
  Operation operation{
      .run = "b",
      .id = 1,
      .content = R"({"command": "set_port", "arguments": {"node": "north", "port": "smart_volume.demand", "value": 300}})"};
  operation.conditions = {{"nodes/north/types/smart_volume/demand", JsonValue::of(900.0)}};
  const Answer answer = world.send(ben, operation);
  EXPECT_EQ(sentence(answer), "stale nodes/north/types/smart_volume/demand: has been changed since");
  EXPECT_EQ(std::get<Refusal>(answer).args.text(), R"({"now": 500, "by": "Heron", "seq": 3})");
  operation.id = 2;
  operation.conditions[0].was = JsonValue::of(500.0);
  EXPECT_EQ(why(world.send(ben, operation)), "");
}

TEST(Room, AVisitorAddsWhatThePhaseLetsVisitorsAdd) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), seat = world.seat(Role::participant);
  const Command add = command<AddNode>({"wish", {R"({"position": [5, 5, 0], "types": {"smart_volume": {"demand": 120}}})"}});
  EXPECT_EQ(why(world.command(seat, add)), "right");
  (void)world.event(lead, "set_phase", R"({"forms": ["smart_volume"]})");
  EXPECT_EQ(sentence(world.command(seat, add)), "");
  const Command other = command<AddNode>({"sensor", {R"({"types": {"sensor": {"address": "http://example.org/"}}})"}});
  EXPECT_EQ(why(world.command(seat, other)), "right");
  EXPECT_EQ(why(world.say(seat, OperationKind::undo, "{}")), "") << "it can be taken back";
  EXPECT_FALSE(world.scene().nodes.contains("wish"));
}

TEST(Room, NobodyOpensConnectionsInARoomWithoutThem) {
  for (const bool is_live : {false, true}) {
    RoomWorld world(kTable, {.scripts = false, .live = is_live});
    const auto lead = world.seat(Role::facilitator);
    const Command address = command<SetPort>({"meter", {"sensor.address"}, {"\"http://example.org/\""}});
    EXPECT_EQ(why(world.command(lead, address)), is_live ? "" : "right");
    const Command add = command<AddNode>({"m", {R"({"types": {"media": {"file": "/etc/passwd"}}})"}});
    EXPECT_EQ(why(world.command(lead, add)), is_live ? "" : "right");
    EXPECT_EQ(why(world.command(lead, command<SetScript>({"s", "kind 's'"}))), "right");
  }
}

TEST(Room, ARewindIsAStepLikeAnyOther) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), ben = world.seat(Role::stakeholder, {}, "card");
  const std::int64_t before = world.ledger().last_seq();
  const Scene first = world.scene();
  (void)world.command(ben, set_demand("south", 555));
  (void)world.command(lead, command<RemoveNode>({"north"}));
  const Scene second = world.scene();
  EXPECT_EQ(why(world.say(ben, OperationKind::rewind, R"({"to": 1})")), "right");
  EXPECT_EQ(sentence(world.say(lead, OperationKind::rewind, R"({"to": )" + std::to_string(before) + "}")), "");
  EXPECT_TRUE(world.scene() == first);
  EXPECT_EQ(sentence(world.say(lead, OperationKind::undo, "{}")), "");
  EXPECT_TRUE(world.scene() == second);
  EXPECT_EQ(why(world.say(lead, OperationKind::rewind, R"({"to": 99})")), "bad");
}

// What is told of them is what a rewind would find: it has nothing to take back exactly where it goes to one of those entries.
TEST(Room, ARewindTakesNothingBackWhereTheSceneIsAsItWas) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  Random random(11);
  int empty = 0, full = 0;
  const auto is_unchanged = [&](std::int64_t seq) {
    const auto spans = world.room().unchanged_since();
    return std::any_of(spans.begin(), spans.end(), [&](const auto& span) { return seq >= span.first && seq <= span.second; });
  };
  for (int k = 0; k < 800; ++k) {
    switch (random.below(5)) {
      case 0: (void)world.command(lead, set_demand("south", 500 + k)); break;
      case 1: (void)world.event(lead, "mark", R"({"text": "We talk."})"); break;
      case 2: (void)world.say(lead, OperationKind::undo, "{}"); break;
      default: {
        // Mostly not far back, as people do it.
        const std::size_t count = static_cast<std::size_t>(world.ledger().last_seq());
        const std::int64_t back =
            1 + static_cast<std::int64_t>(random.below(k % 4 == 0 ? count : std::min<std::size_t>(count, 6)));
        const std::int64_t to = world.ledger().last_seq() - back;
        const bool expected = is_unchanged(to);
        const Answer answer = world.say(lead, OperationKind::rewind, R"({"to": )" + std::to_string(to) + "}");
        ASSERT_EQ(why(answer), expected ? "gone" : "") << k << ": to " << to;
        ++(expected ? empty : full);
      }
    }
    ASSERT_TRUE(is_unchanged(world.ledger().last_seq())) << k;
    if (k % 50 == 49) world.crash();
  }
  EXPECT_GT(empty, 20);
  EXPECT_GT(full, 20);
}

// Each step back once took back all steps back before it, too: the thirtieth would have had a thousand million commands.
TEST(Room, AStepBackIsNoLongerThanWhatLiesBetween) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  std::vector<std::pair<std::int64_t, Scene>> places = {{world.ledger().last_seq(), world.scene()}};
  std::size_t most = 0;
  const auto note = [&] {
    places.emplace_back(world.ledger().last_seq(), world.scene());
    const Command& said = world.ledger().log().back().command;
    if (said.id == "batch") most = std::max(most, std::get<CommandList>(said.arguments.at("commands"))->size());
  };
  Random random(5);
  int edits = 0;
  for (int k = 0; k < 150; ++k) {
    if (k % 10 == 0) {
      (void)world.command(lead,
                          ++edits % 3 == 0 ? command<AddNode>({"n" + std::to_string(k), {"{}"}}) : set_demand("south", 500 + k));
    } else if (k % 10 == 5) {
      (void)world.say(lead, random.below(2) == 0 ? OperationKind::undo : OperationKind::redo, "{}");
      ++edits;
    } else {
      // Anywhere, or entry by entry from the beginning, as with a slider.
      const std::size_t at = k < 100 ? random.below(places.size()) : static_cast<std::size_t>(k) - 100;
      const auto& [seq, scene] = places[at];
      const Answer answer = world.say(lead, OperationKind::rewind, R"({"to": )" + std::to_string(seq) + "}");
      ASSERT_TRUE(world.scene() == scene) << k << ": " << sentence(answer);
      EXPECT_NE(why(answer), "right");
    }
    note();
    ASSERT_LE(most, 2u * static_cast<std::size_t>(edits)) << k;
    if (k % 25 == 24) world.crash();
  }
  EXPECT_GT(most, 3u);
}

TEST(Room, WhoComesWhileTheDoorAsksWaitsForARole) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator);
  const auto come = [&](Role role, bool is_by_code) {
    const auto admitted = world.room().admit({.role = role, .areas = {}, .card = {}, .is_by_code = is_by_code}, world.now());
    world.store();
    return std::get<Admission>(admitted).seat;
  };
  const auto waits = [&](std::int64_t seat) { return world.room().state().seat(seat)->is_waiting; };
  EXPECT_FALSE(waits(come(Role::participant, true))) << "the door is open";
  ASSERT_EQ(sentence(world.event(lead, "set_door", R"({"door": "asks"})")), "");
  const auto anna = come(Role::participant, true), ben = come(Role::participant, true);
  EXPECT_TRUE(waits(anna) && waits(ben));
  EXPECT_EQ(world.room().state().seat(anna)->role, Role::viewer);
  EXPECT_FALSE(waits(come(Role::designer, false))) << "an invitation is an answer";
  EXPECT_FALSE(waits(come(Role::viewer, true))) << "a beamer watches";
  ASSERT_EQ(sentence(world.event(lead, "set_role", R"({"seat": )" + std::to_string(anna) + R"(, "role": "viewer"})")), "");
  EXPECT_FALSE(waits(anna)) << "to watch is a role as well";
  ASSERT_EQ(sentence(world.event(lead, "set_door", R"({"door": "open"})")), "");
  EXPECT_TRUE(waits(ben)) << "nobody has answered";
  const auto hash = hash_of(world.room().state());
  world.crash();
  EXPECT_EQ(hash_of(world.room().state()), hash);
  EXPECT_TRUE(waits(ben));
  ASSERT_EQ(sentence(world.event(lead, "remove_seat", R"({"seat": )" + std::to_string(ben) + "}")), "");
  EXPECT_FALSE(world.room().state().seats.at(ben).is_waiting);
}

TEST(Room, UndoIsOnesOwn) {
  RoomWorld world;
  const auto lead = world.seat(Role::facilitator), ben = world.seat(Role::stakeholder, {}, "card");
  (void)world.command(ben, set_demand("south", 555));
  (void)world.command(lead, set_demand("south", 666));
  EXPECT_EQ(sentence(world.say(ben, OperationKind::undo, "{}")),
            "stale : cannot be undone: seat 1 has changed nodes/south/types/smart_volume/demand since");
  EXPECT_EQ(why(world.say(ben, OperationKind::undo, R"({"of": 1})")), "right");
  (void)world.say(lead, OperationKind::undo, "{}");
  EXPECT_EQ(sentence(world.say(lead, OperationKind::undo, R"({"of": 2})")), "");
  EXPECT_EQ(world.demand("south"), 700);
  EXPECT_EQ(world.disk.entries.back().by, lead);
}

}  // namespace
}  // namespace bl::room
