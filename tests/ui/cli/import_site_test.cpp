// `import` into a scene with a site: what becomes of buildings that stand inside of it, and accounts that hide nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/support/sanitized.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

std::string square_feature(const std::string& id, double x, double y, double width, double depth, double height) {
  const auto corner = [](double east, double north) {
    return "[" + std::to_string(85000 + east) + "," + std::to_string(446000 + north) + "]";
  };
  return R"({"type": "Feature", "properties": {"gid": ")" + id + R"(", "height": )" + std::to_string(height) +
         R"(}, "geometry": {"type": "Polygon", "coordinates": [[)" + corner(x, y) + "," + corner(x + width, y) + "," +
         corner(x + width, y + depth) + "," + corner(x, y + depth) + "," + corner(x, y) + "]]}}";
}
std::string feature_file(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" +
         features + "]}";
}

class ImportSite : public testing::Test {
 protected:
  ImportSite() {
    place.write("site.geojson", feature_file(square_feature("site", 0, 0, 60, 50, 0)));
    place.write("brief.csv", "use,floor_area_m2,count,storey_height_m\nhousing,1200,6,3\nschool,2500,1,3.5\n");
    // Inside; inside with a quarter; a neighbour whose wall is drawn two centimetres over the line; away.
    place.write(
        "around.geojson",
        feature_file(square_feature("inside", 10, 10, 10, 10, 12) + "," + square_feature("reaching", 55, 20, 20, 10, 9) + "," +
                     square_feature("beside", 59.98, 0, 10, 10, 9) + "," + square_feature("away", 90, 0, 10, 10, 9)));
  }
  // The scene with the surroundings, and what was said.
  Outcome import(std::vector<std::string> more = {}) {
    const Outcome made = place.run(
        {"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--out", "scene.json", "--force"});
    EXPECT_EQ(made.code, 0) << made.err;
    std::vector<std::string> arguments{"import",   "around.geojson", "--into",   "scene.json", "--out",
                                       "all.json", "--force",        "--report", "rows.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return place.run(arguments);
  }
  nlohmann::json node(const std::string& id) const {
    const nlohmann::json scene = place.json("all.json");
    for (const auto& one : scene["nodes"])
      if (one["id"] == id) return one;
    return {};
  }
  std::string row(const std::string& id) const {
    const std::string text = place.text("rows.csv");
    const std::size_t at = text.find("feature," + id + ",");
    return at == std::string::npos ? "" : text.substr(text.rfind('\n', at) + 1, text.find('\n', at) - text.rfind('\n', at) - 1);
  }
  double boundary_volume() const {
    const Outcome run = place.run({"run", "all.json", "--ticks", "2", "--save", "after.json"});
    EXPECT_EQ(run.code, 0) << run.err;
    return place.json("after.json")["state"]["nodes"]["site"].value("boundary.volume", 0.0);
  }
  Workplace place;
};

TEST_F(ImportSite, WithoutATerminalTheyAreKeptAndItIsSaid) {
  const Outcome done = import();
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("1 building stands inside the site `site` and stays: the site leaves out the ground under it, courts "
                          "included, up to its roof."),
            std::string::npos)
      << done.out;
  EXPECT_NE(done.out.find("That is what --keep does; --clear leaves such buildings out"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("1 building reaches into the site `site` with less than half of its ground and stays"),
            std::string::npos)
      << done.out;
  const nlohmann::json rows = node("site")["types"]["boundary"]["exclusions"];
  ASSERT_EQ(rows.size(), 8u) << rows.dump();
  EXPECT_EQ(rows[0]["name"], "building_inside");
  EXPECT_EQ(rows[0].value("bottom", 0.0), 0);
  EXPECT_EQ(rows[0]["top"], 12);
  EXPECT_EQ(rows[4]["name"], "building_reaching");
  EXPECT_NEAR(boundary_volume(), 60 * 50 * 30 - 10 * 10 * 12 - 5 * 10 * 9, 1e-6) << "less the bodies that stand in it";
  EXPECT_NE(row("features/0").find("100 % of it inside the site `site`"), std::string::npos) << row("features/0");
  EXPECT_NE(row("features/1").find("25 % of it inside"), std::string::npos) << row("features/1");
  EXPECT_EQ(row("features/2").find("inside"), std::string::npos) << row("features/2");
  EXPECT_EQ(place.run({"check", "all.json"}).code, 0);
}

TEST_F(ImportSite, VolumesSettleWithoutGrowingThroughWhatIsKept) {
  ASSERT_EQ(import({"--keep"}).code, 0);
  const Outcome run = place.run({"run", "all.json", "--report", "out"});
  EXPECT_EQ(run.code, 0) << run.last_line() << run.err;
  // Local metres: the origin is the middle of the site.
  const std::string obj = place.text("out/volumes.obj");
  std::size_t corners = 0;
  bool is_volume = false;
  for (std::size_t at = 0, end; at < obj.size(); at = end + 1) {
    end = std::min(obj.find('\n', at), obj.size());
    const std::string line = obj.substr(at, end - at);
    if (line.starts_with("o ")) is_volume = line.find("building") == std::string::npos && line.find("ite") == std::string::npos;
    if (!line.starts_with("v ") || !is_volume) continue;
    double x = 0, y = 0, z = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z), 3);
    ++corners;
    const auto is_within = [&](double west, double south, double east, double north, double top) {
      return x > west + 0.05 && x < east - 0.05 && y > south + 0.05 && y < north - 0.05 && z < top - 0.05;
    };
    EXPECT_FALSE(is_within(-20, -15, -10, -5, 12)) << line;
    EXPECT_FALSE(is_within(25, -5, 45, 5, 9)) << line;
  }
  EXPECT_GT(corners, 7 * 2 * 4u) << "each of seven volumes has a floor and a roof";
}

TEST_F(ImportSite, ClearedOnesAreLeftOutWithARow) {
  const Outcome done = import({"--clear"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("1 building that stands inside the site `site` was left out."), std::string::npos) << done.out;
  EXPECT_TRUE(node("building_inside").is_null());
  EXPECT_FALSE(node("building_reaching").is_null()) << "less than half of it is inside: a neighbour";
  EXPECT_NE(row("features/0").find("skipped"), std::string::npos) << row("features/0");
  EXPECT_NE(row("features/0").find("building: it stands inside the site, which is cleared"), std::string::npos)
      << row("features/0");
  EXPECT_NEAR(boundary_volume(), 60 * 50 * 30 - 5 * 10 * 9, 1e-6);
}

// What an import before has kept is cleared as well, where people have left it alone.
TEST_F(ImportSite, ClearingAgainRemovesWhatWasKept) {
  place.write("around.geojson",
              feature_file(square_feature("inside", 10, 10, 10, 10, 12) + "," + square_feature("loved", 30, 10, 10, 10, 12) +
                           "," + square_feature("reaching", 55, 20, 20, 10, 9)));
  ASSERT_EQ(import({"--keep"}).code, 0);
  nlohmann::json scene = place.json("all.json");
  for (auto& one : scene["nodes"])
    if (one["id"] == "building_loved") one["name"] = "The old school";
  place.write("kept.json", scene.dump());
  const auto clear = [&](const std::string& into) {
    const Outcome done = place.run(
        {"import", "around.geojson", "--into", into, "--clear", "--out", "all.json", "--force", "--report", "rows.csv"});
    EXPECT_EQ(done.code, 0) << done.err;
    return done.out;
  };
  const std::string said = clear("kept.json");
  EXPECT_NE(said.find("1 building that stands inside the site `site` was left out. Removed, with the ground that the site left "
                      "out for it: `building_inside`."),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("`building_loved` stands inside the site `site` and stays, because people have changed it"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("0 new, 0 updated, 1 unchanged, 1 changed by people, 0 gone, 1 removed."), std::string::npos) << said;
  EXPECT_TRUE(node("building_inside").is_null());
  EXPECT_EQ(node("building_loved")["name"], "The old school");
  EXPECT_NE(row("features/1").find("people have changed it: it stays"), std::string::npos) << row("features/1");
  EXPECT_NEAR(boundary_volume(), 60 * 50 * 30 - 10 * 10 * 12 - 5 * 10 * 9, 1e-6) << "only the other two are left out";
  // And the other way round it comes back.
  const Outcome kept = place.run({"import", "around.geojson", "--into", "all.json", "--keep", "--out", "all.json", "--force"});
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_FALSE(node("building_inside").is_null());
}

TEST_F(ImportSite, PartsShareTheFateOfTheirBuilding) {
  const std::string map = R"(<osm version="0.6">
    <node id="1" lat="52" lon="5"/><node id="2" lat="52" lon="5.0002"/><node id="3" lat="52.0002" lon="5.0002"/><node id="4" lat="52.0002" lon="5"/>
    <node id="5" lat="52" lon="5.0001"/><node id="6" lat="52.0002" lon="5.0001"/>
    <way id="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="building" v="yes"/></way>
    <way id="2"><nd ref="1"/><nd ref="5"/><nd ref="6"/><nd ref="4"/><nd ref="1"/><tag k="building:part" v="yes"/><tag k="height" v="9"/></way>
    <way id="3"><nd ref="5"/><nd ref="2"/><nd ref="3"/><nd ref="6"/><nd ref="5"/><tag k="building:part" v="yes"/><tag k="height" v="20"/></way></osm>)";
  place.write("parts.osm", map);
  // A site over three quarters of it: the eastern part lies half outside.
  place.write(
      "site.geojson",
      R"({"type": "Polygon", "coordinates": [[[4.9998,51.9998],[5.00015,51.9998],[5.00015,52.0004],[4.9998,52.0004],[4.9998,51.9998]]]})");
  ASSERT_EQ(
      place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--out", "scene.json"}).code,
      0);
  const Outcome done =
      place.run({"import", "parts.osm", "--into", "scene.json", "--clear", "--out", "all.json", "--report", "rows.csv"});
  EXPECT_EQ(done.code, 0) << "nothing else is in the file, and the site is cleared: " << done.err;
  EXPECT_EQ(done.err, "") << "there is nothing to ask about";
  EXPECT_NE(done.out.find("wrote all.json: no new nodes"), std::string::npos) << done.out;
  EXPECT_NE(place.text("rows.csv").find("skipped,way,w1,"), std::string::npos) << place.text("rows.csv");
  EXPECT_NE(place.text("rows.csv").find("skipped,way,w3,"), std::string::npos);
  const Outcome kept = place.run({"import", "parts.osm", "--into", "scene.json", "--keep", "--out", "all.json", "--force"});
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_NE(kept.out.find("1 building stands inside the site `site` and stays"), std::string::npos) << kept.out;
  EXPECT_EQ(node("site")["types"]["boundary"]["exclusions"].size(), 8u) << "both parts";
  EXPECT_EQ(place.run({"import", "parts.osm", "--into", "scene.json", "--keep", "--clear", "--out", "no.json"}).code, 2);
}

// One site is cleared of what reaches into the other: it is gone from both, and nobody is told that it stays.
TEST_F(ImportSite, WhatOneSiteClearsDoesNotStayInTheOther) {
  const auto site = [](const std::string& id, int west, int east) {
    const std::string w = std::to_string(west), e = std::to_string(east);
    return R"({"id": ")" + id + R"(", "types": {"boundary": {"form": "plan", "height": 30, "plan": [[)" + w + ", 0, 0], [" + e +
           ", 0, 0], [" + e + ", 50, 0], [" + w + ", 50, 0]]}}}";
  };
  place.write("two.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [)" + site("site_a", 0, 50) + "," +
                              site("site_b", 50, 100) + R"(], "links": []})");
  // Two thirds in the one, one third in the other.
  place.write("house.geojson",
              R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"height": 12}, "geometry":
      {"type": "Polygon", "coordinates": [[[30, 10], [60, 10], [60, 30], [30, 30], [30, 10]]]}}]})");
  const std::vector<std::string> call{"import", "house.geojson", "--into", "two.json", "--out",  "all.json",
                                      "--crs",  "local",         "--as",   "building", "--force"};
  std::vector<std::string> clearing = call, keeping = call;
  clearing.push_back("--clear");
  keeping.push_back("--keep");
  const Outcome cleared = place.run(clearing);
  EXPECT_EQ(cleared.code, 0) << cleared.err;
  EXPECT_NE(cleared.out.find("1 building that stands inside the site `site_a` was left out."), std::string::npos) << cleared.out;
  EXPECT_EQ(cleared.out.find("stays"), std::string::npos) << cleared.out;
  const Outcome kept = place.run(keeping);
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_NE(kept.out.find("1 building stands inside the site `site_a` and stays"), std::string::npos) << kept.out;
  EXPECT_NE(kept.out.find("1 building reaches into the site `site_b`"), std::string::npos) << kept.out;
}

// Layers have one value at each place, which has an option of its own.
TEST_F(ImportSite, LayersTakeTheirValuesByAnotherOption) {
  place.write("points.geojson",
              R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"pop": 5, "h": 3},
      "geometry": {"type": "Point", "coordinates": [5.0, 52.0]}}]})");
  const std::vector<std::string> call{"import", "points.geojson", "--as", "layer", "--value", "pop", "--out", "l.json"};
  std::vector<std::string> with_property = call;
  with_property.insert(with_property.end(), {"--property", "height=h"});
  const Outcome refused = place.run(with_property);
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("by --value h"), std::string::npos) << refused.err;
  EXPECT_EQ(refused.err.find("none of the files has features"), std::string::npos) << refused.err;
  EXPECT_EQ(place.run(call).code, 0);
}

TEST_F(ImportSite, PropertiesThatNobodyHasAreToldOnBothSides) {
  const auto said = [&](const std::string& property) {
    const Outcome outcome = place.run({"import", "around.geojson", "--property", property, "--out", "p.json"});
    EXPECT_EQ(outcome.code, 2) << property;
    EXPECT_FALSE(std::filesystem::exists(place.path("p.json")));
    return outcome.err;
  };
  EXPECT_NE(
      said("hieght=height").find("--property: there is no property `hieght` that an import looks for, did you mean `height`?"),
      std::string::npos)
      << said("hieght=height");
  EXPECT_NE(said("height=heihgt").find("--property: no feature has a property `heihgt`, did you mean `height`?"),
            std::string::npos)
      << said("height=heihgt");
  EXPECT_NE(said("height=").find("expects OURS=THEIRS"), std::string::npos);
  place.write(
      "map.osm",
      R"(<osm version="0.6"><node id="1" lat="52" lon="5"/><node id="2" lat="52" lon="5.001"/><way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/></way></osm>)");
  const Outcome map = place.run({"import", "map.osm", "--property", "height=h", "--out", "p.json"});
  EXPECT_EQ(map.code, 2);
  EXPECT_NE(map.err.find("none of the files has features with properties"), std::string::npos) << map.err;
  EXPECT_EQ(place.run({"import", "around.geojson", "--property", "height=HEIGHT", "--out", "p.json"}).code, 0);
}

TEST_F(ImportSite, AnOldReportDoesNotOutliveAFailedImport) {
  for (const auto& [file, into] :
       {std::pair<std::string, std::string>{"cut.osm", ""}, {"missing.osm", ""}, {"around.geojson", "cut.osm"}}) {
    place.write("cut.osm", R"(<osm version="0.6"><node id="1")");
    place.write("rows.csv", "a,b\n1,2\n");
    std::vector<std::string> arguments{"import", file, "--out", "p.json", "--report", "rows.csv"};
    if (!into.empty()) arguments.insert(arguments.end(), {"--into", into});
    EXPECT_EQ(place.run(arguments).code, 2) << file;
    const std::string rows = place.text("rows.csv");
    EXPECT_NE(rows.find(file + ",skipped,file,"), std::string::npos) << rows;
  }
}

TEST_F(ImportSite, ModelsWithoutACrsComeInAsLocal) {
  place.write(
      "model.city.json",
      R"({"type": "CityJSON", "version": "2.0", "vertices": [[1,2,0],[11,2,0],[11,12,0],[1,12,0]], "CityObjects": {"b": {"type": "Building",
       "attributes": {"measuredHeight": 8}, "geometry": [{"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]}]}}})");
  const Outcome refused = place.run({"import", "model.city.json", "--out", "all.json"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--crs local"), std::string::npos) << refused.err;
  const Outcome done = place.run({"import", "model.city.json", "--crs", "local", "--out", "all.json"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(place.json("all.json")["settings"]["coordinate_system"], "local");
  EXPECT_EQ(node("building_b")["types"]["existing_building"]["outline"][0], nlohmann::json::array({1.0, 2.0, 0.0}));
  EXPECT_EQ(place.run({"run", "all.json", "--ticks", "2"}).code, 0);
  const Outcome elsewhere = place.run({"import", "around.geojson", "--into", "all.json", "--out", "no.json"});
  EXPECT_EQ(elsewhere.code, 2);
  EXPECT_NE(elsewhere.err.find("no place on Earth"), std::string::npos) << elsewhere.err;
  // Into a scene that has a place they come in its own metres.
  const Outcome made =
      place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--out", "scene.json"});
  ASSERT_EQ(made.code, 0) << made.err;
  const Outcome added =
      place.run({"import", "model.city.json", "--crs", "local", "--into", "scene.json", "--out", "all.json", "--force"});
  ASSERT_EQ(added.code, 0) << added.err;
  EXPECT_EQ(place.json("all.json")["settings"]["coordinate_system"], "EPSG:28992");
  EXPECT_EQ(node("building_b")["types"]["existing_building"]["outline"][0], nlohmann::json::array({1.0, 2.0, 0.0}));
}

// A row of many houses: no step of an import may cost more the more there are before it.
TEST_F(ImportSite, ThousandsOfHousesComeInQuickly) {
  if (test::kIsSanitized) GTEST_SKIP() << "it is about time";
  const int count = 30000;
  std::string houses;
  for (int i = 0; i < count; ++i)
    houses += (i > 0 ? ",\n" : "") +
              square_feature(i % 2 == 0 ? "same" : "h" + std::to_string(i), 15.0 * (i % 200), 15.0 * (i / 200), 10, 10, 9);
  place.write("town.geojson", feature_file(houses));
  // Seconds of the processor, so that a busy machine does not decide.
  const Outcome done = place.shell("ulimit -t 20; \"$BEHAVIOURLINKS\" import town.geojson --out town.json");
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("new nodes: " + std::to_string(count) + " existing_building"), std::string::npos)
      << done.out.substr(0, 500);
}

// Memory that is not enough ends in a sentence, wherever it ran out.
TEST_F(ImportSite, MemoryThatRunsOutEndsInASentence) {
  if (kIsSanitized) GTEST_SKIP() << "sanitizers need more address space than any limit leaves";
  std::string houses;
  for (int i = 0; i < 20000; ++i)
    houses += (i > 0 ? ",\n" : "") + square_feature("h", 15.0 * (i % 200), 15.0 * (i / 200), 10, 10, 9);
  place.write("town.geojson", feature_file(houses));
  std::size_t refused = 0;
  for (int megabytes = 90; megabytes <= 330; megabytes += 20) {
    const Outcome done = place.shell("ulimit -v " + std::to_string(megabytes * 1024) +
                                     "; \"$BEHAVIOURLINKS\" import town.geojson --out town.json --force");
    if (done.code == 0) continue;
    if (done.code == 127 || done.err.find("error while loading shared libraries") != std::string::npos) continue;
    ++refused;
    EXPECT_EQ(done.code, 1) << megabytes << " MiB: " << done.err;
    EXPECT_TRUE(done.err.find("memory ran out") != std::string::npos || done.err.find("no more threads") != std::string::npos)
        << megabytes << " MiB: " << done.err;
  }
  EXPECT_GT(refused, 2u);
}

}  // namespace

}  // namespace bl::test
