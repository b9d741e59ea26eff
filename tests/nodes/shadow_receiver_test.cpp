// Shadow receivers: where their points lie, which way they look, and façades of both sides.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World alone(const std::string& ports) {
  World world = World::from_text(scene_text(node_text("it", "[10, 20, 1]", "shadow_receiver", ports) + "," +
                                            node_text("study", "[0, 0, 0]", "sun_study") + "," +
                                            node_text("sun", "[0, 0, 0]", "sun_and_sky", R"("min_altitude": 5)")));
  world.tick(8);
  return world;
}

Point3 point_of(const World& world, std::size_t row) {
  const Table& map = world.table("it", "shadow_receiver.map");
  return {map.number(row, "x"), map.number(row, "y"), map.number(row, "z")};
}

TEST(ShadowReceiver, PointsAreTheMiddlesOfEqualFields) {
  World level = alone(R"("width": 8, "depth": 6, "spacing": 2.5, "raised": 4)");
  EXPECT_EQ(level.number("it", "shadow_receiver.columns"), 4);
  EXPECT_EQ(level.number("it", "shadow_receiver.rows"), 3);
  EXPECT_EQ(level.number("it", "shadow_receiver.area"), 48);
  EXPECT_EQ(point_of(level, 0), (Point3{7, 18, 5}));
  EXPECT_EQ(point_of(level, 11), (Point3{13, 22, 5}));
  World turned = alone(R"("width": 8, "depth": 6, "spacing": 2.5, "rotation": 90)");
  EXPECT_NEAR(point_of(turned, 0).x, 12, 1e-12);
  EXPECT_NEAR(point_of(turned, 0).y, 17, 1e-12);
  World fine = alone(R"("width": 1000, "depth": 1000, "spacing": 1)");
  EXPECT_LE(fine.table("it", "shadow_receiver.map").rows.size(), 4096u);
  EXPECT_GE(fine.table("it", "shadow_receiver.map").rows.size(), 3800u);
}

TEST(ShadowReceiver, FacadesSeeTheSunInFrontOfThem) {
  const auto facing = [](const char* azimuth) {
    World world = alone(std::string(R"("upright": true, "width": 4, "depth": 4, "azimuth": )") + azimuth);
    const Vector3 across = world.point("it", "shadow_receiver.half_across"), up = world.point("it", "shadow_receiver.half_up");
    const double turn = std::stod(azimuth) * std::acos(-1) / 180;
    EXPECT_NEAR(cross(across, up).x, 4 * std::sin(turn), 1e-9);
    EXPECT_NEAR(cross(across, up).y, 4 * std::cos(turn), 1e-9);
    return world.number("it", "shadow_receiver.sun_mean");
  };
  World level = alone("");
  const double all = level.number("it", "shadow_receiver.sun_mean");
  EXPECT_EQ(all, level.number("sun", "sun_and_sky.possible"));
  // In March the sun is in the south all day, half of it in the east and half in the west.
  EXPECT_NEAR(facing("180"), all, 1);
  EXPECT_EQ(facing("0"), 0);
  EXPECT_NEAR(facing("90") + facing("270"), all, 1e-6);
  EXPECT_NEAR(facing("90"), facing("270"), 1500);
}

TEST(ShadowReceiver, SceneTellsTheThreeApart) {
  World world = World::from_file("scenes/nodes/shadow_receiver.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("facade_north", "shadow_receiver.sun_max"), 0);
  EXPECT_EQ(world.number("facade_north", "shadow_receiver.share_met"), 0);
  EXPECT_EQ(world.number("facade_south", "shadow_receiver.share_met"), 1);
  const double met = world.number("playground", "shadow_receiver.share_met");
  EXPECT_GT(met, 0.3);
  EXPECT_LE(met, 1);
  EXPECT_EQ(world.table("playground", "shadow_receiver.losses").rows.size(), 2u);
}

}  // namespace
}  // namespace bl
