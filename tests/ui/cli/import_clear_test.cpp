// `import --keep-clear`: streets, rails, water and green of a file as ground that a site leaves out.
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
  EXPECT_NE(done.out.find("Of 8000 m² of the site `site`, 7100 m² remain to build on; the brief asks for 3600 m² of floor area."),
            std::string::npos)
      << done.out;
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

// City models draw streets as surfaces; a road round a block is not the block.
TEST_F(KeepClear, StreetsAndRailsOfCityModelsAreKeptClear) {
  place.write("roads.city.json", R"({"type": "CityJSON", "version": "2.0",
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/28992"},
    "transform": {"scale": [1, 1, 1], "translate": [85000, 447000, 0]},
    "vertices": [[10,10,0],[50,10,0],[50,50,0],[10,50,0], [20,20,0],[40,20,0],[40,40,0],[20,40,0],
                 [60,0,0],[70,0,0],[70,80,0],[60,80,0], [80,0,0],[84,0,0],[84,10,0],[80,10,0]],
    "CityObjects": {
      "ring": {"type": "Road", "attributes": {"function": "grass verge"}, "geometry": [{"type": "MultiSurface", "lod": "1",
        "boundaries": [[[0,1,2,3],[4,7,6,5]]]}]},
      "line": {"type": "Railway", "geometry": [{"type": "MultiSurface", "lod": "1", "boundaries": [[[8,9,10,11]]]}]},
      "ditch": {"type": "Waterway", "geometry": [{"type": "MultiSurface", "lod": "1", "boundaries": [[[12,13,14,15]]]}]}}})");
  const Outcome streets =
      place.run({"import", "roads.city.json", "--into", "scene.json", "--keep-clear", "streets", "--out", "a.json"});
  ASSERT_EQ(streets.code, 0) << streets.err;
  EXPECT_NE(streets.out.find("leaves out the ground of 1 piece of street"), std::string::npos) << streets.out;
  EXPECT_EQ(streets.out.find("No ground of"), std::string::npos) << streets.out;
  EXPECT_NEAR(ground_area("a.json"), 8000 - (40 * 40 - 20 * 20), 1e-6) << "the block inside stays";
  const Outcome all =
      place.run({"import", "roads.city.json", "--into", "scene.json", "--keep-clear", "streets,rails,water", "--out", "b.json"});
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_NEAR(ground_area("b.json"), 8000 - 1200 - 800 - 40, 1e-6);
}

// Tracks of OpenStreetMap are lines: 5 m of ground, unless they are below it.
TEST_F(KeepClear, RailwaysOfMapsAreKeptClear) {
  // Around the middle of the site, by its place on Earth: 50 m east and west of it.
  const nlohmann::json settings = place.json("scene.json")["settings"];
  const double latitude = settings.value("latitude", 0.0), longitude = settings.value("longitude", 0.0);
  const auto at = [](double degrees) { return std::to_string(degrees); };
  const auto way = [](const char* id, const std::string& tags) {
    return std::string("<way id='") + id + "'><nd ref='1'/><nd ref='2'/>" + tags + "</way>";
  };
  const std::string nodes = "<node id='1' lat='" + at(latitude) + "' lon='" + at(longitude - 0.01) + "'/><node id='2' lat='" +
                            at(latitude) + "' lon='" + at(longitude + 0.01) + "'/>";
  const auto write = [&](const std::string& tags) {
    place.write("rails.osm", "<?xml version='1.0'?><osm version='0.6'>" + nodes + way("7", tags) + "</osm>");
  };
  const auto import = [&](const std::string& out) {
    return place.run({"import", "rails.osm", "--into", "scene.json", "--keep-clear", "rails", "--force", "--out", out});
  };
  write("<tag k='railway' v='rail'/>");
  const Outcome rail = import("a.json");
  ASSERT_EQ(rail.code, 0) << rail.err;
  EXPECT_NE(rail.out.find("leaves out the ground of 1 piece of railway"), std::string::npos) << rail.out;
  EXPECT_NEAR(8000 - ground_area("a.json"), 100 * 5, 2) << "across the whole site, which lies a little askew";
  write("<tag k='railway' v='rail'/><tag k='tunnel' v='yes'/>");
  const Outcome below = import("b.json");
  EXPECT_EQ(below.out.find("piece of railway"), std::string::npos) << below.out;
}

TEST_F(KeepClear, WhatWasAskedForAndIsNotThereIsAWarning) {
  const Outcome none =
      place.run({"import", "streets.geojson", "--into", "scene.json", "--keep-clear", "streets,rails", "--out", "a.json"});
  ASSERT_EQ(none.code, 0) << none.err;
  EXPECT_NE(none.out.find("warning: No ground of `rails` is kept clear, although that was asked for: the files hold none."),
            std::string::npos)
      << none.out;
  EXPECT_EQ(none.out.find("No ground of `streets`"), std::string::npos) << none.out;
  place.write("away.geojson",
              ground_file(ground_feature("[86000,447000],[86100,447000],[86100,447080],[86000,447080],[86000,447000]",
                                         R"("gid": "lake", "natural": "water")")));
  const Outcome away = place.run(
      {"import", "away.geojson", "--as", "area", "--into", "scene.json", "--keep-clear", "water", "--force", "--out", "b.json"});
  EXPECT_NE(away.out.find("No ground of `water` is kept clear, although that was asked for: of 1 in the files none reaches"),
            std::string::npos)
      << away.out;
}

// The pit of a tree is no reason for a hole in a house.
TEST_F(KeepClear, SmallGreenIsBuiltOver) {
  const auto lawn = [](const char* id, int x, int size) {
    const auto corner = [&](int dx, int dy) {
      return "[" + std::to_string(85000 + x + dx) + "," + std::to_string(447000 + dy) + "]";
    };
    return ground_feature(
        corner(0, 0) + "," + corner(size, 0) + "," + corner(size, size) + "," + corner(0, size) + "," + corner(0, 0),
        std::string(R"("landuse": "grass", "gid": ")") + id + "\"");
  };
  place.write("green.geojson", ground_file(lawn("pit", 10, 2) + "," + lawn("tree", 20, 3) + "," + lawn("lawn", 30, 10)));
  const auto import = [&](std::vector<std::string> more, const std::string& out) {
    more.insert(more.begin(),
                {"import", "green.geojson", "--as", "area", "--into", "scene.json", "--keep-clear", "green", "--out", out});
    return place.run(more);
  };
  const Outcome plain = import({}, "a.json");
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_NE(plain.out.find("does not leave out 2 areas of green with less than 10 m² of ground each (--least-green)"),
            std::string::npos)
      << plain.out;
  EXPECT_NEAR(ground_area("a.json"), 8000 - 100, 1e-6);
  ASSERT_EQ(import({"--least-green", "0"}, "b.json").code, 0);
  EXPECT_NEAR(ground_area("b.json"), 8000 - 100 - 4 - 9, 1e-6);
  const Outcome none = import({"--least-green", "200"}, "c.json");
  EXPECT_NE(none.out.find("what reaches into a site is smaller than 200 m²"), std::string::npos) << none.out;
  EXPECT_EQ(import({"--least-green=-1"}, "d.json").code, 2);
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
