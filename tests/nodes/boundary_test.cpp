// The boundary: measures that can be reckoned by hand, and shapes that are refused.
#include <gtest/gtest.h>

#include "core/geometry/domain_table.h"
#include "tests/nodes/scene_text.h"
#include "tests/support/world.h"

namespace bl {
namespace {

std::string boundary_error(const std::string& ports) {
  World world = World::from_text(one_node("boundary", ports));
  world.tick();
  return world.node_error("it", "boundary");
}

TEST(Boundary, PlanIsDrawnUpToItsHeight) {
  World world = World::from_text(
      one_node("boundary", R"("form": "plan", "plan": [[0,0,7],[10,0,7],[10,20,7],[0,20,7]], "bottom": 2, "height": 5)"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "boundary"), "");
  EXPECT_NEAR(world.number("it", "boundary.volume"), 1000, 1e-9);
  EXPECT_NEAR(world.number("it", "boundary.ground_area"), 200, 1e-9);
  const Table& planes = world.table("it", "boundary.planes");
  ASSERT_EQ(planes.rows.size(), 6u);
  EXPECT_EQ(planes.number(0, "z"), -1);
  EXPECT_EQ(planes.number(0, "offset"), -2);
  EXPECT_EQ(planes.number(1, "z"), 1);
  EXPECT_EQ(planes.number(1, "offset"), 7);
  ASSERT_NE(world.mesh("it", "boundary.shape"), nullptr);
  EXPECT_NEAR(enclosed_volume(*world.mesh("it", "boundary.shape")), 1000, 1e-9);
}

TEST(Boundary, HullOfATetrahedron) {
  World world = World::from_text(one_node("boundary", R"("points": [[0,0,0],[6,0,0],[0,6,0],[0,0,6],[1,1,1]])"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "boundary"), "");
  EXPECT_NEAR(world.number("it", "boundary.volume"), 36, 1e-9);
  EXPECT_NEAR(world.number("it", "boundary.ground_area"), 18, 1e-9);
  EXPECT_EQ(world.table("it", "boundary.planes").rows.size(), 4u);
}

TEST(Boundary, GroundAreaOfAnOverhangIsWhatIsSeenFromAbove) {
  // A pyramid on its tip: 4 m² at the top, nothing on the ground.
  World world = World::from_text(one_node("boundary", R"("points": [[0,0,0],[-1,-1,3],[1,-1,3],[1,1,3],[-1,1,3]])"));
  world.tick();
  EXPECT_NEAR(world.number("it", "boundary.ground_area"), 4, 1e-12);
  EXPECT_NEAR(world.number("it", "boundary.volume"), 4, 1e-12);
}

TEST(Boundary, AFreshOneIsUsable) {
  World world = World::from_text(one_node("boundary", ""));
  world.tick();
  EXPECT_EQ(world.node_error("it", "boundary"), "");
  EXPECT_NEAR(world.number("it", "boundary.volume"), 32000, 1e-6);
}

TEST(Boundary, RefusesWhatHasNoVolume) {
  EXPECT_EQ(boundary_error(R"("points": [[0,0,0],[1,0,0],[0,1,0]])"),
            "nodes/it/boundary/points: a boundary needs at least 4 points that are not in one plane; 3 given, 3 of them at "
            "different places");
  EXPECT_EQ(boundary_error(R"("points": [[0,0,0],[1,0,0],[0,1,0],[1,1,0],[2,2,0]])"),
            "nodes/it/boundary/points: all boundary points lie in one plane: add a point above or below it");
  EXPECT_EQ(boundary_error(R"("form": "plan", "plan": [[0,0,0],[1,0,0]])"),
            "nodes/it/boundary/plan: a plan polygon needs at least 3 corners at different places, 2 found");
  EXPECT_EQ(boundary_error(R"("form": "plan", "plan": [[0,0,0],[1,0,0],[2,0,0]])"),
            "nodes/it/boundary/plan: the plan polygon has no area: its corners lie on one line");
}

TEST(Boundary, APlanMayBendIn) {
  World world = World::from_text(
      one_node("boundary", R"("form": "plan", "plan": [[0,0,0],[10,0,0],[10,10,0],[5,2,0],[0,10,0]], "height": 3)"));
  world.tick();
  EXPECT_EQ(world.node_error("it", "boundary"), "");
  EXPECT_NEAR(world.number("it", "boundary.volume"), 180, 1e-9);
  EXPECT_NEAR(world.number("it", "boundary.ground_area"), 60, 1e-9);
  const Table& planes = world.table("it", "boundary.planes");
  const auto domain = geometry::read_domain(planes);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(domain->pieces.size(), 3u);
  EXPECT_EQ(domain->side_count, 7u);
  EXPECT_NEAR(domain->volume, 180, 1e-9);
  // There and back again the rows are the same.
  Table again;
  write_domain(*domain, again);
  EXPECT_EQ(again, planes);
}

TEST(Boundary, OldTablesAreOneConvexPiece) {
  Table old{{"x", "y", "z", "offset"}, {}};
  old.rows = {{1.0, 0.0, 0.0, 2.0},  {-1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 3.0},
              {0.0, -1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 4.0},  {0.0, 0.0, -1.0, 0.0}};
  const auto domain = geometry::read_domain(old);
  ASSERT_TRUE(domain.ok());
  EXPECT_EQ(domain->pieces.size(), 1u);
  EXPECT_EQ(domain->pieces[0].sides, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_NEAR(domain->volume, 24, 1e-12);
}

TEST(Boundary, RefusesWithThePlaceOfTheRow) {
  EXPECT_EQ(boundary_error(R"("form": "plan", "plan": [[0,0,0],[10,10,0],[10,0,0],[0,10,0]])"),
            "nodes/it/boundary/plan: the plan polygon crosses itself: side 0 and side 2 meet at (5.000, 5.000)");
  const std::string hole = R"({"name": "a", "x": 1, "y": 1}, {"name": "a", "x": 3, "y": 1}, {"name": "a", "x": 3, "y": 3})";
  EXPECT_EQ(boundary_error(R"("form": "plan", "holes": [)" + hole +
                           R"(, {"name": "b", "x": 50}, {"name": "b", "x": 51}, {"name": "b", "x": 50, "y": 1}])"),
            "nodes/it/boundary/holes/3: the hole lies outside the plan polygon: its first corner is at (50.000, 0.000)");
  EXPECT_EQ(boundary_error(R"("exclusions": [)" + hole + "]"),
            "nodes/it/boundary/exclusions/0: the top of the boundary (0 m) has to lie above its bottom (0 m)");
  EXPECT_EQ(boundary_error(R"("setbacks": [{"z": 1, "offset": -1}])"),
            "nodes/it/boundary/setbacks: the planes cut the whole boundary away: nothing is left of it");
  EXPECT_EQ(boundary_error(R"("setbacks": [{"offset": -1}])"),
            "nodes/it/boundary/setbacks/0: the plane has no direction: its normal is zero");
  EXPECT_EQ(boundary_error(R"("form": "mesh")"), "nodes/it/boundary/triangles: a boundary mesh needs at least 4 triangles");
}

// A rectangle of exclusions from the ground up, one row for each corner.
std::string kept_open(const std::string& name, const std::string& use, double west, double south, double east, double north,
                      double top = 20) {
  std::string rows;
  for (const auto& [x, y] : {std::pair{west, south}, {east, south}, {east, north}, {west, north}})
    rows += (rows.empty() ? "" : ", ") + (R"({"name": ")" + name + R"(", "use": ")" + use + R"(", "x": )" + std::to_string(x)) +
            R"(, "y": )" + std::to_string(y) + R"(, "bottom": 0, "top": )" + std::to_string(top) + "}";
  return rows;
}

TEST(Boundary, GroundThatIsKeptOpenIsMeasuredByUse) {
  const std::string plan = R"("form": "plan", "plan": [[0,0,0],[100,0,0],[100,50,0],[0,50,0]], "exclusions": [)";
  // 10 m by 10 m; a building that stays takes 20 m² of it, and 5 m by 10 m lie outside of the plan.
  World world = World::from_text(one_node(
      "boundary", plan + kept_open("lawn", "garden", -5, 0, 10, 10) + ", " + kept_open("house", "", 8, 0, 20, 10) + ", " +
                      kept_open("place", "square", 30, 10, 50, 30) + ", " + kept_open("beds", "garden", 45, 10, 60, 30) + "]"));
  world.tick();
  ASSERT_EQ(world.node_error("it", "boundary"), "");
  const Table& areas = world.table("it", "boundary.open_areas");
  ASSERT_EQ(areas.rows.size(), 2u);
  EXPECT_EQ(areas.text(0, "use"), "garden");
  EXPECT_NEAR(areas.number(0, "area"), 80 + 15 * 20, 1e-9);
  EXPECT_NEAR(areas.number(0, "drawn"), 15 * 10 + 15 * 20, 1e-9);
  EXPECT_EQ(areas.text(1, "use"), "square");
  EXPECT_NEAR(areas.number(1, "area"), 15 * 20, 1e-9) << "what lies in both counts for the first use";
  EXPECT_NEAR(world.number("it", "boundary.open_area"), 680, 1e-9);
  EXPECT_NEAR(world.number("it", "boundary.ground_area"), 5000 - 680 - 120, 1e-9) << "the building is neither";
}

// The border of a plot is that of its land, whatever the boundary leaves out inside.
TEST(Boundary, TheLandHasTheGroundThatIsLeftOut) {
  const std::string plan = R"("form": "plan", "plan": [[0,0,0],[60,0,0],[60,40,0],[0,40,0]], "height": 20)";
  const auto world_of = [](const std::string& ports) {
    return World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "it", "types": {"boundary": {)" +
                            ports + "}}}]}");
  };
  World whole = world_of(plan);
  whole.tick();
  EXPECT_TRUE(whole.table("it", "boundary.land_planes").rows.empty()) << "it is the boundary itself";
  World pit = world_of(plan + R"(, "exclusions": [{"name": "pit", "x": 29, "y": 19, "bottom": 0, "top": 20},
    {"name": "pit", "x": 31, "y": 19}, {"name": "pit", "x": 31, "y": 21}, {"name": "pit", "x": 29, "y": 21}])");
  pit.tick();
  EXPECT_EQ(pit.node_error("it", "boundary"), "");
  EXPECT_EQ(pit.table("it", "boundary.land_planes").rows.size(), 6u);
  EXPECT_EQ(pit.table("it", "boundary.land_planes").rows, whole.table("it", "boundary.planes").rows);
  EXPECT_NEAR(pit.number("it", "boundary.volume"), 20 * (2400 - 4), 1e-6);
}

TEST(Boundary, OnlyGroundUnderTheSkyIsOpen) {
  const std::string plan = R"("form": "plan", "plan": [[0,0,0],[10,0,0],[10,10,0],[0,10,0]], "height": 20, "exclusions": [)";
  World world = World::from_text(one_node("boundary", plan + kept_open("passage", "square", 2, 2, 6, 6, 8) + "]"));
  world.tick();
  EXPECT_NEAR(world.number("it", "boundary.open_area"), 0, 1e-9) << "volumes may be above it";
  EXPECT_NEAR(world.table("it", "boundary.open_areas").number(0, "drawn"), 16, 1e-9);
  World hull =
      World::from_text(one_node("boundary", R"("exclusions": [)" + kept_open("lawn", "garden", -20, -20, -10, 20) + "]"));
  hull.tick();
  EXPECT_NEAR(hull.number("it", "boundary.open_area"), 400, 1e-9) << "boundaries of other forms keep ground open too";
}

TEST(Boundary, AnErrorKeepsTheLastGoodShape) {
  World world = World::from_text(one_node("boundary", R"("form": "plan", "height": 10)"));
  world.tick();
  const double volume = world.number("it", "boundary.volume");
  EXPECT_EQ(world.submit(command<SetPort>({.node = "it", .port = {"boundary.plan"}, .value = {"[[0,0,0],[1,0,0]]"}})), "");
  world.tick();
  EXPECT_NE(world.node_error("it", "boundary"), "");
  EXPECT_EQ(world.number("it", "boundary.volume"), volume);
}

TEST(Boundary, SceneHoldsSpacesOfKnownSize) {
  World world = World::from_file("scenes/nodes/boundary.json");
  EXPECT_TRUE(world.settle(20));
  // The prism has a triangle of 20 m by 12 m for its section, and is 30 m long.
  EXPECT_NEAR(world.number("hull", "boundary.volume"), 3600, 1e-6);
  EXPECT_NEAR(world.number("hull", "boundary.ground_area"), 600, 1e-9);
  EXPECT_NEAR(world.number("plan", "boundary.ground_area"), 600 - 12.5, 1e-9);
  // A block of 40 m by 30 m and 12 m height, less a court of 20 m by 10 m, with a tower of 10 m by 10 m and 30 m.
  EXPECT_NEAR(world.number("court", "boundary.volume"), 1000 * 12 + 100 * 18, 1e-6);
  EXPECT_NEAR(world.number("court", "boundary.ground_area"), 1000, 1e-6);
  // An ell of 825 m² and 15 m, less the wedge of a setback of one to one from 11 m up, and a chapel of 600 m³.
  EXPECT_NEAR(world.number("ell", "boundary.volume"), 825 * 15 - 0.5 * 4 * 4 * 40 - 600, 1e-6);
  EXPECT_NEAR(world.number("ell", "boundary.ground_area"), 825, 1e-6);
  EXPECT_NEAR(world.number("mesh", "boundary.volume"), 1500, 1e-6);
  EXPECT_NEAR(world.number("mesh", "boundary.ground_area"), 200, 1e-6);
}

}  // namespace
}  // namespace bl
