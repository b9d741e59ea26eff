// Share footprint: a name by hand, a building of three uses, and everything that its parts must not be.
#include <cmath>

#include "core/reading/report_model.h"
#include "tests/links/link_case.h"

namespace bl {
namespace {

using Names = std::vector<std::string>;

TEST(ShareFootprint, ProposesTheHost) {
  LinkCase link("share_footprint");
  link.from("node.id", std::string("shops")).from("footprint.storeys_built", 3.0);
  ASSERT_EQ(link.run(), "");
  EXPECT_EQ(*std::get<Shared<Names>>(link.proposed(End::to, "footprint.shares").value()), Names{"shops"});
}

TEST(ShareFootprint, ThreeUsesMakeOneBuilding) {
  World world = World::from_file("scenes/links/share_footprint.json");
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("solver", "standing_solver.message"), "");
  double floors = 0;
  for (const char* id : {"shops", "offices", "flats", "library"}) {
    const double asked = world.number(id, "smart_volume.demand") / world.number(id, "smart_volume.storey_height");
    EXPECT_NEAR(world.number(id, "smart_volume.floor_area"), asked, 0.006 * asked) << id;
    EXPECT_LE(world.number(id, "smart_volume.error"), 0.006) << id;
    floors += world.number(id, "smart_volume.floor_area");
  }
  EXPECT_NEAR(world.number("solver", "standing_solver.total_floor_area"), floors, 1e-12 * floors);
  EXPECT_EQ(world.number("shops", "smart_volume.bottom"), 0);
  EXPECT_GT(world.number("flats", "smart_volume.bottom"), world.number("offices", "smart_volume.bottom"));
  EXPECT_EQ(world.text("flats", "smart_volume.stands_on"), "offices");
  EXPECT_EQ(world.number("shops", "footprint.storeys_held"), 6);
  // Covered once, by whoever has the ground.
  const double covered = world.number("solver", "standing_solver.covered");
  EXPECT_LT(covered, 1200);
  // A limit on the host is one on the building: it loses storeys, its footprint grows, and the flats stay as large.
  ASSERT_EQ(world.submit(command<SetPort>({.node = "shops", .port = {"footprint.height_limit"}, .value = {"15.5"}})), "");
  world.tick(8);
  ASSERT_TRUE(world.settle());
  EXPECT_LT(world.number("shops", "footprint.storeys_held"), 6);
  EXPECT_GT(world.number("solver", "standing_solver.covered"), covered);
  EXPECT_NEAR(world.number("flats", "smart_volume.floor_area"), 2200, 14);
  ASSERT_EQ(world.submit(command<RemoveLink>({.id = "l2_flats"})), "");
  world.tick(8);
  ASSERT_TRUE(world.settle());
  EXPECT_EQ(world.text("flats", "smart_volume.stands_on"), "the ground");
}

// The scene with a plot and a link of rules: the building of shops, offices and flats has six storeys.
World building_on_plot(const std::string& plot, const std::string& shops = R"("aspect": 2, "storeys": 6)",
                       const std::string& links = "") {
  std::string text = project_file("scenes/links/share_footprint.json");
  const auto change = [&text](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  change(R"("aspect": 2, "storeys": 6)", shops);
  change(R"("nodes": [)",
         R"("nodes": [{"id": "land", "types": {"plot": {"polygon": [[-40,-25,0],[40,-25,0],[40,25,0],[-40,25,0]], )" + plot +
             "}}},");
  if (!links.empty()) change(R"("links": [)", R"("links": [)" + links + ",");
  return World::from_text(text);
}

// The flats have their position 12 m north of the building: what they have is where the building is.
TEST(ShareFootprint, PlatesWithArcsAreDrawnAboutTheHost) {
  World world = building_on_plot(R"("setback": 8)", R"("form": "round", "storeys": 6)");
  ASSERT_TRUE(world.settle());
  const double radius = std::sqrt(world.number("shops", "smart_volume.weight"));
  ASSERT_GT(radius, 13);
  ASSERT_LT(radius, 17) << "the building keeps 8 m from all sides";
  EXPECT_EQ(world.number("land", "plot.setback_overshoot"), 0);
  // Wherever plates are read they are what stands.
  reading::ReportModel model;
  reading::read_model(world.state(), model);
  for (const reading::VolumeRow& row : model.volumes) {
    if (row.id == "library") continue;
    ASSERT_FALSE(row.body.stacks.empty()) << row.id;
    EXPECT_EQ(row.body.centre, (Point3{-14, 0, 0})) << row.id;
    EXPECT_NEAR(enclosed_volume(geometry::mesh_of(row.body, 0.02)), enclosed_volume(*row.mesh), 1e-6 * row.volume) << row.id;
  }
}

double top_of_building(const World& world) {
  double top = 0;
  for (const char* id : {"shops", "offices", "flats"})
    top = std::max(top, world.number(id, "smart_volume.bottom") + world.number(id, "smart_volume.height"));
  return top;
}

// The host is the highest of the three, so that its floor lies where the others end.
TEST(ShareFootprint, LimitsOfHeightCountFromTheGroundOfTheBuilding) {
  const std::string rules = R"({"id": "rules", "kind": "plot_rules", "from": "land", "to": {"typification": "smart_volume"}})";
  World high = building_on_plot(R"("height_max": 24)", R"("aspect": 2, "storeys": 6, "order": 5)", rules);
  ASSERT_TRUE(high.settle());
  ASSERT_GT(high.number("shops", "smart_volume.bottom"), 12);
  EXPECT_EQ(high.number("shops", "footprint.storeys_held"), 6);
  EXPECT_LT(top_of_building(high), 24);
  EXPECT_GT(top_of_building(high), 20);
  EXPECT_EQ(high.link_error("rules"), "");
  // Storeys go by their mean height, whatever that of the host is; they come back, and do not come and go.
  ASSERT_EQ(high.submit(command<SetPort>({.node = "land", .port = {"plot.height_max"}, .value = {"19"}})), "");
  high.tick(20);
  ASSERT_TRUE(high.settle());
  EXPECT_EQ(high.number("shops", "footprint.storeys_held"), 5);
  EXPECT_LE(top_of_building(high), 19);
  const std::string said = high.link_error("rules");
  EXPECT_NE(said.find("the building of `shops` has 5 of 6 storeys, because it may be no higher than 19.00 m"), std::string::npos)
      << said;
  EXPECT_EQ(said.find("has 5 of 6"), said.rfind("has 5 of 6")) << "once of each building: " << said;
  EXPECT_NEAR(high.number("flats", "smart_volume.floor_area"), 2200, 14);
  ASSERT_EQ(high.submit(command<SetPort>({.node = "land", .port = {"plot.height_max"}, .value = {"30"}})), "");
  high.tick(20);
  ASSERT_TRUE(high.settle());
  EXPECT_EQ(high.number("shops", "footprint.storeys_held"), 6);
  // One set by hand on another one than the host counts from there as well.
  ASSERT_EQ(high.submit(command<SetPort>({.node = "flats", .port = {"footprint.height_limit"}, .value = {"16"}})), "");
  high.tick(20);
  ASSERT_TRUE(high.settle());
  EXPECT_LE(top_of_building(high), 16);
  EXPECT_GT(top_of_building(high), 12);
}

TEST(ShareFootprint, BadHostsAreNamedAndNobodyIsLost) {
  const auto said = [](const std::string& flats, const std::string& offices) {
    World world = World::from_file("scenes/links/share_footprint.json");
    for (const char* link : {"l1_offices", "l2_flats"}) EXPECT_EQ(world.submit(command<RemoveLink>({.id = link})), "");
    EXPECT_EQ(world.submit(command<SetPort>({.node = "flats", .port = {"footprint.shares"}, .value = {flats}})), "");
    EXPECT_EQ(world.submit(command<SetPort>({.node = "offices", .port = {"footprint.shares"}, .value = {offices}})), "");
    EXPECT_TRUE(world.settle());
    for (const char* id : {"shops", "offices", "flats"}) EXPECT_GT(world.number(id, "smart_volume.floor_area"), 500) << id;
    return world.text("solver", "standing_solver.message");
  };
  EXPECT_NE(said(R"(["nobody"])", "[]")
                .find("`flats` has a footprint of its own, because `nobody`, whose footprint it shares, is no "
                      "volume of this solver"),
            std::string::npos);
  EXPECT_NE(said(R"(["plot"])", "[]").find("`plot`, whose footprint it shares, is no volume of this solver"), std::string::npos);
  EXPECT_NE(said(R"(["flats"])", "[]").find("is itself"), std::string::npos);
  const std::string circle = said(R"(["offices"])", R"(["flats"])");
  EXPECT_NE(circle.find("`flats` has a footprint of its own, because `offices`"), std::string::npos) << circle;
  EXPECT_NE(circle.find("`offices` has a footprint of its own, because `flats`"), std::string::npos) << circle;
  const std::string chain = said(R"(["offices"])", R"(["shops"])");
  EXPECT_NE(
      chain.find("`flats` has a footprint of its own, because `offices`, whose footprint it shares, shares the footprint of "
                 "another itself"),
      std::string::npos)
      << chain;
}

}  // namespace
}  // namespace bl
