// The programme: totals by hand, and rows that cannot be.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string programme_error(const std::string& rows) {
  World world = World::from_text(one_node("programme", R"("rows": [)" + rows + "]"));
  world.tick();
  return world.node_error("it", "programme");
}

TEST(Programme, AddsUpAreaTimesHeightTimesCount) {
  World world = World::from_text(one_node("programme", R"("rows": [
      {"use": "housing", "floor_area": 100, "floor_area_min": 80, "storey_height": 3, "count": 4},
      {"use": "shop", "floor_area": 50, "storey_height": 4}])"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "programme"), "");
  EXPECT_EQ(world.number("it", "programme.total_floor_area"), 450);
  EXPECT_EQ(world.number("it", "programme.total_floor_area_min"), 320);
  EXPECT_EQ(world.number("it", "programme.total_volume"), 1400);
  EXPECT_EQ(world.number("it", "programme.items"), 5);
  EXPECT_EQ(world.number("it", "programme.uses"), 2);
}

TEST(Programme, AnEmptyOneWantsNothing) {
  World world = World::from_text(one_node("programme", ""));
  world.tick();
  EXPECT_EQ(world.node_error("it", "programme"), "");
  EXPECT_EQ(world.number("it", "programme.total_volume"), 0);
  EXPECT_EQ(world.number("it", "programme.items"), 0);
}

TEST(Programme, NamesTheRowAndColumnOfAFault) {
  EXPECT_EQ(
      programme_error(R"({"use": "a", "floor_area": 1}, {"use": "b", "floor_area": 1}, {"use": "a", "floor_area": 2})"),
      "nodes/it/programme/rows/2/use: the use `a` stands in an earlier row too: put both into one row, or name one otherwise");
  EXPECT_EQ(programme_error(R"({"use": "a", "floor_area": 10, "floor_area_min": 12})"),
            "nodes/it/programme/rows/0/floor_area_min: the value is 12 m², more than the floor area aimed at (10 m²): lower it");
  EXPECT_EQ(programme_error(R"({"use": "a", "floor_area": 10, "floor_area_max": 8})"),
            "nodes/it/programme/rows/0/floor_area_max: the value is 8 m², less than the floor area aimed at (10 m²): raise it, "
            "or write 0 for none");
  EXPECT_EQ(programme_error(R"({"use": "a", "floor_area": 10, "count": 1.5})"),
            "nodes/it/programme/rows/0/count: the value must be a whole number of items, at least 1, found 1.5");
  EXPECT_EQ(programme_error(R"({"use": "a", "floor_area": 0})"),
            "nodes/it/programme/rows/0/floor_area: the value must be more than 0 m², found 0");
  EXPECT_EQ(programme_error(R"({"use": "", "floor_area": 1})"), "nodes/it/programme/rows/0/use: the use is empty: name the use");
}

TEST(Programme, RowsOfOpenSpaceAskForGround) {
  World world = World::from_text(scene_text(
      R"({"id": "it", "types": {"programme": {"rows": [{"use": "square", "floor_area": 300},
          {"use": "housing", "floor_area": 100, "count": 4, "storey_height": 3}, {"use": "garden", "floor_area": 50, "count": 2}]}}},
         {"id": "use_garden", "types": {"use": {"use": "garden", "is_open": true}}},
         {"id": "use_square", "types": {"use": {"use": "square", "is_open": true}}},
         {"id": "use_housing", "types": {"use": {"use": "housing"}}})"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "programme"), "");
  EXPECT_EQ(world.number("it", "programme.total_floor_area"), 400);
  EXPECT_EQ(world.number("it", "programme.total_volume"), 1200);
  EXPECT_EQ(world.number("it", "programme.total_open_area"), 400);
  EXPECT_EQ(*std::get<Shared<std::vector<std::string>>>(value_in(world.state(), "it", "programme.open_uses")),
            (std::vector<std::string>{"garden", "square"}));
  ASSERT_EQ(world.submit(command<SetPort>({.node = "use_garden", .port = {"use.is_open"}, .value = {"false"}})), "");
  world.tick();
  EXPECT_EQ(world.number("it", "programme.total_floor_area"), 500) << "the node of the use decides";
}

TEST(Programme, KeepsWhatVolumesMayStandOn) {
  World world = World::from_text(one_node("programme", R"("rows": [
      {"use": "garage", "floor_area": 100, "standing": "ground"}, {"use": "flats", "floor_area": 50}])"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "programme"), "");
  EXPECT_EQ(world.table("it", "programme.rows").text(0, "standing"), "ground");
  EXPECT_EQ(world.table("it", "programme.rows").text(1, "standing"), "stack") << "where nothing is said";
  EXPECT_EQ(programme_error(R"({"use": "a", "floor_area": 10, "standing": "air"})"),
            "nodes/it/programme/rows/0/standing: the value `air` is none of `ground`, `stack` and `bridge`: write one of them");
}

TEST(Programme, SceneAddsUp) {
  World world = World::from_file("scenes/nodes/programme.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("brief", "programme.total_floor_area"), 80 * 24 + 420 + 450);
  EXPECT_EQ(world.number("brief", "programme.items"), 28);
}

}  // namespace
}  // namespace bl
