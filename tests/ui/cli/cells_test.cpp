// `cells`: figures that a reader can do by hand, agreement with independent values, and bad input.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/reference_files.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

constexpr const char* kCube =
    R"("boundary": {"planes": [[-2, 0, 0, 0], [1, 0, 0, 1], [0, -1, 0, 0], [0, 1, 0, 1], [0, 0, -1, 0], [0, 0, 1, 1]]})";

TEST(Cells, BallAndHalfCubes) {
  const Workplace place;
  place.write("i.json", std::string("{\"cases\": [{") + kCube + R"(, "sites": [[0.5, 0.5, 0.5]], "weights": [0.04]}, {)" + kCube +
                            R"(, "sites": [[0.25, 0.5, 0.5], [0.75, 0.5, 0.5]], "weights": [9, 9]}]})");
  const Outcome outcome = place.run({"cells", "i.json", "--json", "o.json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json cases = place.json("o.json")["cases"];
  EXPECT_NEAR(cases[0]["cells"][0]["volume"].get<double>(), 4.0 / 3 * std::numbers::pi * 0.008, 1e-15);
  EXPECT_NEAR(cases[0]["cells"][0]["cell_volume"].get<double>(), 1, 1e-15);
  EXPECT_NEAR(cases[1]["cells"][0]["volume"].get<double>(), 0.5, 1e-15);
  EXPECT_NEAR(cases[1]["cells"][0]["surface_area"].get<double>(), 4, 1e-15);
  EXPECT_NEAR(cases[1]["cells"][0]["facet_areas"]["site:1"].get<double>(), 1, 1e-15);
  EXPECT_NEAR(cases[1]["cells"][0]["facet_areas"]["plane:0"].get<double>(), 1, 1e-15);
  EXPECT_FALSE(cases[1]["cells"][0]["facet_areas"].contains("plane:1"));
  EXPECT_EQ(cases[1]["cells"][0]["state"], "alive");
}

TEST(Cells, ComplexNamesWhatLiesBetweenTheCells) {
  const Workplace place;
  place.write("i.json", std::string("{") + kCube + R"(, "sites": [[0.25, 0.5, 0.5], [0.75, 0.5, 0.5]], "weights": [9, 9]})");
  ASSERT_EQ(place.run({"cells", "i.json", "--json", "o.json", "--complex"}).code, 0);
  const nlohmann::json complex = place.json("o.json")["complex"];
  EXPECT_EQ(complex["vertices"].size(), 12u);
  EXPECT_EQ(complex["edges"].size(), 20u);
  EXPECT_EQ(complex["facets"].size(), 11u);
  EXPECT_EQ(complex["facets"][0]["name"], "{0,1}");
  EXPECT_NEAR(complex["facets"][0]["area"].get<double>(), 1, 1e-15);
  EXPECT_EQ(complex["facets"][0]["edges"], nlohmann::json::parse(R"(["{0,1,#2}", "{0,1,#3}", "{0,1,#4}", "{0,1,#5}"])"));
  EXPECT_EQ(complex["facets"][0]["polygons"][0].size(), 4u);
  EXPECT_EQ(complex["vertices"][0], nlohmann::json::parse(R"({"name": "{0,1,#2,#4}", "position": [0.5, 0, 0]})"));
  ASSERT_EQ(place.run({"cells", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_FALSE(place.json("o.json").contains("complex"));
}

TEST(Cells, VerticesGiveThePlanesThatWereFound) {
  const Workplace place;
  place.write(
      "i.json",
      R"({"boundary": {"vertices": [[0,0,0],[2,0,0],[2,2,0],[0,2,0],[1,1,3]]}, "sites": [[0.3, 0.3, 0.3]], "weights": [100]})");
  ASSERT_EQ(place.run({"cells", "i.json", "--json", "o.json"}).code, 0);
  EXPECT_EQ(place.json("o.json")["planes"].size(), 5u);
  EXPECT_NEAR(place.json("o.json")["cells"][0]["volume"].get<double>(), 4, 1e-14);
}

void expect_values_of(const std::filesystem::path& file) {
  const Workplace place;
  ASSERT_EQ(place.run({"cells", file.string(), "--json", "o.json"}).code, 0);
  const nlohmann::json wanted = nlohmann::json::parse(read_text(file))["cases"], found = place.json("o.json")["cases"];
  const auto expect_near = [](double a, double b, const std::string& what) {
    EXPECT_NEAR(a, b, 1e-11 * std::max(std::abs(a), 1e-6)) << what;
  };
  for (std::size_t c = 0; c < wanted.size(); ++c)
    for (const auto& cell : wanted[c]["cells"]) {
      const auto& ours = found[c]["cells"][cell["site"].get<std::size_t>()];
      const std::string name = wanted[c]["name"];
      expect_near(std::stod(cell["volume"].get<std::string>()), ours["volume"], name);
      expect_near(std::stod(cell["spherical_area"].get<std::string>()), ours["spherical_area"], name);
      for (const auto& [facet, area] : cell["facet_areas"].items())
        expect_near(std::stod(area.get<std::string>()), ours["facet_areas"].value(facet, 0.0), name + " " + facet);
    }
}

TEST(Cells, AgreesWithIndependentValues) {
  for (const auto& file : reference_files("cells")) expect_values_of(file);
}

TEST(Cells, BadInputHasAPlace) {
  const Workplace place;
  const std::string cube = std::string("{") + kCube;
  for (
      const auto& [text, said] :
      {std::pair<std::string, const char*>{R"({"cases": [)" + cube + R"(, "sites": [[0, 0, 0]], "weights": [1]}, )" + cube +
                                               R"(, "sites": [[0, 0, 0], [0, "x", 0]], "weights": [1, 1]}]})",
                                           "i.json: cases/1/sites/1/1: expects a finite number"},
       {cube + R"(, "sites": [[0, 0, null]], "weights": [1]})", "i.json: sites/0/2: "},
       {cube + R"(, "sites": [[0, 0, NaN]], "weights": [1]})", "i.json: line "},
       {cube + R"(, "sites": [[0, 0, 1e300]], "weights": [1]})", "i.json: "},
       {cube + R"(, "sites": [[0, 0, 0]], "weights": [1, 2]})", "i.json: weights: there are 1 site, but 2 weights"},
       {cube + R"(, "sites": [[0, 0, 0]]})", "i.json: weights: `weights` is missing"},
       {R"({"boundary": {"vertices": [[0,0,0],[1,0,0],[0,1,0]]}, "sites": [], "weights": []})", "i.json: boundary/vertices: "},
       {R"({"boundary": {"planes": [[1,0,0,1]]}, "sites": [], "weights": []})", "i.json: boundary/planes: "},
       {R"({"boundary": {"plan": [[0,0],[9,0],[9,9]], "bottom": 0, "top": 9, "setbacks": [[1,0,1,9]]}, "sites": [], "weights": []})",
        "i.json: boundary/setbacks: is not read here"},
       {R"({"boundary": {}, "sites": [], "weights": []})", "i.json: boundary: expects `planes`, `vertices`, `plan` or `mesh`"}}) {
    place.write("i.json", text);
    const Outcome outcome = place.run({"cells", "i.json", "--json", "o.json"});
    EXPECT_EQ(outcome.code, 2) << text;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << text << "\n" << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(place.path("o.json")));
  }
}

}  // namespace

}  // namespace bl::test
