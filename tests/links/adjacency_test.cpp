// Adjacency: the pull by hand, and rooms around a dining hall.
#include "tests/links/link_case.h"

namespace bl {
namespace {

Value neighbours(double area) {
  return Shared<Table>(Table{{"node", "area"}, {{std::string("a"), 7.0}, {std::string("b"), area}}});
}

LinkCase rooms(double length, double shared) {
  LinkCase link("adjacency");
  link.set("area", 36.0)
      .set("stiffness", 0.1)
      .from("smart_volume.neighbours", neighbours(shared))
      .to("node.id", std::string("b"));
  link.from("node.position", Point3{0, 0, 0}).to("node.position", Point3{length, 0, 0});
  link.from("smart_volume.radius", 10.0).to("smart_volume.radius", 8.0);
  return link;
}

TEST(Adjacency, PullsByTheClearDistanceAndTheMissingArea) {
  auto apart = rooms(20, 0);  // 2 m clear and 6 m for the whole area: a tenth of 8 m, half by each
  ASSERT_EQ(apart.run(), "");
  expect_near(apart.move(End::from), {0.4, 0, 0});
  expect_near(apart.move(End::to), {-0.4, 0, 0});
  auto touching = rooms(15, 18);  // half of the area is missing
  ASSERT_EQ(touching.run(), "");
  expect_near(touching.move(End::from), {0.15, 0, 0});
}

TEST(Adjacency, IsContentWithEnoughAndOnOnePoint) {
  EXPECT_EQ(rooms(15, 36).run(), "");
  auto enough = rooms(15, 40), together = rooms(0, 0), nothing = rooms(15, 0);
  ASSERT_EQ(enough.run(), "");
  ASSERT_EQ(together.run(), "");
  ASSERT_EQ(nothing.set("area", 0.0).run(), "");
  EXPECT_FALSE(enough.moves(End::from));
  EXPECT_FALSE(together.moves(End::from));
  EXPECT_FALSE(nothing.moves(End::from));
}

TEST(Adjacency, SceneGivesTheDiningHallItsWalls) {
  World world = World::from_file("scenes/links/adjacency.json");
  ASSERT_TRUE(world.settle());
  world.tick(200);
  const Table& walls = world.table("dining", "smart_volume.neighbours");
  ASSERT_EQ(walls.rows.size(), 3u);
  for (std::size_t row = 0; row < walls.rows.size(); ++row)
    EXPECT_GT(walls.number(row, "area"), walls.text(row, "node") == "garden" ? 29.5 : 59) << walls.text(row, "node");
}

}  // namespace
}  // namespace bl
