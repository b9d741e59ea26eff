// Twenty drafts by five editors, accepted in a random order: who is in whose way is named with both values, and nothing is lost.
#include <gtest/gtest.h>

#include "tests/core/room/room_world.h"
#include "tests/support/sanitized.h"

namespace bl::room {
namespace {

constexpr const char* kNodes[] = {"north", "north_2", "south"};

std::int64_t seat_of(std::int64_t draft) { return 2 + draft % 5; }

TEST(ManyDrafts, AcceptedInAnyOrderNameTheirConflictsAndKeepTheirAuthors) {
  for (std::uint64_t seed = 1; seed <= (test::kIsSanitized ? 2 : 12); ++seed) {
    Random random(seed);
    RoomWorld world;
    const auto lead = world.seat(Role::facilitator);
    for (int k = 0; k < 5; ++k) (void)world.seat(Role::designer, {"north"});
    std::map<std::string, std::map<std::string, double>> wishes;  // by draft and node
    std::vector<std::string> waiting;
    for (std::int64_t k = 0; k < 20; ++k) {
      const std::string id = "d" + std::to_string(k);
      ASSERT_EQ(sentence(world.say(seat_of(k), OperationKind::draft_begin, R"({"draft": ")" + id + "\"}")), "");
      for (std::uint64_t step = 0; step <= random.below(2); ++step) {
        const std::string node = kNodes[random.below(3)];
        wishes[id][node] = static_cast<double>(100 + random.below(800));
        ASSERT_EQ(sentence(world.command(seat_of(k), set_demand(node, wishes[id][node]), id)), "");
      }
      ASSERT_EQ(sentence(world.event(seat_of(k), "propose", R"({"draft": ")" + id + "\"}")), "");
      waiting.push_back(id);
    }
    std::map<std::string, std::string> writers;  // by node: the author who was accepted last
    while (!waiting.empty()) {
      const std::size_t k = random.below(waiting.size());
      const std::string id = waiting[k];
      waiting.erase(waiting.begin() + static_cast<std::ptrdiff_t>(k));
      const std::string author = RoomState::author_of_seat(seat_of(std::stoi(id.substr(1))));
      std::map<std::string, std::string> expected, found;
      for (const auto& [node, wish] : wishes[id])
        if (writers.contains(node) && writers[node] != author &&
            world.demand(node) != wish)  // who wants the same is in nobody's way
          expected["nodes/" + node + "/types/smart_volume/demand"] =
              writers[node] + " " + JsonValue::of(world.demand(node)).text() + " " + JsonValue::of(wish).text();
      for (const DraftConflict& conflict : world.room().summary_of(id).conflicts)
        found[text_of(conflict.place)] =
            conflict.author + " " + conflict.live.value().text() + " " + conflict.drafted.value().text();
      ASSERT_EQ(found, expected) << seed << " " << id;
      std::map<std::string, double> before;
      for (const char* node : kNodes) before[node] = world.demand(node);
      const auto accept = [&] {
        return world.event(lead, "decide_proposal", R"({"draft": ")" + id + R"(", "is_accepted": true})");
      };
      ASSERT_EQ(sentence(accept()), "");
      const EntryRecord& entered = world.disk.entries[world.disk.entries.size() - 2];
      EXPECT_EQ(entered.entry.author.id, author);
      EXPECT_EQ(entered.by, lead);
      EXPECT_EQ(entered.draft, id);
      for (const auto& [node, wish] : wishes[id]) EXPECT_EQ(world.demand(node), wish);
      if (random.below(3) == 0) {
        ASSERT_EQ(sentence(world.say(lead, OperationKind::undo,
                                     R"({"of": )" + std::to_string(RoomState::seat_of_author(author)) + "}")),
                  "");
        for (const char* node : kNodes) ASSERT_EQ(world.demand(node), before[node]) << seed << " " << id;
      }
      // An undo is a change by whoever made the draft: later drafts are told of it as of any other.
      for (const auto& [node, wish] : wishes[id]) writers[node] = author;
    }
    for (std::int64_t k = 0; k < 20; ++k)
      EXPECT_EQ(world.room().state().proposals.at("d" + std::to_string(k)).state, ProposalState::accepted);
  }
}

}  // namespace
}  // namespace bl::room
