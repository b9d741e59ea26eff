// A sensor of people says how full the hall is, and what is wrong with its address.
#include <gtest/gtest.h>

#include "tests/support/world.h"

namespace bl {
namespace {

std::string scene_of(const std::string& ports) {
  return R"({"format": "behaviourlinks", "version": 1, "nodes": [{"id": "eyes", "types": {"people_sensor": )" + ports +
         R"(}}], "links": []})";
}

TEST(PeopleSensor, SaysHowManyOfThoseWhoCouldBeThere) {
  for (const auto& [ports, share] : {std::pair{R"({"present": 5, "most": 20})", 0.25},
                                     {R"({"present": 0, "most": 20})", 0.0},
                                     {R"({"present": 9, "most": 3})", 1.0},
                                     {R"({"present": 9, "most": 0})", 0.0}}) {
    World world = World::from_text(scene_of(ports));
    world.tick();
    EXPECT_EQ(world.number("eyes", "people_sensor.share"), share) << ports;
    EXPECT_EQ(world.text("eyes", "people_sensor.message"), "");
  }
}

TEST(PeopleSensor, SaysWhatIsWrong) {
  World table = World::from_text(scene_of(R"({"connection": "the table cannot be played: x"})"));
  table.tick();
  EXPECT_EQ(table.text("eyes", "people_sensor.message"), "the table cannot be played: x");
  World network = World::from_text(scene_of(R"({"address": "osc://9000/people"})"));
  network.tick();
  EXPECT_EQ(network.text("eyes", "people_sensor.message"),
            "people are followed by recorded tables only: write `replay:walk.csv#person`");
  World broken = World::from_text(scene_of(R"({"address": "somewhere"})"));
  broken.tick();
  EXPECT_TRUE(broken.text("eyes", "people_sensor.message").starts_with("the address cannot be used: "));
}

}  // namespace
}  // namespace bl
