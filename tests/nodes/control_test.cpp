// The control: clamping, notches, switches, and ranges that cannot be.
#include <gtest/gtest.h>

#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

double output_of(const std::string& ports) {
  World world = World::from_text(one_node("control", ports));
  world.tick();
  EXPECT_EQ(world.node_error("it", "control"), "") << ports;
  return world.number("it", "control.output");
}

std::string control_error(const std::string& ports) {
  World world = World::from_text(one_node("control", ports));
  world.tick();
  return world.node_error("it", "control");
}

TEST(Control, StaysInsideItsRange) {
  EXPECT_EQ(output_of(R"("value": 12.5)"), 12.5);
  EXPECT_EQ(output_of(R"("value": -1)"), 0);
  EXPECT_EQ(output_of(R"("value": 101)"), 100);
  EXPECT_EQ(output_of(R"("value": -7, "minimum": -10, "maximum": -5)"), -7);
}

TEST(Control, SnapsToNotchesCountedFromTheLowerEnd) {
  EXPECT_EQ(output_of(R"("value": 3.2, "step": 1)"), 3);
  EXPECT_EQ(output_of(R"("value": 3.5, "step": 1)"), 4);
  EXPECT_EQ(output_of(R"("value": 6, "minimum": 1, "maximum": 11, "step": 4)"), 5);
  EXPECT_EQ(output_of(R"("value": -3.6, "minimum": -10, "maximum": 10, "step": 1)"), -4);
  // The last notch is 9: the upper end itself is none.
  EXPECT_EQ(output_of(R"("value": 10, "minimum": 0, "maximum": 10, "step": 3)"), 9);
  // A range of three tenths is three steps of a tenth, whatever the rounding says.
  EXPECT_DOUBLE_EQ(output_of(R"("value": 1, "minimum": 0, "maximum": 0.3, "step": 0.1)"), 0.3);
  EXPECT_LE(output_of(R"("value": 1, "minimum": 0, "maximum": 0.3, "step": 0.1)"), 0.3);
}

TEST(Control, ASwitchIsOnOrOff) {
  EXPECT_EQ(output_of(R"("value": 1, "is_switch": true)"), 1);
  EXPECT_EQ(output_of(R"("value": 0.49, "is_switch": true)"), 0);
  EXPECT_EQ(output_of(R"("value": 7, "is_switch": true, "minimum": 5, "maximum": 2)"), 1);
}

TEST(Control, RefusesRangesThatCannotBe) {
  EXPECT_EQ(control_error(R"("minimum": 5, "maximum": 2)"),
            "nodes/it/control/maximum: the maximum (2) has to lie above the minimum (5)");
  EXPECT_EQ(control_error(R"("minimum": 2, "maximum": 2)"),
            "nodes/it/control/maximum: the maximum (2) has to lie above the minimum (2)");
  EXPECT_EQ(control_error(R"("step": 101)"),
            "nodes/it/control/step: the step (101) is larger than the range (100): make it smaller, or 0 for none");
}

TEST(Control, KnowsItsUnits) {
  EXPECT_EQ(output_of(R"("value": 3, "unit": "m3")"), 3);
  EXPECT_EQ(output_of(R"("value": 3, "unit": "m²")"), 3);
  EXPECT_EQ(control_error(R"("unit": "metre")"),
            "nodes/it/control/unit: `metre` is no unit that is known; known are `ratio`, `count`, `m`, `m2`, `m3`, `1/m`, `deg`, "
            "`s`, `m/s`, `1/h`, `EUR`");
  EXPECT_EQ(control_error(R"("unit": "EURO")"), "nodes/it/control/unit: `EURO` is no unit that is known, did you mean `EUR`?");
  EXPECT_EQ(control_error(R"("unit": "ha")"),
            "nodes/it/control/unit: values are not kept in `ha`: write `m2`, and the numbers in it");
}

TEST(Control, SceneIsWhatItSays) {
  World world = World::from_file("scenes/nodes/control.json");
  EXPECT_TRUE(world.settle(20));
  EXPECT_EQ(world.number("storeys", "control.output"), 6);
  EXPECT_NEAR(world.number("storey_height", "control.output"), 3.4, 1e-12);
  EXPECT_EQ(world.number("winter", "control.output"), 1);
}

}  // namespace
}  // namespace bl
