// Terrain follow: bilinear ground by hand, places beside it, and volumes that come to rest above a slope.
#include "tests/links/link_case.h"

namespace bl {
namespace {

// Two by two cells, 10 m apart: 0, 1 in the north, 2, 3 in the south.
LinkCase over(double x, double y, double z) {
  LinkCase link("terrain_follow");
  link.from("terrain.rows", Shared<Table>(Table{{"heights"}, {{std::string("AAAABA")}, {std::string("ACAADA")}}}));
  link.from("terrain.west", 0.0).from("terrain.north", 10.0).from("terrain.cell", 10.0).from("terrain.lowest", 0.0);
  link.from("terrain.step", 1 / 64.0).to("node.position", Vector3{x, y, z});
  return link;
}

TEST(TerrainFollow, GroundBetweenCellsIsBilinear) {
  LinkCase middle = over(5, 5, 0);
  ASSERT_EQ(middle.set("stiffness", 1.0).run(), "");
  expect_near(middle.move(End::to), {0, 0, 1.5});
  LinkCase south = over(2.5, 0, 0);
  ASSERT_EQ(south.set("stiffness", 0.5).set("offset", 4.0).run(), "");
  expect_near(south.move(End::to), {0, 0, 0.5 * (2.25 + 4)});
  LinkCase there = over(10, 10, 1);
  ASSERT_EQ(there.run(), "");
  EXPECT_FALSE(there.moves(End::to));
}

TEST(TerrainFollow, BesideTheGroundIsAnErrorOrLeftAlone) {
  LinkCase beside = over(20, 5, 0);
  EXPECT_EQ(beside.run(), "to: there is no ground at (20.0, 5.0): move the node onto the terrain, or turn `needs_ground` off");
  EXPECT_EQ(beside.set("needs_ground", false).run(), "");
  EXPECT_FALSE(beside.moves(End::to));
}

// A volume that stands is not moved: it is told the ground, which may be anything else the moment before.
TEST(TerrainFollow, AVolumeThatStandsIsToldItsGround) {
  LinkCase standing = over(5, 5, 0);
  ASSERT_EQ(standing.to("footprint.ground", 30.0).set("offset", -0.5).run(), "");
  EXPECT_FALSE(standing.moves(End::to));
  EXPECT_DOUBLE_EQ(standing.number(End::to, "footprint.ground"), 1.0);
}

TEST(TerrainFollow, VolumesStandOnASlopeFromTheFirstTickOn) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "hill", "types": {"terrain": {"rows": [{"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"}, {"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"},
     {"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"}, {"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"}, {"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"},
     {"heights": "AAAABkADIAEsAGQAH0AJYAK8AMg"}], "west": -10, "north": 45, "lowest": 2}}},
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]], "height": 40}}},
    {"id": "solver", "types": {"standing_solver": {}}},
    {"id": "low", "position": [10, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"storeys": 3}}},
    {"id": "high", "position": [50, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"storeys": 3}}}], "links": [
    {"id": "on", "kind": "terrain_follow", "from": "hill", "to": {"typification": "footprint"}}]})");
  world.tick(12);
  for (const char* node : {"low", "high"}) {
    EXPECT_EQ(world.text(node, "smart_volume.reason"), "");
    EXPECT_GT(world.number(node, "smart_volume.bottom"), 0) << node;
    EXPECT_NEAR(world.number(node, "smart_volume.bottom"), world.number(node, "footprint.ground"), 1e-12) << node;
    EXPECT_NEAR(world.point(node, "node.position").z, 0, 1e-12) << "it is not moved";
  }
  // 1 m in 10 m: 94 m² reach 5 m downhill from the position, and hang nowhere above the slope.
  EXPECT_NEAR(world.number("low", "smart_volume.bottom"), 4 - 0.5, 0.06);
  EXPECT_NEAR(world.number("high", "smart_volume.bottom"), 8 - 0.5, 0.06);
}

// The largest height counts from where each stands: uphill nobody loses storeys to the ground.
TEST(TerrainFollow, TheHeightOfARuleCountsFromTheGroundOfEachVolume) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "hill", "types": {"terrain": {"rows": [{"heights": "AAAAH0APoAXcAfQAnEAu4A2s"}, {"heights": "AAAAH0APoAXcAfQAnEAu4A2s"},
     {"heights": "AAAAH0APoAXcAfQAnEAu4A2s"}, {"heights": "AAAAH0APoAXcAfQAnEAu4A2s"}, {"heights": "AAAAH0APoAXcAfQAnEAu4A2s"},
     {"heights": "AAAAH0APoAXcAfQAnEAu4A2s"}], "west": -10, "north": 45}}},
    {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]], "height": 60},
     "plot": {"polygon": [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]], "height_max": 10}}},
    {"id": "solver", "types": {"standing_solver": {}}},
    {"id": "low", "position": [10, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"storeys": 4}}},
    {"id": "high", "position": [25, 20, 0], "types": {"smart_volume": {"demand": 900}, "footprint": {"storeys": 4}}}], "links": [
    {"id": "rules", "kind": "plot_rules", "from": "site", "to": {"typification": "smart_volume"}},
    {"id": "on", "kind": "terrain_follow", "from": "hill", "to": {"typification": "footprint"}}]})");
  world.tick(60);
  EXPECT_GT(world.number("high", "smart_volume.bottom"), 4 + world.number("low", "smart_volume.bottom"));
  for (const char* node : {"low", "high"}) EXPECT_EQ(world.number(node, "footprint.storeys_held"), 3) << node;
  EXPECT_NEAR(world.number("site", "plot.top"), 9.6, 1e-9);
  EXPECT_EQ(world.number("site", "plot.overshoot"), 0);
}

TEST(TerrainFollow, SceneStandsFiveMetresAboveTheSlope) {
  World world = World::from_file("scenes/links/terrain_follow.json");
  ASSERT_TRUE(world.settle());
  for (const char* node : {"low", "middle", "high"}) {
    const Vector3 p = world.point(node, "node.position");
    EXPECT_NEAR(p.z, 2 + 0.1 * (p.x + 10) + 5, 0.02) << node;
  }
}

}  // namespace
}  // namespace bl
