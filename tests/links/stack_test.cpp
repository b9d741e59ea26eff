// Stack: levels by hand, volumes without a shape, and flats on offices on a hall.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase stacked() {
  LinkCase link("stack");
  link.set("stiffness", 0.5).from("node.position", Point3{0, 0, 5}).to("node.position", Point3{4, -2, 12});
  link.from("smart_volume.bottom", 0.0).from("smart_volume.height", 9.01);
  link.to("smart_volume.bottom", 7.0).to("smart_volume.height", 6.0);
  return link;
}

TEST(Stack, LiftsOnTopAndCentres) {
  auto link = stacked();  // the top is at 9.01 m, 2.01 m too high for the bottom; one centimetre is let off
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), {-2, 1, 1});
  EXPECT_FALSE(link.moves(End::from));
  ASSERT_EQ(link.set("gap", 3.0).set("centred", false).run(), "");
  expect_near(link.move(End::to), {0, 0, 2.5});
}

TEST(Stack, SameLevelUsesNeitherGapNorCentre) {
  auto link = stacked();
  ASSERT_EQ(link.set("relation", std::string("same_level")).set("gap", 3.0).to("smart_volume.bottom", 2.01).run(), "");
  expect_near(link.move(End::to), {0, 0, -1});
}

TEST(Stack, RestsWithinACentimetreAndWithoutShapes) {
  auto link = stacked();
  ASSERT_EQ(link.set("centred", false).to("smart_volume.bottom", 9.015).run(), "");
  expect_near(link.move(End::to), {0, 0, 0});
  ASSERT_EQ(link.to("smart_volume.bottom", 0.0).to("smart_volume.height", 0.0).run(), "");
  expect_near(link.move(End::to), {0, 0, 0});
}

TEST(Stack, WhatStandsIsSaidToStandOnTheRoof) {
  auto link = stacked();
  link.from("node.id", std::string("podium")).from("footprint.storeys_built", std::int64_t{2});
  link.to("footprint.storeys_built", std::int64_t{6});
  ASSERT_EQ(link.run(), "");
  EXPECT_TRUE(link.proposed(End::to, "footprint.bases") == Value(Shared(std::vector<std::string>{"podium"})));
  expect_near(link.move(End::to), {-2, 1, 0});  // heights follow from what it stands on
  ASSERT_EQ(link.set("relation", std::string("same_level")).run(), "");
  EXPECT_FALSE(link.proposed(End::to, "footprint.bases").has_value());
}

TEST(Stack, SceneATowerOnAPodium) {
  World world = World::from_file("scenes/studies/tower_on_podium.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("solver", "standing_solver.message"), "");
  EXPECT_EQ(world.text("tower", "smart_volume.stands_on"), "podium");
  EXPECT_EQ(world.text("podium", "smart_volume.stands_on"), "the ground");
  EXPECT_DOUBLE_EQ(world.number("tower", "smart_volume.bottom"), world.number("podium", "smart_volume.height"));
  for (const char* id : {"podium", "tower", "flats", "shops"})
    EXPECT_NEAR(world.number(id, "smart_volume.volume"), world.number(id, "smart_volume.demand"), 1e-3) << id;
  // Built ground is that of those who stand on the ground.
  EXPECT_NEAR(world.number("solver", "standing_solver.covered"),
              world.number("podium", "smart_volume.footprint") + world.number("shops", "smart_volume.footprint"), 1e-6);
  // Flats above shops fill the roof that the shops have.
  EXPECT_NEAR(world.number("flats", "smart_volume.footprint"), world.number("shops", "smart_volume.footprint"), 0.01);
  // Without the link they compete for the ground.
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "on_podium"})), "");
  world.tick(5);
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("tower", "smart_volume.bottom"), 0);
  // What it should stand on is gone: named, and nothing is lost.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "tower", .port = {"footprint.bases"}, .value = {"[\"nobody\"]"}})), "");
  world.tick(5);
  EXPECT_EQ(world.text("solver", "standing_solver.message"),
            "`tower` stands on the ground, because `nobody` is no volume of this solver");
  EXPECT_NEAR(world.number("tower", "smart_volume.volume"), world.number("tower", "smart_volume.demand"), 1e-2);
}

TEST(Stack, SceneStacksThreeUses) {
  World world = World::from_file("scenes/links/stack.json");
  ASSERT_TRUE(world.settle());
  world.tick(100);
  const auto bottom = [&](const char* node) { return world.number(node, "smart_volume.bottom"); };
  const auto top = [&](const char* node) { return bottom(node) + world.number(node, "smart_volume.height"); };
  EXPECT_NEAR(bottom("offices"), top("hall"), 0.05);
  EXPECT_NEAR(bottom("flats"), top("offices"), 0.05);
  EXPECT_NEAR(bottom("annex"), bottom("hall"), 0.05);
  EXPECT_NEAR(world.point("flats", "node.position").x, 28, 0.05);
  EXPECT_EQ(world.text("flats", "smart_volume.state"), "alive");
}

}  // namespace
}  // namespace bl
