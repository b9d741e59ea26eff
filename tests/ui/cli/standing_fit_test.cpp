// `fit` of volumes that stand: figures by hand, what is written, and bad input with its place.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

const std::string kStandingPlot = R"("boundary": {"plan": [[0,0],[60,0],[60,60],[0,60]], "bottom": 0, "top": 30})";

std::string standing_case(const std::string& sites, const std::string& demands, const std::string& form,
                          const std::string& more = "") {
  return "{" + kStandingPlot + ", \"sites\": " + sites + ", \"demands\": " + demands + ", \"form\": {" + form + "}" +
         (more.empty() ? "" : ", " + more) + "}";
}

TEST(StandingFit, ADiscHasItsFloorsAndItsVolume) {
  const Workplace place;
  const std::string form = R"("kind": "round", "storeys": [3], "storey_height": 4, "setbacks": [0, 2])";
  place.write("i.json", standing_case("[[30,30,0]]", R"([{"floor_area": 500}])", form));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  nlohmann::json fit = place.json("o.json");
  EXPECT_EQ(fit["status"], "met");
  const nlohmann::json& site = fit["sites"][0];
  const double radius = std::sqrt(site["weight"].get<double>());
  EXPECT_EQ(site["weight"], fit["weights"][0]);
  ASSERT_EQ(site["plates"].size(), 3u);
  EXPECT_NEAR(site["plates"][0].get<double>(), std::numbers::pi * radius * radius, 1e-9);
  EXPECT_NEAR(site["plates"][1].get<double>(), std::numbers::pi * (radius - 2) * (radius - 2), 1e-9);
  EXPECT_EQ(site["plates"][2], site["plates"][1]) << "the last set-back holds on";
  EXPECT_NEAR(site["floor_area"].get<double>(), 500, 5e-4);
  EXPECT_NEAR(fit["volumes"][0].get<double>(), 2000, 2e-3);
  place.write("i.json", standing_case("[[30,30,0]]", "[2000]", form));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_NEAR(place.json("o.json")["sites"][0]["floor_area"].get<double>(), 500, 5e-4) << "2000 m³ in storeys of 4 m";
}

TEST(StandingFit, BlocksHaveTheirAspectAndCourtyardsTheirDepth) {
  const Workplace place;
  place.write("i.json", standing_case("[[30,30,0]]", R"([{"floor_area": 800}])",
                                      R"("kind": "block", "storeys": [1], "aspect": 2, "angle": 30, "depth": null)"));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_NEAR(place.json("o.json")["weights"][0].get<double>(), 200, 1e-3) << "4 w: 40 m by 20 m";
  place.write("i.json", standing_case("[[30,30,0]]", R"([{"floor_area": 1000}])",
                                      R"("kind": "block", "storeys": [2], "aspect": 2, "depth": 5)"));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  const double a = 2 * std::sqrt(2 * place.json("o.json")["weights"][0].get<double>());
  EXPECT_NEAR(a * (a / 2) - (a - 10) * (a / 2 - 10), 500, 1e-3);
}

TEST(StandingFit, GroupsLocksIntervalsAndThreads) {
  const Workplace place;
  const std::string form = R"("kind": "round", "storeys": [2, 3, 1, 4], "setbacks": [0, 1], "depth": 6)";
  const std::string sites = "[[12,15,0],[30,18,0],[45,40,0],[15,45,0]]";
  place.write("i.json", standing_case(sites, R"([{"floor_area": 900}, {"floor_area": {"max": 300}}])", form,
                                      R"("groups": [[0, 1], [2]], "weights": [0, 0, 0, 36])"));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  const nlohmann::json fit = place.json("o.json");
  EXPECT_NEAR(fit["sites"][0]["floor_area"].get<double>() + fit["sites"][1]["floor_area"].get<double>(), 900, 1e-3);
  EXPECT_LE(fit["sites"][2]["floor_area"].get<double>(), 300.001);
  EXPECT_EQ(fit["weights"][3], 36.0) << "in no group";
  place.write("i.json", standing_case(sites, R"([{"floor_area": 500}, {"floor_area": {"min": 400}}, 300, null])", form,
                                      R"("locked": [3], "weights": [0, 0, 0, 36])"));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "1.json"}).code, 0);
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "2.json", "--threads", "3"}).code, 0);
  EXPECT_EQ(place.text("1.json"), place.text("2.json"));
  EXPECT_EQ(place.json("1.json")["weights"][3], 36.0);
  EXPECT_GE(place.json("1.json")["sites"][1]["floor_area"].get<double>(), 399.999);
  EXPECT_NEAR(place.json("1.json")["volumes"][2].get<double>(), 300, 1e-3);
}

TEST(StandingFit, WhatCannotBeMetSaysWhoGoesShort) {
  const Workplace place;
  place.write("i.json", standing_case("[[15,30,0],[45,30,0]]", R"([{"floor_area": 6000}, {"floor_area": 2000}])",
                                      R"("kind": "round", "storeys": [2, 2])"));
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  EXPECT_EQ(outcome.code, 3) << outcome.out;
  EXPECT_NE(outcome.err.find("the demands cannot be met together"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("short by %"), std::string::npos) << outcome.out;
  const nlohmann::json fit = place.json("o.json");
  EXPECT_EQ(fit["status"], "infeasible");
  ASSERT_EQ(fit["losses"].size(), 2u);
  EXPECT_EQ(fit["losses"][0]["wanted"], 6000.0);
  EXPECT_EQ(fit["losses"][0]["had"], fit["sites"][0]["floor_area"]);
}

TEST(StandingFit, AStoreyThatIsEatenHasASentence) {
  const Workplace place;
  place.write("i.json", standing_case("[[30,30,0]]", R"([{"floor_area": 30}])",
                                      R"("kind": "round", "storeys": [4], "setbacks": [0, 1, 6])"));
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  ASSERT_EQ(outcome.code, 0);
  const std::string said = "storey 3 of site 0 has no floor: its set-back of 6 m leaves nothing of the footprint";
  EXPECT_NE(outcome.out.find("note: i.json: " + said), std::string::npos) << outcome.out;
  const nlohmann::json fit = place.json("o.json");
  EXPECT_EQ(fit["notes"][0], said);
  EXPECT_EQ(fit["sites"][0]["plates"][2], 0.0);
}

TEST(StandingFit, ADemandForNothingNeedsNoWeight) {
  const Workplace place;
  place.write("i.json", standing_case("[[15,30,0],[45,30,0]]", R"([{"floor_area": 0}, {"floor_area": 200}])",
                                      R"("kind": "round", "storeys": [2, 2])", R"("weights": [9, 9])"));
  ASSERT_EQ(place.run({"fit", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_EQ(place.json("o.json")["sites"][0]["floor_area"], 0.0);
}

TEST(StandingFit, ADepthBeyondThePlotIsNoted) {
  const Workplace place;
  place.write("i.json",
              standing_case("[[30,30,0]]", R"([{"floor_area": 300}])", R"("kind": "round", "storeys": [2], "depth": 80)"));
  const Outcome outcome = place.run({"fit", "i.json", "--json", "o.json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("note: i.json: form/depth: 80 m leaves no courtyard anywhere"), std::string::npos) << outcome.out;
}

struct BadForm {
  std::string name, text, said;
  std::vector<std::string> options = {};
};

TEST(StandingFit, BadFormsAreNamedWithTheirPlace) {
  const std::string two = "[[15,30,0],[45,30,0]]", demands = "[600, 600]";
  const auto with = [&](const std::string& form) { return standing_case(two, demands, form); };
  const auto more = [&](const std::string& field) { return with(R"("kind": "round", "storeys": [2, 4], )" + field); };
  const std::vector<BadForm> rows{
      {"no_object", "{" + kStandingPlot + ", \"sites\": " + two + ", \"demands\": " + demands + ", \"form\": \"round\"}",
       "form: expects {\"kind\""},
      {"misspelt_form", "{" + kStandingPlot + ", \"sites\": " + two + ", \"demands\": " + demands + ", \"forms\": {}}",
       "forms: unknown field, did you mean `form`?"},
      {"unknown_field", more(R"("setback": [1])"), "form/setback: unknown field, did you mean `setbacks`?"},
      {"kind_missing", with(R"("storeys": [1, 1])"), "form/kind: `kind` is missing: round, block or cell"},
      {"kind_unknown", with(R"("kind": "ball", "storeys": [1, 1])"), "form/kind: expects \"round\", \"block\" or \"cell\""},
      {"storeys_missing", with(R"("kind": "round")"), "form/storeys: `storeys` is missing"},
      {"storeys_of_one_site", with(R"("kind": "round", "storeys": [1])"),
       "form/storeys: expects the number of storeys of each site: 2 sites, 1 number"},
      {"no_storey", with(R"("kind": "round", "storeys": [1, 0])"), "form/storeys/1: must be a whole number of storeys"},
      {"half_a_storey", with(R"("kind": "round", "storeys": [1.5, 1])"), "form/storeys/0: must be a whole number of storeys"},
      {"too_many_storeys", with(R"("kind": "round", "storeys": [1, 1e9])"), "form/storeys/1: must be a whole number of storeys"},
      {"storey_as_text", with(R"("kind": "round", "storeys": [1, "2"])"), "form/storeys/1: expects a finite number"},
      {"flat_storeys", more(R"("storey_height": 0)"), "form/storey_height: must be a length above 0"},
      {"setback_outwards", more(R"("setbacks": [0, -1])"), "form/setbacks/1: a set-back is 0 or more"},
      {"setback_as_number", more(R"("setbacks": 2)"), "form/setbacks: expects a list"},
      {"setback_beyond_the_plot", more(R"("setbacks": [0, 1, 30])"),
       "form/setbacks/2: storey 3 of site 1 has no floor: a set-back of 30 m leaves nothing of the plot"},
      {"no_depth", more(R"("depth": 0)"), "form/depth: must be a length above 0"},
      {"negative_depth", more(R"("depth": -4)"), "form/depth: must be a length above 0"},
      {"not_a_number", more(R"("depth": NaN)"), "i.json: line 1"},
      {"endless_number", more(R"("angle": 1e999)"), "i.json: line 1"},
      {"angle_as_text", more(R"("angle": "30")"), "form/angle: expects a finite number"},
      {"no_aspect", more(R"("aspect": 0)"), "form/aspect: must be first side / second side, from 0.001 to 1000, found 0"},
      {"storeys_of_two_heights",
       standing_case(two, R"([{"floor_area": 300, "storey_height": 4}, 1])", R"("kind": "round", "storeys": [2, 2])"),
       "demands/0/storey_height: is 4 here and 3 in `form`: leave it out here"},
      {"feedback",
       more(R"("depth": 8)"),
       "form: volumes that stand are fitted by Newton's method only",
       {"--method", "feedback"}},
      {"in_a_list", "{\"cases\": [" + more(R"("depth": 8)") + ", " + more(R"("depth": 0)") + "]}", "cases/1/form/depth: "}};
  for (const BadForm& row : rows) {
    const Workplace place;
    place.write("i.json", row.text);
    std::vector<std::string> arguments{"fit", "i.json", "--json", "o.json"};
    arguments.insert(arguments.end(), row.options.begin(), row.options.end());
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 2) << row.name << ": " << outcome.out;
    EXPECT_NE(outcome.err.find(row.said), std::string::npos) << row.name << ": " << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(place.path("o.json"))) << row.name;
  }
}

}  // namespace

}  // namespace bl::test
