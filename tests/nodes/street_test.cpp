// The street: lanes, toll, closing, and the sentence of one that nobody serves.
#include <cmath>

#include <gtest/gtest.h>

#include "core/file/scene_file.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

TEST(Street, WithoutANetworkItSaysSo) {
  World world = World::from_text(one_node("street", ""));
  world.tick();
  EXPECT_EQ(world.text("it", "street.reason"), "no traffic network takes care of it, or its network fails");
}

TEST(Street, FourStreetsInParallel) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_TRUE(world.settle(100));
  EXPECT_EQ(world.text("closed", "street.reason"), "it is closed");
  EXPECT_EQ(world.text("network", "traffic_network.message"), "`closed`: it is closed");
  EXPECT_EQ(world.number("closed", "street.flow_forth"), 0);
  EXPECT_EQ(world.number("narrow", "street.flow_forth"), 0) << "300 m at 8 m/s are never worth it here";
  // 0.05 EUR at 180 s each are 9 s: so much longer takes the wide street.
  EXPECT_NEAR(world.number("wide", "street.time_forth"), world.number("toll_road", "street.time_forth") + 9, 0.01);
  EXPECT_NEAR(world.number("wide", "street.flow_forth") + world.number("toll_road", "street.flow_forth"), 2400, 1e-6);
  EXPECT_EQ(world.number("toll_road", "street.time_back"), 0) << "one way";
  EXPECT_EQ(world.number("wide", "street.used_length"), 320);
  EXPECT_EQ(world.number("narrow", "street.used_length"), 300);
}

TEST(Street, ItsCourseIsItsLengthAndItsEndsFollowTheJunctions) {
  World world = World::from_file("scenes/nodes/street.json");
  world.tick();
  EXPECT_EQ(world.number("wide", "street.used_length"), 320) << "50 + 220 + 50 m by two bends";
  ASSERT_EQ(world.submit(command<SetPort>({.node = "north", .port = {"node.position"}, .value = {"[-30, 300, 0]"}})), "");
  world.tick(2);
  EXPECT_EQ(world.number("wide", "street.used_length"), 310) << "40 + 220 + 50 m: the bends stay where they are";
  EXPECT_NEAR(world.number("narrow", "street.used_length"), std::sqrt(30 * 30 + 300 * 300), 1e-9);
  ASSERT_EQ(world.submit(command<SetPort>({.node = "wide", .port = {"street.length"}, .value = {"500"}})), "");
  world.tick(2);
  EXPECT_EQ(world.number("wide", "street.used_length"), 500) << "a length that is set holds";
}

TEST(Street, HeightsOfItsCourseCountForNothing) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_EQ(
      world.submit(command<SetPort>({.node = "wide", .port = {"street.course"}, .value = {"[[0, 200, 900], [0, 100, -900]]"}})),
      "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "north", .port = {"node.position"}, .value = {"[0, 300, 400]"}})), "");
  world.tick(2);
  EXPECT_NEAR(world.number("wide", "street.used_length"), 500, 1e-9) << "300 m, and 400 m evenly upwards";
}

TEST(Street, ARoundThatEndsWhereItBeginsIsAStreetToDriveOn) {
  const std::string round = R"({"id": "round", "types": {"street": {"start": "gate", "end": "gate", "speed": 10)";
  const auto scene = [&](const std::string& course) {
    return scene_text(R"({"id": "network", "types": {"traffic_network": {}}},)" +
                      node_text("gate", "[0, 0, 0]", "junction", R"("delay": 3)") + "," + round + course + "}}}");
  };
  World bent = World::from_text(scene(R"(, "course": [[30, 0, 0], [30, 40, 0]])"));
  bent.tick();
  EXPECT_EQ(bent.number("round", "street.used_length"), 120);
  EXPECT_EQ(bent.number("round", "street.time_forth"), 15) << "12 s of way, and 3 s at the junction";
  EXPECT_EQ(bent.text("round", "street.reason"), "");
  EXPECT_EQ(bent.number("gate", "junction.streets"), 1);
  World straight = World::from_text(scene(""));
  straight.tick();
  EXPECT_EQ(straight.text("round", "street.reason"), "it begins and ends at the same junction");
}

TEST(Street, BadPointsOfACourseHaveTheirPlace) {
  const auto place_of = [](const std::string& course) {
    const SceneReading reading = read_scene(one_node("street", R"("course": )" + course), full_registry());
    return reading.is_usable() ? std::string() : reading.first_error().place + ": " + reading.first_error().message;
  };
  EXPECT_EQ(place_of("[[1, 2, 3], [4, 5, 6]]"), "");
  EXPECT_EQ(place_of("[]"), "");
  EXPECT_EQ(place_of("[[1, 2, 3], [4, 5]]"), "nodes/it/types/street/course/1: expects a point [x, y, z] in m, found [4, 5]");
  EXPECT_EQ(place_of(R"([[1, 2, "three"]])").substr(0, 30), "nodes/it/types/street/course/0");
  EXPECT_EQ(place_of("[[1, 2, 3], [4, 5, 6], [0, 2e7, 0]]"),
            "nodes/it/types/street/course/2: lies farther than 10 000 km from the origin; use local metric coordinates");
  EXPECT_EQ(place_of("7").substr(0, 28), "nodes/it/types/street/course");
}

TEST(Street, ItsCourseIsSavedAndLoaded) {
  const std::string text = project_file("scenes/nodes/street.json");
  const SceneReading reading = read_scene(text, full_registry());
  ASSERT_TRUE(reading.is_usable());
  EXPECT_EQ(write_scene(reading.scene, full_registry()), text) << "byte for byte";
  EXPECT_NE(text.find(R"("course": [[-30, 260, 0], [-30, 40, 0]])"), std::string::npos);
}

TEST(Street, OfNoLanesOrForWalkingIsClosedToCars) {
  World world = World::from_file("scenes/nodes/street.json");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "wide", .port = {"street.lanes"}, .value = {"0"}})), "");
  ASSERT_EQ(world.submit(command<SetPort>({.node = "toll_road", .port = {"street.for_cars"}, .value = {"false"}})), "");
  world.tick(3);
  EXPECT_EQ(world.text("wide", "street.reason"), "it is closed");
  EXPECT_EQ(world.text("toll_road", "street.reason"), "it is for walking only");
  EXPECT_NEAR(world.number("narrow", "street.flow_forth"), 2400, 1e-6);
  EXPECT_NEAR(world.number("narrow", "street.volume_over_capacity"), 8, 1e-9);
}

}  // namespace
}  // namespace bl
