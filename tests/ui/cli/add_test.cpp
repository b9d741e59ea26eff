// `add`: rules, a sun and a garden in one act each, what they become in a run, and what is refused.
#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

nlohmann::json added_node(const nlohmann::json& scene, const std::string& id) {
  for (const auto& one : scene["nodes"])
    if (one["id"] == id) return one;
  return {};
}
nlohmann::json links_of(const nlohmann::json& scene, const std::string& kind) {
  nlohmann::json found = nlohmann::json::array();
  for (const auto& one : scene["links"])
    if (one["kind"] == kind) found.push_back(one);
  return found;
}

class Add : public testing::Test {
 protected:
  Add() {
    place.write("site.geojson", R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
      "coordinates": [[[85000,447000],[85080,447000],[85080,447044],[85000,447044],[85000,447000]]]})");
    place.write("brief.csv", "use,floor_area_m2,count,storey_height_m\noffices,2400,1,3.2\nhousing,900,1,3\n");
    EXPECT_EQ(
        place.run({"new", "--boundary", "site.geojson", "--height", "40", "--programme", "brief.csv", "--out", "s.json"}).code,
        0);
  }
  Outcome add(std::vector<std::string> more) {
    more.insert(more.begin(), {"add", "s.json"});
    return place.run(more);
  }
  Workplace place;
};

TEST_F(Add, RulesHoldThePlotThatTheBoundaryBecomes) {
  const Outcome done = add({"rules", "--fsi", "0.5", "--height", "9"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("The rules of `site`: FSI 0.5, height 9 m."), std::string::npos) << done.out;
  const nlohmann::json plot = added_node(place.json("s.json"), "site")["types"]["plot"];
  EXPECT_EQ(plot["fsi_max"], 0.5);
  EXPECT_EQ(plot["polygon"], added_node(place.json("s.json"), "site")["types"]["boundary"]["plan"]);
  (void)place.run({"run", "s.json", "--json", "r.json"});
  const nlohmann::json figures = place.json("r.json");
  ASSERT_FALSE(figures["plots"].empty()) << figures.dump();
  EXPECT_EQ(figures["plots"][0]["id"], "site");
  EXPECT_LE(figures["plots"][0]["fsi"].get<double>(), 0.5 * 1.02);
  // Again sets what is there: one link, one plot.
  ASSERT_EQ(add({"rules", "--gsi", "0.4"}).code, 0);
  const nlohmann::json scene = place.json("s.json");
  EXPECT_EQ(links_of(scene, "plot_rules").size(), 1u);
  EXPECT_EQ(added_node(scene, "site")["types"]["plot"]["fsi_max"], 0.5);
  EXPECT_EQ(added_node(scene, "site")["types"]["plot"]["gsi_max"], 0.4);
}

// They are added all the same: who wants other storeys next may want the rule first.
TEST_F(Add, RulesThatNothingCanKeepAreTold) {
  const Outcome low = add({"rules", "--height", "2", "--setback", "23"});
  ASSERT_EQ(low.code, 0) << low.err;
  EXPECT_NE(low.out.find("Warning: no volume can be as low as 2 m: the lowest has 3.00 m with its least number of storeys."),
            std::string::npos)
      << low.out;
  EXPECT_NE(low.out.find("Warning: a setback of 23 m leaves nothing of `site` to build on"), std::string::npos) << low.out;
  const Outcome some = add({"rules", "--height", "3.1", "--setback", "21"});
  EXPECT_NE(some.out.find("Warning: 1 of 2 volumes cannot be as low as 3.1 m: `offices` is higher"), std::string::npos)
      << some.out;
  EXPECT_EQ(some.out.find("leaves nothing"), std::string::npos) << "2 m by 38 m are left; " << some.out;
  const Outcome sound = add({"rules", "--height", "12", "--setback", "3"});
  EXPECT_EQ(sound.out.find("Warning"), std::string::npos) << sound.out;
  const Outcome none = add({"rules", "--fsi", "0", "--gsi", "0"});
  EXPECT_NE(none.out.find("Warning: an FSI of 0 allows no floor area on `site`"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("Warning: a GSI of 0 leaves no ground of `site` to build on"), std::string::npos) << none.out;
}

TEST_F(Add, AGardenFarFromTheSiteIsTold) {
  const std::string before = place.text("s.json");
  const Outcome near = add({"garden", "--corners", "-12,40", "12,40", "12,52", "-12,52"});
  ASSERT_EQ(near.code, 0) << near.err;
  EXPECT_NE(near.out.find("The garden lies outside of the site, 18.0 m from the boundary `site`"), std::string::npos) << near.out;
  EXPECT_EQ(near.out.find("Warning"), std::string::npos) << near.out;
  place.write("s.json", before);
  const Outcome far = add({"garden", "--corners", "1000,1000", "1020,1000", "1020,1020", "1000,1020"});
  ASSERT_EQ(far.code, 0) << far.err;
  EXPECT_NE(far.out.find("Warning: the garden lies 1370 m from the boundary `site`, which is 40 m high"), std::string::npos)
      << far.out;
  place.write("s.json", before);
  EXPECT_EQ(add({"garden", "--corners", "0,0", "10,0", "10,10", "0,10"}).out.find("outside of the site"), std::string::npos);
}

TEST_F(Add, AGardenBringsItsSunAndHoldsIt) {
  const Outcome done = add({"garden", "--corners", "-12,40", "12,40", "12,52", "-12,52", "--hours", "9", "--date", "2026-06-21"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("New: the garden `garden`, 24.0 m by 12.0 m, with 9 h of sun a day on 50 % of its area."),
            std::string::npos)
      << done.out;
  const nlohmann::json scene = place.json("s.json");
  EXPECT_EQ(added_node(scene, "sun")["types"]["sun_and_sky"]["date"], "2026-06-21");
  EXPECT_TRUE(added_node(scene, "offices")["types"].contains("shadow_caster"));
  ASSERT_EQ(links_of(scene, "solar_right").size(), 1u);
  EXPECT_EQ(links_of(scene, "solar_right")[0]["from"], "garden");
  const Outcome run = place.run({"run", "s.json", "--save", "after.json"});
  EXPECT_GT(place.json("after.json")["state"]["nodes"]["garden"].value("shadow_receiver.sun_mean", 0.0), 0) << run.out << run.err;
  // A second garden takes the same sun; the first can be asked for more hours.
  ASSERT_EQ(add({"garden", "--corners", "60,0", "70,10", "60,10"}).code, 0);
  const Outcome more = add({"garden", "--id", "garden", "--hours", "4"});
  ASSERT_EQ(more.code, 0) << more.err;
  const nlohmann::json after = place.json("s.json");
  EXPECT_EQ(added_node(after, "garden")["types"]["shadow_receiver"]["required_sun"], 14400);
  EXPECT_EQ(links_of(after, "solar_right").size(), 2u);
  EXPECT_FALSE(added_node(after, "garden_2").is_null());
  EXPECT_TRUE(added_node(after, "sun_2").is_null());
}

// What is said of the sun holds for the sun that is there already.
TEST_F(Add, AGardenTakesEachOptionOfTheSun) {
  ASSERT_EQ(add({"garden", "--corners", "-12,40", "12,40", "12,52", "-12,52"}).code, 0);
  const Outcome clocks = add({"garden", "--id", "garden", "--utc-offset", "2"});
  ASSERT_EQ(clocks.code, 0) << clocks.err;
  EXPECT_NE(clocks.out.find("The sun is `sun`"), std::string::npos) << clocks.out;
  EXPECT_EQ(added_node(place.json("s.json"), "sun")["types"]["sun_and_sky"]["utc_offset"], 7200);
  const Outcome east = add({"garden", "--id", "garden", "--longitude", "5"});
  EXPECT_EQ(east.code, 2) << east.out;
  EXPECT_NE(east.err.find("both a latitude and a longitude"), std::string::npos) << east.err;
}

TEST_F(Add, AnOpenGardenTakesGroundThatCountsAsNotBuilt) {
  const auto ground = [&] {
    (void)place.run({"run", "s.json", "--ticks", "2", "--save", "after.json"});
    return place.json("after.json")["state"]["nodes"]["site"].value("boundary.ground_area", 0.0);
  };
  EXPECT_NEAR(ground(), 80 * 44, 1e-6);
  const Outcome done = add({"garden", "--corners", "0,0", "20,0", "20,10", "0,10", "--open"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("The boundary `site` leaves out its 200.0 m²: open space"), std::string::npos) << done.out;
  EXPECT_NEAR(ground(), 80 * 44 - 200, 1e-6);
  ASSERT_EQ(add({"rules", "--gsi", "0.9"}).code, 0);
  (void)place.run({"run", "s.json", "--json", "r.json"});
  const nlohmann::json plot = place.json("r.json")["plots"][0];
  EXPECT_NEAR(plot["area"].get<double>(), 80 * 44, 1e-6) << "the land stays what it is";
  EXPECT_EQ(plot["land_is"], "gross");
  EXPECT_NEAR(plot["osr"].get<double>(), (1 - plot["gsi"].get<double>()) / plot["fsi"].get<double>(), 1e-9);
  EXPECT_EQ(add({"garden", "--id", "garden", "--open"}).code, 2);
}

// What lies on another open space counts there.
TEST_F(Add, AnOpenGardenOnAnotherOneSaysWhatItDoesNotGet) {
  ASSERT_EQ(add({"garden", "--corners", "0,0", "20,0", "20,10", "0,10", "--open"}).code, 0);
  const Outcome second = add({"garden", "--corners", "15,0", "35,0", "35,10", "15,10", "--open"});
  EXPECT_NE(second.out.find("Of these, 50.0 m² were left out before, as a street or another open space, and count there"),
            std::string::npos)
      << second.out;
}

// A garden is left out wherever it lies in a boundary, whatever its corners and the boundary's form are.
TEST_F(Add, AnOpenGardenIsLeftOutWhereverItReachesIn) {
  const auto ground = [&] {
    (void)place.run({"run", "s.json", "--ticks", "2", "--save", "after.json"});
    return place.json("after.json")["state"]["nodes"]["site"].value("boundary.ground_area", 0.0);
  };
  // Across the plot, with no corner in it.
  const Outcome across = add({"garden", "--corners", "-60,-5", "60,-5", "60,5", "-60,5", "--open"});
  ASSERT_EQ(across.code, 0) << across.err;
  EXPECT_NE(across.out.find("The boundary `site` leaves out the 800.0 m² of it that lie inside, of 1200.0 m²: open space"),
            std::string::npos)
      << across.out;
  EXPECT_NEAR(ground(), 80 * 44 - 800, 1e-6);
  // Beside it, with a side in common.
  const Outcome beside = add({"garden", "--corners", "40,0", "60,0", "60,10", "40,10", "--open"});
  EXPECT_NE(beside.out.find("No boundary reaches it"), std::string::npos) << beside.out;
  // The node of the first is removed, its rows are not: the next one of the same name has its own ground alone.
  nlohmann::json scene = place.json("s.json");
  for (std::size_t i = 0; i < scene["nodes"].size(); ++i)
    if (scene["nodes"][i]["id"] == "garden") scene["nodes"].erase(i--);
  for (std::size_t i = 0; i < scene["links"].size(); ++i)
    if (scene["links"][i]["from"] == "garden") scene["links"].erase(i--);
  place.write("s.json", scene.dump());
  const Outcome again = add({"garden", "--corners", "0,0", "20,0", "20,10", "0,10", "--open"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.out.find("What it left out as `garden` before is replaced."), std::string::npos) << again.out;
  EXPECT_NEAR(ground(), 80 * 44 - 200, 1e-6);
}

TEST_F(Add, OpenGardensReachUpToTheTopOfBoundariesOfAllForms) {
  place.write("hull.json", scene_text("", "", R"({"form": "hull", "points": [[0, 0, 0], [50, 0, 0], [50, 40, 0], [0, 40, 0],
    [0, 0, 30], [50, 0, 30], [50, 40, 30], [0, 40, 30]]})"));
  place.write("steps.json", scene_text("", "", R"({"form": "plan", "height": 10, "plan": [[0, 0, 0], [50, 0, 0], [50, 40, 0],
    [0, 40, 0]], "steps": [{"name": "tower", "x": 0, "y": 0, "top": 60}, {"name": "tower", "x": 50, "y": 0},
    {"name": "tower", "x": 50, "y": 40}, {"name": "tower", "x": 0, "y": 40}]})"));
  for (const char* scene : {"hull.json", "steps.json"}) {
    const Outcome done = place.run({"add", scene, "garden", "--corners", "10,10", "20,10", "20,20", "10,20", "--open",
                                    "--latitude", "52", "--longitude", "5"});
    ASSERT_EQ(done.code, 0) << done.err;
    EXPECT_NE(done.out.find("The boundary `site` leaves out its 100.0 m²"), std::string::npos) << done.out;
    (void)place.run({"run", scene, "--ticks", "2", "--save", "after.json"});
    const nlohmann::json site = place.json("after.json")["state"]["nodes"]["site"];
    EXPECT_NEAR(site.value("boundary.ground_area", 0.0), 50 * 40 - 100, 1e-6) << scene << ": nothing hangs above the garden";
  }
}

TEST_F(Add, WhatIsWrongIsRefusedInASentenceAndNothingIsWritten) {
  const std::string before = place.text("s.json");
  const auto said = [&](std::vector<std::string> arguments) {
    const Outcome done = add(std::move(arguments));
    EXPECT_EQ(done.code, 2) << done.out;
    return done.err;
  };
  const auto has = [](const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(has(said({"rules"}), "say which rules"));
  EXPECT_TRUE(has(said({"rules", "--gsi", "2"}), "--gsi: must be between 0 and 1, found 2"));
  EXPECT_TRUE(has(said({"rules", "--plot", "sit", "--fsi", "2"}), "there is no node `sit`, did you mean `site`?"));
  EXPECT_TRUE(has(said({"rules", "--plot", "offices", "--fsi", "2"}), "neither a plot nor a boundary with a plan"));
  EXPECT_TRUE(has(said({"rules", "--corners", "1,1"}), "belongs to `garden`"));
  EXPECT_TRUE(has(said({"sun", "--date", "2026-02-30"}), "expects a day such as 2026-03-21"));
  EXPECT_TRUE(has(said({"sun", "--latitude", "50"}), "both a latitude and a longitude"));
  EXPECT_TRUE(has(said({"garden"}), "say where the garden is"));
  EXPECT_TRUE(has(said({"garden", "--corners", "1,1", "2"}), "found `2`"));
  EXPECT_TRUE(has(said({"garden", "--corners", "0,0", "9,9", "9,0", "0,9"}), "the outline meets itself at (4.50, 4.50)"));
  EXPECT_TRUE(has(said({"garden", "--corners", "0,0", "5,5", "9,9"}), "--corners"));
  EXPECT_TRUE(has(said({"garden", "--id", "nothing"}), "there is no node `nothing`"));
  EXPECT_EQ(place.text("s.json"), before);
  place.write("nowhere.json", R"({"format": "behaviourlinks", "version": 1, "nodes": [], "links": []})");
  const Outcome nowhere = place.run({"add", "nowhere.json", "sun"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_TRUE(has(nowhere.err, "no place on Earth")) << nowhere.err;
}

TEST_F(Add, UsesWithoutFiguresAreToldByNewAndByRun) {
  place.write("brief.csv", "use,floor_area_m2,count,storey_height_m\nhousing,900,1,3\ntheatre,900,1,\nobservatory,90,1,3\n");
  const Outcome made =
      place.run({"new", "--boundary", "site.geojson", "--height", "40", "--programme", "brief.csv", "--out", "u.json"});
  ASSERT_EQ(made.code, 0);
  EXPECT_NE(
      made.out.find("No figures are known of the uses `observatory`, `theatre`: their people, parking places and trips do not "
                    "count until each has a node of the type `use`."),
      std::string::npos)
      << made.out;
  EXPECT_NE(made.out.find("Rows without a storey height: 1 (`theatre`). They have 3.2 m"), std::string::npos) << made.out;
  const Outcome run = place.run({"run", "u.json"});
  EXPECT_NE(run.out.find("No figures are known of the uses `observatory`, `theatre`"), std::string::npos) << run.out;
  EXPECT_EQ(place.run({"run", "s.json"}).out.find("No figures"), std::string::npos);
}

TEST_F(Add, BriefsSayStoreysAndBlocksStandAlongTheLongestSide) {
  place.write("brief.csv", "use,floor_area_m2,count,storeys\nhousing,900,1,7\noffices,900,1,\n");
  place.write("site.geojson", R"({"type": "Polygon", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}},
      "coordinates": [[[85000,447000],[85080,447060],[85050,447100],[84970,447040],[85000,447000]]]})");
  ASSERT_EQ(
      place.run({"new", "--boundary", "site.geojson", "--height", "40", "--programme", "brief.csv", "--out", "t.json"}).code, 0);
  const nlohmann::json scene = place.json("t.json");
  const nlohmann::json housing = added_node(scene, "housing")["types"]["footprint"];
  EXPECT_EQ(housing["storeys"], 7);
  EXPECT_NEAR(housing.value("angle", 0.0), 36.87, 0.01);
  EXPECT_NE(added_node(scene, "offices")["types"]["footprint"].value("storeys", 1), 7);
  place.write("bad.csv", "use,floor_area_m2,storeys\nhousing,900,2.5\n");
  const Outcome bad =
      place.run({"new", "--boundary", "site.geojson", "--height", "40", "--programme", "bad.csv", "--out", "b.json"});
  EXPECT_EQ(bad.code, 2);
  EXPECT_NE(bad.err.find("The number of storeys is 2.5. It must be a whole number from 1 to 200, or empty."), std::string::npos)
      << bad.err;
}

}  // namespace

}  // namespace bl::test
