// `import --keep-clear`: streets, water and green of a file as ground that a site leaves out.
#include <gtest/gtest.h>

#include "core/making/site_grounds.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

std::string ground_feature(const std::string& ring, const std::string& properties) {
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": "Polygon", "coordinates": [[)" +
         ring + "]]}}";
}
std::string ground_file(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" +
         features + "]}";
}

class KeepClear : public testing::Test {
 protected:
  KeepClear() {
    place.write("site.geojson",
                ground_file(ground_feature("[85000,447000],[85100,447000],[85100,447080],[85000,447080],[85000,447000]", "")));
    place.write("brief.csv", "use,floor_area_m2,count\nhousing,1200,3\n");
    place.write("streets.geojson",
                ground_file(R"({"type": "Feature", "properties": {"gid": "main", "highway": "residential", "width": 10},
      "geometry": {"type": "LineString", "coordinates": [[84950,447040],[85050,447040],[85050,447150]]}})"));
    place.write("ground.geojson",
                ground_file(ground_feature("[85080,447000],[85100,447000],[85100,447020],[85080,447020],[85080,447000]",
                                           R"("gid": "pond", "natural": "water")") +
                            "," +
                            ground_feature("[85000,447000],[85010,447000],[85010,447010],[85000,447010],[85000,447000]",
                                           R"("gid": "lawn", "landuse": "grass")") +
                            "," +
                            ground_feature("[84000,446000],[86000,446000],[86000,448000],[84000,448000],[84000,446000]",
                                           R"("gid": "polder", "landuse": "meadow")")));
    EXPECT_EQ(
        place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--out", "scene.json"})
            .code,
        0);
  }
  double ground_area(const std::string& scene) {
    const Outcome run = place.run({"run", scene, "--ticks", "2", "--save", "after.json"});
    EXPECT_EQ(run.code, 0) << run.err;
    return place.json("after.json")["state"]["nodes"]["site"].value("boundary.ground_area", 0.0);
  }
  Workplace place;
};

TEST_F(KeepClear, StreetsTakeTheirWidthOutOfTheSite) {
  const Outcome done =
      place.run({"import", "streets.geojson", "--into", "scene.json", "--keep-clear", "streets", "--out", "a.json"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("The site `site` leaves out the ground of 1 piece of street"), std::string::npos) << done.out;
  // 55 m from the west, and 35 m up from there: the corner counts once.
  EXPECT_NEAR(ground_area("a.json"), 8000 - 55 * 10 - 35 * 10, 1e-6);
  ASSERT_EQ(place.run({"import", "streets.geojson", "--into", "a.json", "--keep-clear", "streets", "--out", "b.json"}).code, 0);
  EXPECT_EQ(place.text("a.json"), place.text("b.json")) << "again changes nothing";
  EXPECT_EQ(place.run({"run", "b.json"}).code, 0) << "volumes settle beside the street";
}

TEST_F(KeepClear, WaterAndGreenAreLeftOutAndWhatTheSiteLiesInIsNot) {
  const Outcome done = place.run({"import", "ground.geojson", "--as", "area", "--into", "scene.json", "--keep-clear",
                                  "water,green", "--out", "a.json", "--report", "rows.csv"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("1 area of green, 1 area of water"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("`green polder` covers 100 % of the site `site`, and the site keeps that ground"), std::string::npos)
      << done.out;
  EXPECT_NEAR(ground_area("a.json"), 8000 - 400 - 100, 1e-6);
  EXPECT_NE(place.text("rows.csv").find("the site `site` leaves its ground out"), std::string::npos) << place.text("rows.csv");
}

std::string square_ring(int west, int south, int width, int depth) {
  const std::string w = std::to_string(85000 + west), e = std::to_string(85000 + west + width);
  const std::string s = std::to_string(447000 + south), n = std::to_string(447000 + south + depth);
  return "[" + w + "," + s + "],[" + e + "," + s + "],[" + e + "," + n + "],[" + w + "," + n + "],[" + w + "," + s + "]";
}

// An element is that of its source: the same id elsewhere is another one.
TEST_F(KeepClear, EqualIdsDoNotWipeOutEachOther) {
  const auto green = [](const std::string& ring) { return ground_feature(ring, R"("gid": 7, "landuse": "grass")"); };
  place.write("parks.geojson", ground_file(green(square_ring(0, 0, 10, 10)) + "," + green(square_ring(40, 0, 10, 10))));
  place.write("forests.geojson", ground_file(green(square_ring(60, 0, 20, 10))));
  place.write("later.geojson", ground_file(green(square_ring(0, 60, 20, 20))));
  const auto import = [&](std::vector<std::string> files, const std::string& into, const std::string& out) {
    files.insert(files.begin(), "import");
    files.insert(files.end(), {"--as", "area", "--keep-clear", "green", "--into", into, "--out", out});
    const Outcome done = place.run(files);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.out;
  };
  const std::string said = import({"parks.geojson", "forests.geojson"}, "scene.json", "a.json");
  EXPECT_NE(said.find("leaves out the ground of 3 areas of green"), std::string::npos) << said;
  EXPECT_NEAR(ground_area("a.json"), 8000 - 100 - 100 - 200, 1e-6);
  (void)import({"later.geojson"}, "a.json", "b.json");
  EXPECT_NEAR(ground_area("b.json"), 8000 - 100 - 100 - 200 - 400, 1e-6);
  (void)import({"parks.geojson", "forests.geojson"}, "b.json", "c.json");
  EXPECT_NEAR(ground_area("c.json"), 8000 - 100 - 100 - 200 - 400, 1e-6);
  (void)import({"parks.geojson", "forests.geojson"}, "a.json", "d.json");
  EXPECT_EQ(place.text("a.json"), place.text("d.json")) << "again changes nothing";
  // Of one source by name, as people write it.
  (void)import({"parks.geojson", "forests.geojson", "--source", "City"}, "scene.json", "e.json");
  EXPECT_NEAR(ground_area("e.json"), 8000 - 100 - 100 - 200, 1e-6);
}

// What moved away gives its ground back, also where nobody asks again what is kept clear; what left the file is named.
TEST_F(KeepClear, GroundThatMovedAwayIsGivenBack) {
  const auto lawn = [](const std::string& id, int west) {
    return ground_feature(square_ring(west, 0, 10, 10), R"("gid": ")" + id + R"(", "landuse": "grass")");
  };
  place.write("ground.geojson", ground_file(lawn("a", 0) + "," + lawn("b", 40)));
  ASSERT_EQ(
      place.run({"import", "ground.geojson", "--as", "area", "--into", "scene.json", "--keep-clear", "green", "--out", "a.json"})
          .code,
      0);
  EXPECT_NEAR(ground_area("a.json"), 8000 - 200, 1e-6);
  place.write("ground.geojson", ground_file(lawn("a", 500) + "," + lawn("b", 40)));
  const Outcome moved = place.run({"import", "ground.geojson", "--as", "area", "--into", "a.json", "--out", "b.json"});
  ASSERT_EQ(moved.code, 0) << moved.err;
  EXPECT_NE(moved.out.find("The site `site` leaves out the ground of 1 area of green no longer: it does not reach into the site"),
            std::string::npos)
      << moved.out;
  EXPECT_NEAR(ground_area("b.json"), 8000 - 100, 1e-6);
  place.write("ground.geojson", ground_file(lawn("a", 500)));
  const Outcome gone = place.run({"import", "ground.geojson", "--as", "area", "--into", "b.json", "--out", "c.json"});
  ASSERT_EQ(gone.code, 0) << gone.err;
  EXPECT_NE(gone.out.find("The site `site` still leaves out what this import does not bring any more"), std::string::npos)
      << gone.out;
  EXPECT_NE(gone.out.find("`green b of ground.geojson`"), std::string::npos) << gone.out;
  EXPECT_NEAR(ground_area("c.json"), 8000 - 100, 1e-6);
}

TEST_F(KeepClear, WrongWordsAndScenesWithoutASiteAreTold) {
  EXPECT_EQ(place.run({"import", "streets.geojson", "--keep-clear", "trees", "--out", "a.json"}).code, 2);
  const Outcome done = place.run({"import", "streets.geojson", "--keep-clear", "streets", "--out", "a.json"});
  EXPECT_EQ(done.code, 0);
  EXPECT_NE(done.out.find("The scene has no site, so that nothing is kept clear"), std::string::npos) << done.out;
}

TEST(StreetGround, BendsThatAreTooSharpAreCutIntoPieces) {
  importing::ContextStreet street;
  street.width = 6;
  street.line = {{0, 0, 0}, {50, 0, 0}, {0, 3, 0}};
  EXPECT_EQ(making::street_ground(street).size(), 2u);
  street.line = {{0, 0, 0}, {50, 0, 0}, {50, 50, 0}};
  const auto rings = making::street_ground(street);
  ASSERT_EQ(rings.size(), 1u);
  EXPECT_NEAR(geometry::signed_area(rings[0]), 600, 1e-9);
  street.line = {{0, 0, 0}, {0, 0, 5}};
  EXPECT_TRUE(making::street_ground(street).empty()) << "no length in plan";
}

}  // namespace

}  // namespace bl::test
