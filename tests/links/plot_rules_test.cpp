// Plot rules: the limits of one tick by hand, volumes beside the plot, and a scene that comes down to what is allowed.
#include <string>

#include "tests/links/link_case.h"

namespace bl {
namespace {

// Two volumes of 1000 m³ each with free limits; the second stands beside the plot.
LinkCase rules(double fsi, double gsi, double height) {
  LinkCase link("plot_rules");
  link.from("plot.polygon", Shared<std::vector<Point3>>(std::vector<Point3>{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}));
  link.from("plot.ground", 0.0).from("plot.height_max", 20.0).from("plot.fsi", fsi).from("plot.fsi_max", 2.0);
  link.from("plot.gsi", gsi).from("plot.gsi_max", 0.5);
  link.read(End::to, "smart_volume.centroid", {Vector3{5, 5, 5}, Vector3{50, 5, 5}});
  link.read(End::to, "smart_volume.demand", {1000.0, 1000.0}).read(End::to, "smart_volume.demand_limit", {1e9, 1e9});
  link.read(End::to, "smart_volume.bottom", {0.0, 0.0}).read(End::to, "smart_volume.height", {height, height});
  link.read(End::to, "node.id", {std::string("here"), std::string("beside")});
  link.read(End::to, "smart_volume.wanted", {1000.0, 1000.0}).read(End::to, "smart_volume.fitted", {1000.0, 1000.0});
  link.set("gain", 0.5).set("tolerance", 0.0).set("least", 0.001);
  return link;
}

std::string why(const World& world) { return " " + world.link_error("l1_rules"); }

TEST(PlotRules, TheTightestRuleLimits) {
  // FSI 4 where 2 is allowed: half the way to a half.
  LinkCase dense = rules(4, 0.1, 5);
  ASSERT_EQ(dense.run(), "");
  EXPECT_DOUBLE_EQ(dense.number(End::to, "smart_volume.demand_limit", 0), 750);
  EXPECT_FALSE(dense.proposed(End::to, "smart_volume.demand_limit", 1).has_value());
  LinkCase wide = rules(4, 2, 5);  // GSI 2 where 0.5 is allowed
  ASSERT_EQ(wide.run(), "");
  EXPECT_DOUBLE_EQ(wide.number(End::to, "smart_volume.demand_limit", 0), 1000 * (1 + 0.5 * (0.25 - 1)));
  LinkCase high = rules(1, 0.1, 40);  // twice as high as allowed
  ASSERT_EQ(high.run(), "");
  EXPECT_DOUBLE_EQ(high.number(End::to, "smart_volume.demand_limit", 0), 750);
  LinkCase let = rules(4, 2, 40);
  ASSERT_EQ(let.set("hold_fsi", false).set("hold_gsi", false).set("hold_height", false).run(), "");
  EXPECT_FALSE(let.proposed(End::to, "smart_volume.demand_limit", 0).has_value());
}

TEST(PlotRules, JustBelowWhatIsAllowedTheLimitsRest) {
  LinkCase held = rules(1.99, 0.498, 19.9);
  held.set("tolerance", 0.01).read(End::to, "smart_volume.demand_limit", {600.0, 1e9});
  ASSERT_EQ(held.run(), "");
  EXPECT_DOUBLE_EQ(held.number(End::to, "smart_volume.demand_limit", 0), 600);
  EXPECT_EQ(held.remarked(LinkRemark::at_work), "");
  LinkCase high = rules(1, 0.1, 20.2);
  ASSERT_EQ(high.set("tolerance", 0.01).run(), "");
  EXPECT_DOUBLE_EQ(high.number(End::to, "smart_volume.demand_limit", 0), 1000 * (1 + 0.5 * (19.9 / 20.2 - 1)));
  EXPECT_EQ(high.remarked(LinkRemark::at_work), "from: height 20.2 m of 20.0 m at `here`");
}

TEST(PlotRules, LeaveTheLeastShareAndSayWhoHoldsTheRule) {
  LinkCase link = rules(1, 0.62, 5);
  link.from("plot.gsi_max", 0.4).read(End::to, "smart_volume.demand_limit", {200.0, 1e9});
  link.read(End::to, "smart_volume.wanted", {900.0, 1000.0}).read(End::to, "smart_volume.fitted", {899.0, 1000.0});
  ASSERT_EQ(link.set("least", 0.2).run(), "");
  EXPECT_DOUBLE_EQ(link.number(End::to, "smart_volume.demand_limit", 0), 200);
  EXPECT_EQ(link.remarked(LinkRemark::unmet),
            "from: cannot be met: GSI 0.62 of 0.40, held by `here` (900 m³ are insisted on); loosen the rule, or lower what is "
            "insisted on or `least`");
  link.read(End::to, "smart_volume.wanted", {200.0, 1000.0}).read(End::to, "smart_volume.fitted", {200.0, 1000.0});
  ASSERT_EQ(link.run(), "");
  EXPECT_NE(link.remarked(LinkRemark::unmet).find("GSI 0.62 of 0.40, held by `here`, which is down to 20 % of its demand"),
            std::string::npos);
}

// What holds several rules is said once, and what has no end is counted.
TEST(PlotRules, SayOnceWhatHoldsSeveralRules) {
  LinkCase link = rules(4.136, 0.62, 15);
  link.from("plot.height_max", 4.0).read(End::to, "smart_volume.centroid", std::vector<Value>(2, Vector3{5, 5, 5}));
  link.read(End::to, "smart_volume.demand_limit", {200.0, 200.0});
  link.read(End::to, "smart_volume.wanted", {200.0, 200.0}).read(End::to, "smart_volume.fitted", {200.0, 200.0});
  ASSERT_EQ(link.set("least", 0.2).run(), "");
  EXPECT_EQ(
      link.remarked(LinkRemark::unmet),
      "from: cannot be met: FSI 4.14 of 2.00, GSI 0.62 of 0.50, height 15.0 m of 4.0 m at `here`, height 15.0 m of 4.0 m at "
      "`beside`, all are down to 20 % of their demands; loosen the rule, or lower what is insisted on or `least`");
  LinkCase near = rules(1, 0.1, 20.0004);
  ASSERT_EQ(near.run(), "");
  EXPECT_EQ(near.remarked(LinkRemark::at_work), "from: height 20.0004 m of 20.0000 m at `here`");
}

TEST(PlotRules, CountTheHeightsOfManyVolumes) {
  LinkCase link = rules(1, 0.1, 15);
  const std::size_t count = 7;
  const auto all = [&](const char* path, const Value& value) { link.read(End::to, path, std::vector<Value>(count, value)); };
  link.from("plot.height_max", 4.0);
  all("smart_volume.centroid", Vector3{5, 5, 5});
  for (const char* path : {"smart_volume.demand", "smart_volume.wanted", "smart_volume.fitted"}) all(path, 1000.0);
  all("smart_volume.demand_limit", 1e9);
  all("smart_volume.bottom", 0.0);
  all("smart_volume.height", 15.0);
  all("node.id", std::string("one"));
  ASSERT_EQ(link.run(), "");
  const std::string said = link.remarked(LinkRemark::at_work);
  EXPECT_EQ(said.substr(said.size() - 10), "and 3 more") << said;
}

// People have locked what could give way.
TEST(PlotRules, LockedLimitsAreNamedAtOnce) {
  World world = World::from_file("scenes/links/plot_rules.json");
  for (const char* id : {"west", "east"})
    ASSERT_EQ(world.submit(command<LockPort>({.node = id, .port = {"smart_volume.demand_limit"}})), "");
  world.tick(20);
  const std::string said = world.link_error("l1_rules");
  EXPECT_NE(said.find("cannot be met: FSI "), std::string::npos) << said;
  EXPECT_NE(said.find("`west` (6000 m³, its limit is locked)"), std::string::npos) << said;
  EXPECT_NE(said.find("loosen the rule, unlock the limits, or lower"), std::string::npos) << said;
}

// One volume is insisted on and breaks the rule by itself: the other is left its share, and the scene is not called settled.
TEST(PlotRules, ARuleThatCannotBeMetKeepsASceneFromSettling) {
  World world = World::from_file("scenes/links/plot_rules.json");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "west", .port = {"smart_volume.demand_min"}, .value = {"6000"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {"plot.fsi_max"}, .value = {"0.8"}})), "");
  EXPECT_FALSE(world.settle(300));
  const std::string said = world.link_error("l1_rules");
  EXPECT_NE(said.find("cannot be met: FSI "), std::string::npos) << said;
  EXPECT_NE(said.find("held by `west` (6000 m³ are insisted on)"), std::string::npos) << said;
  EXPECT_NEAR(world.number("east", "smart_volume.fitted"), 0.2 * 6000, 0.02 * 1200) << "never wound to nothing";
}

TEST(PlotRules, SceneComesDownToWhatIsAllowed) {
  World world = World::from_file("scenes/links/plot_rules.json");
  ASSERT_TRUE(world.settle());
  EXPECT_LE(world.number("plot", "plot.fsi"), 2.02);
  EXPECT_GE(world.number("plot", "plot.fsi"), 1.9) << "more is wanted than is allowed: what is allowed is used";
  EXPECT_LE(world.number("plot", "plot.height_overshoot"), 0.4);
  EXPECT_EQ(world.number("west", "smart_volume.demand"), 6000) << "what is wanted has to stay visible beside what is allowed";
  EXPECT_LT(world.number("west", "smart_volume.wanted"), 3500);
}

TEST(PlotRules, WhereNothingIsAllowedAndNothingIsThereAllRests) {
  LinkCase held = rules(0, 0, 5);
  held.from("plot.gsi_max", 0.0).from("plot.fsi_max", 0.0).read(End::to, "smart_volume.demand_limit", {400.0, 1e9});
  ASSERT_EQ(held.run(), "");
  EXPECT_DOUBLE_EQ(held.number(End::to, "smart_volume.demand_limit", 0), 400);
  LinkCase low = rules(1, 0.06, 5);  // 0.04 too much of the land: answered as 0.04 of a tenth
  low.from("plot.gsi_max", 0.02);
  ASSERT_EQ(low.run(), "");
  EXPECT_DOUBLE_EQ(low.number(End::to, "smart_volume.demand_limit", 0), 1000 * (1 - 0.5 * 0.4));
}

// Volumes that shrink lift off the ground: what they cover of it goes little by little, and so the limit finds its place.
TEST(PlotRules, ComesToRestWithSmallGroundSpaceIndices) {
  for (const char* most : {"0.1", "0.03", "0"}) {
    World world = World::from_file("scenes/links/plot_rules.json");
    ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {"plot.gsi_max"}, .value = {most}})), "");
    ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l1_rules", .parameter = "least", .value = {"0.01"}})), "");
    EXPECT_TRUE(world.settle(1500)) << most << why(world);
    EXPECT_LE(world.number("plot", "plot.gsi"), std::stod(most) + 0.01) << most;
  }
}

TEST(PlotRules, SaysWhichVolumeNoSmallerDemandBringsBelowTheHeight) {
  World world = World::from_file("scenes/links/plot_rules.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("plot", "plot.message"), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "plot", .port = {"plot.height_max"}, .value = {"3"}})), "");
  world.tick(20);
  EXPECT_NE(world.text("plot", "plot.message")
                .find("m above the ground, so that however small it becomes it stands above the "
                      "largest height of 3.0 m"),
            std::string::npos)
      << world.text("plot", "plot.message");
}

// The one stands, the other is rounded: one link holds both, each in its own way.
TEST(PlotRules, WhatStandsKeepsTheHeightByItsStoreys) {
  LinkCase high = rules(1, 0.1, 40);
  high.read(End::to, "smart_volume.storey_height", {4.0, 4.0});
  high.read(End::to, "footprint.storeys", {std::int64_t{10}, std::int64_t{10}});
  high.read(End::to, "footprint.storeys_held", {std::int64_t{10}, std::int64_t{10}});
  high.read(End::to, "footprint.storeys_min", {std::int64_t{1}, std::int64_t{1}});
  high.read(End::to, "footprint.height_limit", {1e6, 1e6});
  ASSERT_EQ(high.run(), "");
  EXPECT_DOUBLE_EQ(high.number(End::to, "footprint.height_limit", 0), 20);
  EXPECT_FALSE(high.proposed(End::to, "footprint.height_limit", 1).has_value()) << "it is beside the plot";
  EXPECT_FALSE(high.proposed(End::to, "smart_volume.demand_limit", 0).has_value());
  EXPECT_EQ(high.remarked(LinkRemark::at_work), "from: height 40.0 m of 20.0 m at `here`");
  // Five of ten, and the ground is lower than the origin.
  high.read(End::to, "footprint.storeys_held", {std::int64_t{5}, std::int64_t{10}});
  high.read(End::to, "smart_volume.height", {20.0, 40.0}).read(End::to, "footprint.height_limit", {20.0, 1e6});
  ASSERT_EQ(high.run(), "");
  EXPECT_EQ(high.remarked(LinkRemark::short_of),
            "from: `here` has 5 of 10 storeys, because it may be no higher than 20.00 m by the rules of the plot");
  high.read(End::to, "footprint.storeys_min", {std::int64_t{7}, std::int64_t{1}});
  high.read(End::to, "footprint.storeys_held", {std::int64_t{7}, std::int64_t{10}});
  high.read(End::to, "smart_volume.height", {28.0, 40.0});
  ASSERT_EQ(high.run(), "");
  EXPECT_EQ(high.remarked(LinkRemark::unmet),
            "from: cannot be met: height 28.0 m of 20.0 m at `here`, held by `here`, which keeps at least 7 storeys "
            "(`storeys_min`); loosen the "
            "rule, or lower `storeys_min` of `here`");
}

TEST(PlotRules, SceneOfBallsAndOfVolumesThatStand) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,60,0],[0,60,0]], "height": 40},
                             "plot": {"polygon": [[0,0,0],[60,0,0],[60,60,0],[0,60,0]], "height_max": 14, "fsi_max": 1.2}}},
    {"id": "balls", "types": {"smart_volumes_solver": {"members": ["ball"]}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-6}}},
    {"id": "ball", "position": [12, 12, 6], "types": {"smart_volume": {"demand": 2000}}},
    {"id": "block", "position": [40, 40, 0], "types": {"smart_volume": {"demand": 9000, "storey_height": 3},
                                                       "footprint": {"storeys": 8}}}],
    "links": [{"id": "rules", "kind": "plot_rules", "from": "site", "to": {"typification": "smart_volume"}}]})");
  ASSERT_TRUE(world.settle(300));
  EXPECT_EQ(world.number("block", "footprint.storeys_held"), 4);
  EXPECT_NEAR(world.number("block", "smart_volume.floor_area"), 3000, 0.01);
  EXPECT_NEAR(world.number("block", "smart_volume.footprint"), 750, 0.01);
  EXPECT_NE(world.link_error("rules").find("`block` has 4 of 8 storeys"), std::string::npos) << world.link_error("rules");
  EXPECT_EQ(world.text("ball", "smart_volume.state"), "alive");
  // A ball that gets the role of a footprint is held by its storeys from then on, and the other way round.
  ASSERT_EQ(world.submit(command<Typify>({.node = "ball", .typification = "footprint", .values = {}})), "");
  ASSERT_EQ(world.submit(command<Untypify>({.node = "block", .typification = "footprint"})), "");
  world.tick(3);
  EXPECT_EQ(world.link_error("rules").find("has no `footprint"), std::string::npos) << world.link_error("rules");
  ASSERT_EQ(world.submit(command<Untypify>({.node = "ball", .typification = "footprint"})), "");
  ASSERT_EQ(world.submit(command<Typify>({.node = "block", .typification = "footprint", .values = {}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "block", .port = {"footprint.storeys"}, .value = {"8"}})), "");
  world.tick(20);
  ASSERT_TRUE(world.settle(300));
  EXPECT_EQ(world.number("block", "footprint.storeys_held"), 4);
  // The FSI takes floor area from both, storeys from none.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "site", .port = {"plot.fsi_max"}, .value = {"0.6"}})), "");
  world.tick(20);
  ASSERT_TRUE(world.settle(600));
  EXPECT_LE(world.number("site", "plot.fsi"), 0.6);
  EXPECT_GT(world.number("site", "plot.fsi"), 0.57);
  EXPECT_EQ(world.number("block", "footprint.storeys_held"), 4);
  EXPECT_LT(world.number("block", "smart_volume.footprint"), 700);
}

// The plot is a strip of the boundary, 10 m wide. The set-back moves the middle of the block from 8.4 m over its inner side to
// 10.5 m; it stands on the plot all the same.
TEST(PlotRules, NobodyLeavesAPlotByKeepingItsSetback) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[100,0,0],[100,40,0],[0,40,0]], "height": 40}}},
    {"id": "strip", "types": {"plot": {"polygon": [[0,0,0],[10,0,0],[10,40,0],[0,40,0]], "setback": 3}}},
    {"id": "rest", "types": {"plot": {"polygon": [[10,0,0],[100,0,0],[100,40,0],[10,40,0]]}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-6}}},
    {"id": "block", "position": [8, 20, 0], "types": {"smart_volume": {"demand": 1800, "storey_height": 3},
                                                      "footprint": {"storeys": 2}}}],
    "links": [{"id": "rules", "kind": "plot_rules", "from": "strip", "to": "block"}]})");
  world.tick(20);
  for (int tick = 0; tick < 20; ++tick) {
    world.tick();
    ASSERT_EQ(world.number("block", "footprint.border_distance"), 3) << tick;
    ASSERT_EQ(world.number("strip", "plot.count"), 1) << tick;
    ASSERT_EQ(world.number("rest", "plot.count"), 0) << tick;
  }
  EXPECT_TRUE(world.settle(50));
  EXPECT_GT(world.point("block", "smart_volume.centroid").x, 10);
  // One whose position lies before the border still stands on the plot, and one beyond its inner side does not.
  for (const auto& [at, count] : {std::pair("[-2, 20, 0]", 1), std::pair("[10.5, 20, 0]", 0)}) {
    ASSERT_EQ(world.submit(command<SetPort>({.node = "block", .port = {"node.position"}, .value = {at}})), "");
    world.tick(20);
    ASSERT_TRUE(world.settle(100)) << at;
    EXPECT_EQ(world.number("strip", "plot.count"), count) << at;
    EXPECT_EQ(world.number("rest", "plot.count"), 1 - count) << at;
  }
}

// The set-back of a plot holds from its border. Ground that the boundary leaves out inside has a distance that people set.
TEST(PlotRules, TheSetbackDoesNotHoldFromTreesInsideThePlot) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40, "exclusions": [
      {"name": "pit", "x": 29, "y": 19, "bottom": 0, "top": 40}, {"name": "pit", "x": 31, "y": 19},
      {"name": "pit", "x": 31, "y": 21}, {"name": "pit", "x": 29, "y": 21}]},
                             "plot": {"polygon": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "setback": 4}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-6}}},
    {"id": "a", "position": [10, 10, 0], "types": {"smart_volume": {"demand": 9960, "storey_height": 3},
                                                   "footprint": {"storeys": 2, "form": "cell"}}}],
    "links": [{"id": "rules", "kind": "plot_rules", "from": "site", "to": {"typification": "smart_volume"}}]})");
  world.tick(5);
  ASSERT_TRUE(world.settle(300));
  EXPECT_NEAR(world.number("a", "smart_volume.footprint"), 52 * 32 - 4, 1e-4) << "4 m from the border, none from the pit";
  EXPECT_EQ(world.number("site", "plot.setback_overshoot"), 0);
  ASSERT_EQ(world.submit(command<SetPort>({.node = "a", .port = {"footprint.exclusion_distance"}, .value = {"3"}})), "");
  world.tick(20);
  EXPECT_NEAR(world.number("a", "smart_volume.footprint"), 52 * 32 - 4 - 8 * 3 - 9 * 3.14159265358979, 1e-4)
      << "3 m about the pit, round at its corners";
}

// One volume near the border on each side of the plot; the street along the south has a distance of its own only by hand.
TEST(PlotRules, VolumesThatStandKeepTheSetback) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 40},
                             "plot": {"polygon": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "setback": 4}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-6}}},
    {"id": "west", "position": [-6, -4, 0], "types": {"junction": {}}},
    {"id": "east", "position": [66, -4, 0], "types": {"junction": {}}},
    {"id": "road", "types": {"street": {"start": ["west"], "end": ["east"]}}},
    {"id": "a", "position": [10, 10, 0], "types": {"smart_volume": {"demand": 3000, "storey_height": 3},
                                                   "footprint": {"storeys": 2, "form": "cell"}}},
    {"id": "b", "position": [50, 30, 0], "types": {"smart_volume": {"demand": 3000, "storey_height": 3},
                                                   "footprint": {"storeys": 2, "form": "round"}}}],
    "links": []})");
  ASSERT_TRUE(world.settle(100));
  EXPECT_NEAR(world.number("site", "plot.setback_overshoot"), 4, 1e-6) << "the cell reaches the border";
  EXPECT_NEAR(world.number("site", "plot.overshoot"), 1, 1e-6);
  const std::string rules = R"({"kind": "plot_rules", "from": "site", "to": {"typification": "smart_volume"}})";
  ASSERT_EQ(world.submit(command<AddLink>({"rules", {rules}})), "");
  world.tick(5);
  ASSERT_TRUE(world.settle(300));
  EXPECT_EQ(world.number("site", "plot.setback_overshoot"), 0);
  EXPECT_EQ(world.number("a", "footprint.border_distance"), 4);
  const double round = world.number("b", "smart_volume.footprint");
  EXPECT_NEAR(round, 500, 0.01);
  EXPECT_NEAR(world.number("a", "smart_volume.footprint") + round, 500 + 500, 0.02);
  // Along the street people want more: the cell moves its southern side, and still has what it wants.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "a", .port = {"footprint.street_distance"}, .value = {"7"}})), "");
  world.tick(5);
  ASSERT_TRUE(world.settle(300));
  EXPECT_NEAR(world.number("a", "smart_volume.footprint"), 500, 0.01);
  const auto corners = *world.table("a", "footprint.plates").numbers(0, "corners");
  double south = 1e9, west = 1e9;
  for (std::size_t k = 0; k < corners.size(); k += 4) {
    west = std::min(west, corners[k]);
    south = std::min(south, corners[k + 1]);
  }
  EXPECT_NEAR(south, 7, 1e-6);
  EXPECT_NEAR(west, 4, 1e-6);
}

}  // namespace
}  // namespace bl
