// Plot rules: the limits of one tick by hand, volumes beside the plot, and a scene that comes down to what is allowed.
#include "tests/links/link_case.h"

namespace bl {
namespace {

// Two volumes of 1000 m³ each with free limits; the second stands beside the plot.
LinkCase rules(double fsi, double gsi, double height) {
  LinkCase link("plot_rules");
  link.from("plot.polygon", Shared<std::vector<Point3>>(std::vector<Point3>{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}));
  link.from("plot.ground", 0.0).from("plot.height_max", 20.0).from("plot.fsi", fsi).from("plot.fsi_max", 2.0);
  link.from("plot.gsi", gsi).from("plot.gsi_max", 0.5);
  link.read(End::to, "smart_volume.centroid", {Vector3{5, 5, 5}, Vector3{50, 5, 5}});
  link.read(End::to, "smart_volume.demand", {1000.0, 1000.0}).read(End::to, "smart_volume.demand_limit", {1e9, 1e9});
  link.read(End::to, "smart_volume.bottom", {0.0, 0.0}).read(End::to, "smart_volume.height", {height, height});
  link.set("gain", 0.5);
  return link;
}

TEST(PlotRules, TheTightestRuleLimits) {
  // FSI 4 where 2 is allowed: half the way to a half.
  LinkCase dense = rules(4, 0.1, 5);
  ASSERT_EQ(dense.run(), "");
  EXPECT_DOUBLE_EQ(dense.number(End::to, "smart_volume.demand_limit", 0), 750);
  EXPECT_FALSE(dense.proposed(End::to, "smart_volume.demand_limit", 1).has_value());
  LinkCase wide = rules(4, 2, 5);  // GSI 2 where 0.5 is allowed
  ASSERT_EQ(wide.run(), "");
  EXPECT_DOUBLE_EQ(wide.number(End::to, "smart_volume.demand_limit", 0), 1000 * (1 + 0.5 * (0.25 - 1)));
  LinkCase high = rules(1, 0.1, 40);  // twice as high as allowed
  ASSERT_EQ(high.run(), "");
  EXPECT_DOUBLE_EQ(high.number(End::to, "smart_volume.demand_limit", 0), 750);
  LinkCase let = rules(4, 2, 40);
  ASSERT_EQ(let.set("hold_fsi", false).set("hold_gsi", false).set("hold_height", false).run(), "");
  EXPECT_FALSE(let.proposed(End::to, "smart_volume.demand_limit", 0).has_value());
}

TEST(PlotRules, SceneComesDownToWhatIsAllowed) {
  World world = World::from_file("scenes/links/plot_rules.json");
  ASSERT_TRUE(world.settle());
  EXPECT_LE(world.number("plot", "plot.fsi"), 2.02);
  EXPECT_GE(world.number("plot", "plot.fsi"), 1.9) << "more is wanted than is allowed: what is allowed is used";
  EXPECT_LE(world.number("plot", "plot.height_overshoot"), 0.4);
  EXPECT_EQ(world.number("west", "smart_volume.demand"), 6000) << "what is wanted has to stay visible beside what is allowed";
  EXPECT_LT(world.number("west", "smart_volume.wanted"), 3500);
}

}  // namespace
}  // namespace bl
