// `import` into scenes that say where they lie by latitude, longitude and true north alone: nothing of that changes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/ui/cli/program.h"

namespace bl::test {

namespace {

// A hundredth of a degree north of the scene's origin, and 0.0002 degrees long.
constexpr const char* kHouseNorth =
    R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"gid": "north", "height": 9}, "geometry":
      {"type": "Polygon", "coordinates": [[[4.9999,52.0099],[5.0001,52.0099],[5.0001,52.0101],[4.9999,52.0101],[4.9999,52.0099]]]}}]})";

class ImportPlace : public testing::Test {
 protected:
  ImportPlace() { place.write("house.geojson", kHouseNorth); }
  void write_scene_at(const std::string& settings) {
    place.write("s.json", R"({"format": "behaviourlinks", "version": 1, "settings": {)" + settings + R"(}, "nodes": [
      {"id": "site", "types": {"boundary": {"form": "plan", "height": 20, "plan": [[0, 0, 0], [50, 0, 0], [50, 40, 0], [0, 40, 0]]}}}],
      "links": []})");
  }
  Workplace place;
};

TEST_F(ImportPlace, LatitudeAndLongitudeStayAndFilesComeToThem) {
  write_scene_at(R"("latitude": 52, "longitude": 5, "true_north": 30)");
  const Outcome done = place.run({"import", "house.geojson", "--into", "s.json", "--out", "a.json"});
  ASSERT_EQ(done.code, 0) << done.err;
  const nlohmann::json settings = place.json("a.json")["settings"];
  EXPECT_EQ(settings["latitude"], 52);
  EXPECT_EQ(settings["longitude"], 5);
  EXPECT_EQ(settings["true_north"], 30);
  EXPECT_FALSE(settings.contains("coordinate_system"));
  EXPECT_EQ(done.out.find("no place on Earth"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("The scene has no coordinate system: the files lie in it by its latitude, longitude and true north."),
            std::string::npos)
      << done.out;
  // 1112.6 m to the true north, which lies 30 degrees clockwise from y.
  const nlohmann::json house = place.json("a.json")["nodes"][0];
  ASSERT_EQ(house["id"], "building_north");
  EXPECT_NEAR(house["position"][0].get<double>(), 1112.6 * 0.5, 0.5);
  EXPECT_NEAR(house["position"][1].get<double>(), 1112.6 * std::sqrt(0.75), 0.5);
  // Again, nothing moves.
  ASSERT_EQ(place.run({"import", "house.geojson", "--into", "a.json", "--out", "b.json"}).code, 0);
  EXPECT_EQ(place.text("a.json"), place.text("b.json"));
  const Outcome origin = place.run({"import", "house.geojson", "--into", "s.json", "--origin", "5,52", "--out", "c.json"});
  EXPECT_EQ(origin.code, 2);
  EXPECT_NE(origin.err.find("the scene lies at latitude 52°, longitude 5° already"), std::string::npos) << origin.err;
}

TEST_F(ImportPlace, ScenesWithoutAnyPlaceGetThatOfTheFile) {
  write_scene_at("");
  const Outcome done = place.run({"import", "house.geojson", "--into", "s.json", "--out", "a.json"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("The scene had no place on Earth"), std::string::npos) << done.out;
  EXPECT_NEAR(place.json("a.json")["settings"]["latitude"].get<double>(), 52.01, 1e-3);
}

}  // namespace

}  // namespace bl::test
