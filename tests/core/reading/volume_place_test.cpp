// Where a volume is named in drawings and tables: at its position, or in the middle of where it stands instead.
#include <gtest/gtest.h>

#include <cmath>

#include "core/reading/report_model.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl::reading {
namespace {

// A site of 100 m by 50 m with a canal from 40 to 60 m, and a house of 450 m² about a position.
Point3 place_of_house(const std::string& position) {
  World world = World::from_text(
      scene_text(R"({"id": "site", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[100,0,0],[100,50,0],[0,50,0]],
        "exclusions": [{"name": "canal", "x": 40, "y": -1, "bottom": 0, "top": 20}, {"name": "canal", "x": 60, "y": -1},
                       {"name": "canal", "x": 60, "y": 51}, {"name": "canal", "x": 40, "y": 51}]}}},
      {"id": "house", "position": )" +
                 position +
                 R"(, "types": {"smart_volume": {"demand": 2700, "storey_height": 3},
                                               "footprint": {"storeys": 2, "form": "block"}}},
      {"id": "solver", "types": {"standing_solver": {"tolerance": 1e-6}}})"));
  EXPECT_TRUE(world.settle(200));
  EXPECT_NEAR(world.number("house", "smart_volume.footprint"), 450, 0.01);
  ReportModel model;
  read_model(world.state(), model);
  EXPECT_EQ(model.volumes.size(), 1u);
  return model.volumes.empty() ? Point3() : model.volumes.front().place;
}

TEST(VolumePlace, IsThePositionWhereTheVolumeStandsThere) {
  const Point3 place = place_of_house("[20, 25, 0]");
  EXPECT_EQ(place.x, 20);
  EXPECT_EQ(place.y, 25);
}

// The half side h of its square has (h - 2) 2 h = 450 m²: from 42 - h to the canal.
TEST(VolumePlace, IsTheMiddleOfWhatStandsElsewhereAndNotItsEdge) {
  const Point3 place = place_of_house("[42, 25, 0]");
  const double half = 1 + std::sqrt(1 + 225.0);
  EXPECT_NEAR(place.x, (42 - half + 40) / 2, 0.01);
  EXPECT_NEAR(place.y, 25, 0.01);
}

}  // namespace
}  // namespace bl::reading
