// The user: choices inside their ranges and on their steps, and rows that cannot be.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

World user_world(const std::string& ports) {
  World world = World::from_text(one_node("user", ports));
  world.tick();
  return world;
}
double chosen(const std::string& row) {
  const World world = user_world(R"("choices": [)" + row + "]");
  EXPECT_EQ(world.node_error("it", "user"), "");
  return world.table("it", "user.values").number(0, "value");
}
std::string fault(const std::string& rows) { return user_world(R"("choices": [)" + rows + "]").node_error("it", "user"); }

TEST(User, ChoicesStayInTheirRangeAndOnTheirSteps) {
  EXPECT_EQ(chosen(R"({"id": "a", "value": 40})"), 40);
  EXPECT_EQ(chosen(R"({"id": "a", "value": 140})"), 100);
  EXPECT_EQ(chosen(R"({"id": "a", "value": 3, "minimum": 5})"), 5);
  EXPECT_EQ(chosen(R"({"id": "a", "value": 17, "minimum": 9, "maximum": 30, "step": 3})"), 18);
  EXPECT_EQ(chosen(R"({"id": "a", "value": 10, "minimum": 0, "maximum": 10, "step": 4})"), 8)
      << "the last step below the maximum";
  EXPECT_NEAR(chosen(R"({"id": "a", "value": 1, "maximum": 1, "step": 0.1})"), 1, 1e-12);
}

TEST(User, NamesTheRowAndColumnOfAFault) {
  EXPECT_EQ(fault(R"({"id": "a", "minimum": 3, "maximum": 3})"),
            "nodes/it/user/choices/0/maximum: the maximum (3) has to lie above the minimum (3)");
  EXPECT_EQ(fault(R"({"id": "a", "maximum": 3, "step": 4})"),
            "nodes/it/user/choices/0/step: the step (4) is larger than the range (3): make it smaller, or 0 for none");
  EXPECT_EQ(fault(R"({"id": "a"}, {"id": "a"})"),
            "nodes/it/user/choices/1/id: the choice `a` stands in an earlier row too: name one otherwise");
  EXPECT_EQ(fault(R"({"id": ""})"), "nodes/it/user/choices/0/id: the choice has no name: name it, so that links find it");
  EXPECT_NE(fault(R"({"id": "a", "unit": "ell"})").find("nodes/it/user/choices/0/unit: "), std::string::npos);
}

TEST(User, AColourIsSixDigits) {
  EXPECT_EQ(user_world(R"("colour": "#AAbb09")").node_error("it", "user"), "");
  for (const std::string wrong : {"red", "#12345", "#1234567", "#12345g", ""})
    EXPECT_EQ(user_world(R"("colour": ")" + wrong + "\"").node_error("it", "user"),
              "nodes/it/user/colour: `" + wrong + "` is no colour: write it as `#rrggbb`, such as `#4477aa`");
}

TEST(User, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/user.json");
  EXPECT_TRUE(world.settle(20));
  const Table values = world.table("resident", "user.values");
  EXPECT_EQ(values.number(values.row_of("id", "height"), "value"), 18);
  EXPECT_EQ(values.number(values.row_of("id", "shops"), "value"), 600);
  EXPECT_EQ(world.number("facilitator", "user.choice_count"), 0);
}

}  // namespace
}  // namespace bl
