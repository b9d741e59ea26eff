// Trade: the law that what one gives the other gets, to the last bit; then deals by hand.
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

struct Trader {
  double demand = 0, allotment = 0, bought = 0;
};

LinkCase trading(const Trader& from, const Trader& to) {
  LinkCase link("trade");
  for (const auto& [end, trader] : {std::pair{End::from, from}, {End::to, to}}) {
    link.read(end, "node.id", {std::string(end == End::from ? "a" : "b")});
    link.read(end, "smart_volume.demand", {trader.demand}).read(end, "volume_account.allotment", {trader.allotment});
    link.read(end, "volume_account.bought", {trader.bought});
  }
  return link;
}
double sold_to(LinkCase& link) {
  EXPECT_EQ(link.run(), "");
  EXPECT_EQ(link.number(End::from, "volume_account.bought"), -link.number(End::to, "volume_account.bought"));
  EXPECT_EQ(link.number(End::from, "volume_account.paid"), -link.number(End::to, "volume_account.paid"));
  return link.number(End::to, "volume_account.bought");
}

// Houses with odd demands and allotments, and links of trade between odd ones, with odd prices.
std::string market(Random& random, int houses) {
  Json scene = {{"format", "behaviourlinks"}, {"version", 1}, {"nodes", Json::array()}, {"links", Json::array()}};
  const auto id = [](std::uint64_t house) { return "house" + std::to_string(house); };
  for (int i = 0; i < houses; ++i)
    scene["nodes"].push_back({{"id", id(static_cast<std::uint64_t>(i))},
                              {"types",
                               {{"smart_volume", {{"demand", random.uniform(10, 9000)}}},
                                {"volume_account", {{"allotment", random.uniform(10, 9000)}}}}}});
  for (int l = 0; l < 2 * houses; ++l) {
    const std::uint64_t from = random.below(static_cast<std::uint64_t>(houses)),
                        to = random.below(static_cast<std::uint64_t>(houses));
    // Some links are between two houses, some among all, and some between a house and all.
    const std::uint64_t form = random.below(4);
    if (form < 2 && from == to) continue;
    const Json all = {{"typification", "volume_account"}};
    scene["links"].push_back({{"id", "l" + std::to_string(l)},
                              {"kind", "trade"},
                              {"from", form == 2 ? all : Json(id(from))},
                              {"to", form < 2 ? Json(id(to)) : all},
                              {"strength", random.below(3) == 0 ? 0.5 : 1.0},
                              {"parameters", {{"rate", random.uniform(1, 400)}, {"price", random.uniform(0, 900)}}}});
  }
  return scene.dump();
}

TEST(Trade, LawWhatOneGivesTheOtherGetsToTheLastBit) {
  Random random(12);
  double moved = 0;
  for (int round = 0; round < 20; ++round) {
    const int houses = 2 + static_cast<int>(random.below(12));
    World world = World::from_text(market(random, houses));
    for (int tick = 0; tick < 60; ++tick) {
      world.tick();
      double bought = 0, paid = 0;
      for (int i = 0; i < houses; ++i) {
        bought += world.number("house" + std::to_string(i), "volume_account.bought");
        paid += world.number("house" + std::to_string(i), "volume_account.paid");
        moved += std::abs(world.number("house" + std::to_string(i), "volume_account.bought"));
      }
      ASSERT_EQ(bought, 0.0) << "round " << round << ", tick " << tick;
      ASSERT_EQ(paid, 0.0) << "round " << round << ", tick " << tick;
    }
  }
  EXPECT_GT(moved, 1e5);
}

TEST(Trade, TheLargerNeedBuys) {
  auto buys = trading({1000, 1000}, {1400, 1000});
  EXPECT_EQ(sold_to(buys), 100) << "a quarter of the difference of 400";
  EXPECT_EQ(buys.number(End::to, "volume_account.paid"), 40000);
  EXPECT_EQ(buys.number(End::from, "smart_volume.demand_limit"), 1000);
  auto sells = trading({1400, 1000}, {1000, 1000});
  EXPECT_EQ(sold_to(sells), -100);
  auto surplus = trading({100, 1000}, {1000, 1000});
  EXPECT_EQ(sold_to(surplus), 100) << "at most the rate";
  EXPECT_EQ(sold_to(surplus.set("rate", 7.0)), 7);
  auto poor = trading({0, 80}, {9000, 1000});
  EXPECT_EQ(sold_to(poor), 40) << "half of what there is";
  auto before = trading({1000, 900, 100}, {1400, 1200, -200});
  EXPECT_EQ(sold_to(before), 100) << "what was bought before counts";
}

// A seller with many buyers keeps what it cannot sell twice.
TEST(Trade, NobodySellsMoreThanThereIs) {
  LinkCase link("trade");
  link.set("rate", 1e6).read(End::from, "node.id", {std::string("seller")});
  link.from("smart_volume.demand", 0.0).from("volume_account.allotment", 100.0).from("volume_account.bought", 0.0);
  const std::vector<Value> nothing(50, 0.0), much(50, 9000.0);
  std::vector<Value> ids;
  for (int i = 0; i < 50; ++i) ids.push_back("buyer" + std::to_string(i));
  link.read(End::to, "node.id", ids).read(End::to, "smart_volume.demand", much);
  link.read(End::to, "volume_account.allotment", nothing).read(End::to, "volume_account.bought", nothing);
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::from, "volume_account.bought"), -50, 0.1) << "half of what there is, by all buyers together";
}

TEST(Trade, EqualNeedsAndLockedAccountsTradeNothing) {
  auto equal = trading({1500, 1000}, {2500, 2000});
  EXPECT_EQ(sold_to(equal), 0);
  for (const std::string port : {"volume_account.bought", "volume_account.paid"})
    for (const End end : {End::from, End::to}) {
      auto locked = trading({1000, 1000}, {1400, 1000});
      EXPECT_EQ(sold_to(locked.lock(end, port)), 0);
      EXPECT_EQ(locked.remarked(LinkRemark::short_of), std::string("the account of `") + (end == End::from ? "a" : "b") +
                                                           "` is locked, so that it does not trade: unlock it");
    }
}

TEST(Trade, SceneTradesUntilAllLackTheSame) {
  World world = World::from_file("scenes/links/trade.json");
  ASSERT_TRUE(world.settle());
  // Demands of 13500 m³ and rights of 12000 m³: each lacks 500 m³.
  double rights = 0;
  for (const auto& [house, demand] : {std::pair{"house_1", 2000.0}, {"house_2", 5000.0}, {"house_3", 6500.0}}) {
    EXPECT_NEAR(world.number(house, "volume_account.right"), demand - 500, 2) << house;
    EXPECT_NEAR(world.number(house, "smart_volume.volume"), demand - 500, 0.01 * demand) << house;
    EXPECT_NEAR(world.number(house, "volume_account.paid"), 400 * world.number(house, "volume_account.bought"), 1e-6) << house;
    rights += world.number(house, "volume_account.right");
  }
  EXPECT_EQ(rights, 12000);
}

}  // namespace
}  // namespace bl
