// The proposal of a scene, and what all formats make of it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/export/coarse_ground.h"
#include "core/export/format.h"
#include "core/export/identity.h"
#include "core/export/option_text.h"
#include "core/export/read_proposal.h"
#include "core/export/solids.h"
#include "core/geometry/plan_ring.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

TEST(Proposal, StoreysAddUpToTheFiguresOfTheScene) {
  const World world = settled_world();
  const Proposal proposal = proposal_of(world);
  ASSERT_EQ(proposal.buildings.size(), 2u);
  double all = 0;
  for (const Building& building : proposal.buildings) {
    double sum = 0, drawn = 0;
    for (const Storey& storey : building.storeys) {
      sum += storey.floor_area;
      drawn += area_of(storey.faces);
      EXPECT_GT(storey.top, storey.bottom);
    }
    const double figure = world.number(building.id, "smart_volume.floor_area");
    EXPECT_NEAR(sum, figure, 1e-9 * figure);
    // The sections are those that the solver measures, with fine chords for arcs.
    EXPECT_NEAR(drawn, figure, 0.01 * figure);
    const double footprint = world.number(building.id, "smart_volume.footprint");
    EXPECT_NEAR(area_of(building.outline), footprint, 0.01 * footprint);
    EXPECT_TRUE(is_closed(*building.mesh));
    EXPECT_GT(building.storeys.size(), 2u);
    all += sum;
  }
  EXPECT_NEAR(proposal.all.floor_area, all, 1e-9 * all);
  ASSERT_FALSE(proposal.lands.empty());
  EXPECT_NEAR(proposal.lands.front().area, 2400, 1e-9 * 2400);
  EXPECT_NEAR(area_of(proposal.lands.front().faces), 2400, 1e-9 * 2400);
}

TEST(Proposal, EachStoreyOfABuildingHasALevelOfItsOwn) {
  const Proposal proposal = proposal_of(settled_world());
  for (const Building& building : proposal.buildings)
    for (std::size_t k = 1; k < building.storeys.size(); ++k) EXPECT_GT(building.storeys[k].level, building.storeys[k - 1].level);
}

// Shops of 4.5 m below flats of 3 m: the storey that both have is as high as a shop.
TEST(Proposal, StoreysOfASharedBuildingHaveLevelsOfTheirOwn) {
  Proposal proposal;
  const auto add = [&](const char* id, std::initializer_list<double> floors) {
    Building& building = proposal.buildings.emplace_back();
    building.id = id;
    building.is_standing = true;
    building.storey_height = 4.5;
    for (auto floor = floors.begin(); floor + 1 != floors.end(); ++floor)
      building.storeys.push_back({static_cast<int>(building.storeys.size()), 0, *floor, *(floor + 1), 100, {}, {}, {}});
  };
  add("shops", {0, 4.5, 9});
  add("flats", {4.5, 9, 12, 15, 18, 21, 24});
  number_levels(proposal);
  EXPECT_EQ(proposal.level_height, 3);
  EXPECT_EQ(proposal.levels, 8);
  for (const Building& building : proposal.buildings)
    for (std::size_t k = 1; k < building.storeys.size(); ++k)
      EXPECT_GT(building.storeys[k].level, building.storeys[k - 1].level) << building.id;
}

// Storeys below the ground leave with negative numbers, and count in nothing but their own area.
TEST(Formats, CellarsAreStoreysBelowTheGround) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-30, -20, 0], [30, -20, 0], [30, 20, 0], [-30, 20, 0]], "height": 30}}},
      {"id": "solver", "types": {"standing_solver": {}}},
      {"id": "house", "types": {"footprint": {"form": "round", "cellar_storeys": 2, "cellar_height": 2.8, "depth": 7},
                                "smart_volume": {"demand": 6000, "use": "housing", "storey_height": 3}}}]})");
  ASSERT_TRUE(world.settle());
  const Proposal proposal = proposal_of(world);
  const Building& house = proposal.buildings.at(0);
  ASSERT_EQ(house.cellars.size(), 2u);
  EXPECT_EQ(house.cellars[1].number, -2);
  EXPECT_NEAR(house.cellars[1].bottom, -5.6, 1e-12);
  EXPECT_NEAR(house.cellars[0].top, 0, 1e-12);
  const double cellar = world.number("house", "footprint.cellar_area");
  EXPECT_NEAR(house.cellars[0].floor_area + house.cellars[1].floor_area, cellar, 1e-12 * cellar);
  EXPECT_NEAR(area_of(house.cellars[0].faces), 0.5 * cellar, 1e-3 * cellar);
  EXPECT_GT(house.cellars[0].floor_area, house.storeys[0].floor_area) << "under the courtyard too";
  double floors = 0;
  for (const Storey& storey : house.storeys) floors += storey.floor_area;
  EXPECT_NEAR(floors, house.floor_area, 1e-9 * floors);
  const auto written = [&](const char* id) {
    const FormatDefinition* format = find_format(id);
    auto files = format->write(proposal, *option_values(*format, {}), false);
    EXPECT_TRUE(files) << id;
    return files->files.front().content;
  };
  const std::string ifc = written("ifc");
  EXPECT_NE(ifc.find("house, storey -2"), std::string::npos);
  EXPECT_NE(ifc.find("'CellarArea'"), std::string::npos);
  const auto city = nlohmann::json::parse(written("cityjson"));
  EXPECT_EQ(city["CityObjects"]["building/house"]["attributes"]["storeysBelowGround"], 2);
  const auto& part = city["CityObjects"]["building/house/-1"];
  EXPECT_EQ(part["type"], "BuildingPart");
  EXPECT_EQ(part["parents"][0], "building/house");
  EXPECT_EQ(part["geometry"].size(), 1u);
  EXPECT_NE(written("dxf").find("L-1-"), std::string::npos);
  EXPECT_NE(written("csv").find("cellar,house"), std::string::npos);
  EXPECT_FALSE(written("xlsx").empty());
}

TEST(Proposal, WhatHasNotRunIsNoProposal) {
  const World world = World::from_file("scenes/start/quarter.json");
  const auto proposal = read_proposal(world.state(), "quarter.json");
  if (world.state().tick == 0) {
    ASSERT_FALSE(proposal);
    EXPECT_NE(proposal.error().message.find("--settle"), std::string::npos);
  }
}

TEST(FacesOfRings, HolesAreFoundWhateverTheyTurn) {
  const geometry::Ring outer = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}},
                       hole = {{2, 2, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}},
                       island = {{2.5, 2.5, 0}, {3, 2.5, 0}, {3, 3, 0}, {2.5, 3, 0}};
  const auto faces = faces_of_rings({island, hole, geometry::Ring(outer.rbegin(), outer.rend())});
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_EQ(faces[0].holes.size(), 1u);
  EXPECT_GT(geometry::signed_area(faces[0].outer), 0);
  EXPECT_LT(geometry::signed_area(faces[0].holes[0]), 0);
  EXPECT_NEAR(area_of(faces), 100 - 4 + 0.25, 1e-12);
}

// Side by side they share corners and a side, but none lies within the other.
TEST(FacesOfRings, NeighboursAreNoHoles) {
  const auto faces =
      faces_of_rings({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{1, 0, 0}, {1.5, 0, 0}, {1.5, 1, 0}, {1, 1, 0}}});
  EXPECT_EQ(faces.size(), 2u);
}

TEST(Formats, AllWriteTheSameBytesTwiceAndNameTheState) {
  Proposal proposal = proposal_of(settled_world());
  proposal.shell = kShell;
  ASSERT_GE(all_formats().size(), 10u);
  for (const FormatDefinition& format : all_formats()) {
    EXPECT_FALSE(format.doc.empty()) << format.id;
    EXPECT_FALSE(format.marks.empty()) << format.id;
    const auto options = option_values(format, {});
    ASSERT_TRUE(options);
    const auto once = format.write(proposal, *options, format.may_fill_folder),
               again = format.write(proposal, *options, format.may_fill_folder);
    ASSERT_TRUE(once) << format.id << ": " << once.error().text();
    ASSERT_EQ(once->files.size(), again->files.size());
    for (std::size_t k = 0; k < once->files.size(); ++k) {
      EXPECT_EQ(once->files[k].content, again->files[k].content) << format.id;
      const std::string& content = once->files[k].content;
      EXPECT_TRUE(has_mark(format, content, content)) << format.id << ": " << content.substr(0, 80);
      const bool is_packed = format.ending == ".xlsx" || format.ending == ".3mf" || format.ending == ".pdf";
      EXPECT_TRUE(is_packed || once->files[k].content.find(proposal.hash) != std::string::npos) << format.id;
    }
  }
}

TEST(Formats, APageHoldsItsDataAndNothingThatEndsIt) {
  Proposal proposal = proposal_of(settled_world());
  const FormatDefinition* format = find_format("html");
  ASSERT_NE(format, nullptr);
  EXPECT_EQ(format->shell, "proposal.html");
  const auto without = format->write(proposal, *option_values(*format, {}), false);
  ASSERT_FALSE(without);
  EXPECT_NE(without.error().message.find("not built"), std::string::npos) << without.error().message;
  proposal.shell = kShell;
  proposal.title = "A </title> & a </script>";
  const auto made = format->write(proposal, *option_values(*format, {}), false);
  ASSERT_TRUE(made);
  const std::string& page = made->files.front().content;
  EXPECT_NE(page.find("<title>A &lt;/title&gt; &amp; a &lt;/script&gt;</title>"), std::string::npos);
  EXPECT_EQ(page.find("</script>"), page.rfind("</script>"));
  const std::size_t begin = page.find("json\">") + 6;
  const auto data = nlohmann::json::parse(page.substr(begin, page.find("</script>") - begin));
  EXPECT_EQ(data["title"], proposal.title);
  EXPECT_EQ(data["buildings"].size(), proposal.buildings.size());
  for (const auto& building : data["buildings"])
    for (const auto& storey : building["storeys"]) EXPECT_LT(storey["path"], data["paths"].size());
}

// A page that reads other data stays blank, without a word: an export refuses it.
TEST(Formats, APageOfAnotherVersionIsRefused) {
  Proposal proposal = proposal_of(settled_world());
  const FormatDefinition* format = find_format("html");
  const std::string now = "content=\"2\"";
  for (const std::string other : {"content=\"1\"", "content=\"three\"", ""}) {
    proposal.shell = kShell;
    proposal.shell.replace(proposal.shell.find(now), now.size(), other);
    const auto made = format->write(proposal, *option_values(*format, {}), false);
    ASSERT_FALSE(made) << other;
    EXPECT_EQ(made.error().code, ErrorCode::version);
    EXPECT_NE(made.error().message.find("this program writes version 2: build the page again"), std::string::npos)
        << made.error().message;
  }
}

// So many volumes that a page has no room for their shapes.
Proposal crowded_proposal() {
  Proposal proposal = proposal_of(settled_world());
  proposal.shell = kShell;
  const Building one = proposal.buildings.front();
  for (int k = 0; k < 1500; ++k) {
    proposal.buildings.push_back(one);
    proposal.buildings.back().id += std::to_string(k);
  }
  return proposal;
}

TEST(Formats, APageThatWouldBeTooLargeBecomesCoarser) {
  const ExportFiles made = files_of(crowded_proposal(), "html");
  EXPECT_LE(made.files.front().content.size(), 3000000u);
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes.front().find("upright"), std::string::npos) << made.notes.front();
}

// Where nothing may be built the rule is 0; where there is none, tables say nothing.
TEST(Formats, NoRuleIsNoNumber) {
  World world = World::from_text(R"({"format": "behaviourlinks", "version": 1, "settings": {}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "plan": [[-30, -20, 0], [30, -20, 0], [30, 20, 0], [-30, 20, 0]], "height": 30}}},
      {"id": "solver", "types": {"smart_volumes_solver": {}}},
      {"id": "house", "position": [0, 0, 8], "types": {"smart_volume": {"demand": 900}}},
      {"id": "free", "types": {"plot": {}}},
      {"id": "park", "types": {"plot": {"fsi_max": 0, "height_max": 12.5}}}]})");
  ASSERT_TRUE(world.settle());
  Proposal proposal = proposal_of(world);
  proposal.shell = kShell;
  const auto land = [&](const char* id) {
    return *std::find_if(proposal.lands.begin(), proposal.lands.end(), [&](const Land& one) { return one.id == id; });
  };
  EXPECT_FALSE(land("free").fsi_max || land("free").gsi_max || land("free").height_max);
  EXPECT_EQ(land("park").fsi_max, 0.0);
  EXPECT_FALSE(land("park").gsi_max);
  EXPECT_EQ(land("park").height_max, 12.5);
  const auto features = nlohmann::json::parse(file_of(proposal, "geojson", {"coordinates=scene"}))["features"];
  for (const auto& feature : features) {
    const auto& figures = feature["properties"];
    if (feature["id"] == "plot/free") { EXPECT_TRUE(figures["fsi_max"].is_null() && figures["height_max_m"].is_null()); }
    if (feature["id"] == "plot/park") { EXPECT_EQ(figures["fsi_max"], 0); }
  }
  const std::string page = file_of(proposal, "html");
  EXPECT_NE(page.find(R"("fsi_max":0.0,"gsi_max":null,"height_max":12.5)"), std::string::npos);
}

// A slope of 128 by 128 places, as the terrain node has it at most.
Mesh slope() {
  constexpr std::uint32_t kSide = 128;
  Mesh ground;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) ground.vertices.push_back({5.0 * x, 5.0 * y, 0.1 * x});
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t a = y * kSide + x, b = a + kSide;
      ground.triangles.push_back({a, a + 1, b + 1});
      ground.triangles.push_back({a, b + 1, b});
    }
  return ground;
}

TEST(CoarseGround, ItCoversTheSameLandWithFewerTriangles) {
  const Mesh ground = slope();
  EXPECT_EQ(coarse_ground(ground, ground.triangles.size()), ground);
  for (const std::size_t most : {20000u, 4000u, 1000u, 50u, 2u}) {
    const Mesh coarse = coarse_ground(ground, most);
    EXPECT_LE(coarse.triangles.size(), most);
    EXPECT_GE(coarse.triangles.size(), most / 4);
    double area = 0;
    for (const auto& [a, b, c] : coarse.triangles) {
      const Vector3 u = coarse.vertices[b] - coarse.vertices[a], v = coarse.vertices[c] - coarse.vertices[a];
      const double part = (u.x * v.y - u.y * v.x) / 2;
      EXPECT_GE(part, 0) << "turned over";
      area += part;
    }
    EXPECT_NEAR(area, 635.0 * 635.0, 1e-6 * area) << most;
    for (const Point3& v : coarse.vertices) EXPECT_NEAR(v.z, 0.02 * v.x, 1e-9) << "places stay where they are";
  }
}

// The ground stays on a page that has little room, and what is coarser is said.
TEST(Formats, ALargePageKeepsTheGround) {
  Proposal proposal = crowded_proposal();
  const Building& one = proposal.buildings.front();
  proposal.terrains = {std::make_shared<const Mesh>(slope())};
  proposal.neighbours.push_back({"old", "Old", "", one.outline.front(), 0, 9, one.mesh});
  const ExportFiles made = files_of(proposal, "html");
  const std::string& page = made.files.front().content;
  EXPECT_LE(page.size(), 3000000u);
  EXPECT_NE(page.find("\"n/terrain/0\""), std::string::npos);
  ASSERT_EQ(made.notes.size(), 1u);
  EXPECT_NE(made.notes.front().find(" of 32258 triangles"), std::string::npos) << made.notes.front();
  EXPECT_NE(made.notes.front().find("existing building is an upright body"), std::string::npos) << made.notes.front();
}

TEST(Formats, GeoJsonRefusesASceneWithoutAPlace) {
  Proposal proposal = proposal_of(settled_world());
  proposal.reference = {};
  const FormatDefinition* format = find_format("geojson");
  ASSERT_NE(format, nullptr);
  const auto refused = format->write(proposal, *option_values(*format, {}), false);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("where it lies on Earth"), std::string::npos) << refused.error().message;
  const auto own = format->write(proposal, *option_values(*format, {"coordinates=scene"}), false);
  ASSERT_TRUE(own);
  EXPECT_EQ(own->notes.size(), 1u);
}

TEST(Formats, OptionsAreReadByTheirDeclarations) {
  const FormatDefinition* format = find_format("stl");
  ASSERT_NE(format, nullptr);
  const auto values = option_values(*format, {"scale=200", "layout=binary"});
  ASSERT_TRUE(values);
  EXPECT_EQ(std::get<double>((*values)[format->port_index("scale")]), 200);
  EXPECT_FALSE(option_values(*format, {"scale=0.5"}));
  EXPECT_FALSE(option_values(*format, {"scale=large"}));
  EXPECT_FALSE(option_values(*format, {"layout=triangles"}));
  EXPECT_FALSE(option_values(*format, {"surroundings=maybe"}));
  const auto unknown = check_option_names({format}, {"scael=200"});
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("did you mean `scale`"), std::string::npos);
  EXPECT_FALSE(check_option_names({format}, {"scale"}));
}

// Known to the decimetre by hand: the origin of the scene is where the settings say.
TEST(WayToEarth, TheOriginIsWhereTheSceneSays) {
  Proposal proposal;
  proposal.reference = {"", 0, 0, 52, 5, 30};
  const auto way = WayToEarth::make(proposal);
  ASSERT_TRUE(way);
  const Point3 origin = way->degrees({0, 0, 0});
  EXPECT_NEAR(origin.x, 5, 1e-12);
  EXPECT_NEAR(origin.y, 52, 1e-12);
  // True north lies 30 degrees clockwise from the scene's y.
  const Point3 north = way->degrees({std::sin(std::numbers::pi / 6) * 1000, std::cos(std::numbers::pi / 6) * 1000, 0});
  EXPECT_NEAR(north.x, 5, 1e-9);
  EXPECT_GT(north.y, 52.008);
}

}  // namespace
}  // namespace bl::exporting
