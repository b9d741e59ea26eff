// Solar envelope: a plane at 45 degrees by hand, and volumes that come back under the planes of a winter.
#include <cmath>
#include <numbers>

#include "core/demand/shared_storeys.h"
#include "core/geometry/plates_table.h"
#include "core/sun/shadow_shape.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

const double kHalf = std::sqrt(0.5);

// The sun in the south at 45 degrees; the neighbour's edge along the x axis, on the ground: the plane z = -y.
LinkCase envelope(const std::string& mode, const Point3& position, double bottom, double height) {
  LinkCase link("solar_envelope");
  link.set("mode", mode).set("gain", 0.5).set("tolerance", 0.1);
  link.set("edge", Shared<std::vector<Point3>>(std::vector<Point3>{{-20, 0, 0}, {20, 0, 0}}));
  link.from("sun_and_sky.moments", Shared<Table>(Table{{"x", "y", "z", "seconds"}, {{0.0, -kHalf, kHalf, 600.0}}}));
  link.to("node.position", position).to("smart_volume.radius", 5.0).to("smart_volume.bottom", bottom);
  link.to("smart_volume.height", height).to("smart_volume.demand", 500.0).to("smart_volume.demand_limit", 1e9);
  link.to("smart_volume.wanted", 500.0).to("smart_volume.fitted", 500.0).to("node.id", std::string("tower"));
  return link;
}

TEST(SolarEnvelope, ABallComesBackUnderThePlane) {
  // The centre lies in the plane: 5 m too much, 0.5 m allowed, half of the rest taken back.
  auto link = envelope("move", {0, -10, 10}, 5, 10);
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), Vector3{0, -kHalf, -kHalf} * 2.25);
  auto below = envelope("move", {0, -18, 10}, 5, 10);
  ASSERT_EQ(below.run(), "");
  EXPECT_FALSE(below.moves(End::to));
}

TEST(SolarEnvelope, AFlatTopReachesLess) {
  // Cut off at the height of its centre, the shape reaches through the plane with the edge of its disc: 5 sin 45.
  auto link = envelope("move", {0, -10, 10}, 5, 5);
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), Vector3{0, -kHalf, -kHalf} * (0.5 * (5 * kHalf - 0.5)));
}

TEST(SolarEnvelope, ShavesAndLetsGrow) {
  auto link = envelope("shave", {0, -11, 7}, 2, 10);  // 2 m under the plane in height: beyond = (5 - 4 · 0.707) / 5 - 0.1
  ASSERT_EQ(link.run(), "");
  const double beyond = (5 - 4 * kHalf) / 5 - 0.1;
  EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit"), 500 * (1 - 0.5 * beyond), 1e-9);
  auto free = envelope("shave", {0, -40, 7}, 2, 10);
  free.to("smart_volume.demand_limit", 200.0);
  ASSERT_EQ(free.run(), "");
  EXPECT_NEAR(free.number(End::to, "smart_volume.demand_limit"), 200 * 1.25, 1e-9);
}

// The last eighth of the tolerance is not shaved off by ever less: there it rests, and is kept.
TEST(SolarEnvelope, RestsWithinItsPlay) {
  for (const double beyond : {0.012, 0.013}) {    // of the radius, beyond a tolerance of 0.1
    const double below = 5 * (1 - 0.1 - beyond);  // of the centre under the plane z = -y
    auto link = envelope("shave", {0, -10 - below / kHalf, 10}, 5, 10);
    link.set("play", 0.125).to("smart_volume.demand_limit", 400.0);
    ASSERT_EQ(link.run(), "");
    const bool is_kept = beyond < 0.1 / 8;
    EXPECT_NEAR(link.number(End::to, "smart_volume.demand_limit"), is_kept ? 400 : 400 * (1 - 0.5 * beyond), 1e-9);
    EXPECT_EQ(link.remarked(LinkRemark::at_work).empty(), is_kept);
  }
}

TEST(SolarEnvelope, SaysWhatItIsBringingAboutAndWhatCannotBeMet) {
  auto work = envelope("shave", {0, -11, 7}, 2, 10);
  ASSERT_EQ(work.run(), "");
  EXPECT_EQ(work.remarked(LinkRemark::at_work), "edge: `tower` reaches 2.17 m through the planes of the sun");
  auto used_up = envelope("shave", {0, -11, 7}, 2, 10);
  used_up.to("smart_volume.demand_limit", 100.0).to("smart_volume.wanted", 100.0).to("smart_volume.fitted", 100.0);
  ASSERT_EQ(used_up.run(), "");
  EXPECT_EQ(
      used_up.remarked(LinkRemark::unmet),
      "edge: cannot be met: `tower` reaches 2.17 m through the planes of the sun, held by `tower`, which is down to 20 % of "
      "its demand; move the edge or the volume, or lower what is insisted on or `least`");
  auto locked = envelope("shave", {0, -11, 7}, 2, 10);
  ASSERT_EQ(locked.lock(End::to, "smart_volume.demand_limit").run(), "");
  EXPECT_EQ(locked.remarked(LinkRemark::unmet),
            "edge: cannot be met: `tower` reaches 2.17 m through the planes of the sun, held by `tower` (500 m³, its limit is "
            "locked); move the edge or the volume, unlock the limits, or lower what is insisted on or `least`");
  auto fixed_place = envelope("move", {0, -10, 10}, 5, 10);
  ASSERT_EQ(fixed_place.lock(End::to, "node.position").run(), "");
  EXPECT_NE(fixed_place.remarked(LinkRemark::unmet).find("and its position is locked"), std::string::npos);
  auto kept = envelope("shave", {0, -40, 7}, 2, 10);
  ASSERT_EQ(kept.run(), "");
  EXPECT_EQ(kept.remarked(LinkRemark::at_work) + kept.remarked(LinkRemark::unmet), "");
}

// All is shaved and the rule is broken still: a problem, and no settled scene.
TEST(SolarEnvelope, AUsedUpLeastShareKeepsASceneFromSettling) {
  World world = World::from_file("scenes/links/solar_envelope.json");
  ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l1_envelope", .parameter = "mode", .value = {"\"shave\""}})), "");
  ASSERT_EQ(world.submit(command<SetLinkParameter>({.id = "l1_envelope", .parameter = "least", .value = {"0.9"}})), "");
  EXPECT_FALSE(world.settle(200));
  const std::string said = world.link_error("l1_envelope");
  EXPECT_NE(said.find("cannot be met: `"), std::string::npos) << said;
  EXPECT_NE(said.find("which is down to 90 % of its demand"), std::string::npos) << said;
}

TEST(SolarEnvelope, SunFromTheOtherSideAndShapesWithoutSizeAreLeftAlone) {
  auto north = envelope("move", {0, 10, 10}, 5, 10);  // the volume stands on the far side of the edge
  ASSERT_EQ(north.run(), "");
  EXPECT_FALSE(north.moves(End::to));
  auto nothing = envelope("move", {0, -10, 10}, 5, 10);
  nothing.to("smart_volume.radius", 0.0);
  ASSERT_EQ(nothing.run(), "");
  EXPECT_FALSE(nothing.moves(End::to));
  auto point = envelope("move", {0, -10, 10}, 5, 10);
  point.set("edge", Shared<std::vector<Point3>>(std::vector<Point3>{{0, 0, 0}}));
  EXPECT_EQ(point.run(), "edge: an edge has at least two points: add them");
}

TEST(SolarEnvelope, SceneKeepsTheNeighboursSun) {
  World world = World::from_file("scenes/links/solar_envelope.json");
  ASSERT_TRUE(world.settle(400));
  EXPECT_EQ(world.link_error("l1_envelope"), "");
  // The neighbour's windows lie on the edge: they have lost next to nothing.
  EXPECT_GT(world.number("windows", "shadow_receiver.sun_mean"), 0.97 * world.number("windows", "shadow_receiver.sun_possible"));
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l1_envelope"})), "");
  for (const char* id : {"slab", "tower"})
    ASSERT_EQ(
        world.submit(command<SetPort>(
            {.node = id, .port = {"node.position"}, .value = {std::string(id) == "slab" ? "[14, 12, 6]" : "[40, 14, 14]"}})),
        "");
  world.tick(8);
  ASSERT_TRUE(world.settle(400));
  EXPECT_LT(world.number("windows", "shadow_receiver.sun_mean"), 0.9 * world.number("windows", "shadow_receiver.sun_possible"));
}

// Ten metres square about (0, -20), so that its roof's edge lies 15 m from the neighbour's: the plane there is 15 m high.
LinkCase standing(std::int64_t built, const std::string& mode = "shave") {
  geometry::StandingBody body;
  body.centre = {0, -20, 0};
  body.stacks.push_back({static_cast<int>(built), 0, 4, 100, {}, {}});
  body.stacks.back().outlines.push_back({{{{-5, -25, 0}}, {{5, -25, 0}}, {{5, -15, 0}}, {{-5, -15, 0}}}, 0});
  Table plates;
  geometry::write_body(body, plates);
  LinkCase link = envelope(mode, {0, -20, 0}, 0, 4.0 * static_cast<double>(built));
  link.to("smart_volume.storey_height", 4.0)
      .to("footprint.storeys", std::int64_t{6})
      .to("footprint.storeys_min", std::int64_t{1});
  // The radius follows from the footprint: 5 m. The weight of such a volume may be anything.
  link.to("smart_volume.footprint", 25 * std::numbers::pi).to("smart_volume.radius", 0.0);
  link.to("footprint.storeys_held", built).to("footprint.height_limit", 1e6).to("footprint.plates", Shared<Table>(plates));
  return link;
}

TEST(SolarEnvelope, OfWhatStandsTheStoreysGoThatReachThrough) {
  auto high = standing(6), kept = standing(3);
  for (LinkCase* link : {&high, &kept}) ASSERT_EQ(link->run(), "");
  EXPECT_NEAR(high.number(End::to, "footprint.height_limit"), 15, 1e-9);
  EXPECT_FALSE(high.moves(End::to));
  EXPECT_NEAR(kept.number(End::to, "footprint.height_limit"), 15, 1e-9);
  EXPECT_EQ(kept.remarked(LinkRemark::short_of),
            "edge: `tower` has 3 of 6 storeys, because it may be no higher than 15.00 m to stay below the planes of the sun");
  auto least = standing(6);
  least.to("footprint.storeys_min", std::int64_t{6}).to("footprint.height_limit", 24.0);
  ASSERT_EQ(least.run(), "");
  EXPECT_EQ(least.remarked(LinkRemark::unmet),
            "edge: cannot be met: `tower` reaches 9.00 m through the planes of the sun, held by `tower`, which keeps at least 6 "
            "storeys (`storeys_min`); move the edge or the volume, or lower `storeys_min`");
}

// The same tower as two volumes: this one has the storeys from the fourth on, above shops of 4 m in three storeys.
LinkCase upper(const std::string& mode) {
  LinkCase link = standing(3, mode);
  geometry::StandingBody body;
  body.centre = {0, -20, 0};
  body.stacks.push_back({3, 12, 4, 100, {}, {}});
  body.stacks.back().outlines.push_back({{{{-5, -25, 0}}, {{5, -25, 0}}, {{5, -15, 0}}, {{-5, -15, 0}}}, 0});
  Table plates;
  geometry::write_body(body, plates);
  link.to("footprint.plates", Shared<Table>(plates)).to("smart_volume.bottom", 12.0).to("smart_volume.height", 12.0);
  // Its own place is nowhere near the building.
  link.to("node.position", Vector3{0, 40, 0});
  return link.to("footprint.building", Shared<Table>(demand::table_of(demand::Building{"shops", 6, 1, 6, 4, 0, 24, 1e6, 0.5})));
}

TEST(SolarEnvelope, OfABuildingThatSeveralShareTheStoreysGoThatReachThrough) {
  auto link = upper("shave");
  ASSERT_EQ(link.run(), "");
  EXPECT_NEAR(link.number(End::to, "footprint.height_limit"), 15, 1e-9) << "above the ground of the building";
  // What lies below another one, and below the planes, says nothing of it.
  auto shops = standing(3);
  shops.to("footprint.building", Shared<Table>(demand::table_of(demand::Building{"shops", 6, 1, 6, 4, 0, 24, 1e6, 0.5})));
  ASSERT_EQ(shops.run(), "");
  EXPECT_FALSE(shops.proposed(End::to, "footprint.height_limit").has_value());
  auto moved = upper("move");
  ASSERT_EQ(moved.run(), "");
  EXPECT_FALSE(moved.moves(End::to));
  EXPECT_EQ(moved.remarked(LinkRemark::unmet),
            "edge: cannot be met: `tower` reaches 9.00 m through the planes of the sun, and `tower` stands where `shops` does, "
            "whose footprint it shares; lead this link to that one, or let it be shaved");
}

TEST(SolarEnvelope, WhatStandsMovesBackOnTheLevel) {
  auto link = standing(6, "move");  // 9 m through the plane, half a metre allowed, half of the rest in one tick
  ASSERT_EQ(link.run(), "");
  expect_near(link.move(End::to), {0, -0.5 * 8.5, 0});
  auto below = standing(3, "move");
  ASSERT_EQ(below.run(), "");
  EXPECT_FALSE(below.moves(End::to));
}

}  // namespace
}  // namespace bl
