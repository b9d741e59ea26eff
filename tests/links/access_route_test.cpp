// Access route: the nearest junctions within a walk, and a sentence where there are none.
#include "tests/links/link_case.h"

namespace bl {
namespace {

using Texts = std::vector<std::string>;

LinkCase route(double max_walk, std::int64_t count) {
  LinkCase link("access_route");
  link.set("max_walk", max_walk).set("count", count);
  link.from("node.id", std::string("house")).from("node.position", Vector3{0, 0, 0});
  link.read(End::to, "node.id", {std::string("a"), std::string("b"), std::string("c")});
  link.read(End::to, "node.position", {Vector3{300, 0, 0}, Vector3{0, 50, 0}, Vector3{0, 0, 100}});
  link.read(End::to, "junction.delay", {0.0, 0.0, 0.0});
  return link;
}

Texts access_of(const LinkCase& link) {
  return *std::get<Shared<Texts>>(link.proposed(End::from, "traffic_zone.access").value());
}

TEST(AccessRoute, TheNearestWithinAWalk) {
  LinkCase one = route(200, 1), two = route(200, 5), all = route(400, 5);
  ASSERT_EQ(one.run() + two.run() + all.run(), "");
  EXPECT_EQ(access_of(one), Texts{"b"});
  EXPECT_EQ(access_of(two), (Texts{"b", "c"}));
  EXPECT_EQ(access_of(all), (Texts{"b", "c", "a"}));
}

TEST(AccessRoute, TooFarIsSaidByTheZoneAlone) {
  LinkCase far = route(40, 1);
  ASSERT_EQ(far.run(), "");
  EXPECT_EQ(access_of(far), Texts{});
  // One zone that moves away loses its access, and the others keep theirs.
  World world = World::from_file("scenes/links/access_route.json");
  ASSERT_TRUE(world.settle(50));
  ASSERT_EQ(world.submit(command<SetPort>({"school", {"node.position"}, {"[0, 90000, 0]"}})), "");
  world.tick(3);
  EXPECT_TRUE(std::get<Shared<Texts>>(value_in(world.state(), "school", "traffic_zone.access"))->empty());
  EXPECT_NE(world.text("school", "traffic_zone.reason").find("no access"), std::string::npos);
  EXPECT_EQ(*std::get<Shared<Texts>>(value_in(world.state(), "workshop", "traffic_zone.access")), (Texts{"east", "middle"}));
}

TEST(AccessRoute, SceneAttachesZones) {
  World world = World::from_file("scenes/links/access_route.json");
  ASSERT_TRUE(world.settle(50));
  const auto access = [&](const char* zone) {
    return *std::get<Shared<Texts>>(value_in(world.state(), zone, "traffic_zone.access"));
  };
  EXPECT_EQ(access("school"), (Texts{"middle", "west"}));
  EXPECT_EQ(access("workshop"), (Texts{"east", "middle"})) << "by hand and by link";
  EXPECT_EQ(world.text("school", "traffic_zone.reason"), "");
  EXPECT_GT(world.number("school", "traffic_zone.trips_served"), 49.9);
}

}  // namespace
}  // namespace bl
