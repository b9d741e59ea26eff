// `import` of a terrain below a site: the site and its volumes stand on it, once; and what is told where they cannot.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// A plane that rises to the east: 67 m at the western border of the site, 71 m at the eastern one.
std::string plane_rows(int columns, int lowest = 66, int step = 2) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows 5\nxllcorner 84950\nyllcorner 446940\ncellsize 50\n";
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < columns; ++column) text += std::to_string(lowest + step * column) + " ";
    text += "\n";
  }
  return text;
}

nlohmann::json ground_part(const nlohmann::json& scene, const std::string& id) {
  for (const auto& one : scene["nodes"])
    if (one["id"] == id) return one["types"];
  return {};
}

class ImportGround : public testing::Test {
 protected:
  ImportGround() {
    place.write("hill.asc", plane_rows(5));
    place.write("narrow.asc", plane_rows(2));
    place.write("site.geojson",
                R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
      {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[85000,447000],[85100,447000],
      [85100,447080],[85000,447080],[85000,447000]]]}}]})");
    place.write("brief.csv", "use,floor_area_m2,count\nhousing,1200,3\ngarden,600,1\n");
    EXPECT_EQ(new_scene("standing", "scene.json").code, 0);
  }
  Outcome new_scene(const std::string& form, const std::string& out) {
    return place.run(
        {"new", "--boundary", "site.geojson", "--height", "25", "--programme", "brief.csv", "--form", form, "--out", out});
  }
  Outcome import(const std::string& file, const std::string& into, const std::string& out) {
    const Outcome done = place.run({"import", file, "--crs", "EPSG:28992", "--into", into, "--out", out});
    EXPECT_EQ(done.code, 0) << done.err;
    return done;
  }
  nlohmann::json state_after_run(const std::string& scene) {
    const Outcome run = place.run({"run", scene, "--save", "after.json"});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    return place.json("after.json")["state"]["nodes"];
  }
  Workplace place;
};

TEST_F(ImportGround, TheSiteIsLiftedAndVolumesStandOnTheSlope) {
  const Outcome done = import("hill.asc", "scene.json", "a.json");
  EXPECT_NE(done.out.find("now, its lowest ground, instead of 0 m, and its height is 29 m instead of 25 m"), std::string::npos)
      << done.out;
  EXPECT_NE(done.out.find("The link `on_ground` sets all volumes"), std::string::npos) << done.out;
  const nlohmann::json boundary = ground_part(place.json("a.json"), "site")["boundary"];
  EXPECT_NEAR(boundary.value("bottom", 0.0), 67, 0.0101);
  EXPECT_NEAR(boundary.value("height", 0.0), 25 + 4, 0.0201) << "25 m above the highest ground";
  ASSERT_FALSE(boundary["exclusions"].empty()) << "the garden";
  EXPECT_NEAR(boundary["exclusions"][0].value("bottom", 0.0), 67, 0.0101) << "open over the whole height, as before";
  EXPECT_NEAR(boundary["exclusions"][0].value("top", 0.0), 67 + boundary.value("height", 0.0), 1e-9);
  const nlohmann::json state = state_after_run("a.json");
  for (const char* volume : {"housing_1", "housing_2", "housing_3"}) {
    ASSERT_TRUE(state.contains(volume)) << state.dump();
    const double bottom = state[volume].value("smart_volume.bottom", 0.0);
    EXPECT_GE(bottom, 67 - 0.0101) << volume;
    EXPECT_LE(bottom, 71) << volume;
    EXPECT_NEAR(bottom, state[volume].value("footprint.ground", 0.0), 1e-9) << volume;
    EXPECT_NEAR(state[volume].value("smart_volume.floor_area", 0.0), 1200, 12) << volume;
  }
}

// Rules and gardens that come after the terrain count from the ground as those that were there before it.
TEST_F(ImportGround, WhatIsAddedAfterTheTerrainLiesOnIt) {
  (void)import("hill.asc", "scene.json", "a.json");
  ASSERT_EQ(place.run({"add", "a.json", "rules", "--height", "15"}).code, 0);
  ASSERT_EQ(place.run({"add", "a.json", "garden", "--corners", "-40,-20", "-20,-20", "-20,0", "-40,0"}).code, 0);
  const nlohmann::json scene = place.json("a.json");
  EXPECT_NEAR(ground_part(scene, "site")["plot"].value("ground", 0.0), 67, 0.0101);
  const double middle = 0.5 * (67 + 71);
  for (const auto& one : scene["nodes"])
    if (one["id"] == "garden") {
      EXPECT_NEAR(one["position"][2].get<double>(), middle + 4 * (one["position"][0].get<double>()) / 100, 0.02);
    }
  const nlohmann::json state = state_after_run("a.json");
  EXPECT_LE(state["site"].value("plot.top", 99.0), 15 + 1e-9);
}

// Maps give heights above the ground. Whichever comes first, buildings stand on the terrain, and an import of the map again
// changes nothing.
TEST_F(ImportGround, BuildingsOfMapsStandOnTheTerrainInEitherOrder) {
  place.write("houses.geojson",
              R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
      {"type": "Feature", "id": "a", "properties": {"building": "yes", "height": 9}, "geometry": {"type": "Polygon", "coordinates":
      [[[85110,447000],[85120,447000],[85120,447010],[85110,447010],[85110,447000]]]}},
      {"type": "Feature", "id": "b", "properties": {"building": "yes", "height": 9}, "geometry": {"type": "Polygon", "coordinates":
      [[[84990,447000],[84980,447000],[84980,447010],[84990,447010],[84990,447000]]]}}]})");
  (void)import("hill.asc", "scene.json", "a.json");
  (void)import("houses.geojson", "a.json", "hill_first.json");
  (void)import("houses.geojson", "scene.json", "b.json");
  const Outcome later = import("hill.asc", "b.json", "houses_first.json");
  EXPECT_NE(later.out.find("2 buildings of the surroundings have heights above the ground: each stands on its lowest ground now"),
            std::string::npos)
      << later.out;
  for (const char* file : {"hill_first.json", "houses_first.json"}) {
    std::vector<double> bases;
    const nlohmann::json scene = place.json(file);
    for (const auto& one : scene["nodes"])
      if (one["types"].contains("existing_building")) {
        bases.push_back(one["types"]["existing_building"].value("base", 0.0));
        EXPECT_NEAR(one["position"][2].get<double>(), bases.back(), 1e-9);
      }
    ASSERT_EQ(bases.size(), 2u) << file;
    std::sort(bases.begin(), bases.end());
    EXPECT_NEAR(bases[0], 67 - 0.8, 0.011) << file;
    EXPECT_NEAR(bases[1], 71 + 0.4, 0.011) << file;
  }
  const Outcome again = import("houses.geojson", "houses_first.json", "again.json");
  EXPECT_EQ(place.text("houses_first.json"), place.text("again.json")) << again.out;
}

// A better terrain of the same name lifts what stood on the one before; what is set apart from it stays, as before.
TEST_F(ImportGround, AnUpdatedTerrainTakesTheSiteWithIt) {
  (void)import("hill.asc", "scene.json", "a.json");
  ASSERT_EQ(place.run({"add", "a.json", "garden", "--corners", "-40,-20", "-20,-20", "-20,0", "-40,0"}).code, 0);
  const auto garden_height = [&](const char* file) {
    const nlohmann::json scene = place.json(file);
    for (const auto& one : scene["nodes"])
      if (one["id"] == "garden") return one["position"][2].get<double>();
    return 0.0;
  };
  const double before = garden_height("a.json");
  place.write("hill.asc", plane_rows(5, 76));
  const Outcome again = import("hill.asc", "a.json", "b.json");
  EXPECT_NE(again.out.find("begins at 77.00 m now, its lowest ground, instead of 67 m, and keeps its height of 29 m"),
            std::string::npos)
      << again.out;
  EXPECT_EQ(again.out.find("which somebody has set"), std::string::npos) << again.out;
  EXPECT_NEAR(ground_part(place.json("b.json"), "site")["boundary"].value("bottom", 0.0), 77, 0.0101);
  EXPECT_NEAR(garden_height("b.json"), before + 10, 0.011);
}

// With a site at the height of its lowest ground already, and with a terrain that only rises more than the one before.
TEST_F(ImportGround, ASteeperTerrainRaisesTheSite) {
  place.write("sea.asc", plane_rows(5, -1));
  (void)import("sea.asc", "scene.json", "sea.json");
  const nlohmann::json by_sea = ground_part(place.json("sea.json"), "site")["boundary"];
  EXPECT_NEAR(by_sea.value("bottom", 0.0), 0, 0.0101);
  EXPECT_NEAR(by_sea.value("height", 0.0), 29, 0.0201);
  (void)import("hill.asc", "scene.json", "a.json");
  place.write("hill.asc", plane_rows(5, 65, 4));
  (void)import("hill.asc", "a.json", "b.json");
  const nlohmann::json steeper = ground_part(place.json("b.json"), "site")["boundary"];
  EXPECT_NEAR(steeper.value("bottom", 0.0), 67, 0.0101);
  EXPECT_NEAR(steeper.value("height", 0.0), 33, 0.0201);
  // Back again the site keeps its height: somebody may count on it.
  place.write("hill.asc", plane_rows(5));
  (void)import("hill.asc", "b.json", "c.json");
  EXPECT_NEAR(ground_part(place.json("c.json"), "site")["boundary"].value("height", 0.0), 33, 0.0201);
}

// A building that somebody has written by hand, with a source and no record of what was read.
TEST_F(ImportGround, ABuildingWithoutARecordOfWhatWasReadIsLiftedWhereItHasNoHeight) {
  nlohmann::json scene = place.json("scene.json");
  for (const double base : {0.0, 5.0})
    scene["nodes"].push_back(
        {{"id", base == 0 ? "low" : "high"},
         {"types",
          {{"existing_building", {{"outline", {{60, 0, 0}, {70, 0, 0}, {70, 10, 0}, {60, 10, 0}}}, {"base", base}}},
           {"imported", {{"source", "map"}, {"element", base == 0 ? "a" : "b"}}}}}});
  place.write("scene.json", scene.dump());
  (void)import("hill.asc", "scene.json", "a.json");
  EXPECT_NEAR(ground_part(place.json("a.json"), "low")["existing_building"].value("base", 0.0), 71.4, 0.05);
  EXPECT_EQ(ground_part(place.json("a.json"), "high")["existing_building"].value("base", 0.0), 5);
}

TEST_F(ImportGround, AFurtherTerrainThatNobodyFollowsIsTold) {
  (void)import("hill.asc", "scene.json", "a.json");
  place.write("other.asc", "ncols 4\nnrows 3\nxllcorner 84940\nyllcorner 446950\ncellsize 60\n1 2 3 4\n1 2 3 4\n1 2 3 4\n");
  const Outcome done = import("other.asc", "a.json", "b.json");
  EXPECT_NE(done.out.find("lies below the site `site` too, and the link `on_ground` follows another one"), std::string::npos)
      << done.out;
}

TEST_F(ImportGround, ATerrainBesideTheSiteIsTold) {
  place.write("far.asc", "ncols 3\nnrows 2\nxllcorner 85400\nyllcorner 447000\ncellsize 50\n1 2 3\n4 5 6\n");
  const Outcome done = import("far.asc", "scene.json", "a.json");
  EXPECT_NE(done.out.find("has no height anywhere on the site `site`, which stays at 0.0 m"), std::string::npos) << done.out;
}

TEST_F(ImportGround, AgainNothingChangesAndWhatPeopleDidStays) {
  (void)import("hill.asc", "scene.json", "a.json");
  (void)import("hill.asc", "a.json", "b.json");
  EXPECT_EQ(place.text("a.json"), place.text("b.json"));
  // Somebody puts the site back: it stays there, and that is told.
  ASSERT_EQ(place.run({"run", "a.json", "--ticks", "0", "--set", "site/boundary.bottom=0", "--save", "c.json"}).code, 0);
  const Outcome again = import("hill.asc", "c.json", "d.json");
  EXPECT_NE(again.out.find("warning: The ground below the site `site` lies between 67.0 and 71.0 m, the site at 0.0 m"),
            std::string::npos)
      << again.out;
  EXPECT_EQ(ground_part(place.json("d.json"), "site")["boundary"].value("bottom", 0.0), 0);
}

TEST_F(ImportGround, WhatCannotStandOnTheGroundIsAWarning) {
  ASSERT_EQ(place.run({"run", "scene.json", "--ticks", "0", "--set", "site/boundary.bottom=5", "--save", "set.json"}).code, 0);
  const Outcome set = import("hill.asc", "set.json", "a.json");
  EXPECT_NE(set.out.find("the site at 5.0 m, which somebody has set: it stays there"), std::string::npos) << set.out;
  EXPECT_EQ(ground_part(place.json("a.json"), "site")["boundary"]["bottom"], 5);
  const Outcome narrow = import("narrow.asc", "scene.json", "b.json");
  EXPECT_NE(narrow.out.find("and the terrain covers"), std::string::npos) << narrow.out;
  EXPECT_FALSE(ground_part(place.json("b.json"), "site")["boundary"].contains("bottom"));
}

TEST_F(ImportGround, RoundedVolumesAndRulesGoWithTheSite) {
  ASSERT_EQ(new_scene("rounded", "round.json").code, 0);
  ASSERT_EQ(place.run({"add", "round.json", "rules", "--height", "20"}).code, 0);
  (void)import("hill.asc", "round.json", "a.json");
  const auto scene = place.json("a.json");
  EXPECT_NEAR(ground_part(scene, "site")["plot"].value("ground", 0.0), 67, 0.0101);
  for (const auto& one : scene["nodes"])
    if (one["types"].contains("smart_volume")) {
      EXPECT_GE(one["position"][2].get<double>(), 67 - 0.0101);
      EXPECT_LE(one["position"][2].get<double>(), 67 + 25);
    }
}

}  // namespace

}  // namespace bl::test
