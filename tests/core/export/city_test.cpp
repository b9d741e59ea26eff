// City models of buildings whose parts lie upon one another: closed bodies, and what of them is roof, ceiling or neither.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/geometry/plan_split.h"
#include "tests/core/export/two_houses.h"

namespace bl::exporting {
namespace {

struct CitySums {
  std::map<std::string, double> areas;  // by kind of surface [m²]
  double volume = 0;                    // [m³]
  bool is_closed = true;
};

using Corners = std::vector<Point3>;

// Twice the area, as a vector.
Vector3 spanned(const Corners& ring) {
  Vector3 sum;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) sum = sum + cross(ring[k] - ring[0], ring[k + 1] - ring[0]);
  return sum;
}

void add_shell(const nlohmann::json& shell, const nlohmann::json& kinds, const nlohmann::json& names,
               const std::vector<Point3>& places, CitySums& sums) {
  std::multiset<std::pair<std::size_t, std::size_t>> sides;
  for (std::size_t s = 0; s < shell.size(); ++s) {
    Vector3 area;
    for (const auto& ring : shell[s]) {
      const auto numbers = ring.get<std::vector<std::size_t>>();
      Corners corners;
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        corners.push_back(places[numbers[k]]);
        sides.emplace(numbers[k], numbers[(k + 1) % numbers.size()]);
      }
      const Vector3 part = spanned(corners);
      area = area + part;
      for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sums.volume += dot(corners[0] - Point3{}, cross(corners[k] - Point3{}, corners[k + 1] - Point3{})) / 6;
    }
    sums.areas[names[kinds[s].get<std::size_t>()]["type"]] += norm(area) / 2;
  }
  for (const auto& side : sides)
    sums.is_closed = sums.is_closed && sides.count(side) == 1 && sides.count({side.second, side.first}) == 1;
}

CitySums sums_of(const nlohmann::json& document, const std::string& id) {
  const auto& transform = document["transform"];
  std::vector<Point3> places;
  for (const auto& v : document["vertices"])
    places.push_back({v[0].get<double>() * transform["scale"][0].get<double>(),
                      v[1].get<double>() * transform["scale"][1].get<double>(),
                      v[2].get<double>() * transform["scale"][2].get<double>()});
  CitySums sums;
  for (const auto& geometry : document["CityObjects"][id]["geometry"]) {
    if (geometry["lod"] != "2.2") continue;
    const auto& semantics = geometry["semantics"];
    const bool is_one = geometry["type"] == "Solid";
    const nlohmann::json solids = is_one ? nlohmann::json::array({geometry["boundaries"]}) : geometry["boundaries"],
                         values = is_one ? nlohmann::json::array({semantics["values"]}) : semantics["values"];
    for (std::size_t k = 0; k < solids.size(); ++k) add_shell(solids[k][0], values[k][0], semantics["surfaces"], places, sums);
  }
  return sums;
}

geometry::Ring rectangle(double left, double low, double right, double high, double turn) {
  geometry::Ring ring;
  for (const auto& [x, y] : {std::pair(left, low), std::pair(right, low), std::pair(right, high), std::pair(left, high)})
    ring.push_back({std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, 0});
  return ring;
}

Building building_of(const char* id, std::initializer_list<std::pair<geometry::Ring, double>> storeys, double ground) {
  Building building;
  building.id = building.label = id;
  building.is_standing = true;
  building.bottom = building.top = ground;
  for (const auto& [ring, height] : storeys) {
    building.storeys.push_back(
        {static_cast<int>(building.storeys.size()), 0, building.top, building.top + height, 0, {{ring, {}}}, {}, {}});
    building.top += height;
  }
  building.outline = building.storeys.front().faces;
  return building;
}

// By hand: storeys of 20 by 20 m with others upon them that step back, stand out, or both.
TEST(CityModel, WhatIsCoveredIsNeitherRoofNorCeiling) {
  struct Case {
    std::array<double, 4> upper;
    double common;  // [m²]
  };
  for (const auto& [upper, common] :
       {Case{{2, 2, 18, 18}, 256}, Case{{0, 0, 16, 16}, 256}, Case{{0, 4, 20, 16}, 240}, Case{{-3, -3, 23, 23}, 400},
        Case{{10, 5, 25, 15}, 100}, Case{{0, 0, 20, 20}, 400}, Case{{20, 0, 30, 20}, 0}, Case{{5, -5, 15, 25}, 200}})
    for (const double turn : {0.0, 0.3, 1.1}) {
      const geometry::Ring low = rectangle(0, 0, 20, 20, turn), high = rectangle(upper[0], upper[1], upper[2], upper[3], turn);
      const double above = (upper[2] - upper[0]) * (upper[3] - upper[1]);
      Proposal proposal;
      proposal.reference.crs = "EPSG:28992";
      proposal.buildings = {building_of("house", {{low, 3}, {low, 3}, {low, 3}, {high, 3}, {high, 3}, {high, 3}}, 0)};
      const ExportFiles made = files_of(proposal, "cityjson");
      EXPECT_TRUE(made.notes.empty());
      CitySums sums = sums_of(nlohmann::json::parse(made.files.front().content), "building/house");
      EXPECT_TRUE(sums.is_closed) << upper[0] << ", " << turn;
      const double room = 0.02;  // [m²]: corners lie on a grid of a tenth of a millimetre
      EXPECT_NEAR(sums.areas["RoofSurface"], 400 - common + above, room);
      EXPECT_NEAR(sums.areas["OuterCeilingSurface"], above - common, room);
      EXPECT_NEAR(sums.areas["GroundSurface"], 400, room);
      EXPECT_NEAR(sums.areas["ClosureSurface"], upper[2] == 20 && above == 400 ? 0 : 2 * common, room);
      EXPECT_NEAR(sums.volume, 9 * (400 + above), 9 * room);
    }
}

// A tower on a podium of somebody else, and a round one with fine chords.
TEST(CityModel, WhatStandsOnAnotherBuildingCoversItsRoof) {
  geometry::Ring round;
  for (int k = 0; k < 157; ++k) {
    const double angle = 2 * std::numbers::pi * k / 157;
    round.push_back({14 + 8 * std::cos(angle), 10 + 8 * std::sin(angle), 0});
  }
  Proposal proposal;
  proposal.reference.crs = "EPSG:28992";
  proposal.buildings = {building_of("podium", {{rectangle(0, 0, 20, 20, 0), 4.5}}, 0), building_of("tower", {{round, 3}}, 4.5)};
  const ExportFiles made = files_of(proposal, "cityjson");
  EXPECT_TRUE(made.notes.empty());
  const auto document = nlohmann::json::parse(made.files.front().content);
  CitySums podium = sums_of(document, "building/podium"), tower = sums_of(document, "building/tower");
  EXPECT_TRUE(podium.is_closed && tower.is_closed);
  const double all = geometry::signed_area(round), covered = podium.areas["ClosureSurface"];
  EXPECT_GT(covered, 0.8 * all);
  EXPECT_LT(covered, all - 1);
  EXPECT_NEAR(podium.areas["RoofSurface"], 400 - covered, 0.02);
  EXPECT_NEAR(tower.areas["ClosureSurface"], covered, 0.02);
  EXPECT_NEAR(tower.areas["RoofSurface"], all, 0.02);
}

// Of the standing quarter: the upper plate ends at the same slanted side, but for a hundredth of a millimetre.
TEST(CityModel, PartsThatEndAtTheSameSlantedSideStayClosed) {
  const geometry::Ring low = {{107.2359, 7.9701, 0},
                              {107.2359, 40.0299, 0},
                              {76.5891, 40.0299, 0},
                              {68.7641, 31.4935, 0},
                              {68.7641, 7.9701, 0}},
                       high = {{103, 36.5, 0}, {73.3534, 36.5, 0}, {73, 36.1145, 0}, {73, 11.5, 0}, {103, 11.5, 0}};
  Proposal proposal;
  proposal.reference.crs = "EPSG:28992";
  proposal.buildings = {building_of("shops", {{low, 4.5}}, 0), building_of("flats", {{high, 3}}, 4.5)};
  const ExportFiles made = files_of(proposal, "cityjson");
  EXPECT_TRUE(made.notes.empty());
  const auto document = nlohmann::json::parse(made.files.front().content);
  CitySums shops = sums_of(document, "building/shops"), flats = sums_of(document, "building/flats");
  EXPECT_TRUE(shops.is_closed && flats.is_closed);
  EXPECT_NEAR(flats.areas["ClosureSurface"], geometry::signed_area(high), 0.02);
  EXPECT_NEAR(shops.areas["ClosureSurface"], geometry::signed_area(high), 0.02);
  EXPECT_NEAR(shops.areas["RoofSurface"], geometry::signed_area(low) - geometry::signed_area(high), 0.02);
}

class CityScene : public ::testing::TestWithParam<const char*> {};

// What the solver says of a volume's roofs, with what is open of the roof of a podium.
TEST_P(CityScene, BodiesAreClosedAndRoofsAreThoseOfTheVolumes) {
  World world = World::from_file(GetParam());
  world.tick(60);
  const Proposal proposal = proposal_of(world);
  const ExportFiles made = files_of(proposal, "cityjson", {"surroundings=no"});
  for (const std::string& note : made.notes) EXPECT_EQ(note.find("no closed body"), std::string::npos) << note;
  const auto document = nlohmann::json::parse(made.files.front().content);
  for (const Building& building : proposal.buildings) {
    if (!building.is_standing) continue;
    CitySums sums = sums_of(document, "building/" + building.id);
    EXPECT_TRUE(sums.is_closed) << building.id;
    EXPECT_NEAR(sums.volume, enclosed_volume(*building.mesh), 1e-3 * sums.volume) << building.id;
    const double roof = world.number(building.id, "footprint.roof_area");
    if (sums.areas["ClosureSurface"] == 0) {
      EXPECT_NEAR(sums.areas["RoofSurface"], roof, 2e-3 * roof) << building.id;
    } else {
      EXPECT_LE(sums.areas["RoofSurface"], 1.002 * roof) << building.id;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Standing, CityScene,
                         ::testing::Values("scenes/start/standing.json", "scenes/links/share_footprint.json",
                                           "scenes/studies/tower_on_podium.json", "scenes/studies/standing_quarter.json"));

}  // namespace
}  // namespace bl::exporting
