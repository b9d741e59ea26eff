// The façade role: what it says without a style, and a house whose areas can be checked by hand.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Facade, WithoutAnyStyleItSaysSo) {
  World world = World::from_text(scene_text(R"({"id": "it", "types": {"smart_volume": {}, "facade": {}}})"));
  world.tick(2);
  EXPECT_EQ(world.node_error("it", "facade"), "");
  EXPECT_EQ(world.number("it", "facade.facade_area"), 0);
  EXPECT_NE(world.text("it", "facade.message").find("no façade style"), std::string::npos);
}

TEST(Facade, WithoutAStyleOfItsOwnItSaysHowToGiveOne) {
  World world = World::from_text(scene_text(
      R"({"id": "it", "types": {"smart_volume": {}, "facade": {}}}, {"id": "style", "types": {"facade_style": {"name": "brick"}}},
         {"id": "other", "types": {"smart_volume": {}, "facade": {"style": ["brik"]}}})"));
  world.tick(2);
  EXPECT_NE(world.text("it", "facade.message").find("lay a link"), std::string::npos);
  EXPECT_EQ(world.text("other", "facade.message"), "there is no style named `brik`, did you mean `brick`?");
}

TEST(Facade, SceneHasTheAreasOfItsBox) {
  World world = World::from_file("scenes/nodes/facade.json");
  ASSERT_TRUE(world.settle());
  // The ball nearly holds the box: its rim takes a little of the upper corners.
  EXPECT_EQ(world.text("house", "facade.message"), "");
  EXPECT_EQ(world.text("house", "facade.style_in_force"), "plain");
  const double area = world.number("house", "facade.facade_area"), glazed = world.number("house", "facade.glazed_area");
  EXPECT_NEAR(area, 360, 3.6);
  EXPECT_NEAR(glazed, 0.4 * area, 0.01 * area);
  EXPECT_NEAR(glazed + world.number("house", "facade.opaque_area"), area, 1e-9 * area);
  EXPECT_NEAR(world.number("house", "facade.cost"), 1000 * glazed + 500 * (area - glazed), 1e-6);
  EXPECT_NEAR(world.number("house", "facade.panels"), area / 6, 1e-9);
  const Table& sides = world.table("house", "facade.by_orientation");
  ASSERT_EQ(sides.rows.size(), 8u);
  double sum = 0;
  for (std::size_t row = 0; row < sides.rows.size(); ++row) sum += sides.number(row, "area");
  EXPECT_NEAR(sum, area, 1e-9 * area);
  EXPECT_NEAR(sides.number(sides.row_of("orientation", "south"), "area"), 108, 1.1);
  EXPECT_NEAR(sides.number(sides.row_of("orientation", "south"), "width"), 0.4 * 3 / 1.8, 1e-6);
  EXPECT_EQ(world.table("house", "facade.by_storey").rows.size(), 3u);
}

}  // namespace
}  // namespace bl
