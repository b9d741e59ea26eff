// Guests of a room in one process: the same scene, the same ticks, nothing lost and nothing doubled, on any network.
#include "core/guest/room_guest.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/journal/journal.h"
#include "core/journal/packed.h"
#include "core/wire/base64.h"
#include "tests/core/guest/memory_room.h"
#include "tests/support/random_commands.h"
#include "tests/support/sanitized.h"

namespace bl::guest {
namespace {

constexpr const char* kQuarter = "scenes/start/quarter.json";

Command placed_at(const std::string& node, double x, double y, double z) {
  return command<SetPort>({node, {"node.position"}, JsonValue::of({x, y, z})});
}

std::string text_of_scene(const Scene& scene) { return write_scene(scene, full_registry()); }

// What the file of the room holds, folded without any code of guests; every operation stands in it once at most.
Scene scene_of_file(const std::string& path, std::map<std::pair<std::string, std::int64_t>, int>& operations) {
  auto journal = journal::Journal::open(path, full_registry(), {.opened_at = 1});
  EXPECT_TRUE(journal.ok()) << journal.error().text();
  const auto loaded = (*journal)->load();
  EXPECT_TRUE(loaded.ok());
  Scene scene = read_scene(loaded->room.scene, full_registry()).scene;
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> gestures;
  for (const room::EntryRecord& record : loaded->room.stored.entries) {
    const LogEntry& entry = record.entry;
    if (entry.source.operation != 0) {
      // An undo may be several entries of one gesture.
      const auto [known, is_new] = gestures.emplace(std::pair(entry.source.origin, entry.source.operation), entry.gesture);
      if (is_new || known->second != entry.gesture) ++operations[known->first];
    }
    if (!entry.is_command()) continue;
    SceneEdit edit(scene, full_registry());
    EXPECT_TRUE(apply(edit, entry.command).ok());
  }
  return scene;
}

TEST(RoomGuests, AGuestSeesTheSceneAndTakesTheSameTicks) {
  MemoryRoom room(kQuarter);
  RoomGuest& guest = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene && guest.follower().agreed() >= 3; }));
  EXPECT_TRUE(guest.standing().takes_ticks);
  EXPECT_EQ(guest.scene().nodes.size(), read_scene(project_file(kQuarter), full_registry()).scene.nodes.size());
  EXPECT_EQ(guest.role(), "facilitator");
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(hex_digits(guest.moment()->ticked->hash), room.host->health().hash);
  EXPECT_FALSE(guest.follower().has_difference());
}

TEST(RoomGuests, WhatOneSaysIsShownAtOnceAndComesToAll) {
  MemoryRoom room(kQuarter);
  RoomGuest &anna = room.join("facilitator"), &ben = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene && ben.standing().has_scene; }));
  ASSERT_TRUE(anna.submit({command<RenameNode>({"cafe", "Anna's"})}).ok());
  EXPECT_EQ(anna.scene().nodes.find("cafe")->second.name, "Anna's");
  EXPECT_EQ(anna.standing().waiting, 1u);
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name == "Anna's"; }));
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().waiting == 0; }));
  ASSERT_EQ(ben.history().size(), 1u);
  // Views come when they are made, scenes and entries at once.
  ASSERT_TRUE(
      room.turn_until([&] { return anna.people().seats.contains(anna.seat()) && ben.people().seats.contains(anna.seat()); }));
  EXPECT_EQ(ben.people().name_of(ben.history()[0].author.id), anna.people().seats.at(anna.seat()).name);
  // Each takes back what is their own.
  ASSERT_TRUE(ben.undo().ok());
  ASSERT_TRUE(room.turn_until([&] { return ben.standing().waiting == 0; }));
  EXPECT_EQ(ben.take_refusals().size(), 1u) << "Ben has done nothing that could be undone";
  ASSERT_TRUE(anna.undo().ok());
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name == "Café"; }));
  EXPECT_TRUE(ben.history()[0].is_undone);
}

TEST(RoomGuests, ARefusedChangeGoesBackAndSaysWhy) {
  MemoryRoom room(kQuarter);
  RoomGuest& viewer = room.join("viewer");
  ASSERT_TRUE(room.turn_until([&] { return viewer.standing().has_scene; }));
  ASSERT_TRUE(viewer.submit({command<RenameNode>({"cafe", "Mine"})}).ok());
  EXPECT_EQ(viewer.scene().nodes.find("cafe")->second.name, "Mine");
  ASSERT_TRUE(room.turn_until([&] { return viewer.standing().waiting == 0; }));
  EXPECT_EQ(viewer.scene().nodes.find("cafe")->second.name, "Café");
  const auto refusals = viewer.take_refusals();
  ASSERT_EQ(refusals.size(), 1u);
  EXPECT_EQ(refusals[0].why, "right");
  EXPECT_FALSE(refusals[0].text.empty());
  EXPECT_NE(refusals[0].what.find("Café"), std::string::npos) << refusals[0].what;
  EXPECT_FALSE(viewer.why_no_clock().empty());
}

TEST(RoomGuests, ADragIsShownEachFrameAndSaidTenTimesASecond) {
  MemoryRoom room(kQuarter);
  RoomGuest& guest = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene; }));
  const std::int64_t before = room.host->health().seq, gesture = guest.new_gesture();
  const double begin = room.clock.now();
  for (int k = 1; k <= 100; ++k) {
    ASSERT_TRUE(guest.show({placed_at("cafe", 1.0 * k, 0, 6)}, gesture).ok());
    const auto& values = guest.scene().nodes.find("cafe")->second.types.at("node");
    EXPECT_EQ(std::get<Vector3>(values.at("position")).x, k);
    room.turn(0.01);
  }
  const double seconds = room.clock.now() - begin;
  ASSERT_TRUE(guest.end_gesture(gesture).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  const auto entries = static_cast<double>(room.host->health().seq - before);
  EXPECT_GE(entries, 10 * seconds * 0.8);
  EXPECT_LE(entries, 10 * seconds + 2);
  EXPECT_EQ(guest.history().size(), 1u);
  ASSERT_TRUE(guest.undo().ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  EXPECT_NE(std::get<Vector3>(guest.scene().nodes.find("cafe")->second.types.at("node").at("position")).x, 100);
  // A drag that is given up leaves nothing of itself.
  const Scene kept = guest.scene();
  const std::int64_t other = guest.new_gesture();
  for (int k = 1; k <= 40; ++k) {
    ASSERT_TRUE(guest.show({placed_at("cafe", 2.0 * k, 0, 6)}, other).ok());
    room.turn(0.01);
  }
  guest.abandon(other);
  EXPECT_EQ(text_of_scene(guest.scene()), text_of_scene(kept));
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  EXPECT_EQ(text_of_scene(guest.fold().confirmed()), text_of_scene(kept));
}

// Two people take the same node away at the same time: one of them comes second and is refused.
void take_away_together(RoomGuest& one, RoomGuest& other, int& said) {
  const auto& nodes = one.scene().nodes;
  const auto both = std::find_if(nodes.begin(), nodes.end(), [&](const auto& node) {
    return other.scene().nodes.find(node.first) != other.scene().nodes.end();
  });
  if (both == nodes.end()) return;
  const std::string id = both->first;
  for (RoomGuest* guest : {&one, &other})
    if (guest->submit({command<RemoveNode>({.id = id})}).ok()) ++said;
}

// On the clock of the system, where two looks at it never give the same time.
TEST(Followers, WhoIsBehindTakesTicksAtOnce) {
  const SceneReading reading = read_scene(project_file(kQuarter), full_registry());
  Follower follower(full_registry(), 1, host::real_clock());
  ASSERT_TRUE(follower.begin(reading.scene, nullptr).ok());
  for (std::int64_t tick = 1; tick <= 60; ++tick) follower.mark({tick, {}, false});
  const double end = host::real_clock().now() + 120;
  while (follower.behind() > Follower::kBuffer && host::real_clock().now() < end) host::real_clock().sleep(0.005);
  EXPECT_LE(follower.behind(), Follower::kBuffer);
}

// A disk that is slower than the ticks holds up what people are told by as much, and not for as long as somebody drags.
TEST(RoomGuests, TicksGoOnWhileSomebodyDragsAndTheDiskIsSlow) {
  MemoryRoom room(kQuarter);
  RoomGuest &anna = room.join("facilitator"), &ben = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene && ben.standing().has_scene; }));
  room.slowness = 25;  // a quarter of a second, in which the room takes more than two ticks
  const std::int64_t gesture = anna.new_gesture(), first = ben.follower().agreed(), tick = ben.follower().tick();
  int k = 0;
  EXPECT_TRUE(room.turn_until([&] {
    EXPECT_TRUE(anna.show({placed_at("cafe", 60 + 20 * std::sin(0.02 * ++k), 36, 6)}, gesture).ok());
    return k > 1000 && ben.follower().agreed() >= first + 2 && ben.follower().tick() >= tick + 50;
  })) << ben.follower().agreed() - first
      << " hashes and " << ben.follower().tick() - tick << " ticks in " << k << " turns";
  room.slowness = 0;
  ASSERT_TRUE(anna.end_gesture(gesture).ok());
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(anna.differed() + ben.differed(), 0);
  EXPECT_EQ(hex_digits(ben.moment()->ticked->hash), room.host->health().hash);
}

// All folds are equal, every marked tick has the same hash, and the file has every operation that was done once.
void play_in_weather(const Weather& weather, std::uint64_t seed, int turns) {
  MemoryRoom room(kQuarter, seed);
  for (int k = 0; k < 3; ++k) room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] {
    return std::all_of(room.guests.begin(), room.guests.end(), [](const auto& guest) { return guest->standing().has_scene; });
  }));
  room.weather = weather;
  Random& random = room.random();
  std::size_t refused = 0;
  int said = 0, number = 0;
  std::int64_t compared = 0;
  for (int k = 0; k < turns; ++k) {
    for (auto& guest : room.guests) {
      refused += guest->take_refusals().size();
      const std::uint64_t dice = random.below(100);
      if (dice < 6 && guest->submit({random_command(guest->scene(), random, ++number)}).ok()) ++said;
      else if (dice == 6) (void)guest->undo();
      else if (dice == 7) (void)guest->redo();
      else if (dice == 8 && !guest->scene().nodes.empty())
        (void)guest->show({placed_at(guest->scene().nodes.begin()->first, random.uniform(0, 50), random.uniform(0, 50), 3)},
                          1000000 + k);
    }
    if (k % 100 == 50) take_away_together(*room.guests[0], *room.guests[1], said);
    room.turn();
  }
  ASSERT_GT(said, turns / 20);
  // And in better weather all go on together.
  room.weather = {};
  std::map<const RoomGuest*, std::int64_t> agreed;
  for (const auto& guest : room.guests) agreed[guest.get()] = guest->follower().agreed();
  ASSERT_TRUE(room.turn_until([&] {
    // At rest the room seldom says its hash.
    return std::all_of(agreed.begin(), agreed.end(), [](const auto& one) {
      const auto& [guest, before] = one;
      return guest->agreed() >= before + (guest->moment()->is_resting ? 1 : 3);
    });
  }));
  ASSERT_TRUE(room.come_to_rest());
  for (const auto& guest : room.guests) {
    refused += guest->take_refusals().size();
    EXPECT_EQ(text_of_scene(guest->scene()), text_of_scene(room.guests.front()->scene()));
    EXPECT_EQ(hex_digits(guest->moment()->ticked->hash), room.host->health().hash);
    EXPECT_FALSE(guest->follower().has_difference());
    for (const std::string& notice : guest->take_notices()) EXPECT_EQ(notice.find("another result"), std::string::npos) << notice;
    compared += guest->follower().agreed();
  }
  EXPECT_GE(compared, 3) << "each has compared a hash";
  EXPECT_GT(refused, 0u);
  const Scene last = room.guests.front()->fold().confirmed();
  std::map<std::pair<std::string, std::int64_t>, int> operations;
  room.guests.clear();
  room.host.reset();
  EXPECT_EQ(text_of_scene(scene_of_file(room.path(), operations)), text_of_scene(last));
  for (const auto& [operation, times] : operations) EXPECT_EQ(times, 1) << operation.first << " " << operation.second;
}

TEST(RoomGuests, LawOfEqualFoldsOnACalmNetwork) {
  play_in_weather({.lost = 0, .doubled = 0, .cut = 0, .most_delay = 3}, 11, test::kIsSanitized ? 150 : 800);
}

TEST(RoomGuests, LawOfEqualFoldsWhereFramesAreLostAndDoubledAndConnectionsBreak) {
  play_in_weather({.lost = 0.3, .doubled = 0.05, .cut = 0.004, .most_delay = 12}, 12, test::kIsSanitized ? 150 : 1200);
  play_in_weather({.lost = 0.05, .doubled = 0.05, .cut = 0.02, .most_delay = 30}, 13, test::kIsSanitized ? 150 : 800);
}

// Each operation behind the missing one is refused, and each refusal names the missing one.
TEST(RoomGuests, OneMissingOperationIsNotAnsweredByAStorm) {
  MemoryRoom room(kQuarter);
  RoomGuest& guest = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene; }));
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(guest.submit({command<RenameNode>({"cafe", "Name " + std::to_string(k)})}).ok());
  room.wires.front()->to_server_.pop_front();
  std::size_t sent = 0;
  ASSERT_TRUE(room.turn_until([&] {
    sent += room.wires.front()->to_server_.size();
    return guest.standing().waiting == 0;
  }));
  EXPECT_LT(sent, 60u) << "what was under way goes out once more, and nothing else";
  EXPECT_GE(sent, 40u + RoomGuest::kMostUnanswered - 2);
}

TEST(RoomGuests, AnOutageOfAMinuteLosesNothing) {
  MemoryRoom room(kQuarter);
  RoomGuest &anna = room.join("facilitator"), &ben = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene && ben.standing().has_scene; }));
  room.wires.front()->is_closed = true;
  room.weather.lost = 1;
  room.turn();
  for (int k = 0; k < 30; ++k) ASSERT_TRUE(anna.submit({command<RenameNode>({"cafe", "Away " + std::to_string(k)})}).ok());
  for (int k = 0; k < 60; ++k) room.turn(1);
  EXPECT_EQ(anna.standing().waiting, 30u);
  EXPECT_EQ(anna.scene().nodes.find("cafe")->second.name, "Away 29");
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(ben.scene().nodes.find("cafe")->second.name, "Away 29");
  EXPECT_EQ(hex_digits(ben.moment()->ticked->hash), room.host->health().hash);
  EXPECT_EQ(ben.history().size(), 30u);
}

// A tick reads the scene that stands before it: a volume that somebody takes away and brings back before the next tick keeps its
// weight. Who joins in between has to know what the tick before has left.
TEST(RoomGuests, WhoJoinsBetweenAStepAndItsUndoHasTheSameTicks) {
  MemoryRoom room(kQuarter);
  RoomGuest& anna = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.follower().tick() > 30; }));
  anna.play(false);
  ASSERT_TRUE(room.turn_until([&] { return anna.people().is_paused && anna.standing().waiting == 0; }));
  ASSERT_TRUE(anna.submit({command<RemoveNode>({.id = "cafe"})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().waiting == 0; }));
  RoomGuest& ben = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return ben.standing().has_scene; }));
  EXPECT_EQ(ben.scene().nodes.find("cafe"), ben.scene().nodes.end());
  ASSERT_TRUE(anna.undo().ok());
  const auto has_cafe = [&] { return ben.scene().nodes.find("cafe") != ben.scene().nodes.end(); };
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().waiting == 0 && has_cafe(); }));
  anna.play(true);
  const std::int64_t agreed = ben.follower().agreed();
  ASSERT_TRUE(room.turn_until([&] { return ben.follower().agreed() > agreed + 1; }));
  EXPECT_EQ(ben.differed(), 0);
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(hex_digits(ben.moment()->ticked->hash), room.host->health().hash);
}

// Joins somebody whom the first frame with that word does not reach.
RoomGuest& join_without(MemoryRoom& room, const std::string& word, bool& is_lost) {
  room.on_way = [&is_lost, quoted = "\"" + word + "\""](std::string& frame) {
    if (frame.find(quoted) != std::string::npos && !std::exchange(is_lost, true)) frame.clear();
  };
  RoomGuest& guest = room.join("facilitator");
  EXPECT_TRUE(room.turn_until([&] { return guest.standing().has_scene; }));
  return guest;
}

void rename_cafe(MemoryRoom& room, RoomGuest& guest, const std::string& name) {
  ASSERT_TRUE(guest.submit({command<RenameNode>({"cafe", name})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
}

// A snapshot holds what the last tick has read; while the ticks stand, the entries since then come again behind it.
TEST(RoomGuests, ASnapshotRepeatsNoStep) {
  MemoryRoom room(kQuarter);
  RoomGuest& anna = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene; }));
  anna.play(false);
  ASSERT_TRUE(room.turn_until([&] { return anna.people().is_paused && anna.standing().waiting == 0; }));
  bool is_lost = false;
  RoomGuest& ben = join_without(room, "Lost", is_lost);
  const auto say = [&](const std::string& name) { rename_cafe(room, anna, name); };
  say("First");
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name == "First"; }));
  ASSERT_TRUE(anna.undo().ok());
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name != "First"; }));
  say("Lost");
  say("Last");
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name == "Last"; }));
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_TRUE(is_lost);
  EXPECT_EQ(ben.history().size(), anna.history().size());
  // What a guest has only shown has no number, and the mark that all may have changed has no gesture.
  const auto numbers_of = [](const RoomGuest& guest) {
    std::vector<std::int64_t> numbers;
    for (const LogEntry& entry : guest.log())
      if (entry.seq > 0 && entry.gesture != 0) numbers.push_back(entry.seq);
    return numbers;
  };
  EXPECT_EQ(numbers_of(ben), numbers_of(anna));
}

// A snapshot is a scene: the steps that led to it come with it, or are said to be missing.
TEST(RoomGuests, AStepThatASnapshotHoldsIsInTheHistory) {
  MemoryRoom room(kQuarter);
  RoomGuest& anna = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene; }));
  bool is_lost = false;
  RoomGuest& ben = join_without(room, "Lost", is_lost);
  const auto say = [&](const std::string& name) { rename_cafe(room, anna, name); };
  say("First");
  ASSERT_TRUE(room.turn_until([&] { return ben.history().size() == 1; }));
  say("Lost");
  // The next tick has read it; what Ben asks for at its mark holds it.
  ASSERT_TRUE(room.turn_until([&] { return ben.scene().nodes.find("cafe")->second.name == "Lost"; }));
  say("Last");
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_TRUE(is_lost);
  EXPECT_EQ(ben.history().size(), 3u);
  EXPECT_EQ(anna.history().size(), 3u);
  for (const std::string& notice : ben.take_notices()) EXPECT_EQ(notice.find("lacks"), std::string::npos) << notice;
}

TEST(RoomGuests, AServerThatStartsAgainIsFollowedFromWhereItIs) {
  MemoryRoom room(kQuarter);
  RoomGuest& guest = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return guest.follower().tick() > 30; }));
  ASSERT_TRUE(guest.submit({command<RenameNode>({"cafe", "Before"})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  room.restart();
  ASSERT_TRUE(guest.submit({command<RenameNode>({"hotel", "Meanwhile"})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().is_connected && guest.standing().waiting == 0; }));
  const std::int64_t agreed = guest.follower().agreed();
  ASSERT_TRUE(room.turn_until([&] { return guest.follower().agreed() > agreed + 1; }));
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(guest.scene().nodes.find("hotel")->second.name, "Meanwhile");
  EXPECT_EQ(hex_digits(guest.moment()->ticked->hash), room.host->health().hash);
}

// Who comes late reads the scene as it is, and not how it came about. How long that takes is printed, and judged by nobody.
TEST(RoomGuests, WhoJoinsBehindManyEntriesIsToldNoneOfThem) {
  const int entries_before = 500;
  MemoryRoom room("scenes/studies/sixty_volumes.json");
  RoomGuest& anna = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene; }));
  const std::string node = anna.scene().nodes.begin()->first;
  for (int k = 0; k < entries_before; ++k) {
    ASSERT_TRUE(anna.submit({command<RenameNode>({node, "Name " + std::to_string(k)})}).ok());
    if (k % 20 == 19) room.turn(0.1);
  }
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().waiting == 0; }));
  ASSERT_GE(room.host->health().seq, entries_before);
  std::size_t bytes = 0, entries = 0;
  room.on_way = [&](std::string& frame) {
    bytes += frame.size();
    entries += frame.find("\"ops\"") != std::string::npos;
  };
  const double began = host::real_clock().now();
  RoomGuest& ben = room.join("designer");
  ASSERT_TRUE(room.turn_until([&] { return ben.follower().agreed() > 0 || ben.moment()->is_resting; }));
  std::printf("ready behind %lld entries after %.0f ms, %zu bytes\n", static_cast<long long>(room.host->health().seq),
              1000 * (host::real_clock().now() - began), bytes);
  EXPECT_LE(entries, 2u) << "those that were said meanwhile";
  EXPECT_EQ(ben.scene().nodes.find(node)->second.name, "Name " + std::to_string(entries_before - 1));
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(hex_digits(ben.moment()->ticked->hash), room.host->health().hash);
  EXPECT_EQ(ben.differed(), 0);
}

// One bit of one number of the state that a guest begins with. A bit of a demand stays: no tick changes it. A bit of a position
// may be rounded away by the next tick, and then nothing differs any more.
TEST(RoomGuests, AnotherStateIsNoticedWithinTwentyTicksHealedAndTold) {
  MemoryRoom room(kQuarter);
  ASSERT_TRUE(room.turn_until([&] { return room.host->health().tick > 25; }));
  int spoilt = 0;
  room.on_way = [&](std::string& frame) {
    if (spoilt != 0 || frame.find("\"snapshot\"") == std::string::npos) return;
    auto snapshot = wire::read_message<wire::SnapshotOut>(*parse_json(frame));
    ASSERT_TRUE(snapshot.ok());
    const std::string text = *journal::unpack({*wire::bytes_of_base64(snapshot->scene), snapshot->size, snapshot->digest});
    SceneReading reading = read_scene(text, full_registry());
    ASSERT_TRUE(reading.state.has_value());
    double& demand = std::get<double>(reading.state->nodes.at("cafe").at("smart_volume.demand"));
    demand = std::nextafter(demand, 1e9);
    const journal::Packed packed = journal::pack(write_scene(reading.scene, full_registry(), &*reading.state));
    snapshot->scene = wire::base64_of(packed.bytes);
    snapshot->size = packed.size;
    snapshot->digest = packed.digest;
    frame = wire::write_message(*snapshot);
    ++spoilt;
  };
  RoomGuest& guest = room.join("facilitator");
  std::int64_t began = 0;
  ASSERT_TRUE(room.turn_until([&] { return (began = guest.follower().tick()) > 0; }));
  std::vector<std::string> notices;
  ASSERT_TRUE(room.turn_until([&] {
    for (std::string& notice : guest.take_notices()) notices.push_back(std::move(notice));
    return !notices.empty();
  }));
  EXPECT_EQ(spoilt, 1);
  EXPECT_NE(notices.front().find("another result"), std::string::npos) << notices.front();
  EXPECT_LE(guest.follower().tick(), began + 20);
  const std::int64_t agreed = guest.follower().agreed();
  ASSERT_TRUE(room.turn_until([&] { return guest.follower().agreed() > agreed + 2; }));
  for (std::string& notice : guest.take_notices()) notices.push_back(std::move(notice));
  ASSERT_EQ(notices.size(), 2u) << "the facilitator is told as well";
  EXPECT_NE(notices.back().find("computed another result than the server"), std::string::npos) << notices.back();
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(hex_digits(guest.moment()->ticked->hash), room.host->health().hash);
}

TEST(RoomGuests, AnotherProgramShowsTheServersValues) {
  MemoryRoom room(kQuarter);
  host::SelfTest other = host::self_test();
  other.fingerprint = "0000000000000000";
  RoomGuest& guest = room.join("facilitator", other);
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene; }));
  EXPECT_FALSE(guest.standing().takes_ticks);
  ASSERT_EQ(guest.take_notices().size(), 1u);
  const std::int64_t first = guest.follower().tick();
  ASSERT_TRUE(room.turn_until([&] { return guest.follower().tick() > first + 20; })) << "its values come anew";
  ASSERT_TRUE(guest.submit({command<RenameNode>({"cafe", "Other"})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  EXPECT_EQ(guest.fold().confirmed().nodes.find("cafe")->second.name, "Other");
}

TEST(RoomGuests, WhereSomebodyIsComesToOthersAndGoesWithThem) {
  MemoryRoom room(kQuarter);
  RoomGuest &anna = room.join("facilitator"), &ben = room.join("designer");
  ASSERT_TRUE(room.turn_until([&] { return anna.standing().has_scene && ben.standing().has_scene; }));
  const std::int64_t seq = room.host->health().seq;
  ben.set_whereabouts({.cursor = Vector3{1, 2, 3}, .holds = {"cafe"}, .camera = {}, .is_hidden = false});
  ASSERT_TRUE(room.turn_until([&] { return anna.people().whereabouts.contains(ben.seat()); }));
  EXPECT_EQ(anna.people().whereabouts.at(ben.seat()).holds, std::vector<std::string>{"cafe"});
  EXPECT_EQ(anna.people().whereabouts.at(ben.seat()).cursor, (Vector3{1, 2, 3}));
  EXPECT_EQ(room.host->health().seq, seq) << "nothing of it is in the log";
  const std::int64_t seat = ben.seat();
  room.guests.pop_back();
  ASSERT_TRUE(room.turn_until([&] { return !anna.people().whereabouts.contains(seat); }));
}

TEST(RoomGuests, TheFacilitatorSetsTheClock) {
  MemoryRoom room(kQuarter);
  RoomGuest &lead = room.join("facilitator"), &other = room.join("designer");
  ASSERT_TRUE(room.turn_until([&] { return lead.standing().has_scene && other.standing().has_scene; }));
  EXPECT_TRUE(lead.why_no_clock().empty());
  EXPECT_FALSE(other.why_no_clock().empty());
  lead.play(false);
  ASSERT_TRUE(room.turn_until([&] { return !other.moment()->is_playing; }));
  ASSERT_TRUE(room.come_to_rest());
  const std::int64_t tick = room.host->health().tick;
  lead.step(3);
  ASSERT_TRUE(room.turn_until([&] { return other.moment()->ticked->tick == tick + 3; }));
  EXPECT_EQ(hex_digits(other.moment()->ticked->hash), room.host->health().hash);
  lead.set_rate(20);
  lead.play(true);
  ASSERT_TRUE(room.turn_until([&] { return other.moment()->is_playing && other.moment()->wanted_rate == 20; }));
  // Back by what everybody has done; the running state goes on.
  ASSERT_TRUE(lead.submit({command<RenameNode>({"cafe", "Later"})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return lead.standing().waiting == 0; }));
  lead.rewind(1000000);
  ASSERT_TRUE(room.turn_until([&] { return other.scene().nodes.find("cafe")->second.name == "Café"; }));
}

TEST(RoomGuests, AnIdleRoomIsSpokenToAgainAfterHours) {
  if (test::kIsSanitized) GTEST_SKIP() << "it takes minutes to settle";
  MemoryRoom room(kQuarter);
  RoomGuest& guest = room.join("facilitator");
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().has_scene && guest.moment()->is_resting; }, 60000));
  for (int k = 0; k < 100; ++k) room.turn(100);
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().is_connected; }));
  ASSERT_TRUE(guest.submit({command<SetPort>({"cafe", {"smart_volume.demand"}, {"900"}})}).ok());
  ASSERT_TRUE(room.turn_until([&] { return guest.standing().waiting == 0; }));
  // Of 100 000 ticks in that time, a busy computer does not make up for some.
  EXPECT_GT(room.host->health().tick, 50000);
  ASSERT_TRUE(room.come_to_rest());
  EXPECT_EQ(hex_digits(guest.moment()->ticked->hash), room.host->health().hash);
  EXPECT_FALSE(guest.follower().has_difference());
}

}  // namespace
}  // namespace bl::guest
