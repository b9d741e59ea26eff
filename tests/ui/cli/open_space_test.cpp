// Open space from the brief to the tables: `new`, `run`, reports, exports, and `add garden --open --use`.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

class OpenSpaceRows : public testing::Test {
 protected:
  OpenSpaceRows() {
    place.write("site.geojson", R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
      "coordinates": [[[85000,447000],[85100,447000],[85100,447060],[85000,447060],[85000,447000]]]})");
  }
  Outcome make(const std::string& brief, const std::string& form = "standing") {
    place.write("brief.csv", brief);
    return place.run({"new", "--boundary", "site.geojson", "--height", "30", "--programme", "brief.csv", "--form", form, "--out",
                      "s.json", "--force"});
  }
  nlohmann::json result() {
    EXPECT_EQ(place.run({"run", "s.json", "--json", "r.json"}).code, 0);
    return place.json("r.json");
  }
  Workplace place;
};

constexpr const char* kOpenBrief =
    "use,floor_area_m2,count,storey_height_m,adjacent_to\nhousing,900,3,3,garden\nGarden,300,2,,\noffices,1200,1,3.2,housing\n";

TEST_F(OpenSpaceRows, AskForGroundAndGetIt) {
  for (const std::string form : {"standing", "rounded"}) {
    const Outcome made = make(kOpenBrief, form);
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.out.find("`Garden` is open space: 2 rectangles of 600.0 m² are kept open"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("programme: 3 uses, 4 volumes, 3900.0 m² floor area"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("open:      600.0 m² of 600.0 m² of open space asked for"), std::string::npos) << made.out;
    EXPECT_NE(made.out.find("`Garden` is open space and no body that `housing` could touch"), std::string::npos) << made.out;
    EXPECT_EQ(made.out.find("Rows without a storey height"), std::string::npos) << made.out;
    const nlohmann::json run = result();
    EXPECT_EQ(run["volumes"].size(), 4u) << "a garden is no body";
    ASSERT_EQ(run["totals"]["open_space"].size(), 1u);
    const nlohmann::json garden = run["totals"]["open_space"][0];
    EXPECT_EQ(garden["use"], "Garden");
    EXPECT_EQ(garden["wanted_area"], 600);
    EXPECT_NEAR(garden["area"].get<double>(), 600, 1e-3);
    EXPECT_EQ(garden["why_short"], "");
    EXPECT_EQ(run["totals"]["uses"].size(), 2u);
    EXPECT_EQ(run["totals"]["wanted_floor_area"], 3900);
    for (const auto& problem : run["problems"])
      EXPECT_TRUE(problem["place"].get<std::string>().starts_with("links/near_"))
          << "only housing is too far from the offices: " << problem;
    if (form == "rounded") continue;
    const nlohmann::json plot = run["plots"].back();
    EXPECT_EQ(plot["land_is"], "net");
    EXPECT_NEAR(plot["land"].get<double>(), 6000, 1e-6) << "the garden is land";
    EXPECT_NEAR(plot["open_space"].get<double>(), 600, 1e-3);
    const double floors = run["totals"]["floor_area"].get<double>(), gsi = plot["gsi"].get<double>();
    EXPECT_NEAR(plot["fsi"].get<double>(), floors / 6000, 1e-6) << "and no floor area";
    EXPECT_NEAR(plot["osr"].get<double>(), 6000 * (1 - gsi) / floors, 1e-6) << "and open";
  }
}

TEST_F(OpenSpaceRows, StandInAllTables) {
  ASSERT_EQ(make(kOpenBrief).code, 0);
  const Outcome run = place.run({"run", "s.json", "--report", "out"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("open space"), std::string::npos) << run.out;
  EXPECT_NE(place.text("out/open_space.csv").find("Garden,yes,600,"), std::string::npos) << place.text("out/open_space.csv");
  EXPECT_NE(place.text("out/report.html").find("Open space"), std::string::npos);
  EXPECT_EQ(place.text("out/uses.csv").find("Garden"), std::string::npos) << "no floor area";
  const Outcome sent = place.run({"export", "s.json", "--settle", "--format", "csv", "--out", "a.csv", "--format", "xlsx",
                                  "--out", "a.xlsx", "--format", "pdf", "--out", "a.pdf"});
  ASSERT_EQ(sent.code, 0) << sent.err;
  EXPECT_NE(place.text("a.csv").find("open space,,,Garden,"), std::string::npos);
  EXPECT_NE(place.text("a.csv").find(",600,m2,met,"), std::string::npos);
}

TEST_F(OpenSpaceRows, ThatLackGroundAreShortWithAReason) {
  const Outcome made = make("use,floor_area_m2,count,open\nhousing,900,3,\nsports,5900,1,yes\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("No more of the 5900.0 m²"), std::string::npos) << made.out;
  const nlohmann::json run = result();
  const nlohmann::json sports = run["totals"]["open_space"][0];
  EXPECT_GT(sports["short_share"].get<double>(), 0.01);
  EXPECT_NE(sports["why_short"].get<std::string>(), "");
  const auto says = [&](const nlohmann::json& problem) { return problem["place"] == "open space sports"; };
  EXPECT_TRUE(std::any_of(run["problems"].begin(), run["problems"].end(), says)) << run["problems"];
}

TEST_F(OpenSpaceRows, TheColumnDecidesBeforeTheName) {
  const Outcome made = make("use,floor_area_m2,count,open\npark,900,1,no\nhousing,900,1,\n");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(result()["volumes"].size(), 2u) << "a park of floors, as its row says";
  const Outcome wrong = make("use,floor_area_m2,count,open\npark,900,1,maybe\n");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("`maybe` is not understood. Write `yes`"), std::string::npos) << wrong.err;
}

TEST_F(OpenSpaceRows, AGardenThatIsAddedCountsForItsUse) {
  ASSERT_EQ(make("use,floor_area_m2,count\nhousing,900,3\nplayground,200,1\n").code, 0);
  const Outcome done =
      place.run({"add", "s.json", "garden", "--corners", "20,0", "30,0", "30,10", "20,10", "--open", "--use", "playground"});
  ASSERT_EQ(done.code, 0) << done.err;
  const nlohmann::json ground = result()["totals"]["open_space"][0];
  EXPECT_EQ(ground["use"], "playground");
  EXPECT_NEAR(ground["area"].get<double>(), 100, 1e-6) << "in place of what `new` has laid";
  EXPECT_NE(done.out.find("It takes the place of the rectangle `playground`, which `new` had laid for `playground`."),
            std::string::npos)
      << done.out;
  EXPECT_EQ(place.run({"add", "s.json", "garden", "--corners", "0,0", "9,0", "9,9", "--open", "--use", "housing"}).code, 2)
      << "housing has a node that says what it is";
  const Outcome other = place.run({"add", "s.json", "garden", "--corners", "0,0", "9,0", "9,9", "--open"});
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_NE(other.out.find("Its ground counts for `playground`, the only open space that the programme asks for."),
            std::string::npos)
      << other.out;
  EXPECT_NEAR(result()["totals"]["open_space"][0]["area"].get<double>(), 140.5, 1e-6) << "both that were added";
}

TEST_F(OpenSpaceRows, AGardenIsNotThereTwice) {
  ASSERT_EQ(make("use,floor_area_m2,count,open\nhousing,900,3,\nGarden,200,2,\nPocket park,100,1,yes\n").code, 0);
  const auto add = [this](const std::string& west, const std::string& east, std::vector<std::string> more) {
    more.insert(more.begin(),
                {"add", "s.json", "garden", "--corners", west + ",-29", east + ",-29", east + ",-19", west + ",-19", "--open"});
    const Outcome done = place.run(more);
    EXPECT_EQ(done.code, 0) << done.err;
    return done.out;
  };
  const auto area_of = [this](std::size_t row) { return result()["totals"]["open_space"][row]["area"].get<double>(); };
  // Of two rectangles it takes the place of one; the row called so is meant, in whatever letters.
  std::string said = add("-20", "5", {});
  EXPECT_NE(said.find("It takes the place of the rectangle `Garden "), std::string::npos) << said;
  EXPECT_NE(said.find("which `new` had laid for `Garden`."), std::string::npos) << said;
  EXPECT_NEAR(area_of(0), 450, 1e-3);
  said = add("5", "25", {"--use", "GARDEN"});
  EXPECT_NEAR(area_of(0), 450, 1e-3);
  said = add("25", "30", {"--use", "garden"});
  EXPECT_EQ(said.find("takes the place"), std::string::npos) << "none is left that `new` had laid: " << said;
  EXPECT_NEAR(area_of(0), 500, 1e-3);
  EXPECT_EQ(result()["totals"]["open_space"].size(), 2u);
  said = add("-25", "-20", {"--use", "Gardens"});
  EXPECT_NE(said.find("Warning: no row of the programme asks for `Gardens`, did you mean `Garden`?"), std::string::npos) << said;
  said = add("-30", "-25", {"--use", "arboretum"});
  EXPECT_NE(said.find("asks for `arboretum`: it asks for `Garden`, `Pocket park`. Name one of them by --use."), std::string::npos)
      << said;
  EXPECT_EQ(result()["totals"]["open_space"].size(), 4u) << "what no row asks for is there all the same";
}

}  // namespace

}  // namespace bl::test
