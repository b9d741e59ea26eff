// How a volume stands: its storeys, set-backs and courtyard, and what the plates say of them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/plates_table.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// A volume of 3 000 m² on a plot of 100 m by 80 m, with these ports of its footprint.
World one_volume(const std::string& footprint, double height = 60) {
  return World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[100,0,0],[100,80,0],[0,80,0]], "height": )" +
                          std::to_string(height) + R"(}}},
    {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-9}}},
    {"id": "it", "position": [50, 40, 0], "types": {"smart_volume": {"demand": 9000, "storey_height": 3}, "footprint": {)" +
                          footprint + "}}}]}");
}

double plate_area(const World& world) {
  double sum = 0;
  const geometry::StandingBody body = geometry::read_body(world.table("it", "footprint.plates"));
  for (const geometry::PlateStack& stack : body.stacks) {
    double one = 0;
    for (const geometry::PlateFace& face : geometry::faces_of(stack, body.centre, 1e-5)) {
      one += geometry::signed_area(face.outer);
      for (const geometry::Ring& hole : face.holes) one += geometry::signed_area(hole);
    }
    EXPECT_NEAR(one, stack.area, 1e-4 * stack.area);
    sum += stack.storeys * stack.area;
  }
  return sum;
}

TEST(Footprint, StoreysAndFormGiveTheSides) {
  World world = one_volume(R"("form": "block", "storeys": 5, "aspect": 1.5)");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("it", "footprint.storeys_built"), 5);
  EXPECT_NEAR(world.number("it", "smart_volume.footprint"), 600, 1e-6);  // 30 m by 20 m
  EXPECT_NEAR(world.number("it", "footprint.facade_area"), 100 * 15, 1e-6);
  EXPECT_NEAR(world.number("it", "footprint.roof_area"), 600, 1e-6);
  EXPECT_NEAR(world.number("it", "smart_volume.height"), 15, 1e-12);
  EXPECT_NEAR(plate_area(world), 3000, 1e-6);
  EXPECT_NEAR(enclosed_volume(*world.mesh("it", "smart_volume.mesh")), 9000, 1e-4);
}

TEST(Footprint, UpperStoreysSetBack) {
  World world = one_volume(R"("form": "round", "storeys": 4, "full_storeys": 3, "setback": 2)");
  ASSERT_TRUE(world.settle());
  const double radius = world.number("it", "smart_volume.radius");
  EXPECT_NEAR(3 * 3.14159265358979 * radius * radius + 3.14159265358979 * (radius - 2) * (radius - 2), 3000, 1e-4);
  EXPECT_NEAR(plate_area(world), 3000, 0.3);
  EXPECT_EQ(geometry::read_body(world.table("it", "footprint.plates")).stacks.size(), 2u);
}

TEST(Footprint, DeepBuildingsHaveACourtyard) {
  World world = one_volume(R"("form": "block", "storeys": 2, "depth": 10)");
  ASSERT_TRUE(world.settle());
  // A square of side s with a court of side s - 20 m: s² - (s - 20)² = 1 500 m².
  EXPECT_NEAR(2 * std::sqrt(world.number("it", "smart_volume.weight")), 47.5, 1e-6);
  EXPECT_NEAR(world.number("it", "footprint.facade_area"), 4 * (47.5 + 27.5) * 6, 1e-4);
  EXPECT_NEAR(plate_area(world), 3000, 1e-6);
}

TEST(Footprint, AHeightLimitTakesStoreysAndTheFootprintGrows) {
  World world = one_volume(R"("storeys": 6, "height_limit": 13)");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("it", "footprint.storeys_built"), 4);
  EXPECT_NEAR(world.number("it", "smart_volume.footprint"), 750, 1e-6);
}

TEST(Footprint, TheBoundaryLimitsStoreysAndALeastNumberIsKept) {
  World low = one_volume(R"("storeys": 6)", 9.5);
  ASSERT_TRUE(low.settle());
  EXPECT_EQ(low.number("it", "footprint.storeys_built"), 3);
  World kept = one_volume(R"("storeys": 6, "storeys_min": 5, "height_limit": 4)");
  ASSERT_TRUE(kept.settle());
  EXPECT_EQ(kept.number("it", "footprint.storeys_built"), 5);
}

}  // namespace
}  // namespace bl
