// The solver of standing volumes: floor areas met on one ground, limits that come and go, and demands that cannot be met.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/geometry/standing_tick.h"
#include "tests/support/world.h"

namespace bl {
namespace {

// `count` volumes at random places of a plot of 120 m by 90 m, whose plates need `share` of it.
std::string crowd(int count, double share, std::uint64_t seed, const std::string& solver = "",
                  const std::vector<std::string>& forms = {"round", "block"}) {
  Random random(seed);
  std::string text = R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[120,0,0],[120,90,0],[0,90,0]], "height": 60}}},
    {"id": "solver", "types": {"standing_solver": {)" +
                     solver + "}}}";
  for (int i = 0; i < count; ++i) {
    const int storeys = 2 + static_cast<int>(random.uniform(0, 6));
    const double plate = random.uniform(0.5, 1.5) * share * 120 * 90 / count;
    text += R"(,{"id": "v)" + std::to_string(100 + i) + R"(", "position": [)" + shortest(random.uniform(5, 115)) + "," +
            shortest(random.uniform(5, 85)) + R"(, 0], "types": {"smart_volume": {"storey_height": 3, "demand": )" +
            shortest(3 * storeys * plate) + R"(}, "footprint": {"form": ")" + forms[static_cast<std::size_t>(i) % forms.size()] +
            R"(", "storeys": )" + std::to_string(storeys) + R"(, "full_storeys": 1, "setback": )" + (i % 3 == 0 ? "1" : "0") +
            "}}}";
  }
  return text + "]}";
}

TEST(StandingSolver, MeetsFloorAreasOfACrowd) {
  World world = World::from_text(crowd(40, 0.5, 7, R"("tolerance": 1e-7)"));
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.node_error("solver", "standing_solver"), "");
  EXPECT_EQ(world.text("solver", "standing_solver.message"), "");
  EXPECT_EQ(world.number("solver", "standing_solver.count"), 40);
  EXPECT_LE(world.number("solver", "standing_solver.largest_error"), 1e-7);
  double floor = 0, covered = 0;
  for (int i = 0; i < 40; ++i) {
    const std::string id = "v" + std::to_string(100 + i);
    EXPECT_NEAR(world.number(id, "smart_volume.floor_area") * 3, world.number(id, "smart_volume.demand"), 1e-2) << id;
    EXPECT_EQ(world.number(id, "smart_volume.bottom"), 0);
    EXPECT_EQ(world.text(id, "smart_volume.stands_on"), "the ground");
    floor += world.number(id, "smart_volume.floor_area");
    covered += world.number(id, "smart_volume.footprint");
  }
  EXPECT_NEAR(world.number("solver", "standing_solver.plot_area"), 10800, 1e-6);
  EXPECT_NEAR(world.number("solver", "standing_solver.fsi"), floor / 10800, 1e-9);
  EXPECT_NEAR(world.number("solver", "standing_solver.gsi"), covered / 10800, 1e-9);
  EXPECT_NEAR(world.number("solver", "standing_solver.osr"), (10800 - covered) / floor, 1e-9);
}

// A tick is a function of the state: a scene that was saved on its way goes on with the same bits.
TEST(StandingSolver, ASavedStateGoesOnAlike) {
  World first = World::from_text(crowd(20, 0.6, 3, R"("tolerance": 1e-9, "steps": 1)"));
  first.tick(2);
  World second = World::from_text(crowd(20, 0.6, 3, R"("tolerance": 1e-9, "steps": 1)"), 3);
  second.tick(5);
  first.tick(3);
  EXPECT_EQ(first.state().hash, second.state().hash);
}

// Steps that did not suffice in one tick are no reason to say that demands cannot be met.
TEST(StandingSolver, FewStepsInATickOnlyTakeMoreTicks) {
  World world = World::from_text(crowd(40, 0.5, 7, R"("tolerance": 1e-7, "steps": 1)"));
  for (int tick = 0; tick < 12; ++tick) {
    world.tick();
    EXPECT_EQ(world.text("solver", "standing_solver.message"), "") << "tick " << tick;
  }
  EXPECT_LE(world.number("solver", "standing_solver.largest_error"), 1e-7);
}

TEST(StandingSolver, TooMuchIsScaledAndSaid) {
  World world = World::from_text(crowd(12, 1.4, 5));
  world.settle();
  EXPECT_NE(world.text("solver", "standing_solver.message").find("cannot be met together"), std::string::npos)
      << world.text("solver", "standing_solver.message");
  EXPECT_LE(world.number("solver", "standing_solver.gsi"), 1);
}

// Whole cells beside other forms take what they ask for, and what nobody asks for stays open. A form that somebody has changed
// leaves weights from which no step leads on; the message is empty all the same.
TEST(StandingSolver, WholeCellsBesideOtherFormsAreMet) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    World world = World::from_text(crowd(9, 0.7, seed, R"("tolerance": 1e-6)", {"cell", "block", "cell", "round", "cell"}));
    const auto expect_all = [&](const std::string& when) {
      world.tick();  // a scene is settled until the next tick takes what people have set
      ASSERT_TRUE(world.settle()) << when;
      EXPECT_EQ(world.text("solver", "standing_solver.message"), "") << seed << ", " << when;
      EXPECT_LE(world.number("solver", "standing_solver.largest_error"), 1e-6) << seed << ", " << when;
      EXPECT_LT(world.number("solver", "standing_solver.gsi"), 0.95);
    };
    const auto set = [&](const std::string& node, const std::string& port, const std::string& value) {
      EXPECT_EQ(world.submit(command<SetPort>({.node = node, .port = {port}, .value = {value}})), "");
    };
    expect_all("at first");
    for (const char* form : {"cell", "round", "block"}) {
      for (const char* node : {"v101", "v103", "v106"}) set(node, "footprint.form", "\"" + std::string(form) + "\"");
      expect_all("changed to " + std::string(form));
    }
    // Storeys enough to cover all the plot, and back.
    const double demand = world.number("v101", "smart_volume.demand");
    set("v101", "smart_volume.demand", "90000");
    world.tick();
    world.settle(20);
    EXPECT_NE(world.text("solver", "standing_solver.message").find("cannot be met together"), std::string::npos)
        << world.text("solver", "standing_solver.message");
    EXPECT_EQ(world.text("solver", "standing_solver.message").find(": 0.0 %"), std::string::npos);
    set("v101", "smart_volume.demand", shortest(demand));
    expect_all("at last");
  }
}

std::string alone(const std::string& footprint) {
  return R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "house", "position": [30, 20, 0], "types": {"smart_volume": {"storey_height": 3, "demand": 1200}, "footprint": {)" +
         footprint + R"(}}},
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 60}}},
    {"id": "solver", "types": {"standing_solver": {}}}]})";
}

TEST(StandingSolver, WhatIsBuiltOtherwiseThanItIsSetIsSaid) {
  World least = World::from_text(alone(R"("form": "block", "storeys": 2, "storeys_min": 4)"));
  ASSERT_TRUE(least.settle());
  EXPECT_EQ(least.number("house", "footprint.storeys_built"), 4);
  EXPECT_EQ(least.text("solver", "standing_solver.message"),
            "`house` has 4 storeys, the least that it may have, and not 2: lower `storeys_min`, or raise `storeys`");
  // The ground floor alone has 20 m by 20 m, and what stands on it would be 24 m narrower.
  World eaten = World::from_text(alone(R"("form": "block", "aspect": 1, "storeys": 4, "full_storeys": 1, "setback": 12)"));
  ASSERT_TRUE(eaten.settle());
  EXPECT_NEAR(eaten.number("house", "smart_volume.floor_area"), 400, 2);
  EXPECT_EQ(eaten.text("solver", "standing_solver.message"),
            "the set-back of `house` leaves nothing of its upper 3 storeys: lower it, or the number of storeys");
  // A courtyard that is moved out as far as the depth moves it in is as large as the plate.
  World hollow = World::from_text(
      alone(R"("form": "block", "aspect": 1, "storeys": 4, "full_storeys": 1, "depth": 5, "courtyard_setback": 5)"));
  ASSERT_TRUE(hollow.settle());
  EXPECT_EQ(hollow.text("solver", "standing_solver.message"),
            "the `courtyard_setback` of `house` leaves nothing of its upper 3 storeys: lower it, or the number of storeys");
  World sound = World::from_text(alone(R"("form": "block", "aspect": 1, "storeys": 2, "full_storeys": 1, "setback": 1)"));
  ASSERT_TRUE(sound.settle());
  EXPECT_EQ(sound.text("solver", "standing_solver.message"), "");
}

TEST(StandingSolver, ASetBackOfAllStoreysThatChangesNothingIsTold) {
  World idle = World::from_text(alone(R"("form": "block", "aspect": 1, "storeys": 4, "setback": 3)"));
  ASSERT_TRUE(idle.settle());
  EXPECT_EQ(idle.text("solver", "standing_solver.message"),
            "the set-back of `house` holds for all of its 4 storeys alike, and changes nothing: set `full_storeys`, above which "
            "it begins");
  // A distance from neighbours, one storey alone, and what keeps from the border are meant.
  for (const char* meant : {R"("form": "block", "aspect": 1, "storeys": 4, "setback": 3, "party_walls": false)",
                            R"("form": "block", "aspect": 1, "storeys": 1, "setback": 3)", R"("form": "cell", "setback": 3)"}) {
    World world = World::from_text(alone(meant));
    world.settle();
    EXPECT_EQ(world.text("solver", "standing_solver.message").find("changes nothing"), std::string::npos) << meant;
  }
}

TEST(StandingSolver, WhoIsPlacedOutsideTheBoundaryIsToldSo) {
  std::string far = alone(R"("form": "block", "aspect": 1, "storeys": 4)");
  far.replace(far.find("[30, 20, 0]"), 11, "[160, 20, 0]");
  World world = World::from_text(far);
  world.tick(3);
  const std::string outside = "is placed outside of the boundary, where there is no ground for it: move it inside";
  EXPECT_NE(world.text("solver", "standing_solver.message").find("`house` " + outside), std::string::npos)
      << world.text("solver", "standing_solver.message");
}

// The ground of a volume on a slope moves up and down by a little: the boundary above it leaves now eight storeys, now seven.
TEST(StandingSolver, ABoundaryThatTremblesTakesAStoreyOnce) {
  geometry::StandingWish wish;
  wish.site.storey_height = 3;
  wish.storeys = 8;
  int changes = 0, last = 0;
  for (int k = 0; k < 40; ++k) {
    const geometry::Storeys now = geometry::storeys_of(wish, 24 + 0.0005 * std::cos(3 * k));
    changes += last != 0 && now.count != last ? 1 : 0;
    last = wish.built = now.count;
    wish.least_room = now.least_room;
    EXPECT_FALSE(now.is_limited) << "by no limit of height";
  }
  EXPECT_LE(changes, 1);
  EXPECT_EQ(last, 7);
}

// A limit that was lower for a while and is put back leaves no trace: neither on a house, nor on a building of two uses.
TEST(StandingSolver, ALimitThatIsPutBackGivesTheStoreyBack) {
  geometry::StandingWish wish;
  wish.site.storey_height = 3;
  wish.storeys = 7;
  const std::vector<geometry::BuildingShare> shares{{0, 100, 4.5}, {1, 250, 3}};
  for (const bool is_shared : {false, true}) {
    SCOPED_TRACE(is_shared);
    double height = 3;
    const auto storeys = [&] {
      return is_shared ? geometry::storeys_of(wish, shares, 100, height) : geometry::storeys_of(wish, 100);
    };
    const double whole = 7 * (is_shared ? geometry::mean_storey_height(shares, 7) : 3);
    wish.built = 0;
    wish.least_room = 0;
    const auto tick = [&](double limit) {
      wish.height_limit = limit;
      const geometry::Storeys now = storeys();
      wish.built = now.count;
      wish.least_room = now.least_room;
      return now.count;
    };
    EXPECT_EQ(tick(whole), 7);
    EXPECT_EQ(tick(whole - 1), 6);
    EXPECT_EQ(tick(whole - 1), 6);
    EXPECT_EQ(tick(whole), 7);
    EXPECT_EQ(wish.least_room, 0);
    // One that comes back by less than 0.15 storeys may be one that trembles.
    EXPECT_EQ(tick(whole - 0.1), 6);
    EXPECT_EQ(tick(whole), 6);
    EXPECT_EQ(tick(whole + 0.15 * 3), 7);
  }
}

TEST(StandingSolver, ALimitThatTremblesTakesAStoreyOnce) {
  geometry::StandingWish wish;
  wish.site.storey_height = 3;
  wish.storeys = 6;
  int changes = 0, last = 0;
  for (int k = 0; k < 40; ++k) {
    wish.height_limit = 15 + 0.2 * std::sin(k);
    const geometry::Storeys now = geometry::storeys_of(wish, 100);
    changes += last != 0 && now.count != last ? 1 : 0;
    last = wish.built = now.count;
    wish.least_room = now.least_room;
  }
  EXPECT_LE(changes, 1);
  EXPECT_EQ(last, 4);
  wish.height_limit = 15.5;
  EXPECT_EQ(geometry::storeys_of(wish, 100).count, 5);
}

TEST(StandingSolver, WithoutABoundaryItSaysSo) {
  World world = World::from_text(
      R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [{"id": "solver", "types": {"standing_solver": {}}}]})");
  world.tick();
  EXPECT_EQ(world.node_error("solver", "standing_solver"),
            "nodes/solver/standing_solver/boundary: a boundary is needed and none was found: add one, or choose one here");
}

// Land is land, built or not: gardens and courtyards are open ground of the plot.
TEST(StandingSolver, GardensAndCourtyardsAreOpenGroundOfThePlot) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 60, "exclusions": [
      {"name": "lawn", "use": "garden", "x": 50, "y": 0, "bottom": 0, "top": 60}, {"name": "lawn", "x": 60, "y": 0},
      {"name": "lawn", "x": 60, "y": 40}, {"name": "lawn", "x": 50, "y": 40}]}}},
    {"id": "block", "position": [25, 20, 0], "types": {"smart_volume": {"storey_height": 3, "demand": 4500},
     "footprint": {"form": "block", "aspect": 1, "storeys": 3, "depth": 6}}},
    {"id": "solver", "types": {"standing_solver": {}}}]})");
  ASSERT_TRUE(world.settle());
  EXPECT_NEAR(world.number("solver", "standing_solver.plot_area"), 2400, 1e-9) << "with the garden";
  EXPECT_NEAR(world.number("solver", "standing_solver.open_area"), 400, 1e-9);
  const double floors = world.number("block", "smart_volume.floor_area"), built = world.number("block", "smart_volume.footprint");
  EXPECT_NEAR(floors, 1500, 8);
  EXPECT_NEAR(built, floors / 3, 1e-6) << "without its courtyard";
  EXPECT_NEAR(world.number("solver", "standing_solver.fsi"), floors / 2400, 1e-9);
  EXPECT_NEAR(world.number("solver", "standing_solver.gsi"), built / 2400, 1e-9);
  EXPECT_NEAR(world.number("solver", "standing_solver.osr"), (2400 - built) / floors, 1e-9);
}

// Below the ground there is a figure of its own; what stands on a roof has none, and is told so.
TEST(StandingSolver, CellarsCountForThemselves) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
    {"id": "plot", "types": {"boundary": {"form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 60}}},
    {"id": "podium", "position": [30, 20, 0], "types": {"smart_volume": {"storey_height": 3, "demand": 3600},
     "footprint": {"storeys": 2, "cellar_storeys": 3, "cellar_height": 2.5}}},
    {"id": "tower", "position": [30, 20, 0], "types": {"smart_volume": {"storey_height": 3, "demand": 3600},
     "footprint": {"storeys": 6, "bases": ["podium"], "cellar_storeys": 1}}},
    {"id": "solver", "types": {"standing_solver": {}}}]})");
  ASSERT_TRUE(world.settle());
  const double plate = world.number("podium", "smart_volume.footprint");
  EXPECT_NEAR(world.number("podium", "footprint.cellar_area"), 3 * plate, 1e-9 * plate);
  EXPECT_EQ(world.number("podium", "footprint.cellars_built"), 3);
  EXPECT_EQ(world.number("podium", "smart_volume.bottom"), 0);
  EXPECT_NEAR(world.number("podium", "smart_volume.floor_area"), 1200, 6.1);
  const double floors = world.number("podium", "smart_volume.floor_area") + world.number("tower", "smart_volume.floor_area");
  EXPECT_NEAR(world.number("solver", "standing_solver.fsi"), floors / 2400, 1e-9);
  EXPECT_EQ(world.number("tower", "footprint.cellars_built"), 0);
  EXPECT_EQ(world.number("tower", "footprint.cellar_area"), 0);
  EXPECT_EQ(world.text("solver", "standing_solver.message"),
            "`tower` has no cellar, because it stands on `podium`: set its `cellar_storeys` to 0");
}

}  // namespace
}  // namespace bl
