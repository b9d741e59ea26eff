// `fit`: figures that a reader can do by hand, every form of input, and what is written where demands are not met.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/reference_files.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kFitBox = R"("boundary": {"plan": [[0,0],[10,0],[10,10],[0,10]], "bottom": 0, "top": 10})";
const std::string kTwoSites = R"("sites": [[2.5,5,5],[7.5,5,5]])";

TEST(Fit, AFreeBallAndTwoHalves) {
  const Workplace place;
  place.write("i.json", "{\"cases\": [{" + kFitBox + R"(, "sites": [[5,5,5]], "demands": [8]}, {)" + kFitBox + ", " + kTwoSites +
                            R"(, "weights": [0, 0], "demands": [500, 500]}]})");
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.last_line().starts_with("2 of 2 cases met after ")) << outcome.out;
  const nlohmann::json cases = place.json("o.json")["cases"];
  EXPECT_NEAR(cases[0]["weights"][0].get<double>(), std::pow(8 * 3 / (4 * std::numbers::pi), 2.0 / 3), 1e-5);
  EXPECT_NEAR(cases[1]["weights"][0].get<double>(), cases[1]["weights"][1].get<double>(), 1e-3);
  for (const auto& each : cases) {
    EXPECT_EQ(each["status"], "met");
    EXPECT_LE(each["max_relative_error"].get<double>(), 1e-6);
    EXPECT_EQ(each["reasons"].size() + each["losses"].size(), 0u);
    EXPECT_GE(each["evaluations"].get<int>(), each["iterations"].get<int>());
  }
}

TEST(Fit, FeedbackThreadsAndToleranceAreTaken) {
  const Workplace place;
  place.write("i.json", "{" + kFitBox + ", " + kTwoSites + R"(, "demands": [100, 300]})");
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "1.json", "--method", "feedback", "--tolerance", "1e-3"}).code, 0);
  ASSERT_EQ(
      place.run({"fit", "i.json", "--json", "2.json", "--method", "feedback", "--tolerance", "1e-3", "--threads", "2"}).code, 0);
  EXPECT_EQ(place.text("1.json"), place.text("2.json"));
  EXPECT_NEAR(place.json("1.json")["volumes"][1].get<double>(), 300, 0.3);
}

TEST(Fit, WeightsThatWereWrittenMeetAtOnceAndMeasureTheSame) {
  const Workplace place;
  const std::string demands = R"(, "demands": [120, 340])";
  place.write("i.json", "{" + kFitBox + ", " + kTwoSites + demands + "}");
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  const nlohmann::json fit = place.json("o.json");
  place.write("again.json", "{" + kFitBox + ", " + kTwoSites + demands + ", \"weights\": " + fit["weights"].dump() + "}");
  ASSERT_EQ(place.run({"fit", "again.json", "--json", "again.out"}).code, 0);
  EXPECT_EQ(place.json("again.out")["evaluations"], 1);
  EXPECT_EQ(place.json("again.out")["weights"], fit["weights"]);
  ASSERT_EQ(place.run({"cells", "again.json", "--json", "c.json"}).code, 0);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(place.json("c.json")["cells"][i]["volume"].get<double>(), fit["volumes"][i].get<double>(), 1e-9);
}

TEST(Fit, GroupsAndLocks) {
  const Workplace place;
  place.write("i.json", "{" + kFitBox + R"(, "sites": [[2,5,5],[5,5,5],[8,5,5],[5,9,9]], "weights": [0,0,1,0.5],
    "demands": [200], "groups": [[0, 1]], "locked": [2]})");
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  const nlohmann::json fit = place.json("o.json");
  EXPECT_NEAR(fit["volumes"][0].get<double>() + fit["volumes"][1].get<double>(), 200, 2e-4);
  EXPECT_EQ(fit["weights"][2], 1.0) << "locked";
  EXPECT_EQ(fit["weights"][3], 0.5) << "in no group";
  place.write("i.json", "{" + kFitBox + ", " + kTwoSites + R"(, "weights": [0, 4], "demands": [200, null], "locked": [1]})");
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_EQ(place.json("o.json")["weights"][1], 4.0);
  EXPECT_NEAR(place.json("o.json")["volumes"][0].get<double>(), 200, 2e-4);
}

TEST(Fit, IntervalsAndFloorAreas) {
  const Workplace place;
  place.write("i.json", "{" + kFitBox + R"(, "sites": [[2,5,5],[8,5,5],[5,9,9]],
    "demands": [{"min": 100, "max": 120}, {"max": 90}, {"min": 20}]})");
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  const nlohmann::json volumes = place.json("o.json")["volumes"];
  EXPECT_GE(volumes[0].get<double>(), 100 * (1 - 1e-6));
  EXPECT_LE(volumes[0].get<double>(), 120 * (1 + 1e-6));
  EXPECT_LE(volumes[1].get<double>(), 90 * (1 + 1e-6));
  EXPECT_GE(volumes[2].get<double>(), 20 * (1 - 1e-6));
  place.write("i.json", "{" + kFitBox + ", " + kTwoSites +
                            R"(, "demands": [{"floor_area": {"min": 60, "max": 80}, "storey_height": 2.5}, 100]})");
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Fit, TooMuchIsWrittenWithItsLosses) {
  const Workplace place;
  place.write("i.json", "{" + kFitBox + ", " + kTwoSites + R"(, "demands": [900, 600]})");
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_TRUE(outcome.err.starts_with("i.json: ")) << outcome.err;
  EXPECT_TRUE(outcome.last_line().starts_with("infeasible after ")) << outcome.out;
  EXPECT_NE(outcome.out.find("900.000 m³  600.000 m³"), std::string::npos) << outcome.out;
  const nlohmann::json fit = place.json("o.json");
  EXPECT_EQ(fit["status"], "infeasible");
  EXPECT_GE(fit["reasons"].size(), 1u);
  ASSERT_EQ(fit["losses"].size(), 2u);
  EXPECT_EQ(fit["losses"][0]["sites"], nlohmann::json::array({fit["losses"][0]["demand"]}));
  for (const auto& loss : fit["losses"]) EXPECT_GT(loss["wanted"].get<double>(), loss["had"].get<double>());
  EXPECT_NEAR(fit["volumes"][0].get<double>() + fit["volumes"][1].get<double>(), 1000, 1);
}

TEST(Fit, TablesAsPeopleWriteThem) {
  const Workplace place;
  place.write("box.json", "{" + kFitBox + "}");
  const std::string json = "{" + kFitBox + ", " + kTwoSites + R"(, "demands": [120.5, 340]})";
  place.write("i.json", json);
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "wanted.json"}).code, 0);
  for (const std::string table :
       {"x,y,z,weight,demand\n2.5,5,5,0,120.5\n7.5,5,5,,340\n",
        "\xEF\xBB\xBF\"demand\",z,y,x\r\n120.5,5,5,2.5\r\n340,5,5,7.5\r\n",
        "Name;X [m];Y_m;Z;Demand (m³)\ntower;2,5;5;5;120,5\nhall;7,5;5;5;340\n",
        "id\teasting\tnorthing\televation\ttarget_volume\n1\t250 cm\t5\t5\t120.5 m3\n2\t7.5\t5\t5\t340\n"}) {
    place.write("t.csv", table);
    const Outcome outcome = place.run({"fit", "t.csv", "--json", "o.json", "--boundary", "box.json"});
    ASSERT_EQ(outcome.code, 0) << table << outcome.err;
    EXPECT_EQ(place.text("o.json"), place.text("wanted.json")) << table;
  }
  place.write("g.csv", "x,y,z,demand,demand_min,group,weight\n2,5,5,200,,wings,\n8,5,5,,,wings,\n5,9,9,,50,,\n5,1,1,,,,0.25\n");
  // A whole case lends its boundary, too.
  ASSERT_EQ(place.run({"fit", "g.csv", "--json", "o.json", "--boundary", "i.json"}).code, 0);
  const nlohmann::json fit = place.json("o.json");
  EXPECT_NEAR(fit["volumes"][0].get<double>() + fit["volumes"][1].get<double>(), 200, 2e-4);
  EXPECT_GE(fit["volumes"][2].get<double>(), 50 * (1 - 1e-6));
  EXPECT_EQ(fit["weights"][3], 0.25);
  place.write("c.csv", "x,y,z,radius\n2.5,5,5,2\n");
  ASSERT_EQ(place.run({"cells", "c.csv", "--json", "c.json", "--boundary", "box.json"}).code, 0);
  EXPECT_NEAR(place.json("c.json")["cells"][0]["volume"].get<double>(), 4.0 / 3 * std::numbers::pi * 8, 1e-12);
}

TEST(Fit, BoundariesOfAllFormsAreOne) {
  const Workplace place;
  const std::string rest = ", " + kTwoSites + R"(, "weights": [4, 9], "demands": [100, 300]})";
  for (const std::string boundary :
       {R"({"planes": [[-1,0,0,0],[1,0,0,10],[0,-2,0,0],[0,1,0,10],[0,0,-1,0],[0,0,1,10]]})",
        R"({"vertices": [[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],[10,0,10],[10,10,10],[0,10,10]], "volume": "any"})",
        R"({"plan": [[0,10],[10,10],[10,0],[0,0]], "holes": [], "bottom": 0, "top": 10})",
        R"({"mesh": {"vertices": [[0,0,0],[10,0,0],[10,10,0],[0,10,0],[0,0,10],[10,0,10],[10,10,10],[0,10,10]],
          "triangles": [[0,2,1],[0,3,2],[4,5,6],[4,6,7],[0,1,5],[0,5,4],[1,2,6],[1,6,5],[2,3,7],[2,7,6],[3,0,4],[3,4,7]]}})"}) {
    place.write("i.json", "{\"boundary\": " + boundary + rest);
    Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
    ASSERT_EQ(outcome.code, 0) << boundary << outcome.err;
    EXPECT_NEAR(place.json("o.json")["volumes"][1].get<double>(), 300, 3e-4);
    outcome = place.run({"cells", "i.json", "--json", "c.json"});
    ASSERT_EQ(outcome.code, 0) << boundary << outcome.err;
    EXPECT_EQ(place.json("c.json").contains("planes"), boundary.find("planes") == std::string::npos);
  }
}

TEST(Fit, PlansThatAreNotConvex) {
  const Workplace place;
  place.write("i.json", R"({"boundary": {"plan": [[0,0],[10,0],[10,5],[5,5],[5,10],[0,10]],
    "holes": [[[1,1],[3,1],[3,3],[1,3]]], "bottom": 0, "top": 10}, "sites": [[8,2,5],[2,8,5]], "weights": [400, 400], "demands": [355, 355]})");
  ASSERT_EQ(place.run({"cells", "i.json", "--json", "c.json"}).code, 0);
  const nlohmann::json cells = place.json("c.json");
  EXPECT_NEAR(cells["cells"][0]["volume"].get<double>() + cells["cells"][1]["volume"].get<double>(), 710, 1e-9);
  EXPECT_EQ(cells["planes"].size(), 12u) << "bottom, top, six walls and four of the hole";
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST(Fit, MeshesThatAreNotConvex) {
  const Workplace place;
  // A prism over an arrowhead: 1 is the notch.
  place.write("i.json", R"({"boundary": {"mesh": {
    "vertices": [[0,0,0],[5,3,0],[10,0,0],[5,10,0],[0,0,2],[5,3,2],[10,0,2],[5,10,2]],
    "triangles": [[0,3,1],[1,3,2],[4,5,7],[5,6,7],[0,1,5],[0,5,4],[1,2,6],[1,6,5],[2,3,7],[2,7,6],[3,0,4],[3,4,7]]}},
    "sites": [[2.5,3,1],[7.5,3,1]], "weights": [400, 400], "demands": [20, 30]})");
  ASSERT_EQ(place.run({"cells", "i.json", "--json", "c.json"}).code, 0);
  const nlohmann::json cells = place.json("c.json")["cells"];
  EXPECT_NEAR(cells[0]["volume"].get<double>() + cells[1]["volume"].get<double>(), 70, 1e-9);
  EXPECT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
}

TEST(Fit, StrangeButSoundInputIsAnswered) {
  const Workplace place;
  for (const std::string rest :
       {R"("sites": [[20,5,5],[25,5,5]], "demands": [100, 100])", R"("sites": [[1e8,5,5],[-1e8,5,5]], "demands": [100, 100])",
        R"("sites": [[0,0,0],[10,10,10]], "demands": [100, 100])", R"("sites": [[5,5,5],[5,5,5.000001]], "demands": [100, 100])",
        R"("sites": [[2,5,5],[8,5,5]], "demands": [1e-12, 999.99])", R"("sites": [[2,5,5],[8,5,5]], "demands": [0, 10])",
        R"("sites": [[2,5,5],[8,5,5]], "demands": [500, 500])", R"("sites": [[2,5,5],[8,5,5]], "demands": [{"min": 0}, 10])",
        R"("sites": [[2,5,5],[8,5,5]], "weights": [1e18, -1e18], "demands": [10, 10])",
        R"("sites": [[2,5,5],[8,5,5]], "weights": [1e18, 1], "demands": [null, 10], "locked": [0])"})
    for (const char* method : {"newton", "feedback"}) {
      place.write("i.json", "{" + kFitBox + ", " + rest + "}");
      const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json", "--method", method});
      EXPECT_TRUE(outcome.code == 0 || outcome.code == 3) << rest << "\n" << outcome.err;
      EXPECT_EQ(outcome.code == 3, outcome.err.starts_with("i.json: ")) << rest << "\n" << outcome.err;
      const nlohmann::json fit = place.json("o.json");
      EXPECT_EQ(outcome.code == 0, fit["status"] == "met") << rest;
      for (const char* list : {"weights", "volumes"})
        for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(fit[list].at(i).is_number()) << rest << list;
    }
}

TEST(Fit, InterruptWritesEveryCase) {
  const Workplace place;
  std::string cases, sites, demands;
  for (int i = 0; i < 400; ++i) {
    const auto part = [&](int step) { return std::to_string(0.1 + 9.8 * ((i * step) % 401) / 401.0); };
    sites += (i > 0 ? ", [" : "[") + part(17) + "," + part(71) + "," + part(173) + "]";
    demands += i > 0 ? ", 2.4" : "2.4";
  }
  const std::string one = "{" + kFitBox + ", \"sites\": [" + sites + "], \"demands\": [" + demands + "]}";
  // Read in no time, fitted in a minute: the signal comes in between, on slow machines too.
  for (int i = 0; i < 20; ++i) cases += (i > 0 ? ",\n" : "") + one;
  place.write("i.json", "{\"cases\": [" + cases + "]}");
  const Outcome outcome = place.shell(
      "timeout --preserve-status -s INT 1.5 \"$BEHAVIOURLINKS\" fit i.json --json o.json --tolerance 1e-15 --steps 1000 --method "
      "feedback");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  const nlohmann::json fits = place.json("o.json")["cases"];
  ASSERT_EQ(fits.size(), 20u);
  EXPECT_EQ(fits.back()["status"], "cancelled");
  EXPECT_EQ(fits.back()["weights"].size(), 400u);
  // Of cases that were not begun nobody knows the error, so that there is no largest one.
  EXPECT_TRUE(fits.back()["max_relative_error"].is_null());
  EXPECT_EQ(outcome.last_line().find("largest relative error"), std::string::npos) << outcome.last_line();
}

TEST(Fit, TheReferenceFileIsReadAsItIs) {
  const Workplace place;
  for (const auto& file : reference_files("fits")) {
    const Outcome outcome = place.run({"fit", file.string(), "--json", "o.json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const nlohmann::json wanted = nlohmann::json::parse(read_text(file))["cases"], found = place.json("o.json")["cases"];
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t c = 0; c < wanted.size(); ++c)
      for (std::size_t i = 0; i < wanted[c]["demands"].size(); ++i) {
        const double demand = wanted[c]["demands"][i];
        EXPECT_NEAR(found[c]["volumes"].at(i).get<double>(), demand, 1e-5 * demand) << wanted[c]["name"] << " " << i;
      }
  }
}

}  // namespace

}  // namespace bl::test
