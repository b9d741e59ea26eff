// `import` of a terrain below a site: the site and its volumes stand on it, once; and what is told where they cannot.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// A plane that rises to the east: 67 m at the western border of the site, 71 m at the eastern one.
std::string plane_rows(int columns) {
  std::string text = "ncols " + std::to_string(columns) + "\nnrows 5\nxllcorner 84950\nyllcorner 446940\ncellsize 50\n";
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < columns; ++column) text += std::to_string(66 + 2 * column) + " ";
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
  EXPECT_NE(done.out.find("now, its lowest ground, instead of 0 m, and keeps its height of 25 m"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("The link `on_ground` sets all volumes"), std::string::npos) << done.out;
  const nlohmann::json boundary = ground_part(place.json("a.json"), "site")["boundary"];
  EXPECT_NEAR(boundary.value("bottom", 0.0), 67, 0.0101);
  EXPECT_EQ(boundary["height"], 25);
  ASSERT_FALSE(boundary["exclusions"].empty()) << "the garden";
  EXPECT_NEAR(boundary["exclusions"][0].value("bottom", 0.0), 67, 0.0101) << "open over the whole height, as before";
  EXPECT_NEAR(boundary["exclusions"][0].value("top", 0.0), 67 + 25, 0.0101);
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
