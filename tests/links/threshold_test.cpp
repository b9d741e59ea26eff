// Threshold: on above the limit, off below the band, and unchanged between.
#include <nlohmann/json.hpp>

#include "tests/links/link_case.h"

namespace bl {
namespace {

double switched(double value, double present, double band = 10) {
  LinkCase link("threshold");
  link.set("limit", 100.0).set("band", band).set("below", 900.0).set("above", 300.0);
  EXPECT_EQ(link.from("source", value).to("target", present).run(), "");
  return link.number(End::to, "target");
}

TEST(Threshold, SwitchesAboveTheLimitAndBelowTheBand) {
  EXPECT_EQ(switched(101, 900), 300);
  EXPECT_EQ(switched(89, 300), 900);
  EXPECT_EQ(switched(100, 900), 900) << "at the limit it is still off";
  EXPECT_EQ(switched(95, 300), 300) << "within the band it stays on";
  EXPECT_EQ(switched(95, 900), 900) << "within the band it stays off";
  EXPECT_EQ(switched(90, 300), 300);
}

TEST(Threshold, WithoutABandTheTargetIsNotAsked) {
  EXPECT_EQ(switched(100, 300, 0), 900);
  EXPECT_EQ(switched(100.001, 900, 0), 300);
}

TEST(Threshold, TheTwoValuesMustDiffer) {
  LinkCase link("threshold");
  link.set("below", 1.0).from("source", 0.0).to("target", 0.0);
  EXPECT_EQ(link.run(), "above: the values for above and below the limit are the same (1): give them different values");
}

TEST(Threshold, SceneSwitchesTheBusAndKeepsItWithinTheBand) {
  World world = World::from_file("scenes/links/threshold.json");
  world.tick();
  EXPECT_EQ(world.number("stop", "transit_stop.headway"), 900) << "nothing stands there yet";
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.number("stop", "transit_stop.headway"), 300);
  const auto with = [&](double demand) {
    EXPECT_EQ(world.submit(command<SetPort>({"house_3", {"smart_volume.demand"}, JsonValue::of(Json(demand))})), "");
    world.tick(40);
    EXPECT_TRUE(world.settle());
    return world.number("stop", "transit_stop.headway");
  };
  EXPECT_EQ(with(750), 300) << "within the band";
  EXPECT_EQ(with(200), 900);
  EXPECT_EQ(with(750), 900) << "within the band, from below";
}

}  // namespace
}  // namespace bl
