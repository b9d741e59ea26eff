// GeoJSON surroundings: properties under many names, streets that meet, hostile input, and real files against ogrinfo.
#include <gtest/gtest.h>

#include "core/import/geojson_context.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::area_of, test::reason_of, test::shared_bytes;

std::string in_dutch_metres(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::28992"}}, "features": [)" +
         features + "]}";
}
std::string square_feature(double x, double y, double side, const std::string& properties) {
  const auto point = [](double a, double b) { return "[" + std::to_string(a) + "," + std::to_string(b) + "]"; };
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": "Polygon", "coordinates": [[)" +
         point(x, y) + "," + point(x + side, y) + "," + point(x + side, y + side) + "," + point(x, y + side) + "," + point(x, y) +
         "]]}}";
}

TEST(GeoJsonContext, PropertiesUnderTheirManyNames) {
  ContextOptions options;
  options.storey_height = 3;
  options.properties = {{"use", "Nutzung"}};
  const auto context = read_geojson_context(
      in_dutch_metres(square_feature(85000, 447000, 10, R"("measuredHeight": 12.5, "gid": 7, "Nutzung": "school")") + "," +
                      square_feature(85020, 447000, 10, R"("bouwlagen": 4)") + "," +
                      square_feature(85040, 447000, 10, R"("landuse": "grass")")),
      options);
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_EQ(context->buildings.size(), 2u);
  EXPECT_EQ(context->buildings[0].id, "7");
  EXPECT_EQ(context->buildings[0].use, "school");
  EXPECT_EQ(context->buildings[0].height, 12.5);
  EXPECT_EQ(context->buildings[1].height, 12);
  EXPECT_EQ(context->buildings[1].height_source, HeightSource::levels);
  EXPECT_NEAR(area_of(context->buildings[0]), 100, 1e-6);
  ASSERT_EQ(context->areas.size(), 1u);
  EXPECT_EQ(context->areas[0].use, "grass");
  EXPECT_TRUE(context->reference.crs == "EPSG:28992");
}

TEST(GeoJsonContext, StreetsAreCutWhereTheyMeet) {
  const auto line = [](const std::string& points, const std::string& properties) {
    return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": "LineString", "coordinates": [)" +
           points + "]}}";
  };
  const auto context = read_geojson_context(in_dutch_metres(
      line("[85000,447000],[85050,447000],[85100,447000]", R"("highway": "primary", "maxspeed": "50", "oneway": "yes")") + "," +
      line("[85050,447000],[85050,447080]", R"("name": "Side")")));
  ASSERT_TRUE(context.ok());
  ASSERT_EQ(context->streets.size(), 3u);
  EXPECT_EQ(context->junctions.size(), 4u);
  EXPECT_TRUE(context->streets[0].is_one_way);
  EXPECT_EQ(context->streets[0].end, context->streets[2].start);
  EXPECT_EQ(context->streets[2].name, "Side");
}

TEST(GeoJsonContext, KindsAreToldByTheOptionAndFaultsAreRows) {
  ContextOptions options;
  options.feature_kind = "plot";
  const std::string crossed =
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[85000,447000],[85010,447010],[85010,447000],[85000,447010],[85000,447000]]]}})";
  const std::string point =
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [85000,447000]}})";
  const std::string nothing = R"({"type": "Feature", "properties": {}, "geometry": null})";
  const auto context = read_geojson_context(
      in_dutch_metres(square_feature(85000, 447000, 10, "") + "," + crossed + "," + point + "," + nothing), options);
  ASSERT_TRUE(context.ok());
  ASSERT_EQ(context->areas.size(), 1u);
  EXPECT_TRUE(context->areas[0].is_plot);
  EXPECT_EQ(reason_of(context->report, "features/1"), "skipped: plot: its outline crosses or touches itself");
  EXPECT_EQ(reason_of(context->report, "features/2"), "skipped: a single place: points are not read");
  EXPECT_EQ(reason_of(context->report, "features/3"), "skipped: it has no geometry");
  EXPECT_EQ(context->report.total("feature"), 4u);
}

// What a file says of its CRS hinders nobody who gives it; else the fault is told as what it is.
TEST(GeoJsonContext, AFaultOfTheCrsIsToldAsSuchAndTheOptionHelps) {
  const std::string square = R"("geometry": {"type": "Polygon", "coordinates": [[[0,0],[30,0],[30,20],[0,20],[0,0]]]})";
  const std::string text =
      R"({"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"name": "a"}, )" + square +
      R"(}, {"type": "Feature", "crs": {"type": "foo"}, "properties": {"name": "b"}, )" + square +
      R"(}, {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[[0,"x"]]]}}]})";
  const auto without = read_geojson_context(text, {});
  ASSERT_TRUE(without.ok()) << without.error().text();
  EXPECT_EQ(reason_of(without->report, "features/1"), "skipped: its CRS is not understood");
  EXPECT_EQ(reason_of(without->report, "features/2"), "skipped: its geometry cannot be read");
  ContextOptions options;
  options.crs = "local";
  const auto given = read_geojson_context(text, options);
  ASSERT_TRUE(given.ok()) << given.error().text();
  EXPECT_EQ(given->buildings.size(), 2u);
  EXPECT_EQ(reason_of(given->report, "features/2"), "skipped: its geometry cannot be read");
  const std::string whole = R"({"type": "Feature", "crs": 7, "properties": {}, )" + square + "}";
  EXPECT_EQ(read_geojson_context(whole, {}).error().place, "crs");
  EXPECT_TRUE(read_geojson_context(whole, options).ok());
}

TEST(GeoJsonContext, HostileInputIsAnErrorWithAPlace) {
  const std::pair<std::string, std::string> rows[] = {
      {"", "line 1, column 1"},
      {"noise\x01", "byte 0"},
      {"{}", ""},
      {in_dutch_metres(""), "features"},
      {R"({"type": "FeatureCollection"})", "features"},
      {in_dutch_metres(R"({"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [[["a", 1]]]}})"),
       "features/0/geometry/coordinates/0/0"},
      {R"({"type": "Polygon", "coordinates": [[[85000,447000],[85010,447000],[85010,447010],[85000,447000]]]})", "crs"}};
  for (const auto& [text, place] : rows) {
    const auto context = read_geojson_context(text);
    ASSERT_FALSE(context.ok()) << text;
    EXPECT_EQ(context.error().place, place) << text;
    EXPECT_GT(context.error().message.size(), 15u);
  }
}

struct FixtureFile {
  const char *name, *kind;
  std::size_t features;  // by `ogrinfo -al -so FILE`, line "Feature Count"
  std::size_t buildings, streets, areas;
};
constexpr FixtureFile kFiles[] = {
    {"geojson/tudelft_campus_buildings.geojson", "building", 1529, 1529, 0, 0},
    {"geojson/tudelft_campus_domain.geojson", "plot", 1, 0, 0, 1},
    {"geojson/tartu_streets_utm35n.geojson", "", 2238, 0, 3416, 0},
    {"geojson/prague_bubenec_buildings.geojson", "building", 144, 144, 0, 0},
    {"geojson/prague_bubenec_plots.geojson", "plot", 407, 0, 0, 407},
    {"geojson/prague_bubenec_streets.geojson", "", 35, 0, 35, 0},
    {"geojson/prague_bubenec_tessellation.geojson", "area", 144, 0, 0, 144},
    {"geojson/paris_landuse_west_laea.geojson", "", 623, 0, 0, 550},
};

TEST(GeoJsonContext, RealFilesAgreeWithAnIndependentReader) {
  for (const FixtureFile& file : kFiles) {
    const std::string text = shared_bytes(file.name);
    if (text.empty()) continue;
    ContextOptions options;
    options.feature_kind = file.kind;
    const auto context = read_geojson_context(text, options);
    ASSERT_TRUE(context.ok()) << file.name << ": " << context.error().text();
    EXPECT_EQ(context->report.total("feature"), file.features) << file.name;
    EXPECT_EQ(context->buildings.size(), file.buildings) << file.name;
    EXPECT_EQ(context->streets.size(), file.streets) << file.name;
    EXPECT_EQ(context->areas.size(), file.areas) << file.name;
  }
}

TEST(GeoJsonContext, AreasAreThoseOfAnIndependentReader) {
  // `ogr2ogr -dialect SQLite -sql 'select sum(st_area(geometry)) from ...'`: 330629.690 over the buildings, 614625.896 the
  // domain.
  const std::string campus = shared_bytes("geojson/tudelft_campus_buildings.geojson"),
                    domain = shared_bytes("geojson/tudelft_campus_domain.geojson");
  if (campus.empty() || domain.empty()) return;
  ContextOptions options;
  options.feature_kind = "building";
  double area = 0;
  const auto context = read_geojson_context(campus, options);
  for (const ContextBuilding& building : context->buildings) area += area_of(building);
  EXPECT_NEAR(area, 330629.690, 0.05) << "the one building that was left out encloses no area";
  options.feature_kind = "plot";
  const auto plot = read_geojson_context(domain, options);
  EXPECT_NEAR(geometry::signed_area(plot->areas[0].outer), 614625.896, 0.001);
}

TEST(GeoJsonContext, GroundHeightsAreAboveTheSeaAndMinHeightsAboveTheGround) {
  const auto context =
      read_geojson_context(in_dutch_metres(square_feature(85000, 447000, 10, R"("height": 12, "ground_height": 35.2)") + "," +
                                           square_feature(85020, 447000, 10, R"("height": 12, "min_height": 5)") + "," +
                                           square_feature(85040, 447000, 10, R"("height": 12, "base": 5, "min_height": 3)") +
                                           "," + square_feature(85060, 447000, 10, R"("height": 12, "base": "2e6")") + "," +
                                           square_feature(85080, 447000, 10, R"("height": 12, "base": 2000000)")));
  ASSERT_TRUE(context.ok()) << context.error().text();
  ASSERT_EQ(context->buildings.size(), 4u);
  EXPECT_EQ(context->buildings[0].base, 35.2);
  EXPECT_EQ(context->buildings[0].height, 12);
  EXPECT_TRUE(context->buildings[0].is_above_sea);
  EXPECT_EQ(context->buildings[0].height_source, HeightSource::tag);
  EXPECT_EQ(context->buildings[1].base, 5);
  EXPECT_EQ(context->buildings[1].height, 7);
  EXPECT_FALSE(context->buildings[1].is_above_sea);
  EXPECT_EQ(context->buildings[2].base, 8);
  EXPECT_EQ(context->buildings[2].height, 9);
  EXPECT_EQ(reason_of(context->report, "features/3"), "repaired: building") << "its ground is not understood";
  EXPECT_EQ(reason_of(context->report, "features/4"), "skipped: building: its heights lie beyond -10 km or 100 km");
}

TEST(GeoJsonContext, DirectionsOfGeofabrik) {
  const auto line = [](int y, const std::string& oneway) {
    const std::string at = std::to_string(447000 + y);
    return R"({"type": "Feature", "properties": {"fclass": "residential", "oneway": ")" + oneway +
           R"("}, "geometry": {"type": "LineString", "coordinates": [[85000,)" + at + "],[85100," + at + "]]}}";
  };
  const auto context = read_geojson_context(in_dutch_metres(line(0, "F") + "," + line(10, "T") + "," + line(20, "B")));
  ASSERT_TRUE(context.ok());
  ASSERT_EQ(context->streets.size(), 3u);
  EXPECT_TRUE(context->streets[0].is_one_way);
  EXPECT_LT(context->streets[0].line.front().x, context->streets[0].line.back().x);
  EXPECT_TRUE(context->streets[1].is_one_way);
  EXPECT_GT(context->streets[1].line.front().x, context->streets[1].line.back().x);
  EXPECT_FALSE(context->streets[2].is_one_way);
  EXPECT_EQ(context->report.count(ImportOutcome::taken), 3u);
}

}  // namespace
}  // namespace bl::importing
