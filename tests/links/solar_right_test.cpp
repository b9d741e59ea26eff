// Solar right: each way to give way by hand, and a garden that gets its sun.
#include <cmath>
#include <numbers>

#include "core/demand/shared_storeys.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

// A garden at the origin that has lost 1800 of 7200 s; `tower` takes 2400 s of it, `house` 600 s. The link leads to one of them.
LinkCase right(const std::string& mode, const std::string& caster, double deficit = 1800) {
  LinkCase link("solar_right");
  link.set("mode", mode).set("gain", 0.5).set("tolerance", 0.05);
  link.from("node.id", std::string("garden")).from("node.position", Vector3{0, 0, 0});
  link.from("shadow_receiver.deficit", deficit).from("shadow_receiver.required_sun", 7200.0);
  link.from("shadow_receiver.sun_possible", 20000.0).from("shadow_receiver.sun_of_share", 1000.0);
  link.from("shadow_receiver.losses",
            Shared<Table>(Table{{"node", "lost", "shared"}, {{"house", 600.0, 600.0}, {"tower", 2400.0, 2400.0}}}));
  link.to("node.id", caster).to("node.position", Vector3{0, -30, 12}).to("smart_volume.demand", 8000.0);
  link.to("smart_volume.demand_limit", 1e9).to("smart_volume.radius", 10.0).to("smart_volume.bottom", 0.0);
  link.to("smart_volume.wanted", 8000.0).to("smart_volume.fitted", 8000.0);
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
  link.to("smart_volume.demand_limit", 1600.0).to("smart_volume.wanted", 1600.0).to("smart_volume.fitted", 1600.0);
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(limit(link), 1600, 1e-9) << "a fifth of the demand is not taken";
  EXPECT_EQ(link.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun and can have 1.50 h of the 2.00 h, held by `tower`, which "
            "is down to 20 % of its demand; lower "
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
  both.read(End::to, "smart_volume.wanted", {8000.0, 1600.0}).read(End::to, "smart_volume.fitted", {8000.0, 1600.0});
  ASSERT_EQ(both.run(), "");
  EXPECT_NE(both.remarked(LinkRemark::at_work), "");
  both.lock(End::to, "smart_volume.demand_limit", 0);
  ASSERT_EQ(both.run(), "");
  EXPECT_EQ(both.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun and can have 1.50 h of the 2.00 h, held by `house` (8000 "
            "m³, its limit is locked); lower "
            "`required_sun` or `least`, unlock the limits, or move the volume");
}

TEST(SolarRight, WhoCannotMoveOrSinkIsNamed) {
  auto locked = right("move", "tower"), free = right("move", "tower"), sunk = right("lower", "tower");
  locked.lock(End::to, "node.position");
  sunk.to("node.position", Vector3{0, -30, 0.4});
  for (LinkCase* link : {&locked, &free, &sunk}) ASSERT_EQ(link->run(), "");
  EXPECT_EQ(locked.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun and can have 1.50 h of the 2.00 h, held by `tower` (its "
            "position is locked); lower "
            "`required_sun`, or let them be shaved");
  EXPECT_NE(free.remarked(LinkRemark::at_work), "");
  EXPECT_NE(sunk.remarked(LinkRemark::unmet).find("`tower` (it has sunk as far as it can)"), std::string::npos);
  auto stranger = right("move", "shed");
  ASSERT_EQ(stranger.run(), "");
  EXPECT_NE(stranger.remarked(LinkRemark::unmet)
                .find("no volume at the end of this link brings it more: `tower`, `house` "
                      "take it, which this link does not lead to; lower `required_sun`"),
            std::string::npos)
      << stranger.remarked(LinkRemark::unmet);
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
  far.from("shadow_receiver.sun_of_share", 1.5 * 7200).to("smart_volume.demand_limit", 2000.0);
  ASSERT_EQ(far.run(), "");
  EXPECT_NEAR(limit(far), 2000 * (1 + 0.1 * 0.5), 1e-9);
}

// A tower that stands: eight storeys of three metres are wished.
LinkCase standing(double built, double height_limit, double deficit = 1800, const std::string& mode = "shave") {
  LinkCase link = right(mode, "tower", deficit);
  link.to("smart_volume.storey_height", 3.0)
      .to("footprint.storeys", std::int64_t{8})
      .to("footprint.storeys_min", std::int64_t{1});
  link.to("footprint.storeys_held", static_cast<std::int64_t>(built)).to("footprint.height_limit", height_limit);
  // The weight of what stands may be anything; 10 m are the radius of its footprint.
  link.to("smart_volume.radius", 0.0).to("smart_volume.footprint", 100 * std::numbers::pi);
  return link;
}

std::optional<double> height(LinkCase& link) {
  const auto proposed = link.proposed(End::to, "footprint.height_limit");
  return proposed ? std::optional(as_number(*proposed)) : std::nullopt;
}

TEST(SolarRight, WhatStandsGivesWayByStoreys) {
  // From a storey above the roof by a tenth of one, whatever the sun that is missing.
  for (const char* mode : {"shave", "lower"}) {
    auto first = standing(8, 1e6, 1800, mode), next = standing(8, 24.5, 1800, mode);
    for (LinkCase* link : {&first, &next}) ASSERT_EQ(link->run(), "");
    EXPECT_NEAR(height(first).value(), 27 - 0.3, 1e-9) << mode;
    EXPECT_NEAR(height(next).value(), 24.2, 1e-9) << mode;
    EXPECT_FALSE(first.proposed(End::to, "smart_volume.demand_limit").has_value()) << "its floor area stays";
    EXPECT_FALSE(first.moves(End::to));
    EXPECT_EQ(first.remarked(LinkRemark::at_work), "from: `garden` is short of 0.50 h of sun");
  }
  auto moved = standing(8, 1e6, 1800, "move");
  ASSERT_EQ(moved.run(), "");
  expect_near(moved.move(End::to), {0, -1, 0});
  EXPECT_FALSE(height(moved).has_value());
  // Who shares a footprint moves with its host alone.
  moved.to("footprint.building", Shared<Table>(demand::table_of(demand::Building{"shops", 10, 1, 10, 3, 0, 30, 1e6, 0.5})));
  ASSERT_EQ(moved.run(), "");
  EXPECT_FALSE(moved.moves(End::to));
  EXPECT_NE(moved.remarked(LinkRemark::unmet).find("`tower` stands where `shops` does, whose footprint it shares"),
            std::string::npos)
      << moved.remarked(LinkRemark::unmet);
}

TEST(SolarRight, StoreysRestAndTheLimitIsNamed) {
  auto kept = standing(6, 19.9, 300);
  ASSERT_EQ(kept.run(), "");
  EXPECT_DOUBLE_EQ(height(kept).value(), 19.9);
  EXPECT_EQ(
      kept.remarked(LinkRemark::short_of),
      "to: `tower` has 6 of 8 storeys, because it may be no higher than 19.90 m, for the sun of `garden`, which lacks 0.08 h "
      "of its 2.00 h nevertheless: `tolerance` and `play` let it lack 0.11 h in the mean of its points");
  auto met = standing(6, 19.9, 0);
  ASSERT_EQ(met.run(), "");
  EXPECT_EQ(met.remarked(LinkRemark::short_of),
            "to: `tower` has 6 of 8 storeys, because it may be no higher than 19.90 m, so that `garden` keeps its sun");
  auto free = standing(8, 1e6, 300);
  ASSERT_EQ(free.run(), "");
  EXPECT_FALSE(height(free).has_value());
  EXPECT_EQ(free.remarked(LinkRemark::short_of), "");
}

TEST(SolarRight, AStoreyComesBackWhereThereIsMuchMoreThanEnough) {
  auto little = standing(6, 19.9, 0), much = standing(6, 19.9, 0);
  little.from("shadow_receiver.sun_of_share", 1.4 * 7200);
  much.from("shadow_receiver.sun_of_share", 1.6 * 7200);
  for (LinkCase* link : {&little, &much}) ASSERT_EQ(link->run(), "");
  EXPECT_DOUBLE_EQ(height(little).value(), 19.9);
  EXPECT_NEAR(height(much).value(), 20.2, 1e-9);
}

TEST(SolarRight, TheLeastStoreysAndLockedLimitsAreNamed) {
  auto low = standing(2, 6), locked = standing(8, 30);
  locked.lock(End::to, "footprint.height_limit");
  for (LinkCase* link : {&low, &locked}) ASSERT_EQ(link->run(), "");
  EXPECT_DOUBLE_EQ(height(low).value(), 6) << "a fifth of eight storeys is never taken: two";
  EXPECT_EQ(low.remarked(LinkRemark::unmet),
            "from: cannot be met: `garden` is short of 0.50 h of sun and can have 1.50 h of the 2.00 h, held by `tower`, which "
            "keeps at least 2 storeys (`least`: 20 % of 8); lower "
            "`required_sun`, lower `least`, or move the volume");
  EXPECT_NE(locked.remarked(LinkRemark::unmet).find("(its height limit is locked)"), std::string::npos);
}

// With the link the tower loses two storeys and its footprint grows; its floor area stays, and all that follows from it.
TEST(SolarRight, SceneAGardenTakesTwoStoreysFromATower) {
  World with = World::from_file("scenes/studies/tower_and_garden.json");
  World without = World::from_file("scenes/studies/tower_and_garden.json");
  ASSERT_EQ(without.submit(command<RemoveLink>({.id = "sun"})), "");
  ASSERT_TRUE(with.settle(400));
  ASSERT_TRUE(without.settle(400));
  const auto both = [&](const char* node, const char* port) {
    return std::pair(without.number(node, port), with.number(node, port));
  };
  EXPECT_EQ(both("tower", "footprint.storeys_held"), std::pair(10.0, 8.0));
  const auto [small, large] = both("tower", "smart_volume.footprint");
  EXPECT_NEAR(small, 240, 0.01);
  EXPECT_NEAR(large, 300, 0.01);
  for (World* world : {&with, &without}) EXPECT_NEAR(world->number("tower", "smart_volume.floor_area"), 2400, 0.05);
  // The garden has what it is owed, within the tolerance and its play; without the link it has not.
  const auto [short_by, met] = both("garden", "shadow_receiver.deficit");
  const double required = with.number("garden", "shadow_receiver.required_sun");
  EXPECT_GT(short_by, 0.02 * 1.125 * required);
  EXPECT_LE(met, 0.02 * 1.125 * required);
  // Trips and FSI are those of the same floor area; the ground is built on more, and the façades are others.
  EXPECT_NEAR(with.number("tower", "traffic_zone.trips_in"), without.number("tower", "traffic_zone.trips_in"), 0.01);
  EXPECT_GT(with.number("tower", "traffic_zone.trips_in"), 5);
  EXPECT_NEAR(with.number("solver", "standing_solver.fsi"), without.number("solver", "standing_solver.fsi"), 1e-5);
  EXPECT_GT(with.number("solver", "standing_solver.gsi"), without.number("solver", "standing_solver.gsi") + 0.01);
  EXPECT_LT(with.number("tower", "facade.facade_area"), 0.95 * without.number("tower", "facade.facade_area"));
  EXPECT_GT(with.number("tower", "facade.roof_area"), 1.2 * without.number("tower", "facade.roof_area"));
  const std::string said = with.link_error("sun");
  EXPECT_NE(said.find("`tower` has 8 of 10 storeys, because it may be no higher than "), std::string::npos) << said;
  EXPECT_NE(said.find(", for the sun of `garden`, which lacks 0.05 h of its 9.50 h nevertheless"), std::string::npos) << said;
  // No storey comes and goes, and all of them come back when there is room.
  for (int tick = 0; tick < 60; ++tick) {
    with.tick();
    ASSERT_EQ(with.number("tower", "footprint.storeys_held"), 8) << tick;
  }
  ASSERT_EQ(with.submit(command<SetPort>({.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {"3600"}})), "");
  with.tick(60);
  ASSERT_TRUE(with.settle(200));
  EXPECT_EQ(with.number("tower", "footprint.storeys_held"), 10);
  EXPECT_NEAR(with.number("tower", "smart_volume.footprint"), 240, 0.01);
  EXPECT_EQ(with.link_error("sun"), "");
}

// Its own word is what a link keeps: a limit that another one holds is not held on by the sun.
World garden_and_plot(const std::string& height_max, const std::string& more = "", const std::string& links = "") {
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  const std::string plot =
      R"({"id": "plot", "types": {"plot": {"polygon": [[0,0,0],[80,0,0],[80,44,0],[0,44,0]], "height_max": )" + height_max +
      "}}}," + more;
  const std::string rules = R"({"id": "rules", "kind": "plot_rules", "from": "plot", "to": "tower"},)" + links;
  text.insert(text.find("\"nodes\": [") + 10, plot);
  text.insert(text.find("\"links\": [") + 10, rules);
  return World::from_text(text);
}

// The tower is two volumes, one above the other: together they lose the storeys that one alone loses.
TEST(SolarRight, VolumesOfOneBuildingGiveWayTogether) {
  const std::string upper = R"({"id": "upper", "position": [32, 30, 0], "types": {"shadow_caster": {},
    "smart_volume": {"use": "office"}, "footprint": {"order": 1}}},)";
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  text.insert(text.find("\"nodes\": [") + 10, upper);
  text.insert(text.find("\"links\": [") + 10, R"({"id": "above", "kind": "share_footprint", "from": "tower", "to": "upper"},)");
  World world = World::from_text(text);
  ASSERT_TRUE(world.settle(400)) << world.link_error("sun");
  EXPECT_EQ(world.number("tower", "footprint.storeys_held"), 8);
  EXPECT_NEAR(world.number("upper", "smart_volume.floor_area"), 1200, 0.1);
  EXPECT_NEAR(world.number("tower", "smart_volume.footprint"), 300, 0.1);
  EXPECT_LE(world.number("garden", "shadow_receiver.deficit"),
            0.02 * 1.125 * world.number("garden", "shadow_receiver.required_sun"));
  EXPECT_NE(world.link_error("sun").find("the building of `tower` has 8 of 10 storeys"), std::string::npos)
      << world.link_error("sun");
  for (int tick = 0; tick < 60; ++tick) {
    world.tick();
    ASSERT_EQ(world.number("tower", "footprint.storeys_held"), 8) << tick;
  }
  ASSERT_EQ(world.submit(command<SetPort>({.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {"3600"}})), "");
  world.tick(60);
  ASSERT_TRUE(world.settle(200));
  EXPECT_EQ(world.number("tower", "footprint.storeys_held"), 10);
}

// The tower never shades the second garden: what the first one has taken is not held for it.
TEST(SolarRight, AGardenHoldsWhatItHasTakenAlone) {
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  text.insert(text.find("\"nodes\": [") + 10, R"({"id": "garden_2", "position": [32, -70, 0],
    "types": {"shadow_receiver": {"width": 24, "depth": 12, "required_sun": 34200}}},)");
  const std::string from = R"("from": "garden")";
  ASSERT_NE(text.find(from), std::string::npos);
  text.replace(text.find(from), from.size(), R"("from": {"typification": "shadow_receiver"})");
  World world = World::from_text(text);
  ASSERT_TRUE(world.settle(400));
  ASSERT_EQ(world.number("tower", "footprint.storeys_held"), 8);
  ASSERT_EQ(world.number("garden_2", "shadow_receiver.deficit"), 0);
  ASSERT_LT(world.number("garden_2", "shadow_receiver.sun_of_share"), 1.5 * 34200) << "not so much that all could be let go";
  ASSERT_EQ(world.submit(command<SetPort>({.node = "garden", .port = {"shadow_receiver.required_sun"}, .value = {"0"}})), "");
  world.tick(60);
  ASSERT_TRUE(world.settle(200));
  EXPECT_EQ(world.number("tower", "footprint.storeys_held"), 10) << world.link_error("sun");
}

TEST(SolarRight, WhoTakesTheStoreysAloneIsNamed) {
  // Four storeys of 3.2 m are left by the plot, eight by the garden; then nine and eight.
  World plot = garden_and_plot("13"), sun = garden_and_plot("30");
  for (World* world : {&plot, &sun}) ASSERT_TRUE(world->settle(500));
  EXPECT_EQ(plot.number("tower", "footprint.storeys_built"), 4);
  EXPECT_EQ(sun.number("tower", "footprint.storeys_built"), 8);
  EXPECT_NE(plot.link_error("rules").find("`tower` has 4 of 10 storeys"), std::string::npos) << plot.link_error("rules");
  EXPECT_EQ(plot.link_error("sun"), "");
  EXPECT_NE(sun.link_error("sun").find("`tower` has 8 of 10 storeys"), std::string::npos) << sun.link_error("sun");
  EXPECT_EQ(sun.link_error("rules"), "");
  // What has let go holds nobody any longer: the sun would leave eight, and does.
  ASSERT_EQ(plot.submit(command<SetPort>({.node = "plot", .port = {"plot.height_max"}, .value = {"100"}})), "");
  plot.tick(30);
  ASSERT_TRUE(plot.settle(500));
  EXPECT_EQ(plot.number("tower", "footprint.storeys_built"), 8);
}

// A wall that stands before the tower shades the same ground: without the tower the garden would have no minute more.
TEST(SolarRight, WhoBringsNothingBackIsLeftAlone) {
  const std::string wall = R"({"id": "wall", "types": {"shadow_caster": {}, "existing_building":
    {"outline": [[-60, 58, 0], [120, 58, 0], [120, 60, 0], [-60, 60, 0]], "height": 60, "height_source": "tag"}}},)";
  World world = garden_and_plot("1000", wall);
  world.tick(40);
  world.settle(200);
  EXPECT_GT(world.number("garden", "shadow_receiver.deficit"), 0.2 * world.number("garden", "shadow_receiver.required_sun"));
  EXPECT_EQ(world.number("tower", "footprint.storeys_built"), 10);
  EXPECT_EQ(world.number("tower", "footprint.height_limit"), 1e6);
  const std::string said = world.link_error("sun");
  EXPECT_NE(said.find("no volume at the end of this link brings it more: `wall` takes it, which this link does not lead to"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find(" and can have "), std::string::npos) << said;
}

// North of the garden, and far from it, nobody stands in its sun.
TEST(SolarRight, WhoIsOutOfReachIsLeftAlone) {
  const std::string others = R"({"id": "site_b", "types": {"boundary": {"form": "plan",
      "plan": [[0,90,0],[80,90,0],[80,130,0],[0,130,0]], "height": 60}}},
    {"id": "solver_b", "types": {"standing_solver": {"boundary": "site_b", "members": ["north"]}}},
    {"id": "north", "position": [32, 110, 0], "types": {"shadow_caster": {}, "smart_volume": {"demand": 4000, "storey_height": 3.2},
      "footprint": {"storeys": 12}}},)";
  std::string text = project_file("scenes/studies/tower_and_garden.json");
  text.insert(text.find("\"nodes\": [") + 10, others);
  const std::string solver = "\"standing_solver\": {\"tolerance\": 1e-06}";
  ASSERT_NE(text.find(solver), std::string::npos);
  text.replace(text.find(solver), solver.size(),
               R"("standing_solver": {"boundary": "site", "members": ["houses", "tower"], "tolerance": 1e-06})");
  World world = World::from_text(text);
  ASSERT_TRUE(world.settle(500));
  EXPECT_EQ(world.number("north", "footprint.storeys_built"), 12);
  EXPECT_EQ(world.number("tower", "footprint.storeys_built"), 8);
}

}  // namespace
}  // namespace bl
