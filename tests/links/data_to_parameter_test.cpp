// Data to parameter: each way of sampling by hand, ranges, and nodes beside the data.
#include "tests/links/link_case.h"

namespace bl {
namespace {

Value layer() { return Shared<Table>(Table{{"x", "y", "value"}, {{0.0, 0.0, 10.0}, {10.0, 0.0, 40.0}, {0.0, 30.0, 70.0}}}); }

LinkCase at(double x, double y, const std::string& sampling) {
  LinkCase link("data_to_parameter");
  link.set("sampling", sampling).set("rescale", false).set("radius", 20.0);
  link.from("data_layer.values", layer()).to("node.position", Vector3{x, y, 100});
  return link;
}

TEST(DataToParameter, EachSamplingByHand) {
  const auto number = [](LinkCase link) {
    EXPECT_EQ(link.run(), "");
    return link.number(End::to, "target");
  };
  EXPECT_EQ(number(at(4, 0, "nearest")), 10);
  EXPECT_EQ(number(at(6, 0, "nearest")), 40);
  EXPECT_EQ(number(at(4, 0, "mean")), 25);
  // Weights 1/4 and 1/64 at distances 2 and 8.
  EXPECT_DOUBLE_EQ(number(at(2, 0, "inverse_distance")), (10 / 4.0 + 40 / 64.0) / (1 / 4.0 + 1 / 64.0));
  EXPECT_EQ(number(at(10, 0, "inverse_distance")), 40);
  EXPECT_EQ(number(at(0, 29, "mean")), 70);
}

TEST(DataToParameter, RangesAndClamp) {
  const auto number = [](LinkCase link) {
    EXPECT_EQ(link.run(), "");
    return link.number(End::to, "target");
  };
  const auto rescaled = [](bool clamp) {
    LinkCase link = at(0, 0, "nearest");
    link.set("rescale", true)
        .set("in_min", 20.0)
        .set("in_max", 40.0)
        .set("out_min", 100.0)
        .set("out_max", 200.0)
        .set("clamp", clamp);
    return link;
  };
  EXPECT_EQ(number(rescaled(true)), 100);
  EXPECT_EQ(number(rescaled(false)), 50);
  LinkCase empty = rescaled(true);
  EXPECT_EQ(empty.set("in_max", 20.0).run(),
            "in_max: the range of the data is empty; give `in_min` and `in_max` different values");
}

TEST(DataToParameter, ANodeBesideTheDataIsAnErrorOrLeftAlone) {
  LinkCase beside = at(500, 0, "nearest");
  EXPECT_EQ(beside.run(),
            "radius: the layer has no point within 20 m of the node: make the radius larger, or turn `needs_data` off");
  EXPECT_EQ(beside.set("needs_data", false).run(), "");
  EXPECT_FALSE(beside.proposed(End::to, "target").has_value());
}

TEST(DataToParameter, SceneGivesLouderPlacesSmallerVolumes) {
  World world = World::from_file("scenes/links/data_to_parameter.json");
  ASSERT_TRUE(world.settle());
  // The person's 2 000 m³ is one voice, the link's the other: 40 dB → 3 000, 50 dB at x = 20 → 2 333, 70 dB → 1 000.
  EXPECT_EQ(world.link_error("l1_noise"), "");
  EXPECT_GT(world.number("quiet", "smart_volume.demand"), world.number("middle", "smart_volume.demand"));
  EXPECT_GT(world.number("middle", "smart_volume.demand"), world.number("loud", "smart_volume.demand"));
}

}  // namespace
}  // namespace bl
