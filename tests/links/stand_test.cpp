// Stand: the way down by hand, and a garage, shops with flats and a bridge that come to rest.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase hanging_volume(double drop) {
  LinkCase link("stand");
  link.set("stiffness", 0.5).set("footing", 0.2).set("play", 0.05).from("smart_volumes_solver.count", 1.0);
  link.to("smart_volume.drop", drop).to("smart_volume.volume", 4188.790204786391);  // radius 10 m
  return link;
}

TEST(Stand, GoesDownToItsFooting) {
  auto high = hanging_volume(6);  // 6 m, and 2 m into the ground of which 0.5 m may be missing
  ASSERT_EQ(high.run(), "");
  expect_near(high.move(End::to), {0, 0, -3.75});
  auto touching = hanging_volume(0);
  ASSERT_EQ(touching.run(), "");
  expect_near(touching.move(End::to), {0, 0, -0.75});
}

TEST(Stand, RestsOnItsFootingAndIsNeverLifted) {
  for (const double drop : {-1.5, -2.0, -8.0}) {
    auto standing = hanging_volume(drop);
    ASSERT_EQ(standing.run(), "");
    EXPECT_FALSE(standing.moves(End::to)) << drop;
  }
  auto starved = hanging_volume(6);
  ASSERT_EQ(starved.to("smart_volume.volume", 0.0).run(), "");
  EXPECT_FALSE(starved.moves(End::to));
}

TEST(Stand, SceneBringsEverythingDownThatHasTo) {
  World world = World::from_file("scenes/links/stand.json");
  world.tick(1);
  for (const char* id : {"garage", "shops", "flats", "east", "west"}) EXPECT_GT(world.number(id, "smart_volume.hang"), 1) << id;
  ASSERT_TRUE(world.settle());
  for (const char* id : {"garage", "shops", "flats", "east", "west", "walkway"})
    EXPECT_EQ(world.number(id, "smart_volume.hang"), 0) << id;
  for (const char* id : {"garage", "shops", "east", "west"})
    EXPECT_EQ(world.text(id, "smart_volume.stands_on"), "the ground") << id;
  EXPECT_EQ(world.text("flats", "smart_volume.stands_on"), "shops");
  EXPECT_EQ(world.text("walkway", "smart_volume.stands_on"), "");
  EXPECT_GT(world.number("walkway", "smart_volume.bottom"), 3);
  // On its footing a ball has a floor of its own on the ground.
  EXPECT_LT(world.number("garage", "smart_volume.drop"), -0.1 * world.number("garage", "smart_volume.radius"));
}

}  // namespace
}  // namespace bl
