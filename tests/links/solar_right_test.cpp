// Solar right: each way to give way by hand, and a garden that gets its sun.
#include <cmath>

#include "tests/links/link_case.h"

namespace bl {
namespace {

// A garden at the origin that has lost 1800 of 7200 s; `tower` takes 2400 s of it, `house` 600 s. The link leads to one of them.
LinkCase right(const std::string& mode, const std::string& caster, double deficit = 1800) {
  LinkCase link("solar_right");
  link.set("mode", mode).set("gain", 0.5).set("tolerance", 0.05);
  link.from("node.id", std::string("garden")).from("node.position", Vector3{0, 0, 0});
  link.from("shadow_receiver.deficit", deficit).from("shadow_receiver.required_sun", 7200.0);
  link.from("shadow_receiver.sun_possible", 20000.0).from("shadow_receiver.sun_min", 1000.0);
  link.from("shadow_receiver.losses",
            Shared<Table>(Table{{"node", "lost", "shared"}, {{"house", 600.0, 600.0}, {"tower", 2400.0, 2400.0}}}));
  link.to("node.id", caster).to("node.position", Vector3{0, -30, 12}).to("smart_volume.demand", 8000.0);
  link.to("smart_volume.demand_limit", 1e9).to("smart_volume.radius", 10.0).to("smart_volume.bottom", 0.0);
  link.to("smart_volume.wanted", 8000.0).to("smart_volume.volume", 8000.0);
  return link;
}

double limit(LinkCase& link) { return link.number(End::to, "smart_volume.demand_limit"); }

TEST(SolarRight, GivesWayInProportion) {
  // A quarter is missing, a twentieth may be: 0.2, half of it answered at once: 0.1.
  auto shave = right("shave", "tower"), less = right("shave", "house");
  ASSERT_EQ(shave.run(), "");
  ASSERT_EQ(less.run(), "");
  EXPECT_NEAR(limit(shave), 8000 * 0.9, 1e-9);
  EXPECT_NEAR(limit(less), 8000 * (1 - 0.1 / 4), 1e-9);
  EXPECT_FALSE(shave.moves(End::to));
  auto lower = right("lower", "tower");
  ASSERT_EQ(lower.run(), "");
  expect_near(lower.move(End::to), {0, 0, -1.2});
  auto move = right("move", "tower");
  ASSERT_EQ(move.run(), "");
  expect_near(move.move(End::to), {0, -1, 0});
  EXPECT_FALSE(move.proposed(End::to, "smart_volume.demand_limit").has_value());
}

TEST(SolarRight, TheNeedMetNobodyGivesWay) {
  for (const char* mode : {"lower", "move"}) {
    auto met = right(mode, "tower", 360);  // exactly the tolerance
    ASSERT_EQ(met.run(), "");
    EXPECT_FALSE(met.moves(End::to)) << mode;
    auto nearly = right(mode, "tower", 367.2);  // a thousandth beyond it: the push has become small
    ASSERT_EQ(nearly.run(), "");
    EXPECT_LT(norm(nearly.move(End::to)), 0.01) << mode;
  }
  auto rests = right("shave", "tower", 300), grows = right("shave", "tower", 0), stranger = right("shave", "shed"),
       freed = right("shave", "shed");
  freed.to("smart_volume.demand_limit", 5000.0);
  rests.to("smart_volume.demand_limit", 5000.0);
  grows.to("smart_volume.demand_limit", 5000.0);
  for (LinkCase* link : {&rests, &grows, &stranger, &freed}) ASSERT_EQ(link->run(), "");
  EXPECT_EQ(limit(rests), 5000);
  EXPECT_NEAR(limit(grows), 5000 * (1 + 0.5 * 0.025), 1e-9);
  // Takes nothing, so nothing is asked of it; what held it back once is let go though the garden is still short.
  EXPECT_FALSE(stranger.proposed(End::to, "smart_volume.demand_limit").has_value());
  EXPECT_DOUBLE_EQ(limit(freed), 5000 * (1 + 0.5));
}

TEST(SolarRight, WhatNoCasterTakesIsAskedOfNone) {
  auto night = right("move", "tower", 7200);
  night.from("shadow_receiver.sun_possible", 0.0);
  ASSERT_EQ(night.run(), "");
  EXPECT_FALSE(night.moves(End::to));
  auto none = right("move", "tower");
  none.from("shadow_receiver.required_sun", 0.0);
  ASSERT_EQ(none.run(), "");
  EXPECT_FALSE(none.moves(End::to));
}

// A little more than the tolerance may be missing: there a limit rests, and what is left is not shaved off by ever less.
TEST(SolarRight, RestsWithinItsPlay) {
  auto near = right("shave", "tower", 360 + 0.05 * 7200 / 8), beyond = right("shave", "tower", 360 + 0.06 * 7200 / 8);
  for (LinkCase* link : {&near, &beyond}) {
    link->set("play", 0.125).to("smart_volume.demand_limit", 5000.0);
    ASSERT_EQ(link->run(), "");
  }
  EXPECT_EQ(limit(near), 5000);
  EXPECT_EQ(near.remarked(LinkRemark::at_work), "");
  EXPECT_LT(limit(beyond), 5000);
  EXPECT_EQ(beyond.remarked(LinkRemark::at_work), "from: `garden` is short of 0.12 h of sun");
}

TEST(SolarRight, LeavesTheLeastShareAndSaysSo) {
  auto link = right("shave", "tower");
  link.to("smart_volume.demand_limit", 1600.0).to("smart_volume.wanted", 1600.0).to("smart_volume.volume", 1600.0);
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(limit(link), 1600, 1e-9) << "a fifth of the demand is not taken";
  EXPECT_EQ(
      link.remarked(LinkRemark::unmet),
      "from: cannot be met: `garden` is short of 0.50 h of sun, held by `tower`, which is down to 20 % of its demand; lower "
      "`required_sun` or `least`, or move the volume");
}

// Two volumes, of which the first is at what the rule leaves it: the other can still give way, until it is there too.
TEST(SolarRight, IsAtWorkWhileOneCanGiveWay) {
  auto both = right("shave", "tower");
  both.read(End::to, "node.id", {std::string("house"), std::string("tower")});
  both.read(End::to, "node.position", {Vector3{0, -30, 4}, Vector3{0, -30, 12}});
  const std::vector<Value> demands = {8000.0, 8000.0};
  both.read(End::to, "smart_volume.demand", demands).read(End::to, "smart_volume.radius", {10.0, 10.0});
  both.read(End::to, "smart_volume.bottom", {0.0, 0.0}).read(End::to, "smart_volume.demand_limit", {8000.0, 1600.0});
  both.read(End::to, "smart_volume.wanted", {8000.0, 1600.0}).read(End::to, "smart_volume.volume", {8000.0, 1600.0});
  ASSERT_EQ(both.run(), "");
  EXPECT_NE(both.remarked(LinkRemark::at_work), "");
  both.lock(End::to, "smart_volume.demand_limit", 0);
  ASSERT_EQ(both.run(), "");
  EXPECT_EQ(both.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun, held by `house` (8000 m³, its limit is locked); lower "
            "`required_sun` or `least`, unlock the limits, or move the volume");
}

TEST(SolarRight, WhoCannotMoveOrSinkIsNamed) {
  auto locked = right("move", "tower"), free = right("move", "tower"), sunk = right("lower", "tower");
  locked.lock(End::to, "node.position");
  sunk.to("node.position", Vector3{0, -30, 0.4});
  for (LinkCase* link : {&locked, &free, &sunk}) ASSERT_EQ(link->run(), "");
  EXPECT_EQ(locked.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun, held by `tower` (its position is locked); lower "
            "`required_sun`, or let them be shaved");
  EXPECT_NE(free.remarked(LinkRemark::at_work), "");
  EXPECT_NE(sunk.remarked(LinkRemark::unmet).find("`tower` (it has sunk as far as it can)"), std::string::npos);
  auto stranger = right("move", "shed");
  ASSERT_EQ(stranger.run(), "");
  EXPECT_NE(stranger.remarked(LinkRemark::unmet).find("held by volumes that are not at the end of this link"), std::string::npos);
}

TEST(SolarRight, SceneTheGardenGetsItsSun) {
  World world = World::from_file("scenes/links/solar_right.json");
  ASSERT_TRUE(world.settle(400));
  EXPECT_EQ(world.link_error("l1_right"), "");
  const double required = world.number("garden", "shadow_receiver.required_sun");
  // It rests within its tolerance and the play beyond that.
  EXPECT_LE(world.number("garden", "shadow_receiver.deficit"), 0.05 * 1.125 * required);
  const double held = world.number("tower", "smart_volume.wanted");
  EXPECT_LT(held, 0.9 * world.number("tower", "smart_volume.demand"));
  // The house beside it takes less, and gives way less.
  EXPECT_GT(world.number("house", "smart_volume.wanted") / world.number("house", "smart_volume.demand"),
            held / world.number("tower", "smart_volume.demand"));
  // Without the link the garden is short.
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l1_right"})), "");
  world.tick(8);
  ASSERT_TRUE(world.settle(400));
  EXPECT_GT(world.number("garden", "shadow_receiver.deficit"), 0.09 * required);
  EXPECT_EQ(world.number("tower", "smart_volume.wanted"), world.number("tower", "smart_volume.demand"));
}

// Moving away is enough. Sinking is not, because the boundary holds the tower up on the way: that is said, and is not called
// settled.
TEST(SolarRight, OtherWaysToGiveWaySettleOrSaySo) {
  for (const char* mode : {"lower", "move"}) {
    World world = World::from_file("scenes/links/solar_right.json");
    const Point3 before = world.point("tower", "node.position");
    ASSERT_EQ(world.submit(
                  command<SetLinkParameter>({.id = "l1_right", .parameter = "mode", .value = {"\"" + std::string(mode) + "\""}})),
              "");
    world.tick(8);
    const bool is_enough = std::string(mode) == "move";
    EXPECT_EQ(world.settle(600), is_enough) << mode;
    const std::string said = world.link_error("l1_right");
    EXPECT_EQ(said.find("cannot be met: `garden` is short of") != std::string::npos, !is_enough) << said;
    EXPECT_EQ(said.find("and nothing changes any more") != std::string::npos, !is_enough) << said;
    const Vector3 moved = world.point("tower", "node.position") - before;
    if (std::string(mode) == "lower") EXPECT_LT(moved.z, -0.5);
    else EXPECT_LT(moved.y, -0.5);
    EXPECT_LT(norm(Vector3{moved.x, 0, 0}), 30) << mode;
  }
}

// What is left over is what the limit grows by, whatever is tolerated.
TEST(SolarRight, GrowsByTheSunThatIsLeftOver) {
  auto far = right("shave", "tower", 0);
  far.set("tolerance", 0.001).set("gain", 0.1);
  far.from("shadow_receiver.sun_min", 1.5 * 7200).to("smart_volume.demand_limit", 2000.0);
  ASSERT_EQ(far.run(), "");
  EXPECT_NEAR(limit(far), 2000 * (1 + 0.1 * 0.5), 1e-9);
}

}  // namespace
}  // namespace bl
