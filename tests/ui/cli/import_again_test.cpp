// `import` of a file that was imported before: nothing is doubled, what the file changed comes in, what people changed stays.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

constexpr const char* kSmallMap = R"(<osm version="0.6">
  <node id="1" lat="52" lon="5"/><node id="2" lat="52" lon="5.0002"/><node id="3" lat="52.0001" lon="5.0002"/><node id="4" lat="52.0001" lon="5"/>
  <node id="5" lat="52.001" lon="5"/><node id="6" lat="52.001" lon="5.001"/><node id="7" lat="52.001" lon="5.002"/>
  <way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="building" v="yes"/><tag k="height" v="9"/></way>
  <way id="2"><nd ref="5"/><nd ref="6"/><nd ref="7"/><tag k="highway" v="residential"/></way></osm>)";

std::string plots_file(int east, const std::string& more = "") {
  const std::string e = std::to_string(85000 + east);
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [
    {"type": "Feature", "properties": {"gid": "a"}, "geometry": {"type": "Polygon", "coordinates": [[[85000, 447000], [)" +
         e + ", 447000], [" + e + R"(, 447040], [85000, 447040], [85000, 447000]]]}})" + more + "]}";
}

nlohmann::json imported_node(const nlohmann::json& scene, const std::string& id) {
  for (const auto& one : scene["nodes"])
    if (one["id"] == id) return one;
  return {};
}

class ImportAgain : public testing::Test {
 protected:
  Outcome import(const std::string& file, const std::string& into, const std::string& out, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"import", file, "--out", out, "--force"};
    if (!into.empty()) arguments.insert(arguments.end(), {"--into", into});
    arguments.insert(arguments.end(), more.begin(), more.end());
    Outcome done = place.run(arguments);
    EXPECT_EQ(done.code, 0) << done.err;
    return done;
  }
  static void expect_said(const Outcome& done, const std::string& words) {
    EXPECT_NE(done.out.find(words), std::string::npos) << words << "\n" << done.out;
  }
  Workplace place;
};

TEST_F(ImportAgain, DoublesNothing) {
  place.write("map.osm", kSmallMap);
  place.write("plots.geojson", plots_file(40));
  place.write("heights.asc", "ncols 2\nnrows 2\nxllcorner 4.999\nyllcorner 51.999\ncellsize 0.002\n1 2\n3 4\n");
  place.write("noise.csv", "x,y,level\n5,52,55\n5.001,52.001,65\n");
  const std::vector<std::string> wgs{"--crs", "EPSG:4326"};
  (void)import("map.osm", "", "a.json");
  (void)import("heights.asc", "a.json", "a.json", wgs);
  (void)import("noise.csv", "a.json", "a.json", wgs);
  const std::string once = place.text("a.json");
  const Outcome map = import("map.osm", "a.json", "b.json");
  expect_said(map,
              "map.osm was imported before, and nothing is doubled: 0 new, 0 updated, 4 unchanged, 0 changed by people, 0 gone.");
  (void)import("heights.asc", "b.json", "b.json", wgs);
  expect_said(import("noise.csv", "b.json", "b.json", wgs), "0 new, 0 updated, 1 unchanged");
  EXPECT_EQ(place.text("b.json"), once) << "not a byte differs";
  // Ids of OpenStreetMap hold beyond a file: another extract of the same town brings the rest, and the
  // building says where it comes from now.
  place.write("town.osm", kSmallMap);
  expect_said(import("town.osm", "b.json", "c.json"), "0 new, 1 updated, 3 unchanged");
  EXPECT_EQ(place.json("c.json")["nodes"].size(), place.json("a.json")["nodes"].size());
  (void)import("plots.geojson", "", "p.json", {"--as", "plot"});
  (void)import("plots.geojson", "p.json", "q.json", {"--as", "plot"});
  EXPECT_EQ(place.text("p.json"), place.text("q.json"));
}

TEST_F(ImportAgain, TakesWhatTheFileChangedAndKeepsWhatPeopleChanged) {
  const auto square = [](const std::string& id, int west) {
    const std::string w = std::to_string(85000 + west), e = std::to_string(85010 + west);
    return R"(, {"type": "Feature", "properties": {"gid": ")" + id + R"("}, "geometry": {"type": "Polygon", "coordinates": [[[)" +
           w + ", 447100], [" + e + ", 447100], [" + e + ", 447110], [" + w + ", 447110], [" + w + ", 447100]]]}}";
  };
  place.write("plots.geojson", plots_file(40, square("b", 0) + square("c", 50) + square("d", 100)));
  (void)import("plots.geojson", "", "a.json", {"--as", "plot"});
  nlohmann::json scene = place.json("a.json");
  for (auto& one : scene["nodes"])
    if (one["id"] == "plot_b" || one["id"] == "plot_a") one["types"]["plot"]["fsi_max"] = 2.5;
  place.write("a.json", scene.dump());
  // a: by both; b: by people; c: by the file; d: has left the file; e: is new.
  place.write("plots.geojson", plots_file(44, square("b", 0) + square("c", 52) + square("e", 150)));
  const Outcome again = import("plots.geojson", "a.json", "b.json", {"--as", "plot"});
  expect_said(again, "1 new, 1 updated, 0 unchanged, 2 changed by people, 1 gone.");
  expect_said(again, "something else of `plot_a`");
  expect_said(again, "or people have removed it, which no import knows): `plot_e`.");
  expect_said(again, "It stays in the scene: `plot_d`.");
  scene = place.json("b.json");
  EXPECT_EQ(scene["nodes"].size(), 5u);
  EXPECT_EQ(imported_node(scene, "plot_a")["types"]["plot"], imported_node(place.json("a.json"), "plot_a")["types"]["plot"]);
  EXPECT_EQ(imported_node(scene, "plot_b")["types"]["plot"]["fsi_max"], 2.5);
  EXPECT_NE(imported_node(scene, "plot_c")["types"]["plot"], imported_node(place.json("a.json"), "plot_c")["types"]["plot"]);
  EXPECT_EQ(place.run({"check", "b.json"}).code, 0);
  // The next time c is as the file has it, and a is still told.
  expect_said(import("plots.geojson", "b.json", "c.json", {"--as", "plot"}),
              "0 new, 0 updated, 2 unchanged, 2 changed by people, 1 gone.");
}

TEST_F(ImportAgain, ScenesOfBeforeTheRecordKnowTheirNodesByIdAndPlace) {
  place.write("plots.geojson", plots_file(40));
  (void)import("plots.geojson", "", "a.json", {"--as", "plot"});
  nlohmann::json scene = place.json("a.json");
  for (auto& one : scene["nodes"]) one["types"].erase("imported");
  place.write("old.json", scene.dump());
  expect_said(import("plots.geojson", "old.json", "b.json", {"--as", "plot"}), "0 new, 0 updated, 1 unchanged");
  EXPECT_EQ(place.text("b.json"), place.text("a.json"));
}

TEST_F(ImportAgain, ASiteLeavesOutTheGroundOfABuildingOnce) {
  place.write(
      "site.geojson",
      R"({"type": "Polygon", "coordinates": [[[4.999,51.999],[5.001,51.999],[5.001,52.0005],[4.999,52.0005],[4.999,51.999]]]})");
  place.write("brief.csv", "use,floor_area_m2,count\nhousing,1200,2\n");
  place.write("map.osm", kSmallMap);
  ASSERT_EQ(
      place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--out", "s.json"}).code, 0);
  (void)import("map.osm", "s.json", "a.json", {"--keep"});
  ASSERT_EQ(imported_node(place.json("a.json"), "site")["types"]["boundary"]["exclusions"].size(), 4u);
  (void)import("map.osm", "a.json", "b.json", {"--keep"});
  EXPECT_EQ(place.text("b.json"), place.text("a.json"));
  std::string taller = kSmallMap;
  taller.replace(taller.find("\"9\""), 3, "\"12\"");
  place.write("map.osm", taller);
  (void)import("map.osm", "b.json", "c.json", {"--keep"});
  const nlohmann::json rows = imported_node(place.json("c.json"), "site")["types"]["boundary"]["exclusions"];
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0]["top"], 12);
  // Where it does not stand in the site any more, nothing is left out for it.
  for (std::size_t at = 0; (at = taller.find("lat=\"52\"", at)) != std::string::npos;) taller.replace(at, 8, "lat=\"52.01\"");
  for (std::size_t at = 0; (at = taller.find("lat=\"52.0001\"", at)) != std::string::npos;)
    taller.replace(at, 13, "lat=\"52.0101\"");
  place.write("map.osm", taller);
  expect_said(import("map.osm", "c.json", "d.json", {"--keep"}),
              "`building_w1` does not reach into the site `site` any more, and the site leaves nothing out for it.");
  EXPECT_TRUE(imported_node(place.json("d.json"), "site")["types"]["boundary"]["exclusions"].empty());
}

std::string features_file(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" +
         features + "]}";
}
std::string house(int west, int width, int height, const std::string& properties = "") {
  const std::string w = std::to_string(85000 + west), e = std::to_string(85000 + west + width);
  return R"({"type": "Feature", "properties": {"height": )" + std::to_string(height) + properties +
         R"(}, "geometry": {"type": "Polygon", "coordinates": [[[)" + w + ", 447000], [" + e + ", 447000], [" + e +
         ", 447010], [" + w + ", 447010], [" + w + ", 447000]]]}}";
}

// Files with one id for several features, and several files of one source: each feature is one node, the same one again.
TEST_F(ImportAgain, EqualIdsAreKnownByTheirPlaces) {
  std::string row;
  for (int i = 0; i < 12; ++i) row += (i > 0 ? "," : "") + house(20 * i, 10, 9 + i, R"(, "gid": "same")");
  place.write("row.geojson", features_file(row));
  (void)import("row.geojson", "", "a.json");
  expect_said(import("row.geojson", "a.json", "b.json"), "0 new, 0 updated, 12 unchanged, 0 changed by people, 0 gone.");
  EXPECT_EQ(place.text("a.json"), place.text("b.json"));
  place.write("west.geojson", features_file(house(0, 10, 9, R"(, "gid": 1)")));
  place.write("east.geojson", features_file(house(300, 10, 19, R"(, "gid": 1)")));
  const std::vector<std::string> both{"import", "west.geojson", "east.geojson", "--source", "City", "--force", "--out"};
  std::vector<std::string> call = both;
  call.emplace_back("c.json");
  const Outcome first = place.run(call);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(place.json("c.json")["nodes"].size(), 2u) << "nothing is lost";
  EXPECT_EQ(first.out.find("imported before"), std::string::npos) << first.out;
  call = both;
  call.insert(call.end(), {"d.json", "--into", "c.json"});
  const Outcome second = place.run(call);
  expect_said(second, "0 new, 0 updated, 1 unchanged, 0 changed by people, 0 gone.");
  EXPECT_EQ(second.out.find("Gone means"), std::string::npos) << second.out;
  EXPECT_EQ(place.text("c.json"), place.text("d.json"));
}

// Features without an id are what their geometry is, wherever they stand in their file.
TEST_F(ImportAgain, FeaturesWithoutAnIdAreKnownByTheirGeometry) {
  place.write("houses.geojson", features_file(house(0, 10, 9) + "," + house(50, 10, 12) + "," + house(100, 10, 15)));
  (void)import("houses.geojson", "", "a.json");
  const auto node_at = [&](const std::string& scene, double height) {
    const nlohmann::json whole = place.json(scene);
    for (const auto& one : whole["nodes"])
      if (one["types"]["existing_building"]["height"] == height) return one["id"].get<std::string>();
    return std::string();
  };
  const std::string second = node_at("a.json", 12), third = node_at("a.json", 15);
  // The first left the file, the second is higher, the third has grown to the east.
  place.write("houses.geojson", features_file(house(50, 10, 13) + "," + house(100, 14, 15)));
  expect_said(import("houses.geojson", "a.json", "b.json"), "0 new, 2 updated, 0 unchanged, 0 changed by people, 1 gone.");
  EXPECT_EQ(node_at("b.json", 13), second);
  EXPECT_EQ(node_at("b.json", 15), third);
  EXPECT_EQ(place.json("b.json")["nodes"].size(), 3u);
  expect_said(import("houses.geojson", "b.json", "c.json"), "0 new, 0 updated, 2 unchanged, 0 changed by people, 1 gone.");
  EXPECT_EQ(place.text("b.json"), place.text("c.json"));
  // Scenes of before knew features by their numbers.
  nlohmann::json old = place.json("b.json");
  int number = 0;
  for (auto& one : old["nodes"]) one["types"]["imported"]["element"] = std::to_string(number++);
  place.write("old.json", old.dump());
  (void)import("houses.geojson", "old.json", "d.json");
  EXPECT_EQ(place.json("d.json")["nodes"].size(), 3u);
  expect_said(import("houses.geojson", "d.json", "e.json"), "0 new, 0 updated, 2 unchanged");
}

}  // namespace

}  // namespace bl::test
