// A window without a connection: what is said meanwhile, and how it goes out afterwards.
#include "core/guest/room_guest.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/core/guest/memory_room.h"
#include "tests/support/sanitized.h"

namespace bl::guest {
namespace {

// A room with a window that can be cut off for a while: attempts to connect fail at once.
struct Outage {
  Outage() : room("scenes/start/quarter.json") {
    room.before_joining = [this](RoomGuestOptions& options) {
      options.connect = [this, connect = options.connect](const std::function<void()>& wake) {
        auto link = connect(wake);
        room.wires.back()->is_closed = is_away;
        return link;
      };
    };
  }
  void begin() {
    is_away = true;
    for (const auto& wire : room.wires) wire->is_closed = true;
    room.turn();
  }
  MemoryRoom room;
  bool is_away = false;
};

Command placed_at(double x) { return command<SetPort>({"cafe", {"node.position"}, JsonValue::of({x, 0, 6})}); }

// A server takes sixty operations in a second; a minute of them at once would hold up the pings behind them.
TEST(Outages, WhatHasWaitedGoesOutInSmallParts) {
  Outage outage;
  RoomGuest& guest = outage.room.join("facilitator");
  ASSERT_TRUE(outage.room.turn_until([&] { return guest.standing().has_scene; }));
  outage.begin();
  const int said = test::kIsSanitized ? 120 : 300;
  for (int k = 0; k < said; ++k) ASSERT_TRUE(guest.submit({command<RenameNode>({"cafe", "Away " + std::to_string(k)})}).ok());
  EXPECT_EQ(guest.standing().waiting, static_cast<std::size_t>(said));
  outage.is_away = false;
  ASSERT_TRUE(outage.room.turn_until([&] { return guest.standing().is_connected; }));
  const double back = outage.room.clock.now();
  std::size_t most = 0;
  ASSERT_TRUE(outage.room.turn_until([&] {
    const double most_by_now = RoomGuest::kMostAtOnce + (outage.room.clock.now() - back) * RoomGuest::kSentInASecond;
    EXPECT_LE(static_cast<double>(said) - static_cast<double>(guest.standing().waiting), most_by_now + 2);
    most = std::max(most, outage.room.wires.front()->to_server_.size());
    return guest.standing().waiting == 0;
  }));
  EXPECT_LE(most, RoomGuest::kMostUnanswered + 2) << "beside a ping and what else is said";
  EXPECT_EQ(guest.history().size(), static_cast<std::size_t>(said)) << "each step by itself, and once";
  EXPECT_EQ(guest.fold().confirmed().nodes.find("cafe")->second.name, "Away " + std::to_string(said - 1));
}

// Nobody would see the values in between, and each would be a further operation to answer.
TEST(Outages, OfADragWithoutAConnectionTheLastValueIsSaid) {
  Outage outage;
  RoomGuest& guest = outage.room.join("facilitator");
  ASSERT_TRUE(outage.room.turn_until([&] { return guest.standing().has_scene; }));
  const std::int64_t before = outage.room.host->health().seq;
  outage.begin();
  for (int drag = 1; drag <= 3; ++drag) {
    const std::int64_t gesture = guest.new_gesture();
    for (int k = 1; k <= 50; ++k) {
      ASSERT_TRUE(guest.show({placed_at(100 * drag + k)}, gesture).ok());
      outage.room.turn(0.1);
    }
    ASSERT_TRUE(guest.end_gesture(gesture).ok());
    EXPECT_EQ(guest.standing().waiting, static_cast<std::size_t>(drag)) << "each drag is a step of its own";
    const auto& values = guest.scene().nodes.find("cafe")->second.types.at("node");
    EXPECT_EQ(std::get<Vector3>(values.at("position")).x, 100 * drag + 50) << "shown all the same";
  }
  // The last one ends when the network is back.
  const std::int64_t gesture = guest.new_gesture();
  for (int k = 1; k <= 20; ++k) ASSERT_TRUE(guest.show({placed_at(k)}, gesture).ok());
  outage.is_away = false;
  ASSERT_TRUE(outage.room.turn_until([&] { return guest.standing().is_connected && guest.standing().waiting == 0; }));
  ASSERT_TRUE(guest.end_gesture(gesture).ok());
  ASSERT_TRUE(outage.room.turn_until([&] { return guest.fold().seq() == outage.room.host->health().seq; }));
  EXPECT_EQ(guest.history().size(), 4u);
  // A snapshot, which a window gets that is far behind, stands in the log as an empty batch.
  std::int64_t said = 0;
  for (const LogEntry& entry : guest.log())
    if (entry.command.id == "set_port" && entry.seq > before) ++said;
  EXPECT_EQ(said, 4);
  EXPECT_EQ(std::get<Vector3>(guest.fold().confirmed().nodes.find("cafe")->second.types.at("node").at("position")).x, 20);
}

TEST(Outages, APaceThatIsWishedBeforeTheWelcomeIsSaidAfterIt) {
  Outage outage;
  RoomGuest& lead = outage.room.join("facilitator");
  lead.set_rate(17);
  ASSERT_TRUE(outage.room.turn_until([&] { return lead.moment()->wanted_rate == 17; }));
  EXPECT_TRUE(lead.moment()->is_playing);
  // A clock that stands goes on standing, also where the wish was made without a connection.
  lead.play(false);
  ASSERT_TRUE(outage.room.turn_until([&] { return !lead.moment()->is_playing; }));
  outage.begin();
  lead.set_rate(5);
  outage.is_away = false;
  ASSERT_TRUE(outage.room.turn_until([&] { return lead.people().rate == 5; }));
  EXPECT_TRUE(lead.people().is_paused);
  EXPECT_TRUE(lead.take_refusals().empty());
  // Who may not set it is told so.
  RoomGuest& other = outage.room.join("designer");
  other.set_rate(20);
  ASSERT_TRUE(outage.room.turn_until([&] { return other.standing().has_scene && other.standing().waiting == 0; }));
  EXPECT_EQ(other.take_notices(), std::vector<std::string>{"Only the facilitator sets the clock of a room."});
  EXPECT_EQ(lead.people().rate, 5);
}

}  // namespace
}  // namespace bl::guest
