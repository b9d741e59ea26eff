// Shadow casters: the outline of the shadow, and a role that is switched off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

const std::vector<Point3>& outline(const World& world, const char* node) {
  return *std::get<Shared<std::vector<Point3>>>(value_in(world.state(), node, "shadow_caster.outline"));
}

TEST(ShadowCaster, TheOutlineReachesAsFarAsTheSunIsLow) {
  World world = World::from_file("scenes/nodes/shadow_caster.json");
  ASSERT_TRUE(world.settle());
  const Vector3 sun = world.point("sun", "sun_and_sky.direction");
  const MeshPointer mesh = world.mesh("tower", "smart_volume.mesh");
  ASSERT_TRUE(mesh);
  const Vector3 away = Vector3{-sun.x, -sun.y, 0} / std::hypot(sun.x, sun.y);
  double wanted = -1e9, reach = -1e9;
  for (const Point3& corner : mesh->vertices)
    wanted = std::max(wanted, dot(corner, away) + corner.z * std::hypot(sun.x, sun.y) / sun.z);
  for (const Point3& corner : outline(world, "tower")) {
    reach = std::max(reach, dot(corner, away));
    EXPECT_EQ(corner.z, 0);
  }
  EXPECT_NEAR(reach, wanted, 1e-9);
  // By night there is no shadow.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "sun", .port = {"sun_and_sky.time"}, .value = {"7200"}})), "");
  world.tick(8);
  EXPECT_TRUE(outline(world, "tower").empty());
}

// How finely a scene is shown is for the eye.
TEST(ShadowCaster, TheSunDoesNotFollowTheTessellation) {
  World world = World::from_file("scenes/nodes/shadow_caster.json");
  ASSERT_TRUE(world.settle());
  const double lost = world.number("tower", "shadow_caster.sun_lost");
  const std::size_t corners = outline(world, "tower").size();
  for (const char* depth : {"0", "3", "4"}) {
    ASSERT_EQ(
        world.submit(command<SetPort>({.node = "solver", .port = {"smart_volumes_solver.tessellation_depth"}, .value = {depth}})),
        "");
    world.tick(8);
    EXPECT_NEAR(world.number("tower", "shadow_caster.sun_lost"), lost, 1e-6) << "depth " << depth;
    EXPECT_NEAR(static_cast<double>(outline(world, "tower").size()), static_cast<double>(corners), 2) << "depth " << depth;
  }
}

TEST(ShadowCaster, WhoDoesNotCastTakesNothing) {
  World world = World::from_file("scenes/nodes/shadow_caster.json");
  ASSERT_TRUE(world.settle());
  EXPECT_GT(world.number("tower", "shadow_caster.sun_lost"), 600);
  EXPECT_EQ(world.text("tower", "shadow_caster.worst"), "square");
  EXPECT_EQ(world.number("shed", "shadow_caster.sun_lost"), 0);
  EXPECT_EQ(world.number("shed", "shadow_caster.sun_shared"), 0);
  EXPECT_TRUE(outline(world, "shed").empty());
  EXPECT_EQ(world.text("shed", "shadow_caster.worst"), "");
}

// A house of ten metres that stands already: its shadow is ten metres over the tangent of the sun's height long.
TEST(ShadowCaster, ExistingBuildingsCastShadowToo) {
  const std::string house = R"({"id": "house", "types": {"shadow_caster": {}, "existing_building": {
      "outline": [[-10, -6, 0], [10, -6, 0], [10, 0, 0], [-10, 0, 0]], "height": 10}}})";
  World world = World::from_text(scene_text(house + "," + node_text("sun", "[0, 0, 0]", "sun_and_sky") + "," +
                                            node_text("study", "[0, 0, 0]", "sun_study") + "," +
                                            node_text("court", "[0, 4, 0]", "shadow_receiver", R"("width": 16, "depth": 8)")));
  world.tick(8);
  const Vector3 sun = world.point("sun", "sun_and_sky.direction");
  double reach = -1e9;
  for (const Point3& corner : outline(world, "house")) reach = std::max(reach, corner.y);
  EXPECT_NEAR(reach, 10 * -sun.y / sun.z, 1e-9);  // to the north of its wall at y = 0
  const double lost = world.number("house", "shadow_caster.sun_lost");
  EXPECT_GT(lost, 3600);
  EXPECT_NEAR(world.number("court", "shadow_receiver.sun_mean") + lost, world.number("sun", "sun_and_sky.possible"), 1e-6);
  EXPECT_EQ(world.text("house", "shadow_caster.worst"), "court");
  EXPECT_EQ(world.number("study", "sun_study.caster_count"), 1);
}

}  // namespace
}  // namespace bl
