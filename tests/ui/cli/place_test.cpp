// `place`: what a picture says of itself becomes a proposal, and what people say goes before it.
#include <gtest/gtest.h>

#include "tests/support/photograph.h"
#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// A scene at the place of the photograph; `more` are further nodes.
std::string scene_with(const std::string& more) {
  return R"({"format": "behaviourlinks", "version": 1, "settings": {"latitude": -33.505, "longitude": 18.25}, "nodes": [{"id": "a"})" +
         more + "]}";
}

class Place : public ::testing::Test {
 protected:
  // The node that comes of the photograph, and what was told.
  nlohmann::json placed(const std::string& more, std::vector<std::string> options = {}) {
    Photograph taken;
    taken.altitude = 84.3;
    place.write("site.jpg", photograph(taken));
    place.write("scene.json", scene_with(more));
    std::vector<std::string> arguments{"place", "site.jpg", "--into", "scene.json", "--out", "out.json", "--force"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    told = outcome.out;
    const nlohmann::json scene = place.json("out.json");
    for (const auto& node : scene["nodes"])
      if (node["id"] == "site") return node;
    ADD_FAILURE() << told;
    return {};
  }
  double height(const nlohmann::json& node) { return node["position"][2].get<double>(); }

  Workplace place;
  std::string told;
};

TEST_F(Place, ProposesTheRightsThatThePictureNames) {
  const auto node = placed("");
  EXPECT_EQ(node["types"]["media"]["author"], "Ada");
  EXPECT_EQ(node["types"]["media"]["licence"], "CC BY 4.0");
  EXPECT_NE(told.find("its author is `Ada`, its licence is `CC BY 4.0`, as the file says: check it"), std::string::npos) << told;
  const auto other = placed("", {"--author", "Bea", "--licence", "all rights reserved"});
  EXPECT_EQ(other["types"]["media"]["author"], "Bea");
  EXPECT_EQ(other["types"]["media"]["licence"], "all rights reserved");
  EXPECT_EQ(told.find("as the file says"), std::string::npos) << told;
}

TEST_F(Place, StandsAtItsAltitudeWhereTheSceneKnowsTheSea) {
  const std::string sun = R"(, {"id": "sun", "types": {"sun_and_sky": {"elevation": 60}}})";
  EXPECT_NEAR(height(placed(sun)), 24.3, 1e-9);
  EXPECT_NE(told.find("84.3 m above the sea and stands there"), std::string::npos) << told;
  EXPECT_NEAR(height(placed(sun + R"(, {"id": "ground", "types": {"terrain": {}}})")), 84.3, 1e-9);
  EXPECT_NEAR(height(placed("")), 1.6, 1e-9);
  EXPECT_NE(told.find("does not say how high it lies"), std::string::npos) << told;
  EXPECT_NEAR(height(placed(sun, {"--at", "1", "2", "3"})), 3, 1e-9) << "a place by hand goes before the picture's";
}

}  // namespace

}  // namespace bl::test
