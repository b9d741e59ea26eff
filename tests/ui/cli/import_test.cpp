// `import`: surroundings of several formats in one scene that runs, and what it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "core/base/random.h"
#include "tests/support/reference_files.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

constexpr const char* kHouses =
    R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
  {"type": "Feature", "properties": {"gid": 1, "height": 12, "use": "school"}, "geometry": {"type": "Polygon", "coordinates": [[[85000, 447000], [85020, 447000], [85020, 447010], [85000, 447010], [85000, 447000]]]}},
  {"type": "Feature", "properties": {"gid": 2}, "geometry": {"type": "Polygon", "coordinates": [[[85030, 447000], [85040, 447010], [85040, 447000], [85030, 447010], [85030, 447000]]]}}]})";
constexpr const char* kPlot = R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
  "coordinates": [[[85000, 447020], [85040, 447020], [85040, 447060], [85000, 447060], [85000, 447020]]]})";

nlohmann::json node(const nlohmann::json& scene, const std::string& id) {
  for (const auto& one : scene["nodes"])
    if (one["id"] == id) return one;
  return {};
}

class Import : public testing::Test {
 protected:
  Import() {
    place.write("houses.geojson", kHouses);
    place.write("plot.geojson", kPlot);
    place.write("heights.asc",
                "ncols 3\nnrows 2\nxllcorner 84990\nyllcorner 446990\ncellsize 50\nNODATA_value -9999\n1 2 3\n4 5 -9999\n");
    place.write("noise.csv", "x,y,level\n85000,447000,55\n85040,447040,65\n");
  }
  Workplace place;
};

TEST_F(Import, BringsBuildingsIntoASceneWithTheirPlace) {
  const Outcome done = place.run({"import", "houses.geojson", "--out", "scene.json", "--report", "rows.csv"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("1 taken, 0 repaired, 1 skipped of 2 elements"), std::string::npos) << done.out;
  const nlohmann::json scene = place.json("scene.json");
  EXPECT_EQ(scene["settings"]["coordinate_system"], "EPSG:28992");
  const nlohmann::json house = node(scene, "building_1");
  ASSERT_FALSE(house.is_null());
  EXPECT_EQ(house["types"]["existing_building"]["height"], 12);
  EXPECT_EQ(house["types"]["existing_building"]["height_source"], "tag");
  EXPECT_EQ(house["types"]["existing_building"]["origin"], "1 of houses.geojson");
  EXPECT_NE(
      place.text("rows.csv").find("houses.geojson,skipped,feature,features/1,building: its outline crosses or touches itself"),
      std::string::npos)
      << place.text("rows.csv");
  EXPECT_EQ(place.run({"check", "scene.json"}).code, 0);
  EXPECT_EQ(place.run({"run", "scene.json"}).code, 0);
}

TEST_F(Import, SeveralFilesShareOneFrame) {
  const Outcome houses = place.run({"import", "houses.geojson", "--out", "a.json"});
  ASSERT_EQ(houses.code, 0) << houses.err;
  const Outcome plot = place.run({"import", "plot.geojson", "--as", "plot", "--into", "a.json", "--out", "b.json"});
  ASSERT_EQ(plot.code, 0) << plot.err;
  const Outcome rest = place.run({"import", "heights.asc", "noise.csv", "--crs", "EPSG:28992", "--into", "b.json", "--out",
                                  "c.json", "--unit", "dB", "--licence", "CC0"});
  ASSERT_EQ(rest.code, 0) << rest.err;
  const nlohmann::json scene = place.json("c.json");
  ASSERT_EQ(scene["nodes"].size(), 4u);
  const auto outline = node(scene, "building_1")["types"]["existing_building"]["outline"];
  nlohmann::json polygon;
  for (const auto& one : scene["nodes"])
    if (one["id"].get<std::string>().starts_with("plot_geo_")) polygon = one["types"]["plot"]["polygon"];
  ASSERT_FALSE(polygon.is_null()) << "a feature without an id is called by its geometry";
  EXPECT_NEAR(polygon[0][1].get<double>() - outline[0][1].get<double>(), 20, 1e-9) << "20 m north of the house";
  const nlohmann::json ground = node(scene, "terrain")["types"]["terrain"];
  EXPECT_EQ(ground["rows"].size(), 2u);
  EXPECT_NEAR(ground["west"].get<double>() - outline[0][0].get<double>(), 84990 + 25 - 85000, 1e-9);
  const nlohmann::json layer = node(scene, "layer_level")["types"]["data_layer"];
  EXPECT_EQ(layer["values"].size(), 2u);
  EXPECT_EQ(layer["unit"], "dB");
  EXPECT_EQ(layer["licence"], "CC0");
  const Outcome run = place.run({"run", "c.json"});
  EXPECT_EQ(run.code, 0) << run.out << run.err;
  // Another file has other houses under the same ids.
  std::string others = kHouses;
  for (std::size_t at = 0; (at = others.find("447", at)) != std::string::npos; at += 3) others.replace(at, 3, "448");
  place.write("others.geojson", others);
  const Outcome again = place.run({"import", "others.geojson", "--into", "c.json", "--out", "d.json"});
  EXPECT_EQ(again.code, 0);
  EXPECT_FALSE(node(place.json("d.json"), "building_1_2").is_null()) << "an id that is taken gets a number";
}

// A crossing at node 5 with arms to the west (4), east (6), south (2) and north (8), and a way round from 6 by 9 to 8.
std::string crossing_map(const std::string& rules) {
  std::string text = R"(<osm version="0.6">)";
  const char* const places[][3] = {{"2", "59.999", "25.001"}, {"4", "60", "25"},         {"5", "60", "25.001"},
                                   {"6", "60", "25.003"},     {"8", "60.001", "25.001"}, {"9", "60.001", "25.003"}};
  for (const auto& [id, latitude, longitude] : places)
    text += std::string(R"(<node id=")") + id + R"(" lat=")" + latitude + R"(" lon=")" + longitude + R"("/>)";
  const char* const ways[][3] = {{"10", "4", "5"}, {"11", "5", "6"}, {"12", "5", "8"},
                                 {"13", "2", "5"}, {"14", "6", "9"}, {"15", "9", "8"}};
  for (const auto& [id, from, to] : ways)
    text += std::string(R"(<way id=")") + id + R"("><nd ref=")" + from + R"("/><nd ref=")" + to +
            R"("/><tag k="highway" v="residential"/></way>)";
  return text + rules + "</osm>";
}
std::string rule(const char* id, const char* from, const char* via, const char* to, const char* what) {
  return std::string(R"(<relation id=")") + id + R"("><member type="way" ref=")" + from +
         R"(" role="from"/><member type="node" ref=")" + via + R"(" role="via"/><member type="way" ref=")" + to +
         R"(" role="to"/><tag k="type" v="restriction"/><tag k="restriction" v=")" + what + R"("/></relation>)";
}

TEST_F(Import, TurnRestrictionsAreObeyed) {
  const auto flow = [&](const std::string& rules, const std::string& street) {
    place.write("map.osm", crossing_map(rules));
    EXPECT_EQ(place.run({"import", "map.osm", "--out", "streets.json", "--force"}).code, 0);
    nlohmann::json scene = place.json("streets.json");
    for (auto& one : scene["nodes"]) {
      if (one["id"] == "junction_n4") one["types"]["traffic_zone"] = {{"trips_out", 100}};
      if (one["id"] == "junction_n8") one["types"]["traffic_zone"] = {{"trips_in", 100}};
    }
    scene["nodes"].push_back({{"id", "network"}, {"types", {{"traffic_network", nlohmann::json::object()}}}});
    place.write("town.json", scene.dump());
    const Outcome run = place.run({"run", "town.json", "--save", "after.json"});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    return place.json("after.json")["state"]["nodes"][street].value("street.flow_forth", 0.0);
  };
  EXPECT_NEAR(flow("", "street_w12_0"), 100, 1e-6) << "straight to the left";
  EXPECT_EQ(flow(rule("1", "10", "5", "12", "no_left_turn"), "street_w14_0"), 0) << "turning round in the east is shorter";
  const std::string no_return = rule("2", "11", "6", "11", "no_u_turn"), south = rule("3", "13", "2", "13", "no_u_turn");
  EXPECT_NEAR(flow(rule("1", "10", "5", "12", "no_left_turn") + no_return + south, "street_w14_0"), 100, 1e-6);
  EXPECT_NEAR(flow(rule("1", "10", "5", "11", "only_straight_on") + no_return, "street_w14_0"), 100, 1e-6);
  const nlohmann::json rows = node(place.json("streets.json"), "junction_n5")["types"]["turn_rules"]["turns"];
  EXPECT_EQ(rows.dump(), R"([{"from":"street_w10_0","rule":"only","to":"street_w11_0"}])");
  EXPECT_EQ(node(place.json("streets.json"), "junction_n8")["types"].count("turn_rules"), 0u);
}

TEST_F(Import, TurnRestrictionsOfStreetsThatBecameNoNodesAreNamed) {
  std::string map = crossing_map(rule("1", "10", "5", "12", "no_left_turn"));
  map.replace(map.find(R"(v="residential"/></way><way id="13")"), 15, R"(v="pedestrian")");
  place.write("map.osm", map);
  const Outcome done = place.run({"import", "map.osm", "--out", "streets.json", "--report", "report.csv"});
  EXPECT_EQ(done.code, 0) << done.err;
  // In the account it is nothing that was taken.
  EXPECT_NE(place.text("report.csv")
                .find("skipped,relation,r1,turn restriction: one of its streets became no node,`w12/0` became no node"),
            std::string::npos)
      << place.text("report.csv");
  EXPECT_NE(done.out.find("Turn restriction `r1` (no_left_turn) became nothing: `w12/0` became no node."), std::string::npos)
      << done.out;
}

// A rule for several streets is taken where it holds for one of them; what became of it lies at its junction.
TEST_F(Import, TurnRestrictionsThatHoldNameTheirJunction) {
  std::string map =
      crossing_map(R"(<relation id="1"><member type="way" ref="12" role="from"/><member type="way" ref="13" role="from"/>)"
                   R"(<member type="node" ref="5" role="via"/><member type="way" ref="11" role="to"/>)"
                   R"(<tag k="type" v="restriction"/><tag k="restriction" v="no_entry"/></relation>)");
  map.replace(map.find(R"(v="residential"/></way><way id="13")"), 15, R"(v="pedestrian")");
  place.write("map.osm", map);
  EXPECT_EQ(place.run({"import", "map.osm", "--out", "streets.json", "--report", "report.csv"}).code, 0);
  const std::string report = place.text("report.csv");
  const std::size_t row = report.find(",taken,relation,r1,turn restriction,");
  ASSERT_NE(row, std::string::npos) << report;
  const std::string line = report.substr(row, report.find_first_of("\r\n", row) - row);
  EXPECT_TRUE(line.ends_with(",junction_n5")) << line;
  EXPECT_EQ(node(place.json("streets.json"), "junction_n5")["types"]["turn_rules"]["turns"].size(), 1u);
}

TEST_F(Import, RefusesWithASentenceAndWritesNothing) {
  place.write("noise.osm", "noise \x01\x02");
  place.write("empty.geojson", "");
  place.write("there.json", "x");
  const auto refused = [&](std::vector<std::string> arguments, const std::string& said) {
    arguments.insert(arguments.begin(), "import");
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 2) << said;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(place.path("out.json")));
  };
  refused({"noise.osm", "--out", "out.json"}, "noise.osm: byte 0: This is no OpenStreetMap file");
  refused({"empty.geojson", "--out", "out.json"}, "empty.geojson");
  refused({"missing.osm", "--out", "out.json"}, "missing.osm");
  refused({"heights.asc", "--out", "out.json"}, "heights.asc: crs: The file does not say in which CRS");
  refused({"houses.geojson", "--crs", "EPSG:1", "--out", "out.json"}, "crs");
  refused({"houses.geojson", "--origin", "here", "--out", "out.json"}, "expects two numbers");
  refused({"houses.geojson", "noise.osm", "--out", "out.json"}, "noise.osm");
  refused({"houses.geojson", "--out", "there.json"}, "exists already");
  refused({"houses.geojson", "--into", "noise.osm", "--out", "out.json"}, "noise.osm");
  place.write("scene.json", moving_scene());
  refused({"scene.json", "--out", "out.json"},
          "this is a scene of BehaviourLinks; the scene that is added to is named by --into");
  EXPECT_EQ(place.text("there.json"), "x");
}

// What is something else than its name says is told in words, with none of its bytes.
TEST_F(Import, NoiseIsToldByWhatItIsNot) {
  Random random(8);
  std::string noise = "\x07";
  while (noise.size() < 4096) noise += static_cast<char>(random.below(256));
  struct Case {
    const char *name, *said;
  };
  for (const auto& [name, said] : {Case{"n.tif", "This is no GeoTIFF but binary data"},
                                   {"n.asc", "This is no ASCII grid but binary data"},
                                   {"n.geojson", "This is no GeoJSON but binary data"},
                                   {"n.osm", "This is no OpenStreetMap file but binary data"},
                                   {"n.pbf", "This is no OpenStreetMap file but binary data"},
                                   {"n.csv", "This is no CSV table but binary data"},
                                   {"n.city.json", "This is no CityJSON but binary data"},
                                   {"n.dat", "This is no file that is read but binary data"}}) {
    place.write(name, noise);
    const Outcome outcome = place.run({"import", name, "--out", "out.json"});
    EXPECT_EQ(outcome.code, 2) << name;
    EXPECT_TRUE(outcome.err.starts_with(std::string(name) + ": byte 0: " + said)) << outcome.err;
    EXPECT_EQ(outcome.err.find('\\'), std::string::npos) << outcome.err;
    EXPECT_LT(outcome.err.size(), 200u) << outcome.err;
  }
  place.write("p.tif", "\x89PNG\r\n\x1a\n and more");
  EXPECT_NE(place.run({"import", "p.tif", "--out", "out.json"}).err.find("no GeoTIFF but a picture (PNG)"), std::string::npos);
  place.write("t.tif", "x,y,z\n1,2,3\n");
  EXPECT_NE(place.run({"import", "t.tif", "--out", "out.json"}).err.find("no GeoTIFF but text"), std::string::npos);
}

TEST_F(Import, WhatTakesNothingIsSaid) {
  const Outcome far = place.run({"import", "houses.geojson", "--origin", "447000,85000", "--radius", "50", "--out", "out.json"});
  EXPECT_EQ(far.code, 2) << far.out;
  EXPECT_NE(far.err.find("nothing of the files was taken, and nothing was written"), std::string::npos) << far.err;
  EXPECT_FALSE(std::filesystem::exists(place.path("out.json")));
  ASSERT_EQ(place.run({"import", "houses.geojson", "--out", "a.json"}).code, 0);
  const std::string there =
      R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
    {"type": "Feature", "properties": {"gid": 9}, "geometry": {"type": "Polygon",
     "coordinates": [[[185000, 447000], [185020, 447000], [185020, 447010], [185000, 447010], [185000, 447000]]]}}]})";
  place.write("there.geojson", there);
  const Outcome into = place.run({"import", "there.geojson", "--into", "a.json", "--out", "b.json", "--radius", "500"});
  EXPECT_EQ(into.code, 2) << into.out;
  EXPECT_EQ(into.err.find("batch"), std::string::npos) << into.err;
  EXPECT_NE(into.err.find("nothing of the files was taken"), std::string::npos) << into.err;
  const Outcome both = place.run({"import", "houses.geojson", "there.geojson", "--radius", "500", "--out", "c.json"});
  EXPECT_EQ(both.code, 0) << both.err;
  EXPECT_NE(both.out.find("there.geojson: nothing of this file was taken"), std::string::npos) << both.out;
}

TEST_F(Import, RealCityModelsBecomeScenes) {
  const auto village = shared_file("data/osm/small_village.osm"),
             city = shared_file("data/cityjson/denhaag_DH01_subset_v11.city.json");
  if (village.empty() || city.empty()) {
    std::printf("the shared data are not beside this checkout: no real files are read here\n");
    return;
  }
  const Outcome osm = place.run({"import", village.string(), "--out", "village.json"});
  ASSERT_EQ(osm.code, 0) << osm.err;
  EXPECT_NE(osm.out.find("of 340 elements"), std::string::npos) << osm.out;
  EXPECT_EQ(place.run({"run", "village.json"}).code, 0);
  const Outcome model = place.run({"import", city.string(), "--crs", "EPSG:28992", "--out", "city.json"});
  ASSERT_EQ(model.code, 0) << model.err;
  const nlohmann::json scene = place.json("city.json");
  EXPECT_EQ(std::count_if(scene["nodes"].begin(), scene["nodes"].end(),
                          [](const auto& one) { return one["types"]["existing_building"]["form"] == "mesh"; }),
            9);
  EXPECT_EQ(place.run({"run", "city.json"}).code, 0);
}

}  // namespace

}  // namespace bl::test
