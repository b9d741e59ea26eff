// What a window has said outlives its crash: kept first, sent again by the next window, answered once.
#include "core/guest/outbox.h"

#include <sys/stat.h>
#include <set>

#include <nlohmann/json.hpp>

#include "core/file/file_io.h"
#include "tests/core/guest/memory_room.h"
#include "tests/support/sanitized.h"

namespace bl::guest {
namespace {

struct OutboxFolder {
  OutboxFolder()
      : path(std::filesystem::temp_directory_path() / ("behaviourlinks_outbox_" + std::to_string(::getpid()) + "_" +
                                                       ::testing::UnitTest::GetInstance()->current_test_info()->name())) {}
  ~OutboxFolder() { std::filesystem::remove_all(path); }
  std::string stem() const { return path / "rooms" / "host_BKRT"; }
  std::string file() const { return stem() + "-1.outbox"; }
  std::filesystem::path path;
};

unsigned mode_of(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

TEST(Outboxes, NobodyElseReadsThem) {
  const OutboxFolder folder;
  const auto outbox = Outbox::open(folder.stem(), "run");
  ASSERT_TRUE(outbox.ok()) << outbox.error().text();
  EXPECT_EQ(mode_of(folder.file()), 0600u);
  EXPECT_EQ(mode_of(folder.path / "rooms"), 0700u);
}

TEST(Outboxes, AWindowTakesOverWhatAnotherHasLeftAndNeverWhatOneHas) {
  const OutboxFolder folder;
  {
    auto first = Outbox::open(folder.stem(), "one"), second = Outbox::open(folder.stem(), "two");
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_EQ(first->run(), "one");
    EXPECT_EQ(second->run(), "two") << "the first is in use";
    ASSERT_TRUE(first->keep({0, "a", "A"}, 1).ok() && second->keep({0, "b", "B"}, 3).ok() && second->keep({0, "c", "C"}, 4).ok());
    EXPECT_TRUE(first->answered(1));
    EXPECT_FALSE(first->answered(1));
  }
  const auto heir = Outbox::open(folder.stem(), "three");
  ASSERT_TRUE(heir.ok());
  EXPECT_EQ(heir->run(), "two") << "something waits there";
  ASSERT_EQ(heir->waiting().size(), 2u);
  EXPECT_EQ(heir->waiting()[1].id, 2);
  EXPECT_EQ(heir->waiting()[1].frame, "c");
  EXPECT_EQ(heir->last_gesture(), 4);
  const auto other = Outbox::open(folder.stem(), "four");
  EXPECT_EQ(other->run(), "one");
  EXPECT_EQ(other->next_id(), 2);
  EXPECT_EQ(other->last_answered(), 1);
}

// Cut off anywhere, a file gives back all operations but the ones whose lines are cut, and goes on without a gap.
TEST(Outboxes, LawOfAnyCut) {
  const OutboxFolder folder;
  {
    auto outbox = Outbox::open(folder.stem(), "run");
    ASSERT_TRUE(outbox.ok());
    for (int k = 1; k <= 6; ++k) ASSERT_TRUE(outbox->keep({0, "frame " + std::to_string(k), "step"}, k).ok());
    outbox->answered(2);
  }
  const std::string whole = *read_file(folder.file());
  const std::string copy = folder.path / "copy";
  std::filesystem::copy_file(folder.file(), copy);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    std::filesystem::copy_file(copy, folder.file(), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(folder.file(), length);
    std::int64_t next = 0;
    std::size_t count = 0;
    {
      auto outbox = Outbox::open(folder.stem(), "other");
      ASSERT_TRUE(outbox.ok());
      for (const Sent& sent : outbox->waiting()) EXPECT_EQ(sent.frame, "frame " + std::to_string(sent.id)) << length;
      count = outbox->waiting().size();
      next = outbox->next_id();
      ASSERT_TRUE(outbox->keep({0, "after", "step"}, 9).ok());
    }
    const auto again = Outbox::open(folder.stem(), "other");
    ASSERT_EQ(again->waiting().size(), count + 1) << length;
    EXPECT_EQ(again->waiting().back().id, next);
    EXPECT_EQ(again->waiting().back().frame, "after");
  }
}

TEST(Outboxes, AFileThatCannotBeWrittenKeepsNothing) {
  const OutboxFolder folder;
  std::filesystem::create_directories(folder.path);
  ASSERT_TRUE(write_file(folder.path / "rooms", "no folder").ok());
  EXPECT_FALSE(Outbox::open(folder.stem(), "run").ok());
}

bool has_name(const RoomGuest& guest, const std::string& node, const std::string& name) {
  const auto found = guest.scene().nodes.find(node);
  return found != guest.scene().nodes.end() && found->second.name == name;
}

// All windows that join are of the same person, and keep what they say in that folder.
void keep_one_seat(MemoryRoom& room, const OutboxFolder& folder, std::string& token) {
  room.before_joining = [&](RoomGuestOptions& options) {
    if (!token.empty()) options.invite.clear();
    options.token = token;
    options.keep_token = [&](const std::string& given) { token = given; };
    options.outbox = folder.stem();
  };
}

// A crash is what the disk has at that moment: the window is gone, and its file is as it was, or lacks the end of a line that was
// never sent. The marks are nodes that only one operation each can have made.
TEST(RoomGuests, LawOfCrashesEachOperationIsDoneOnce) {
  const OutboxFolder folder;
  MemoryRoom room("scenes/start/quarter.json", 21);
  std::string token;
  keep_one_seat(room, folder, token);
  room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return room.guests[0]->standing().has_scene; }));
  Random& random = room.random();
  std::set<std::string> kept, unsent;
  int crashes = 0;
  std::size_t taken_over = 0;
  const int turns = test::kIsSanitized ? 200 : 1500;
  // Where the threads that tick get no processor, windows crash before they have the scene: until one has left something.
  const double end = host::real_clock().now() + 120;
  for (int k = 0; k < turns || (taken_over == 0 && host::real_clock().now() < end); ++k) {
    RoomGuest& guest = *room.guests[0];
    room.weather = {.lost = 0.2, .doubled = 0.05, .cut = 0.02, .most_delay = 6};
    const std::string mark = "mark_" + std::to_string(k);
    if (random.below(10) < 3 && guest.standing().has_scene &&
        guest.submit({command<AddNode>({mark, JsonValue::of({{"name", mark}})})}, guest.new_gesture()).ok()) {
      kept.insert(mark);
      EXPECT_TRUE(has_name(guest, mark, mark)) << "shown at once";
    }
    if (random.below(10) != 0) {
      room.turn();
      continue;
    }
    ++crashes;
    std::string bytes = *read_file(folder.file());
    // Without a connection the last line was not sent yet, so that it may be cut off half-way.
    if (kept.contains(mark) && !guest.standing().is_connected && random.below(2) == 0) {
      bytes.resize(bytes.size() - 1 - static_cast<std::size_t>(random.below(20)));
      kept.erase(mark);
      unsent.insert(mark);
    }
    room.guests.clear();
    ASSERT_TRUE(write_file(folder.file(), bytes).ok());
    room.join("facilitator");
    taken_over += room.guests[0]->standing().waiting;
  }
  ASSERT_GT(crashes, turns / 20);
  ASSERT_GT(taken_over, 0u) << "some have crashed with something that waits";
  ASSERT_TRUE(room.come_to_rest());
  const RoomGuest& last = *room.guests[0];
  for (const std::string& mark : kept) EXPECT_TRUE(has_name(last, mark, mark)) << mark;
  for (const std::string& mark : unsent) EXPECT_FALSE(has_name(last, mark, mark)) << mark;
  EXPECT_EQ(room.host->health().seats, 1u) << "all of these windows are one person";
  EXPECT_TRUE(room.guests[0]->take_refusals().empty()) << "a second time it would have been refused";
  EXPECT_EQ(hex_digits(last.moment()->ticked->hash), room.host->health().hash);
}

// A power cut takes whole lines, also of operations that were sent and answered. Nothing that the next window says may be taken
// for one of them.
TEST(RoomGuests, LawOfPowerCutsNumbersMeanOneOperationEach) {
  const OutboxFolder folder;
  MemoryRoom room("scenes/start/quarter.json", 22);
  std::string token;
  keep_one_seat(room, folder, token);
  room.join("facilitator");
  Random& random = room.random();
  std::set<std::string> said;
  const int turns = test::kIsSanitized ? 10 : 60;
  for (int k = 0; k < turns; ++k) {
    RoomGuest& guest = *room.guests[0];
    ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene; }));
    const std::string before = *read_file(folder.file());
    for (int j = 0; j < 3; ++j) {
      const std::string mark = "mark_" + std::to_string(3 * k + j);
      ASSERT_TRUE(guest.submit({command<AddNode>({mark, JsonValue::of({{"name", mark}})})}, guest.new_gesture()).ok());
      said.insert(mark);
    }
    ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
    std::string bytes = *read_file(folder.file());
    ASSERT_EQ(bytes.compare(0, before.size(), before), 0);
    room.guests.clear();
    bytes.resize(before.size() + random.below(bytes.size() - before.size()));
    bytes.resize(bytes.rfind('\n') + 1);
    ASSERT_TRUE(write_file(folder.file(), bytes).ok());
    room.join("facilitator");
  }
  ASSERT_TRUE(room.come_to_rest());
  for (const std::string& mark : said) EXPECT_TRUE(has_name(*room.guests[0], mark, mark)) << mark;
  EXPECT_TRUE(room.guests[0]->take_refusals().empty());
}

TEST(RoomGuests, WhatWasSaidWithoutAConnectionIsShownAgainByTheNextWindow) {
  const OutboxFolder folder;
  MemoryRoom room("scenes/start/quarter.json");
  std::string token;
  room.before_joining = [&](RoomGuestOptions& options) {
    options.token = token;
    options.keep_token = [&](const std::string& given) { token = given; };
    options.outbox = folder.stem();
  };
  room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return room.guests[0]->standing().has_scene; }));
  room.wires[0]->is_closed = true;
  room.turn();
  ASSERT_TRUE(room.guests[0]->submit({command<RenameNode>({"cafe", "Away"})}).ok());
  room.guests.clear();
  room.weather.most_delay = 3;
  RoomGuest& next = room.join("facilitator");
  EXPECT_EQ(next.standing().waiting, 1u);
  ASSERT_EQ(next.take_notices().size(), 1u);
  ASSERT_TRUE(room.turn_until([&] { return next.standing().has_scene && next.standing().waiting == 0; }));
  EXPECT_TRUE(has_name(next, "cafe", "Away"));

  // Without its seat nobody can say it any more, and the person is told.
  room.wires.back()->is_closed = true;
  room.turn();
  ASSERT_TRUE(next.submit({command<RenameNode>({"hotel", "Lost"})}).ok());
  room.guests.clear();
  token.clear();
  RoomGuest& stranger = room.join("facilitator");
  const auto refused = stranger.take_refusals();
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_NE(refused[0].what.find("Hotel"), std::string::npos) << refused[0].what;
  ASSERT_TRUE(room.turn_until([&] { return stranger.standing().has_scene; }));
  EXPECT_FALSE(has_name(stranger, "hotel", "Lost"));
}

}  // namespace
}  // namespace bl::guest
