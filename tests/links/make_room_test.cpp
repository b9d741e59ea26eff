// Make room: the way to the middle of a body by hand, and four workshops on one spot.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase pressed_body(const Point3& centroid) {
  LinkCase link("make_room");
  link.set("stiffness", 0.5).set("play", 0.1).from("smart_volumes_solver.count", 3.0);
  link.to("node.position", Point3{1, 2, 3})
      .to("smart_volume.centroid", centroid)
      .to("smart_volume.volume", 4188.79);  // radius 10
  link.to("node.id", std::string("it")).to("smart_volume.standing", std::string("stack")).to("smart_volume.drop", 5.0);
  return link;
}

TEST(MakeRoom, FollowsTheMiddleOfTheBody) {
  auto off = pressed_body({4, 2, 3});  // 3 m off, of which 1 m is free: half of the rest
  ASSERT_EQ(off.run(), "");
  expect_near(off.move(End::to), {1, 0, 0}, 1e-5);
}

TEST(MakeRoom, LeavesRoundBodiesAndThoseWithoutOne) {
  auto within = pressed_body({1, 2.9, 3}), starved = pressed_body({4, 2, 3}), without_solver = pressed_body({4, 2, 3});
  ASSERT_EQ(within.run(), "");
  ASSERT_EQ(starved.to("smart_volume.volume", 0.0).run(), "");
  ASSERT_EQ(without_solver.from("smart_volumes_solver.count", 0.0).run(), "");
  EXPECT_FALSE(within.moves(End::to));
  EXPECT_FALSE(starved.moves(End::to));
  EXPECT_FALSE(without_solver.moves(End::to));
}

// What has to stand on the ground and is not down yet is lifted by nobody: it goes aside by as much.
TEST(MakeRoom, WhatHasToComeDownGoesAsideInsteadOfUp) {
  const auto ground = [](const Point3& centroid, double drop) {
    LinkCase link = pressed_body(centroid);
    link.to("smart_volume.standing", std::string("ground")).to("smart_volume.drop", drop);
    EXPECT_EQ(link.run(), "");
    return link;
  };
  const Vector3 aside = ground({4, 2, 7}, 5).move(End::to);  // 5 m off, of which 1 m is free: half of the rest
  EXPECT_EQ(aside.z, 0);
  EXPECT_NEAR(norm(aside), 2, 1e-5);
  EXPECT_GT(aside.x, 1.7) << "its name turns it a little";
  expect_near(ground({4, 2, 7}, -2).move(End::to), {1.2, 0, 1.6}, 1e-5);
  expect_near(ground({4, 2, -1}, 5).move(End::to), {1.2, 0, -1.6}, 1e-5);
  const Vector3 straight = ground({1, 2, 7}, 5).move(End::to);
  EXPECT_EQ(straight.z, 0);
  EXPECT_NEAR(norm(straight), 1.5, 1e-5) << "straight above another one its name says where to";
}

// Fourteen volumes that have to stand on the ground, on one spot, with the links that `new` lays: they part and come down.
TEST(MakeRoom, ACrowdThatHasToStandOnTheGroundComesToRest) {
  std::string nodes, site = R"({"id": "site", "types": {"boundary": {"form": "plan",)"
                            R"( "plan": [[0, 0, 0], [60, 0, 0], [60, 60, 0], [0, 60, 0]], "height": 40}}})";
  for (int i = 0; i < 14; ++i)
    nodes += R"(, {"id": "v)" + std::to_string(i) + R"(", "position": [)" + std::to_string(30 + 0.01 * i) +
             R"(, 30, 20], "types": {"smart_volume": {"demand": 1500, "standing": "ground"}}})";
  World world =
      World::from_text(R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + site + nodes +
                       R"(, {"id": "solver", "types": {"smart_volumes_solver": {}}}], "links": [)"
                       R"({"id": "room", "kind": "make_room", "from": "solver", "to": {"typification": "smart_volume"}},)"
                       R"( {"id": "stand", "kind": "stand", "from": "solver", "to": {"typification": "smart_volume"}},)"
                       R"( {"id": "inside", "kind": "inside_boundary", "from": "site",)"
                       R"( "to": {"typification": "smart_volume"}, "parameters": {"margin": 1}}]})");
  ASSERT_TRUE(world.settle(1000));
  for (int i = 0; i < 14; ++i) EXPECT_EQ(world.number("v" + std::to_string(i), "smart_volume.hang"), 0) << i;
}

TEST(MakeRoom, ScenePartsTheWorkshops) {
  World world = World::from_file("scenes/links/make_room.json");
  ASSERT_TRUE(world.settle());
  const std::vector<const char*> ids{"glass", "metal", "paint", "wood"};
  for (const char* a : ids)
    for (const char* b : ids) {
      if (a == b) continue;
      const double radii = world.number(a, "smart_volume.radius") + world.number(b, "smart_volume.radius");
      EXPECT_GT(distance(world.point(a, "node.position"), world.point(b, "node.position")), 0.5 * radii) << a << " " << b;
    }
}

}  // namespace
}  // namespace bl
