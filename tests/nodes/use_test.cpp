// Uses: figures of volumes and their sums by hand, and two nodes of one use.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

constexpr const char* kSite =
    R"({"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0, 0, 0], [60, 0, 0], [60, 40, 0], [0, 40, 0]], "height": 30}}},
       {"id": "solver", "types": {"standing_solver": {}}})";

std::string volume(const std::string& id, const std::string& use, double x, double demand) {
  return R"({"id": ")" + id + R"(", "position": [)" + std::to_string(x) +
         R"(, 20, 0], "types": {"footprint": {}, "use_figures": {}, "smart_volume": {"storey_height": 3, "use": ")" + use +
         R"(", "demand": )" + std::to_string(demand) + "}}}";
}

std::string scene_with(const std::string& more) {
  return scene_text(volume("house", "housing", 15, 3600) + ", " + volume("lodge", "housing", 30, 1800) + ", " +
                    volume("chapel", "chapel", 45, 900) + ", " + more + ", " + kSite);
}

constexpr const char* kHousing =
    R"({"id": "use_housing", "types": {"use": {"use": "housing", "trips_per_100": 10, "parking_per_100": 1.5, "people_per_100": 2,
       "cost_per_area": 2000, "value_per_area": 3000, "car_share": 0.4, "out_share": 0.8, "least_sun": 5400, "most_noise": 55}}})";

TEST(Uses, VolumesGetFiguresByTheirFloorArea) {
  World world = World::from_text(scene_with(kHousing));
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.node_error("use_housing", "use"), "");
  // 1200 m² and 600 m² in whole storeys of 3 m.
  const double house = world.number("house", "smart_volume.floor_area"), lodge = world.number("lodge", "smart_volume.floor_area");
  EXPECT_NEAR(house, 1200, 1);
  EXPECT_NEAR(world.number("house", "use_figures.trips"), house / 10, 1e-9);
  EXPECT_NEAR(world.number("house", "use_figures.parking"), house * 0.015, 1e-9);
  EXPECT_NEAR(world.number("house", "use_figures.people"), house * 0.02, 1e-9);
  EXPECT_NEAR(world.number("house", "use_figures.cost"), house * 2000, 1e-6);
  EXPECT_NEAR(world.number("house", "use_figures.value"), house * 3000, 1e-6);
  EXPECT_EQ(world.number("house", "use_figures.car_share"), 0.4);
  EXPECT_EQ(world.number("house", "use_figures.least_sun"), 5400);
  EXPECT_EQ(world.number("house", "use_figures.most_noise"), 55);
  EXPECT_EQ(world.number("use_housing", "use.count"), 2);
  EXPECT_NEAR(world.number("use_housing", "use.floor_area"), house + lodge, 1e-9);
  EXPECT_NEAR(world.number("use_housing", "use.people"), (house + lodge) * 0.02, 1e-9);
}

TEST(Uses, OneUseHasOneNodeAndAName) {
  World twice =
      World::from_text(scene_with(std::string(kHousing) + R"(, {"id": "again", "types": {"use": {"use": "housing"}}})"));
  twice.tick();
  EXPECT_EQ(twice.node_error("use_housing", "use"),
            "nodes/use_housing/use/use: `again` and `use_housing` are both the use `housing`: leave one of them out");
  World nameless = World::from_text(scene_with(R"({"id": "some", "types": {"use": {}}})"));
  nameless.tick();
  EXPECT_EQ(nameless.node_error("some", "use"), "nodes/some/use/use: name the use as its volumes do, such as `housing`");
}

TEST(Uses, OpenSpaceHasNoVolumes) {
  World world = World::from_text(
      scene_with(R"({"id": "use_chapel", "types": {"use": {"use": "chapel", "is_open": true, "people_per_100": 5}}})"));
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.number("use_chapel", "use.count"), 0);
  EXPECT_EQ(world.number("use_chapel", "use.floor_area"), 0);
  EXPECT_EQ(world.number("chapel", "use_figures.people"), 0);
  EXPECT_EQ(world.text("chapel", "use_figures.message"),
            "its use `chapel` is open space, which no volume has: give it another one");
}

TEST(Uses, ParkingAndCostFollowTheUses) {
  World world = World::from_file("scenes/nodes/use.json");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("garage", "smart_volume.volume"), 75 * world.number("use_offices", "use.parking"), 75);
  EXPECT_NEAR(world.number("builder", "stakeholder_group.spent"),
              world.number("use_housing", "use.cost") + world.number("use_offices", "use.cost"), 1e-6);
}

}  // namespace
}  // namespace bl
