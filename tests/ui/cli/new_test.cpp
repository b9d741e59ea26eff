// `new`: from real files to a scene that settles, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

constexpr const char* kSquare =
    R"({"type": "Feature", "properties": {}, "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
        "geometry": {"type": "Polygon", "coordinates": [[[85000, 446000], [85060, 446000], [85060, 446050], [85000, 446050], [85000, 446000]]]}})";
constexpr const char* kCrossing =
    R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
        "coordinates": [[[85000, 446000], [85060, 446050], [85060, 446000], [85000, 446050], [85000, 446000]]]})";
constexpr const char* kCorner =
    R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
        "coordinates": [[[85000, 446000], [85060, 446000], [85060, 446020], [85020, 446020], [85020, 446050], [85000, 446050], [85000, 446000]]]})";
constexpr const char* kCourt =
    R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
        "coordinates": [[[85000, 446000], [85060, 446000], [85060, 446050], [85000, 446050], [85000, 446000]],
                        [[85020, 446015], [85040, 446015], [85040, 446035], [85020, 446035], [85020, 446015]]]})";
constexpr const char* kBrief =
    "use;floor_area_m2;count;storey_height_m;adjacent_to\nhousing;400;6;3;school\nschool;900;1;3,6;\nshop;300;2;4;housing\n";

class New : public testing::Test {
 protected:
  New() {
    place.write("site.geojson", kSquare);
    place.write("brief.csv", kBrief);
  }
  Outcome make(std::vector<std::string> more = {}, const std::string& boundary = "site.geojson") {
    std::vector<std::string> arguments{"new",         "--boundary", boundary, "--height",  "30",
                                       "--programme", "brief.csv",  "--out",  "scene.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return place.run(arguments);
  }
  Workplace place;
};

TEST_F(New, AColumnThatIsProbablyMisspeltIsAWarning) {
  place.write("brief.csv", "use,floor_area_m2,standng,colour\nhousing,400,ground,red\n");
  const Outcome made = make();
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("brief.csv: warning: Column 3 `standng` was left out, did you mean `standing`?"), std::string::npos)
      << made.err;
  EXPECT_NE(made.out.find("note: brief.csv: Column 4 `colour` was left out."), std::string::npos) << made.out;
}

TEST_F(New, NumbersAreWrittenOut) {
  const Outcome made = place.run(
      {"new", "--boundary", "site.geojson", "--height", "1000000000", "--programme", "brief.csv", "--out", "scene.json"});
  EXPECT_NE(made.err.find("found 1000000000"), std::string::npos) << made.err;
}

TEST_F(New, MakesASceneThatSettles) {
  const Outcome made = make({"--title", "A corner of Delft"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("boundary:  4 corners, 3000.0 m², 30 m high, 90000.0 m³"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("programme: 3 uses, 9 volumes, 3900.0 m² floor area, 12840.0 m³"), std::string::npos) << made.out;
  EXPECT_NE(made.out.find("floor space index 1.30"), std::string::npos) << made.out;
  const nlohmann::json scene = place.json("scene.json");
  EXPECT_EQ(scene["settings"]["title"], "A corner of Delft");
  EXPECT_EQ(scene["settings"]["coordinate_system"], "EPSG:28992");
  // Nine volumes, site, programme, solver and sum; and the figures of two uses that have some.
  EXPECT_EQ(scene["nodes"].size(), 15u);
  std::vector<std::string> uses;
  for (const nlohmann::json& node : scene["nodes"])
    if (node["types"].contains("use")) {
      uses.push_back(node["types"]["use"]["use"]);
      EXPECT_FALSE(node["types"]["use"]["source"].get<std::string>().empty()) << uses.back();
    }
  EXPECT_EQ(uses.size(), 2u);
  const Outcome check = place.run({"check", "scene.json"});
  EXPECT_EQ(check.code, 0) << check.err;
  const Outcome run = place.run({"run", "scene.json", "--json", "r.json"});
  EXPECT_EQ(run.code, 0) << run.last_line();
  const nlohmann::json totals = place.json("r.json")["totals"];
  EXPECT_NEAR(totals["volume"].get<double>(), 12840, 128);
  EXPECT_EQ(totals["uses"].size(), 3u);
}

// What a brief says of standing is in the scene's brief as well as at its volumes, so that a later volume of the use has it too.
TEST_F(New, KeepsTheStandingOfEachUse) {
  place.write("stand.csv", "use,floor_area_m2,count,storey_height_m,standing\ngarage,300,1,3,ground\nflats,200,2,3,\n");
  const Outcome made =
      place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "stand.csv", "--out", "s.json"});
  ASSERT_EQ(made.code, 0) << made.err;
  std::map<std::string, nlohmann::json> rows;
  const nlohmann::json scene = place.json("s.json");
  for (const nlohmann::json& node : scene["nodes"])
    if (node["types"].contains("programme"))
      for (const nlohmann::json& row : node["types"]["programme"]["rows"]) rows[row["use"].get<std::string>()] = row;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows["garage"]["standing"], "ground");
  EXPECT_FALSE(rows["flats"].contains("standing")) << "what is the default is not written";
}

// Wishes that cannot all be had: a hub with fourteen neighbours, a chain, and one use that is a hundred times as large as others.
// Every seed settles, in both forms; no centre of a ball comes near another one, and nothing is left in the air. A script of more
// seeds and sites says the same.
TEST_F(New, SettlesWhateverIsWantedBesideWhat) {
  std::string star = "use,floor_area_m2,count,storey_height_m,adjacent_to,standing\nhub,300,1,4,,ground\n", chain = star;
  for (int i = 1; i <= 14; ++i) star += "spoke " + std::to_string(i) + "," + std::to_string(100 + 20 * i) + ",1,3,hub,\n";
  chain += "link 0,150,1,3,,\n";
  for (int i = 1; i <= 12; ++i)
    chain +=
        "link " + std::to_string(i) + "," + std::to_string(100 + 60 * (i * 7 % 5)) + ",1,3,link " + std::to_string(i - 1) + ",\n";
  const std::string unequal =
      "use,floor_area_m2,count,storey_height_m,adjacent_to,standing\nhall,3000,1,5,kiosk|cafe,ground\nkiosk,30,6,3,,\ncafe,110,3,"
      "4,"
      "kiosk,\n";
  place.write("site.geojson", kSquare);
  place.write("corner.geojson", kCorner);
  place.write("court.geojson", kCourt);
  const std::vector<std::string> sites{"site.geojson", "corner.geojson", "court.geojson"};
  std::size_t round = 0;
  for (const std::string& brief : {star, chain, unequal})
    for (const char* seed : {"1", "2", "3"}) {
      place.write("brief.csv", brief);
      const std::string& site = sites[round++ % 3];
      SCOPED_TRACE(brief.substr(70, 20) + " seed " + seed + " on " + site);
      const bool is_standing = *seed == '2';
      ASSERT_EQ(make({"--seed", seed, "--form", is_standing ? "standing" : "rounded", "--force"}, site).code, 0);
      const Outcome run = place.run({"run", "scene.json", "--json", "r.json"});
      EXPECT_EQ(run.code, 0) << run.last_line();
      const nlohmann::json result = place.json("r.json");
      // Not everybody has room beside a hub, nor round a corner; who has none is told, and that is all.
      for (const auto& problem : result["problems"]) {
        const auto message = problem["message"].get<std::string>();
        EXPECT_NE(message.find(" do not touch: "), std::string::npos) << message;
      }
      if (is_standing) continue;
      const auto& volumes = result["volumes"];
      const auto radius = [&](std::size_t i) { return std::cbrt(volumes[i]["demand"].get<double>() / 4.18879); };
      for (std::size_t i = 0; i < volumes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          double square = 0;
          for (int axis = 0; axis < 3; ++axis) {
            const double away = volumes[i]["position"][axis].get<double>() - volumes[j]["position"][axis].get<double>();
            square += away * away;
          }
          EXPECT_GT(std::sqrt(square), 0.4 * (radius(i) + radius(j))) << volumes[i]["id"] << " " << volumes[j]["id"];
        }
    }
}

TEST_F(New, IsTheSameForASeed) {
  ASSERT_EQ(make({"--seed", "7"}).code, 0);
  const std::string first = place.text("scene.json");
  ASSERT_EQ(make({"--seed", "7", "--force"}).code, 0);
  EXPECT_EQ(place.text("scene.json"), first);
  ASSERT_EQ(make({"--seed", "8", "--force"}).code, 0);
  EXPECT_NE(place.text("scene.json"), first);
}

TEST_F(New, KeepsWhatExists) {
  place.write("scene.json", "mine");
  const Outcome outcome = make();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("scene.json: exists already"), std::string::npos) << outcome.err;
  EXPECT_EQ(place.text("scene.json"), "mine");
}

TEST_F(New, RefusesPlansThatItCannotTake) {
  place.write("crossing.geojson", kCrossing);
  const Outcome crossing = make({}, "crossing.geojson");
  EXPECT_EQ(crossing.code, 2);
  EXPECT_NE(crossing.err.find("cross"), std::string::npos) << crossing.err;
  EXPECT_FALSE(std::filesystem::exists(place.path("scene.json")));
}

TEST_F(New, TakesPlansAsTheyAre) {
  place.write("corner.geojson", kCorner);
  const Outcome corner = make({}, "corner.geojson");
  ASSERT_EQ(corner.code, 0) << corner.err;
  EXPECT_NE(corner.out.find("boundary:  6 corners, 1800.0 m², 30 m high, 54000.0 m³"), std::string::npos) << corner.out;
  EXPECT_EQ(place.run({"check", "scene.json"}).code, 0);
  const Outcome hull = make({"--hull", "--force"}, "corner.geojson");
  EXPECT_EQ(hull.code, 0) << hull.err;
  EXPECT_NE(hull.out.find("of which the hull adds 600.0 m²"), std::string::npos) << hull.out;
}

TEST_F(New, KeepsTheHolesOfAPlan) {
  place.write("court.geojson", kCourt);
  const Outcome made = make({}, "court.geojson");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("boundary:  4 corners and 1 hole, 2600.0 m²"), std::string::npos) << made.out;
  const nlohmann::json scene = place.json("scene.json");
  for (const auto& node : scene["nodes"]) {
    if (node["id"] == "site") { EXPECT_EQ(node["types"]["boundary"]["holes"].size(), 4u); }
    if (!node.contains("position") || !node["types"].contains("smart_volume")) continue;
    const double x = node["position"][0], y = node["position"][1];
    // Around the middle of the site, where the court is 20 m by 20 m.
    EXPECT_FALSE(std::abs(x) < 10 && std::abs(y) < 10) << node["id"];
  }
}

TEST_F(New, SaysWhatIsMissingInTheProgramme) {
  place.write("brief.csv", "use,count\nhousing,3\n");
  const Outcome outcome = make();
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.err.starts_with("brief.csv: ")) << outcome.err;
  EXPECT_NE(outcome.err.find("floor_area"), std::string::npos) << outcome.err;
}

TEST_F(New, WarnsOfDemandsThatDoNotFit) {
  place.write("brief.csv", "use,floor_area_m2,storey_height_m\nhousing,40000,3\n");
  const Outcome outcome = make();
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("warning: the demands do not fit into the boundary; they need a height of at least 40.0 m"),
            std::string::npos)
      << outcome.err;
}

TEST_F(New, RefusesHeightsThatAreNone) {
  for (const char* height : {"0", "-3", "nan", "inf", "1e300"}) {
    const Outcome outcome = place.run({"new", "--boundary", "site.geojson", std::string("--height=") + height, "--programme",
                                       "brief.csv", "--out", "scene.json"});
    EXPECT_EQ(outcome.code, 2) << height;
    EXPECT_NE(outcome.err.find("--height: must be a height in m"), std::string::npos) << outcome.err;
  }
}

}  // namespace

}  // namespace bl::test
