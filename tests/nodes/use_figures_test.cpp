// Figures of a use at a volume: those of its use, none where no node is its use, and why.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/world.h"

namespace bl {
namespace {

TEST(UseFigures, AVolumeHasThoseOfItsUseAndOnlyThose) {
  World world = World::from_file("scenes/nodes/use_figures.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("house", "use_figures.use"), "housing");
  EXPECT_EQ(world.text("house", "use_figures.message"), "");
  EXPECT_NEAR(world.number("house", "use_figures.people"), world.number("house", "smart_volume.floor_area") * 0.025, 1e-9);
  EXPECT_EQ(world.text("chapel", "use_figures.message"), "no node is the use `chapel`");
  EXPECT_EQ(world.number("chapel", "use_figures.people"), 0);
  // What had a use and has another one keeps nothing of the first.
  ASSERT_EQ(world.submit(command<SetPort>({"house", {"smart_volume.use"}, JsonValue::of(Json("mill"))})), "");
  world.tick(2);
  EXPECT_EQ(world.text("house", "use_figures.use"), "");
  EXPECT_EQ(world.number("house", "use_figures.trips"), 0);
  EXPECT_EQ(world.number("house", "use_figures.least_sun"), 0);
  EXPECT_EQ(world.number("use_housing", "use.count"), 0);
}

}  // namespace
}  // namespace bl
