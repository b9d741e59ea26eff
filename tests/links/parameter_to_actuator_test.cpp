// Parameter to actuator: numbers go over as they are or rescaled, and an actuator needs an address.
#include "core/base/text.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

LinkCase with(double value, const std::string& address = "osc://9000/x") {
  LinkCase link("parameter_to_actuator");
  return link.from("source", value).to("actuator.address", address);
}

TEST(ParameterToActuator, CarriesAsItIsOrRescaled) {
  auto link = with(300);
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 300);
  ASSERT_EQ(link.set("rescale", true).set("gain", 0.01).set("base", 1.0).run(), "");
  EXPECT_EQ(link.number(End::to, "target"), 4);
}

TEST(ParameterToActuator, SaysWhatIsMissing) {
  EXPECT_EQ(with(1, "").run(), "to: the actuator has no address: give it one such as `mqtt://host:1883/topic`");
  EXPECT_EQ(with(1e300).set("rescale", true).set("gain", 1e300).run(),
            "gain: the rescaled number is too large; make the gain smaller");
}

TEST(ParameterToActuator, SceneSendsTheVolume) {
  World world = World::from_file("scenes/links/parameter_to_actuator.json");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("screen", "actuator.value"), 3000, 30);
  EXPECT_EQ(world.text("screen", "actuator.message"), fixed(world.number("screen", "actuator.value"), 0) + " m³");
}

}  // namespace
}  // namespace bl
