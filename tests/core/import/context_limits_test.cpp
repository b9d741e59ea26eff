// Files made to cost more than they weigh: nested, spiky, holed and overlapping ones are read or refused in little time.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/define/bounded_json.h"
#include "core/geometry/polygon_triangles.h"
#include "core/import/box_grid.h"
#include "core/import/cityjson_context.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/osm_context.h"
#include "core/import/plan_boundary.h"
#include "tests/core/import/context_data.h"
#include "tests/support/gzip.h"
#include "tests/support/sanitized.h"

namespace bl::importing {
namespace {

using test::gzip_of, test::reason_of, test::rows_of;

// Processor time, so that a busy machine does not decide; the limits are many times what is needed, and far below what it took.
// Sanitizers make it up to twenty times as long.
class Stopwatch {
 public:
  double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC / (test::kIsSanitized ? 5 : 1); }

 private:
  std::clock_t start_ = std::clock();
};

std::string ring_text(const geometry::Ring& ring) {
  std::string text = "[";
  for (const Point3& p : ring) text += "[" + std::to_string(85000 + p.x) + "," + std::to_string(447000 + p.y) + "],";
  return text + "[" + std::to_string(85000 + ring[0].x) + "," + std::to_string(447000 + ring[0].y) + "]]";
}
std::string polygon_text(const std::string& properties, const geometry::Ring& outer,
                         const std::vector<geometry::Ring>& holes = {}) {
  std::string text = R"({"type": "Feature", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "properties": {)" +
                     properties + R"(}, "geometry": {"type": "Polygon", "coordinates": [)" + ring_text(outer);
  for (const geometry::Ring& hole : holes) text += "," + ring_text(hole);
  return text + "]}}";
}
std::string dutch(const std::string& features) {
  return R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:28992"}}, "features": [)" +
         features + "]}";
}
geometry::Ring square(double x, double y, double side) {
  return {{x, y, 0}, {x + side, y, 0}, {x + side, y + side, 0}, {x, y + side, 0}};
}

// A zigzag of long teeth, turned by an angle, closed around one side.
geometry::Ring comb(int teeth, double angle) {
  geometry::Ring ring;
  for (int i = 0; i < teeth; ++i) ring.push_back({i % 2 == 0 ? 0.0 : 1000.0, i * 0.01, 0});
  ring.push_back({1010, teeth * 0.01, 0});
  ring.push_back({1010, -5, 0});
  ring.push_back({-5, -5, 0});
  for (Point3& p : ring) p = {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle), 0};
  return ring;
}

TEST(ContextLimits, NestedJsonIsRefusedBeforeItIsBuilt) {
  const std::string deep(20000000, '[');
  const Stopwatch watch;
  for (const auto& error :
       {read_geojson_context(deep).error(), read_cityjson_context(deep).error(), read_geojson_context(gzip_of(deep)).error(),
        read_cityjson_context(gzip_of(deep)).error(), read_layer_geojson(deep, {}).error()}) {
    EXPECT_EQ(error.place, "line 1, column 65");
    EXPECT_NE(error.message.find("nested deeper than 64"), std::string::npos) << error.message;
  }
  EXPECT_LT(watch.seconds(), 8);
  const auto within = read_bounded_json(std::string(64, '[') + std::string(64, ']'), "JSON");
  EXPECT_TRUE(within.ok());
  EXPECT_FALSE(read_bounded_json(std::string(65, '[') + std::string(65, ']'), "JSON").ok());
  EXPECT_TRUE(read_bounded_json(R"({"a": "[[[[\"[[", "b": [1, 2]})", "JSON").ok()) << "brackets in texts count for nothing";
}

TEST(ContextLimits, MoreValuesThanMemoryHoldsAreRefused) {
  std::string many = "[";
  for (std::size_t i = 0; i < kMostJsonValues; ++i) many += "0,";
  const Error error = read_geojson_context(many + "0]").error();
  EXPECT_EQ(error.code, ErrorCode::out_of_range);
  EXPECT_NE(error.message.find("values"), std::string::npos) << error.message;
}

TEST(ContextLimits, ValuesEndWhereTheirBracketsDo) {
  EXPECT_EQ(end_of_first_value(R"( {"a": "}"} tail)"), 11u);
  EXPECT_EQ(end_of_first_value("[1, 2"), std::string_view::npos);
  EXPECT_EQ(end_of_first_value("7"), std::string_view::npos);
}

TEST(ContextLimits, CombsAreCheckedInLittleTime) {
  for (const double angle : {0.0, 0.7, 1.5707963267948966}) {
    const Stopwatch watch;
    geometry::Ring ring = comb(50001, angle);
    EXPECT_FALSE(geometry::find_self_crossing(ring)) << angle;
    std::swap(ring[700].x, ring[902].x), std::swap(ring[700].y, ring[902].y);
    EXPECT_TRUE(geometry::find_self_crossing(ring)) << "two corners changed places: " << angle;
    EXPECT_LT(watch.seconds(), 3) << angle;
  }
}

TEST(ContextLimits, BodiesHaveAsManyCornersAsCanBeTriangulated) {
  const Stopwatch watch;
  const geometry::Ring ring = comb(50001, 0.3);
  const auto context =
      read_geojson_context(dutch(polygon_text(R"("building": "yes")", ring) + "," + polygon_text(R"("landuse": "grass")", ring)));
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_EQ(reason_of(context->report, "features/0"), "skipped: building: it has more than 10000 corners");
  EXPECT_EQ(reason_of(context->report, "features/1"), "taken: area") << "nothing is made of it that would take long";
  EXPECT_LT(watch.seconds(), 10);
}

TEST(ContextLimits, ManyHolesAreSortedInLittleTime) {
  std::vector<geometry::Ring> holes;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) holes.push_back(square(10 + i * 5, 10 + k * 5, 3));
  holes.push_back(square(11, 11, 1));   // in another one
  holes.push_back(square(12, 12, 5));   // across another one
  holes.push_back(square(2000, 0, 1));  // outside
  const Stopwatch watch;
  const auto context = read_geojson_context(dutch(polygon_text(R"("landuse": "grass")", square(0, 0, 1000), holes) + "," +
                                                  polygon_text(R"("building": "yes")", square(0, 0, 1000), holes)));
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_LT(watch.seconds(), 4);
  ASSERT_EQ(context->areas.size(), 1u);
  EXPECT_EQ(context->areas[0].holes.size(), 10000u);
  EXPECT_EQ(rows_of(context->report, "feature", "area"), 1u);
  ASSERT_EQ(context->buildings.size(), 1u);
  EXPECT_TRUE(context->buildings[0].holes.empty());
  EXPECT_EQ(context->report.rows()[1].detail,
            "its 10003 holes left out: with them it has more than 10000 corners; height not known, assumed: 9.6 m");
}

// A solid whose floor and roof have as many corners as wanted.
std::string round_tower(int corners) {
  std::string vertices, below, above, walls;
  for (const int z : {0, 10000})
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * 3.14159265358979 * i / corners, radius = 100000 * (1 + 0.2 * (i % 2));
      vertices += (vertices.empty() ? "[" : ",[") + std::to_string(std::lround(radius * std::cos(angle))) + "," +
                  std::to_string(std::lround(radius * std::sin(angle))) + "," + std::to_string(z) + "]";
    }
  for (int i = 0; i < corners; ++i) {
    const std::string a = std::to_string(i), b = std::to_string((i + 1) % corners), c = std::to_string(corners + i),
                      d = std::to_string(corners + (i + 1) % corners);
    below = a + (below.empty() ? "" : ",") + below;
    above += (above.empty() ? "" : ",") + c;
    walls += ",[[" + a + "," + b + "," + d + "," + c + "]]";
  }
  return R"({"type": "CityJSON", "version": "2.0", "transform": {"scale": [0.001, 0.001, 0.001], "translate": [85000, 447000, 0]},
    "metadata": {"referenceSystem": "EPSG:28992"}, "vertices": [)" +
         vertices +
         R"(], "CityObjects": {"tower": {"type": "Building", "geometry": [{"type": "Solid", "lod": "2", "boundaries": [[[[)" +
         below + "]],[[" + above + "]]" + walls + "]]}]}}}";
}

TEST(ContextLimits, FacesOfVeryManyCornersAreNoSolids) {
  const Stopwatch watch;
  const auto huge = read_cityjson_context(round_tower(30000));
  ASSERT_TRUE(huge.ok()) << huge.error().text();
  EXPECT_EQ(reason_of(huge->report, "tower"), "skipped: it has more than 10000 corners");
  const auto large = read_cityjson_context(round_tower(600));
  ASSERT_TRUE(large.ok());
  ASSERT_EQ(large->buildings.size(), 1u);
  ASSERT_TRUE(large->buildings[0].solid);
  EXPECT_NEAR(enclosed_volume(*large->buildings[0].solid), 10 * geometry::signed_area(large->buildings[0].outer), 0.1);
  EXPECT_LT(watch.seconds(), 10);
}

TEST(ContextLimits, RingsThatCrossThemselvesAreTriangulatedInBoundedTime) {
  std::vector<geometry::Ring> star(1);
  for (int i = 0; i < 1501; ++i) {
    const double angle = 2 * 3.14159265358979 * ((i * 700) % 1501) / 1501;
    star[0].push_back({100 * std::cos(angle), 100 * std::sin(angle), 0});
  }
  const Stopwatch watch;
  EXPECT_EQ(geometry::polygon_triangles(star).size(), 1499u);
  EXPECT_LT(watch.seconds(), 5);
}

TEST(BoxGrid, FindsWhatACompareOfAllFinds) {
  std::vector<geometry::Ring> shapes;
  for (int i = 0; i < 300; ++i) shapes.push_back(square((i * 37) % 101, (i * 53) % 97, i % 50 == 0 ? 80 : 1 + i % 4));
  const BoxGrid grid = BoxGrid::of(shapes, [](const geometry::Ring& ring) -> const geometry::Ring& { return ring; });
  for (const geometry::Ring& probe : {square(3, 4, 2), square(-50, -50, 400), square(500, 500, 1), square(50, 50, 0)}) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      if (plan_box(shapes[i]).meets(plan_box(probe))) wanted.push_back(i);
    EXPECT_EQ(grid.meeting(plan_box(probe)), wanted);
  }
}

TEST(ContextLimits, WaysThatMeetInOnePlaceAreJoinedInLittleTime) {
  std::string text = R"(<?xml version="1.0"?><osm version="0.6"><node id="1" lat="52" lon="4.35"/>)", members;
  constexpr int kWays = 60000;
  for (int i = 0; i < kWays; ++i) {
    text += "<way id=\"" + std::to_string(i + 1) + "\"><nd ref=\"" + std::to_string(i + 10) + "\"/><nd ref=\"1\"/></way>";
    members += "<member type=\"way\" ref=\"" + std::to_string(i + 1) + "\" role=\"outer\"/>";
  }
  text += R"(<relation id="1"><tag k="type" v="multipolygon"/><tag k="building" v="yes"/>)" + members + "</relation></osm>";
  const Stopwatch watch;
  const auto context = read_osm_context(text);
  ASSERT_TRUE(context.ok()) << context.error().text();
  EXPECT_EQ(reason_of(context->report, "r1"), "skipped: building: its outer ring is open");
  EXPECT_LT(watch.seconds(), 6);
}

}  // namespace
}  // namespace bl::importing
