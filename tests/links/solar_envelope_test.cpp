// Solar envelope: a plane at 45 degrees by hand, and volumes that come back under the planes of a winter.
#include <cmath>

#include "core/sun/shadow_shape.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

const double kHalf = std::sqrt(0.5);

// The sun in the south at 45 degrees; the neighbour's edge along the x axis, on the ground: the plane z = -y.
LinkCase envelope(const std::string& mode, const Point3& position, double bottom, double height) {
  LinkCase link("solar_envelope");
  link.set("mode", mode).set("gain", 0.5).set("tolerance", 0.1);
  link.set("edge", Shared<std::vector<Point3>>(std::vector<Point3>{{-20, 0, 0}, {20, 0, 0}}));
  link.from("sun_and_sky.moments", Shared<Table>(Table{{"x", "y", "z", "seconds"}, {{0.0, -kHalf, kHalf, 600.0}}}));
  link.to("node.position", position).to("smart_volume.radius", 5.0).to("smart_volume.bottom", bottom);
  link.to("smart_volume.height", height).to("smart_volume.demand", 500.0).to("smart_volume.demand_limit", 1e9);
  return link;
}

TEST(SolarEnvelope, ABallComesBackUnderThePlane) {
  // The centre lies in the plane: 5 m too much, 0.5 m allowed, half of the rest taken back.
  auto link = envelope("move", {0, -10, 10}, 5, 10);
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), Vector3{0, -kHalf, -kHalf} * 2.25);
  auto below = envelope("move", {0, -18, 10}, 5, 10);
  ASSERT_EQ(below.run(), "");
  EXPECT_FALSE(below.moves(End::to));
}

TEST(SolarEnvelope, AFlatTopReachesLess) {
  // Cut off at the height of its centre, the shape reaches through the plane with the edge of its disc: 5 sin 45.
  auto link = envelope("move", {0, -10, 10}, 5, 5);
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), Vector3{0, -kHalf, -kHalf} * (0.5 * (5 * kHalf - 0.5)));
}

TEST(SolarEnvelope, ShavesAndLetsGrow) {
  auto link = envelope("shave", {0, -11, 7}, 2, 10);  // 2 m under the plane in height: beyond = (5 - 4 · 0.707) / 5 - 0.1
  ASSERT_EQ(link.run(), "");
  const double beyond = (5 - 4 * kHalf) / 5 - 0.1;
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit"), 500 * (1 - 0.5 * beyond), 1e-9);
  auto free = envelope("shave", {0, -40, 7}, 2, 10);
  free.to("smart_volume.demand_limit", 200.0);
  ASSERT_EQ(free.run(), "");
  EXPECT_NEAR(free.number(End::to, "smart_volume.demand_limit"), 200 * 1.25, 1e-9);
}

TEST(SolarEnvelope, SunFromTheOtherSideAndShapesWithoutSizeAreLeftAlone) {
  auto north = envelope("move", {0, 10, 10}, 5, 10);  // the volume stands on the far side of the edge
  ASSERT_EQ(north.run(), "");
  EXPECT_FALSE(north.moves(End::to));
  auto nothing = envelope("move", {0, -10, 10}, 5, 10);
  nothing.to("smart_volume.radius", 0.0);
  ASSERT_EQ(nothing.run(), "");
  EXPECT_FALSE(nothing.moves(End::to));
  auto point = envelope("move", {0, -10, 10}, 5, 10);
  point.set("edge", Shared<std::vector<Point3>>(std::vector<Point3>{{0, 0, 0}}));
  EXPECT_EQ(point.run(), "edge: an edge has at least two points: add them");
}

TEST(SolarEnvelope, SceneKeepsTheNeighboursSun) {
  World world = World::from_file("scenes/links/solar_envelope.json");
  ASSERT_TRUE(world.settle(400));
  EXPECT_EQ(world.link_error("l1_envelope"), "");
  // The neighbour's windows lie on the edge: they have lost next to nothing.
  EXPECT_GT(world.number("windows", "shadow_receiver.sun_mean"), 0.97 * world.number("windows", "shadow_receiver.sun_possible"));
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l1_envelope"})), "");
  for (const char* id : {"slab", "tower"})
    ASSERT_EQ(
        world.submit(command<SetPort>(
            {.node = id, .port = {"node.position"}, .value = {std::string(id) == "slab" ? "[14, 12, 6]" : "[40, 14, 14]"}})),
        "");
  world.tick(8);
  ASSERT_TRUE(world.settle(400));
  EXPECT_LT(world.number("windows", "shadow_receiver.sun_mean"), 0.9 * world.number("windows", "shadow_receiver.sun_possible"));
}

}  // namespace
}  // namespace bl
