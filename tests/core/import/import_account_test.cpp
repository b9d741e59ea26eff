// Accounts that say the truth: corners follow their ways, a broken feature is one row, and models need no place on Earth.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/import/cityjson_context.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/osm_context.h"
#include "core/import/plan_boundary.h"
#include "core/import/plan_cover.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::in_crs, test::reason_of, test::rows_of;

// Nodes 1 to 9 on a grid, from the south-west.
std::string account_map(const std::string& elements) {
  std::string text = R"(<?xml version="1.0"?><osm version="0.6">)";
  for (int i = 0; i < 9; ++i)
    text += "<node id=\"" + std::to_string(i + 1) + "\" lat=\"" + std::to_string(60 + 0.001 * (i / 3)) + "\" lon=\"" +
            std::to_string(25 + 0.001 * (i % 3)) + "\"/>";
  return text + elements + "</osm>";
}
std::string account_way(int id, std::initializer_list<int> nodes, const std::string& key, const std::string& value) {
  std::string text = "<way id=\"" + std::to_string(id) + "\">";
  for (const int node : nodes) text += "<nd ref=\"" + std::to_string(node) + "\"/>";
  return text + "<tag k=\"" + key + "\" v=\"" + value + "\"/></way>";
}

TEST(ImportAccount, CornersCountAsTakenWhereAWayThatUsesThemWas) {
  const auto context = read_osm_context(account_map(account_way(10, {1, 2, 5, 4, 1}, "building", "yes") +
                                                    account_way(11, {3, 6, 9}, "barrier", "fence") +
                                                    account_way(12, {5, 6}, "highway", "proposed")));
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_EQ(rows_of(context->report, "node", "corner of the lines of ways"), 4u);
  EXPECT_EQ(rows_of(context->report, "node", "corner of lines that nothing was made of"), 3u) << "3, 6 and 9";
  EXPECT_EQ(rows_of(context->report, "node", "neither tags"), 2u) << "7 and 8";
  EXPECT_EQ(context->report.total("node"), 9u);
}

TEST(ImportAccount, WhatBecomesNoNodeTakesItsCornersWithIt) {
  const std::string relation =
      R"(<relation id="5"><member type="way" ref="10" role="outer"/><tag k="type" v="multipolygon"/><tag k="landuse" v="grass"/></relation>)";
  auto context = read_osm_context(
      account_map("<way id=\"10\"><nd ref=\"1\"/><nd ref=\"2\"/><nd ref=\"5\"/><nd ref=\"4\"/><nd ref=\"1\"/></way>" + relation +
                  account_way(11, {5, 6, 9, 8, 5}, "building", "yes")));
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_EQ(context->areas.size(), 1u);
  EXPECT_EQ(context->report.count(ImportOutcome::taken, "node"), 7u);
  EXPECT_EQ(reason_of(context->report, "w10"), "taken: outline of a multipolygon");
  context->report.drop({{context->areas[0].row, "nobody wants grass"}});
  EXPECT_EQ(reason_of(context->report, "r5"), "skipped: area of ground: nobody wants grass");
  EXPECT_EQ(reason_of(context->report, "w10"), "skipped: outline of a multipolygon: nothing became of that");
  EXPECT_EQ(context->report.count(ImportOutcome::taken, "node"), 4u) << "those of the building";
  EXPECT_EQ(context->report.total("node"), 9u);
}

std::string dutch_features(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" +
         features + "]}";
}
const std::string kSoundHouse =
    R"({"type": "Feature", "properties": {"height": 9, "level": 5}, "geometry": {"type": "Polygon", "coordinates": [[[85000, 447000], [85010, 447000], [85010, 447010], [85000, 447000]]]}})";
const std::string kNullHouse =
    R"({"type": "Feature", "properties": {"height": 9}, "geometry": {"type": "Polygon", "coordinates": [[[85000, 447000], [85010, null], [85010, 447010], [85000, 447000]]]}})";

TEST(ImportAccount, OneNullCoordinateCostsItsFeatureAlone) {
  const auto context = read_geojson_context(
      dutch_features(kNullHouse + "," + kSoundHouse + R"(, 7, {"type": "Feature", "geometry": {"type": "Polygn"}})"));
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_EQ(context->buildings.size(), 1u);
  EXPECT_EQ(context->report.total(), 4u);
  EXPECT_EQ(reason_of(context->report, "features/0"), "skipped: its geometry cannot be read");
  EXPECT_EQ(reason_of(context->report, "features/1"), "taken: building");
  EXPECT_NE(context->report.rows()[0].detail.find("features/0/geometry/coordinates/0/1: A position must be"), std::string::npos);
  EXPECT_EQ(reason_of(context->report, "features/2"), "skipped: its geometry cannot be read");
  EXPECT_EQ(reason_of(context->report, "features/3"), "skipped: its geometry cannot be read");
  const auto nothing = read_geojson_context(dutch_features(kNullHouse));
  ASSERT_FALSE(nothing.ok()) << "a fault of every feature is one of the file";
  EXPECT_EQ(nothing.error().place, "features/0/geometry/coordinates/0/1");
}

TEST(ImportAccount, SitesAndLayersPassBrokenFeaturesOverAsWell) {
  const auto plan = read_plan_boundary(dutch_features(kNullHouse + "," + kSoundHouse), {});
  ASSERT_TRUE(plan.ok()) << plan.error().text();
  EXPECT_EQ(plan->place, "features/1");
  EXPECT_TRUE(std::any_of(plan->notes.begin(), plan->notes.end(), [](const std::string& note) {
    return note == "The geometry of 1 feature cannot be read: such features were left out.";
  }));
  const std::string point =
      R"({"type": "Feature", "properties": {"level": 5}, "geometry": {"type": "Point", "coordinates": [85000, 447000]}})";
  const std::string broken =
      R"({"type": "Feature", "properties": {"level": 5}, "geometry": {"type": "Point", "coordinates": [null, 447000]}})";
  const auto layer = read_layer_geojson(dutch_features(broken + "," + point), {});
  ASSERT_TRUE(layer.ok()) << layer.error().text();
  EXPECT_EQ(layer->points.size(), 1u);
  EXPECT_EQ(reason_of(layer->report, "features/0"), "skipped: its geometry cannot be read");
}

TEST(ImportAccount, LocalCoordinatesStayAsTheyAre) {
  const std::string model =
      R"({"type": "CityJSON", "version": "2.0", "vertices": [[1,2,0],[11,2,0],[11,12,0],[1,12,0]], "CityObjects": {"b": {"type": "Building",
       "attributes": {"measuredHeight": 8}, "geometry": [{"type": "MultiSurface", "lod": "0", "boundaries": [[[0,1,2,3]]]}]}}})";
  const auto refused = read_cityjson_context(model);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("`--crs local`"), std::string::npos) << refused.error().text();
  const auto near = read_cityjson_context(model, in_crs("local"));
  ASSERT_TRUE(near.ok()) << near.error().text();
  ASSERT_EQ(near->buildings.size(), 1u);
  EXPECT_EQ(near->buildings[0].outer[0].x, 1);
  EXPECT_EQ(near->buildings[0].height, 8);
  EXPECT_EQ(near->reference.crs, "local");
  EXPECT_FALSE(near->reference.is_on_earth());
  EXPECT_TRUE(near->notes.empty() || near->notes[0].find("far") == std::string::npos);
}

TEST(ImportAccount, LocalCoordinatesFarFromZeroAreShiftedAndSo) {
  const auto far = LocalFrame::make("LOCAL", 85000.4, 447000);
  ASSERT_FALSE(far.ok()) << "names are tidied before";
  const auto shifted = LocalFrame::make(tidy_crs_name("LOCAL"), 85000.4, 447000);
  ASSERT_TRUE(shifted.ok()) << shifted.error().text();
  EXPECT_EQ(shifted->to_local(85001, 447002), (Point3{1, 2, 0}));
  ASSERT_EQ(shifted->notes().size(), 1u);
  EXPECT_NE(shifted->notes()[0].find("(85000, 447000)"), std::string::npos);
  const auto again = LocalFrame::into("local", shifted->reference());
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->to_local(85001, 447002), (Point3{1, 2, 0})) << "later files land in the same frame";
  const GeoReference delft{"EPSG:28992", 85000, 447000, 52, 4.4, 0};
  const auto of_scene = LocalFrame::into("local", delft);
  ASSERT_TRUE(of_scene.ok());
  EXPECT_EQ(of_scene->to_local(3, 4), (Point3{3, 4, 0})) << "metres of a scene that has a place";
  EXPECT_EQ(of_scene->from_local(3, 4), (Point3{3, 4, 0}));
  const auto without_place = LocalFrame::into("EPSG:28992", shifted->reference());
  ASSERT_FALSE(without_place.ok());
  EXPECT_NE(without_place.error().message.find("no place on Earth"), std::string::npos);
}

TEST(ImportAccount, CommonGroundIsExact) {
  const geometry::Ring square{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
  const geometry::Ring hole{{4, 4, 0}, {4, 6, 0}, {6, 6, 0}, {6, 4, 0}};
  const geometry::Ring other{{5, -5, 0}, {15, -5, 0}, {15, 5, 0}, {5, 5, 0}};
  const geometry::Ring corner{{0, 0, 0}, {20, 0, 0}, {20, 5, 0}, {5, 5, 0}, {5, 20, 0}, {0, 20, 0}};  // an L
  EXPECT_NEAR(common_area({&square}, {&other}), 25, 1e-12);
  EXPECT_NEAR(common_area({&square, &hole}, {&other}), 24, 1e-12);
  EXPECT_NEAR(common_area({&square}, {&corner}), 75, 1e-12);
  EXPECT_NEAR(common_area({&corner}, {&square, &hole}), 72, 1e-12);
  const geometry::Ring beside{{10, 0, 0}, {20, 0, 0}, {20, 10, 0}, {10, 10, 0}};
  EXPECT_EQ(common_area({&square}, {&beside}), 0);
}

}  // namespace
}  // namespace bl::importing
