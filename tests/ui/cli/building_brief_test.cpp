// Buildings of several rows from a brief: shops below flats, a tower on a podium, cellars, depths and distances.
#include <gtest/gtest.h>

#include <map>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

class BuildingBrief : public testing::Test {
 protected:
  BuildingBrief() {
    place.write("site.geojson", R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
      "coordinates": [[[85000,447000],[85100,447000],[85100,447060],[85000,447060],[85000,447000]]]})");
  }
  Outcome make(const std::string& brief, const std::string& form = "standing") {
    place.write("brief.csv", brief);
    return place.run({"new", "--boundary", "site.geojson", "--height", "40", "--programme", "brief.csv", "--form", form, "--out",
                      "s.json", "--force"});
  }
  // The volumes after a run, by their ids.
  std::map<std::string, nlohmann::json> volumes() {
    const Outcome run = place.run({"run", "s.json", "--json", "r.json"});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    std::map<std::string, nlohmann::json> found;
    const nlohmann::json result = place.json("r.json");
    for (const nlohmann::json& volume : result["volumes"]) found[volume["id"].get<std::string>()] = volume;
    return found;
  }
  nlohmann::json footprint(const std::string& id) {
    const nlohmann::json scene = place.json("s.json");
    for (const nlohmann::json& node : scene["nodes"])
      if (node["id"] == id) return node["types"]["footprint"];
    return {};
  }
  static double bottom(const nlohmann::json& volume) { return volume["plates"].front()["bottom"].get<double>(); }
  Workplace place;
};

// A building has one footprint: its depth is that of the row which gives one.
TEST_F(BuildingBrief, TheDepthOfARowThatSharesHoldsForTheBuilding) {
  const Outcome made = make("use,floor_area_m2,storeys,shares,depth\nshops,1200,1,,\nflats,3600,3,shops,12\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(footprint("shops")["depth"], 12) << made.err;
  EXPECT_NE((made.out + made.err).find("the depth of `flats`, 12 m, holds for the building of `shops` that it shares"),
            std::string::npos)
      << made.out << made.err;
  const Outcome other = make("use,floor_area_m2,storeys,shares,depth\nshops,1200,1,,20\nflats,3600,3,shops,12\n");
  EXPECT_EQ(footprint("shops")["depth"], 20);
  EXPECT_NE((other.out + other.err).find("it shares the building of `shops`, which has a depth of 20 m"), std::string::npos)
      << other.out << other.err;
}

// Whatever the order of the rows is, and not by rows that lie in cellars.
TEST_F(BuildingBrief, ADistanceOnARoofIsLeftOutInAnyOrder) {
  const std::string head = "use,floor_area_m2,storeys,on,shares,distance,below_ground\n", podium = "podium,1600,1,,,,\n",
                    office = "offices,1200,3,podium,,,\n", hotel = "hotel,800,2,,offices,8,\n";
  for (const std::string& rows : {podium + office + hotel, hotel + office + podium}) {
    const Outcome made = make(head + rows);
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_FALSE(footprint("offices").contains("setback")) << rows;
    EXPECT_NE((made.out + made.err).find("the distance of `offices` was left out: on the roof of `podium`"), std::string::npos)
        << made.out << made.err;
  }
  const Outcome cellar = make(head + "offices,1200,3,,,,\narchive,300,,,offices,12,yes\n");
  ASSERT_EQ(cellar.code, 0) << cellar.err;
  EXPECT_FALSE(footprint("offices").contains("setback")) << cellar.out;
}

TEST_F(BuildingBrief, ShopsBelowFlatsShareAFootprintInTheOrderOfRows) {
  const Outcome made = make(
      "use,floor_area_m2,count,storey_height_m,storeys,shares\nshops,600,2,4,1,\noffices,600,2,3.5,1,shops\n"
      "flats,1800,2,3,3,offices\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(footprint("shops_1")["storeys"], 5) << "what the rows say together";
  auto run = volumes();
  ASSERT_EQ(run.size(), 6u);
  for (const std::string number : {"_1", "_2"}) {
    const auto &shops = run["shops" + number], &offices = run["offices" + number], &flats = run["flats" + number];
    EXPECT_NEAR(bottom(shops), 0, 1e-9);
    EXPECT_GT(bottom(offices), bottom(shops));
    EXPECT_GT(bottom(flats), bottom(offices));
    EXPECT_NEAR(flats["floor_area"].get<double>(), 1800, 9);
  }
}

TEST_F(BuildingBrief, ATowerStandsOnThePodiumThatItsRowNames) {
  const Outcome made =
      make("use,floor_area_m2,count,storey_height_m,on\npodium,1600,1,5,\ntower,2400,1,3,Podium\nwing,600,1,3,podium\n");
  ASSERT_EQ(made.code, 0) << made.err;
  auto run = volumes();
  EXPECT_EQ(footprint("podium").value("storeys", 4), 1) << "others stand on it";
  EXPECT_NEAR(bottom(run["podium"]), 0, 1e-9);
  for (const char* id : {"tower", "wing"}) { EXPECT_NEAR(bottom(run[id]), 5, 1e-9) << id; }
  EXPECT_NEAR(run["tower"]["floor_area"].get<double>(), 2400, 12);
}

TEST_F(BuildingBrief, ATowerStandsOnABuildingThatSeveralShare) {
  const Outcome made =
      make("use,floor_area_m2,storey_height_m,storeys,shares,on\nshops,800,4,1,,\nflats,800,3,1,shops,\ntower,1200,3,4,,flats\n");
  ASSERT_EQ(made.code, 0) << made.err;
  auto run = volumes();
  EXPECT_NEAR(bottom(run["tower"]), 7, 0.5) << run["tower"];
}

TEST_F(BuildingBrief, UndergroundParkingBecomesCellars) {
  const Outcome made = make(
      "use,floor_area_m2,count,storey_height_m,storeys,below_ground\nhousing,1600,2,3,4,\nlibrary,600,1,4,1,2\n"
      "Underground parking,700,1,3,,\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(
      made.out.find("`Underground parking` lies below the ground and is no floor area: about 1000 m² of cellars for the 700 "
                    "m² asked for, 1 storey under `library`"),
      std::string::npos)
      << made.out;
  EXPECT_NE(made.out.find("3 volumes, 3800.0 m² floor area"), std::string::npos) << made.out;
  EXPECT_EQ(footprint("library")["cellar_storeys"], 3) << "two of its own and one for the cars";
  EXPECT_EQ(volumes().size(), 3u);
  ASSERT_EQ(make("use,floor_area_m2,storey_height_m,storeys,below_ground,shares\nhousing,1600,3,4,,\nlibrary,600,4,1,,\ncars,300,"
                 "3,,yes,housing\n")
                .code,
            0);
  EXPECT_EQ(footprint("housing")["cellar_storeys"], 1) << "the row names whom it lies below";
  EXPECT_FALSE(footprint("library").contains("cellar_storeys"));
}

TEST_F(BuildingBrief, DepthsAndDistancesReachTheFootprints) {
  ASSERT_EQ(
      make("use,floor_area_m2,count,storey_height_m,storeys,depth,distance\nhousing,1800,2,3,4,,12\noffices,1800,1,3,4,18 m,\n")
          .code,
      0);
  EXPECT_EQ(footprint("housing_1")["depth"], 15) << "the catalogue's";
  EXPECT_EQ(footprint("housing_1")["aspect"], 2) << "450 m² of that depth are a bar of 15 by 30 m";
  EXPECT_EQ(footprint("housing_1")["setback"], 6);
  EXPECT_EQ(footprint("housing_1")["party_walls"], false);
  EXPECT_EQ(footprint("offices")["depth"], 18);
  EXPECT_FALSE(footprint("offices").contains("setback"));
  volumes();
}

// A square with a courtyard of the same depth would have a courtyard half a metre wide.
TEST_F(BuildingBrief, ABarIsBuiltWhereACourtyardWouldBeNarrow) {
  const auto aspect_of = [this](const std::string& area, const std::string& depth) {
    const Outcome made = make("use,floor_area_m2,storey_height_m,storeys,depth\noffices," + area + ",3,1," + depth + "\n");
    EXPECT_EQ(made.code, 0) << made.err;
    return footprint("offices").value("aspect", 1.0);
  };
  EXPECT_NEAR(aspect_of("600", "12"), 4.17, 1e-9) << "12 m by 50 m";
  EXPECT_NEAR(aspect_of("1050", "12"), 7.29, 1e-9) << "the courtyard would be 9.9 m wide";
  EXPECT_EQ(aspect_of("1060", "12"), 1) << "and here 10.1 m";
  EXPECT_NEAR(aspect_of("576", "12"), 4, 1e-9);
  EXPECT_EQ(aspect_of("120", "12"), 1) << "less than its depth";
  aspect_of("600", "12");
  const nlohmann::json offices = volumes()["offices"];
  EXPECT_NEAR(offices["footprint"].get<double>(), 600, 3);
}

TEST_F(BuildingBrief, ATowerOnAPodiumKeepsNoDistanceOnItsRoof) {
  const Outcome made =
      make("use,floor_area_m2,count,storey_height_m,on,distance\npodium,900,1,5,,10\ntower,2400,1,3,podium,24\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("the distance of `tower` was left out: on the roof of `podium` it keeps none"), std::string::npos)
      << made.out;
  EXPECT_FALSE(footprint("tower").contains("setback"));
  EXPECT_EQ(footprint("podium")["setback"], 5);
  auto run = volumes();
  EXPECT_NEAR(bottom(run["tower"]), 5, 1e-9);
  EXPECT_NEAR(run["tower"]["floor_area"].get<double>(), 2400, 12);
}

TEST_F(BuildingBrief, FlatsAboveShopsAreHousing) {
  const Outcome made = make(
      "use,floor_area_m2,storey_height_m\nFlats above shops,900,3\nShops below flats,300,4\nFlats over the shops 2,900,3\n"
      "Rooms above a pub,90,3\n");
  ASSERT_EQ(made.code, 0) << made.err;
  std::map<std::string, double> people;
  const nlohmann::json scene = place.json("s.json");
  for (const nlohmann::json& node : scene["nodes"])
    if (node["types"].contains("use"))
      people[node["types"]["use"]["use"].get<std::string>()] = node["types"]["use"]["people_per_100"].get<double>();
  EXPECT_EQ(people, (std::map<std::string, double>{
                        {"Flats above shops", 1.7}, {"Shops below flats", 4.6}, {"Flats over the shops 2", 1.7}}));
  EXPECT_NE(made.out.find("No figures are known of the use `Rooms above a pub`"), std::string::npos) << made.out;
}

TEST_F(BuildingBrief, StoreysThatHoldTheAreaBackAreToldAndNoHeightThatWouldNotHelp) {
  const Outcome made = make("use,floor_area_m2,count,storey_height_m,storeys\nflats,9000,4,3,4\n");
  ASSERT_EQ(made.code, 0);
  EXPECT_NE(
      made.err.find("with the storeys that the brief gives, the buildings need 9000 m² of ground, and there are 6000 m²: give "
                    "more storeys, for which the height leaves room, or less floor area"),
      std::string::npos)
      << made.err;
  EXPECT_EQ(made.err.find("need a height of"), std::string::npos) << made.err;
}

TEST_F(BuildingBrief, SaysWhichColumnAStackNeeds) {
  const Outcome made = make(
      "use,floor_area_m2,storey_height_m,standing,on\nshops,600,4,ground,\noffices,600,3,stack,\nflats,600,3,stack,shops\nhall,"
      "300,3,,\n");
  ASSERT_EQ(made.code, 0);
  EXPECT_NE(
      made.err.find("line 3: warning: `offices` stands on the ground: `stack` in the column `standing` does not say on what "
                    "it stands. Name the row below it in a column `on`"),
      std::string::npos)
      << made.err;
  EXPECT_EQ(made.err.find("`flats` stands"), std::string::npos) << "its row names what carries it";
  EXPECT_EQ(made.err.find("`hall` stands"), std::string::npos) << "its row says nothing";
  const Outcome balls =
      make("use,floor_area_m2,storey_height_m,standing,shares\nshops,600,4,stack,\nflats,600,3,,shops\n", "rounded");
  ASSERT_EQ(balls.code, 0);
  EXPECT_NE(balls.err.find("Column 5 `shares` was left out: only volumes that stand in storeys follow it"), std::string::npos)
      << balls.err;
  EXPECT_EQ(balls.err.find("stands on the ground"), std::string::npos) << balls.err;
}

TEST_F(BuildingBrief, ListsAllMistakesWithRowAndColumn) {
  const Outcome made = make(
      "use,floor_area_m2,count,storeys,on,shares,below_ground,depth\nshops,x,1,,,,,\nflats,600,1.5,,shop,,,1\n"
      "offices,600,1,999,offices,,deep,\na,100,1,,b,,,\nb,100,1,,a,,,\nc,100,1,,shops,a,,\nd,100,1,,,e,,\ne,100,1,,,d,,\n");
  EXPECT_EQ(made.code, 2);
  for (const std::string part :
       {"line 2, column 2 `floor_area_m2`: `x` is not understood", "line 3, column 3 `count`: The count is 1.5",
        "line 3, column 5 `on`: `shop` is no row of this table, did you mean `shops`?",
        "line 3, column 8 `depth`: The greatest depth of a building is 1 m",
        "line 4, column 4 `storeys`: The number of storeys is 999", "line 4, column 5 `on`: `offices` names itself",
        "line 4, column 7 `below_ground`: `deep` is not understood",
        "line 5, column 5 `on`: `a` would stand upon itself by way of `b`",
        "line 8, column 6 `shares`: `d` would share its own building by way of `e`: leave out one of the names",
        "line 7, column 6 `shares`: `c` cannot stand on the roof of `shops` and share the building of `a`"})
    EXPECT_NE(made.err.find(part), std::string::npos) << part << "\n" << made.err;
}

TEST_F(BuildingBrief, UsesAreKnownByTheWordsThatPeopleWrite) {
  const Outcome made = make(
      "function,area_m2,note\nStarter housing,2000,100 units\nShop,300,\nStart-up office,600,\nCafé,120,\nFab labs,138,15 "
      "tables\n"
      "Observatory,90,\nAquarium,90,\nTheatre,90,\nChapel,90,\nWorkshop,90,\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(
      made.out.find(
          "Figures of `housing` were taken for `Starter housing`, of `offices` for `Start-up office`, of `shops` for `Café`"),
      std::string::npos)
      << made.out;
  EXPECT_NE(made.out.find("No figures are known of the uses `Aquarium`, `Chapel`, `Fab labs`, `Observatory` and 2 more: "),
            std::string::npos)
      << made.out;
  EXPECT_EQ(made.err, "") << "a note is no misspelt name";
  EXPECT_EQ(made.out.find("`note` was left out"), std::string::npos) << made.out;
  std::map<std::string, double> people;
  const nlohmann::json scene = place.json("s.json");
  for (const nlohmann::json& node : scene["nodes"]) {
    if (node["types"].contains("use"))
      people[node["types"]["use"]["use"].get<std::string>()] = node["types"]["use"]["people_per_100"].get<double>();
    if (node["id"] != "programme") continue;
    EXPECT_EQ(node["types"]["programme"]["rows"][0].value("note", ""), "100 units");
  }
  EXPECT_EQ(people,
            (std::map<std::string, double>{{"Café", 4.6}, {"Shop", 4.6}, {"Start-up office", 6.7}, {"Starter housing", 1.7}}));
}

}  // namespace

}  // namespace bl::test
