// Map value: ranges by hand, units that do not meet, and a slider for density.
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase map(double value, bool rescale = true) {
  LinkCase link("map_value");
  link.set("rescale", rescale).set("in_min", 0.0).set("in_max", 100.0).set("out_min", 2000.0).set("out_max", 6000.0);
  link.from("source", value);
  return link;
}

TEST(MapValue, CarriesAsItIsOrRescaled) {
  auto plain = map(25, false);
  ASSERT_EQ(plain.run(), "");
  EXPECT_EQ(plain.number(End::to, "target"), 25);
  for (const auto& [in, out] : {std::pair{0.0, 2000.0}, {25.0, 3000.0}, {100.0, 6000.0}, {150.0, 6000.0}, {-50.0, 2000.0}}) {
    auto link = map(in);
    ASSERT_EQ(link.run(), "");
    EXPECT_EQ(link.number(End::to, "target"), out) << in;
  }
  auto open = map(150);
  ASSERT_EQ(open.set("clamp", false).run(), "");
  EXPECT_EQ(open.number(End::to, "target"), 8000);
  auto falling = map(25);
  ASSERT_EQ(falling.set("out_min", 6000.0).set("out_max", 2000.0).run(), "");
  EXPECT_EQ(falling.number(End::to, "target"), 5000);
}

TEST(MapValue, AnEmptyRangeAndAnEndlessResultAreErrors) {
  EXPECT_EQ(map(5).set("in_max", 0.0).run(),
            "in_max: the range of the input is empty; give `in_min` and `in_max` different values");
  EXPECT_NE(map(1e300).set("clamp", false).set("in_max", 1e-300).run(), "");
}

TEST(MapValue, UnitsMustAgreeUnlessRescaled) {
  const std::string nodes = R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"smart_volume": {"demand": 3000}}}, {"id": "b", "types": {"smart_volume": {}}}],
    "links": [{"id": "l", "kind": "map_value", "from": "a", "to": "b",
    "parameters": {"source": "smart_volume.demand", "target": )";
  World same = World::from_text(nodes + R"("smart_volume.demand_limit"}}]})");
  same.tick();
  EXPECT_EQ(same.link_error("l"), "");
  EXPECT_EQ(same.number("b", "smart_volume.demand_limit"), 3000);
  World rescaled = World::from_text(
      nodes + R"("smart_volume.storey_height", "rescale": true, "in_max": 6000, "out_min": 2, "out_max": 4}}]})");
  rescaled.tick();
  EXPECT_EQ(rescaled.number("b", "smart_volume.storey_height"), 3);
  const SceneReading mixed = read_scene(nodes + R"("smart_volume.storey_height"}}]})", full_registry());
  ASSERT_EQ(mixed.problems.size(), 1u);
  EXPECT_EQ(mixed.problems[0].error.code, ErrorCode::wrong_unit);
  World idle = World::from_text(nodes + R"("smart_volume.storey_height"}}]})");
  idle.tick();
  EXPECT_EQ(idle.link_error("l"), mixed.problems[0].error.text());
  EXPECT_EQ(idle.number("b", "smart_volume.storey_height"), 3.2);
}

TEST(MapValue, AMisspeltPortIsNamedAlsoWhereTheNodesAreChosen) {
  const SceneReading reading = read_scene(R"({"format": "behaviourlinks", "version": 1, "nodes": [
    {"id": "a", "types": {"smart_volume": {"demand": 3000}}}, {"id": "b", "types": {"smart_volume": {}}}],
    "links": [{"id": "l", "kind": "map_value", "from": "a", "to": {"typification": "smart_volume"},
    "parameters": {"source": "smart_volume.demand", "target": "smart_volume.demand_limt"}}]})",
                                          full_registry());
  ASSERT_EQ(reading.problems.size(), 1u);
  EXPECT_EQ(reading.problems[0].error.text(),
            "links/l/to: no node fits this end; the link does nothing: none of the 2 nodes that it chooses has "
            "`smart_volume.demand_limt`, which `map_value` needs, did you mean `demand_limit`?");
}

TEST(MapValue, SceneFollowsTheSliders) {
  World world = World::from_file("scenes/links/map_value.json");
  ASSERT_TRUE(world.settle());
  for (const char* house : {"house_1", "house_2", "house_3"}) {
    EXPECT_EQ(world.number(house, "smart_volume.demand"), 4000) << house;
    EXPECT_EQ(world.number(house, "smart_volume.storey_height"), 2.8) << house;
    EXPECT_NEAR(world.number(house, "smart_volume.volume"), 4000, 40) << house;
  }
}

}  // namespace
}  // namespace bl
