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
      .from("node.id", std::string("a"))
      .to("node.id", std::string("b"));
  link.from("node.position", Point3{0, 0, 0}).to("node.position", Point3{length, 0, 0});
  link.from("smart_volume.radius", 10.0).to("smart_volume.radius", 8.0);
  // Round bodies of these radii, in the middle of which their positions are.
  link.from("smart_volume.wanted", 4188.79).to("smart_volume.wanted", 2144.66);
  link.from("smart_volume.centroid", Point3{0, 0, 0}).to("smart_volume.centroid", Point3{length, 0, 0});
  return link;
}

TEST(Adjacency, PullsByTheClearDistanceAndTheMissingArea) {
  auto apart = rooms(18.5, 0);  // half a metre clear; the bodies allow 3.18 m, less than 6 m for the whole area
  ASSERT_EQ(apart.run(), "");
  expect_near(apart.move(End::from), {0.05 * (18.5 - 15.31946), 0, 0}, 1e-5);
  expect_near(apart.move(End::to), {-0.05 * (18.5 - 15.31946), 0, 0}, 1e-5);
  auto touching = rooms(17, 30);  // a sixth of the area is missing
  ASSERT_EQ(touching.run(), "");
  expect_near(touching.move(End::from), {0.05, 0, 0});
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

// Alone they would share 36 m² some 16.7 m apart, and twice that 15.3 m apart: nearer they are not pulled, whatever is between.
TEST(Adjacency, NeverPullsNearerThanTheBodiesAllow) {
  auto near = rooms(16, 0), nearest = rooms(15.3, 0), far = rooms(30, 0);
  ASSERT_EQ(near.run(), "");
  ASSERT_EQ(nearest.run(), "");
  EXPECT_NEAR(near.move(End::from).x, 0.05 * (16 - 15.3195), 1e-4);  // no more than the way to there
  EXPECT_FALSE(nearest.moves(End::from));
  EXPECT_FALSE(nearest.moves(End::to));
  // A wish that no two bodies of that size can fulfil brings them no nearer than half of the smaller radius.
  ASSERT_EQ(far.set("area", 1e6).set("stiffness", 1.0).run(), "");
  EXPECT_LT(norm(far.move(End::from) - far.move(End::to)), 30 - 10);
}

// A body of radius 10 is pressed where its middle is 0.8 m behind its position; its end goes a quarter of what is left until
// there.
TEST(Adjacency, LeavesThoseThatArePressed) {
  auto free = rooms(20, 0), eased = rooms(20, 0), pressed = rooms(20, 0);
  eased.from("smart_volume.centroid", Point3{-0.5, 0, 0});
  pressed.from("smart_volume.centroid", Point3{-0.9, 0, 0}).to("smart_volume.centroid", Point3{20, 7, 0});
  ASSERT_EQ(free.run(), "");
  ASSERT_EQ(eased.run(), "");
  ASSERT_EQ(pressed.run(), "");
  EXPECT_NEAR(eased.move(End::from).x, 0.075, 1e-5);
  EXPECT_NEAR(eased.move(End::to).x, free.move(End::to).x, 1e-12);
  EXPECT_FALSE(pressed.moves(End::from));
  EXPECT_NEAR(pressed.move(End::to).x, free.move(End::to).x, 1e-12);  // aside is not behind
}

// Whoever goes without is named, with the clear distance; a wall that is there is not.
TEST(Adjacency, SaysWhoDoesNotTouch) {
  auto apart = rooms(34, 0), barred = rooms(17, 0), touching = rooms(17, 30), without_body = rooms(34, 0);
  for (LinkCase* link : {&apart, &barred, &touching, &without_body}) link->from("node.id", std::string("h"));
  without_body.from("smart_volume.radius", 0.0);
  for (LinkCase* link : {&apart, &barred, &touching, &without_body}) ASSERT_EQ(link->run(), "");
  EXPECT_EQ(apart.remarked(LinkRemark::short_of),
            "`h` and `b` do not touch: 16.0 m are between them; move one of them, or what lies between them");
  EXPECT_EQ(
      barred.remarked(LinkRemark::short_of),
      "`h` and `b` do not touch: other volumes or the boundary lie between them; move one of them, or what lies between them");
  EXPECT_EQ(touching.remarked(LinkRemark::short_of), "");
  EXPECT_EQ(without_body.remarked(LinkRemark::short_of), "") << "that it has no body is said elsewhere";
}

// A court between two volumes that may not move: the scene settles, and says so; of several pairs the others are counted.
TEST(Adjacency, AWishThatIsNotMetIsAProblemOfASettledScene) {
  World world = World::from_file("scenes/links/adjacency.json");
  for (const char* id : {"dining", "foyer", "kitchen", "garden"})
    ASSERT_EQ(world.submit(command<LockPort>({.node = id, .port = {"node.position"}})), "");
  ASSERT_TRUE(world.settle());
  const std::string said = world.link_error("l1_service");
  EXPECT_NE(said.find("`dining` and `foyer` do not touch: "), std::string::npos) << said;
  EXPECT_NE(said.find("(and 1 more of its pairs)"), std::string::npos) << said;
  EXPECT_TRUE(world.state().is_settled());
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
