// Plan boundaries from GeoJSON: squares of known size, real files in three kinds of CRS, and broken files with their messages.
#include "core/import/plan_boundary.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/reference_files.h"

namespace bl::importing {
namespace {

// Our own file, and a published one where the shared folder is.
std::vector<std::string> texts_of(const std::string& own, const std::string& published) {
  return test::texts_of(own, "data/geojson/" + published);
}

std::string polygon(const std::string& rings, const std::string& crs = "") {
  return R"({"type":"Polygon",)" + (crs.empty() ? "" : R"("crs":{"type":"name","properties":{"name":")" + crs + R"("}},)") +
         R"("coordinates":)" + rings + "}";
}

const std::string kDutchSquare = "[[[85000,446000],[85100,446000],[85100,446050],[85000,446050],[85000,446000]]]";

bool has_note(const PlanBoundary& plan, const std::string& part) {
  for (const std::string& note : plan.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

std::string boundary_error_of(const std::string& text, const PlanOptions& options = {}) {
  const auto plan = read_plan_boundary(text, options);
  return plan ? "no error" : plan.error().text();
}

TEST(PlanBoundary, MetricCrsIsShiftedOnly) {
  const auto plan = read_plan_boundary(polygon(kDutchSquare, "urn:ogc:def:crs:EPSG::28992"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(plan->outer, (geometry::Ring{{-50, -25, 0}, {50, -25, 0}, {50, 25, 0}, {-50, 25, 0}}));
  EXPECT_DOUBLE_EQ(plan->area, 5000);
  EXPECT_DOUBLE_EQ(plan->hull_area, 5000);
  EXPECT_TRUE(plan->is_convex);
  EXPECT_EQ(plan->reference.crs, "EPSG:28992");
  EXPECT_EQ(plan->reference.origin_x, 85050);
  EXPECT_EQ(plan->reference.origin_y, 446025);
  EXPECT_NEAR(plan->reference.latitude, 52.0, 0.01);
  EXPECT_NEAR(plan->reference.longitude, 4.37, 0.01);
  // West of the central meridian (5.387°) true north lies clockwise of grid north: (5.387 - 4.37)° · sin 52° = 0.80°.
  EXPECT_NEAR(plan->reference.true_north, 0.80, 0.02);
  EXPECT_TRUE(plan->notes.empty()) << plan->notes.front();
}

// At 52° a degree of latitude is 111 267 m, one of longitude 68 678 m (radii of curvature of the WGS84 ellipsoid).
TEST(PlanBoundary, LongitudeLatitudeSquareHasItsSizeInMetres) {
  const double lat = 52 * 3.14159265358979323846 / 180, e2 = 0.00669437999014, a = 6378137;
  const double w = std::sqrt(1 - e2 * std::sin(lat) * std::sin(lat));
  const double metres_per_lat = a * (1 - e2) / (w * w * w) * 3.14159265358979323846 / 180;
  const double metres_per_lon = a * std::cos(lat) / w * 3.14159265358979323846 / 180;
  const auto plan = read_plan_boundary(polygon("[[[4.3,51.9995],[4.301,51.9995],[4.301,52.0005],[4.3,52.0005],[4.3,51.9995]]]"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_NEAR(plan->area, 1e-6 * metres_per_lat * metres_per_lon, 0.01);
  EXPECT_TRUE(plan->is_convex);
  EXPECT_EQ(plan->source_crs, "OGC:CRS84");
  EXPECT_DOUBLE_EQ(plan->reference.latitude, 52);
  EXPECT_DOUBLE_EQ(plan->reference.longitude, 4.3005);
  EXPECT_EQ(plan->reference.crs,
            "+proj=tmerc +lat_0=52.000000 +lon_0=4.300500 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs");
  EXPECT_EQ(plan->reference.origin_x, 0);
  EXPECT_EQ(plan->reference.true_north, 0);
}

TEST(PlanBoundary, LocalFrameIsTrueWithinTwoKilometres) {
  const auto frame = LocalFrame::make("OGC:CRS84", 4.3, 52);
  ASSERT_TRUE(frame);
  // 1 km east of the middle a thousandth of a degree of latitude still has its true length, 111.26736 m, to 1e-7.
  const Point3 a = frame->to_local(4.3145, 52), b = frame->to_local(4.3145, 52.001);
  EXPECT_NEAR(a.x, 995.8, 1);
  EXPECT_NEAR(distance(a, b), 111.26736, 2e-5);
}

TEST(PlanBoundary, WebMercatorIsUnstretched) {
  const double lat = 50.1 * 3.14159265358979323846 / 180;
  const auto plan =
      read_plan_boundary(polygon("[[[1603500,6464000],[1603600,6464000],[1603600,6464100],[1603500,6464100]]]", "EPSG:3857"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_NEAR(plan->area / 1e4, std::cos(lat) * std::cos(lat), 0.003);
  EXPECT_TRUE(has_note(*plan, "the plan was projected anew in metres"));
  EXPECT_TRUE(has_note(*plan, "does not end where it starts; it was closed"));
}

TEST(PlanBoundary, FeetAreMetres) {
  // EPSG:2263 (New York, US survey feet): 1000 by 1000 feet are 92903.4 m².
  const auto plan = read_plan_boundary(
      polygon("[[[980000,200000],[981000,200000],[981000,201000],[980000,201000],[980000,200000]]]", "EPSG:2263"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_NEAR(plan->area, 92903.4, 10);
}

TEST(PlanBoundary, CleansRingsAndTurnsThem) {
  const auto plan =
      read_plan_boundary(polygon("[[[85000,446000],[85000,446050],[85000,446050],[85100,446050],[85100,446000],[85000,446000]],"
                                 "[[85010,446010],[85020,446010],[85020,446020],[85010,446020],[85010,446010]]]",
                                 "EPSG:28992"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_EQ(plan->outer, (geometry::Ring{{-50, -25, 0}, {50, -25, 0}, {50, 25, 0}, {-50, 25, 0}}));
  EXPECT_DOUBLE_EQ(plan->outer_area, 5000);
  EXPECT_DOUBLE_EQ(plan->area, 4900);
  EXPECT_FALSE(plan->is_convex);
  ASSERT_EQ(plan->holes.size(), 1u);
  EXPECT_LT(geometry::signed_area(plan->holes[0]), 0);
  EXPECT_TRUE(has_note(*plan, "In the ring coordinates/0, 1 repeated point was dropped."));
  EXPECT_TRUE(has_note(*plan, "1 hole with 100 m² stays open: nothing is built there."));
  const ConvexPlan convex = convex_hull_plan(*plan);
  EXPECT_DOUBLE_EQ(convex.area, 5000);
  EXPECT_DOUBLE_EQ(convex.added_area, 100);
}

TEST(PlanBoundary, HullOfAnLShape) {
  const auto plan = read_plan_boundary(
      polygon("[[[85000,446000],[85020,446000],[85020,446010],[85010,446010],[85010,446020],[85000,446020],[85000,446000]]]"),
      {.feature = "", .crs = "EPSG:28992", .proj_database = ""});
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_DOUBLE_EQ(plan->area, 300);
  EXPECT_DOUBLE_EQ(plan->hull_area, 350);
  EXPECT_FALSE(plan->is_convex);
  EXPECT_DOUBLE_EQ(convex_hull_plan(*plan).added_area, 50);
}

TEST(PlanBoundary, SpikesAreCutOff) {
  const auto plan = read_plan_boundary(
      polygon("[[[85000,446000],[85100,446000],[85120,446000],[85100,446000],[85100,446050],[85000,446050],[85000,446000]]]",
              "EPSG:28992"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_DOUBLE_EQ(plan->area, 5000);
  EXPECT_EQ(plan->outer.size(), 4u);
  EXPECT_TRUE(has_note(*plan, "In the ring coordinates/0, 2 spikes without width were cut off."));
}

TEST(PlanBoundary, DeepNestingIsAnError) {
  const std::string deep = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_EQ(boundary_error_of(polygon(deep)),
            "line 1, column 96: The text is nested deeper than 64 levels from here on. No file of this kind needs that many: it "
            "is not read.");
}

TEST(PlanBoundary, SiteOutsideItsCrsIsNoted) {
  const auto plan = read_plan_boundary(polygon("[[[0,0],[20,0],[20,10],[0,10],[0,0]]]", "EPSG:28992"));
  ASSERT_TRUE(plan) << plan.error().text();
  EXPECT_TRUE(has_note(*plan, "outside the area that EPSG:28992 is made for"));
}

const std::string kThree = R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:28992"}},"features":[
 {"type":"Feature","properties":{"name":"small","kind":"plot"},"geometry":{"type":"Polygon","coordinates":[[[85000,446000],[85010,446000],[85010,446010],[85000,446000]]]}},
 {"type":"Feature","properties":{"name":"tree"},"geometry":{"type":"Point","coordinates":[85000,446000]}},
 {"type":"Feature","properties":{"name":"large","kind":"plot","number":7},"geometry":{"type":"MultiPolygon","coordinates":[
   [[[85000,446000],[85010,446000],[85010,446010],[85000,446000]]],[[[85100,446000],[85200,446000],[85200,446100,5],[85100,446000]]]]}}]})";

TEST(PlanBoundary, ChoosesFeatures) {
  const auto largest = read_plan_boundary(kThree);
  ASSERT_TRUE(largest) << largest.error().text();
  EXPECT_DOUBLE_EQ(largest->area, 5000);
  EXPECT_EQ(largest->place, "features/2");
  EXPECT_TRUE(has_note(*largest,
                       "Of 2 polygon features the largest was taken, number 2; choose another one by the option `feature`: an "
                       "index from 0 to 2, or property=value."));
  EXPECT_TRUE(has_note(*largest, "1 feature without a polygon was left out."));
  EXPECT_TRUE(has_note(*largest, "The feature has 2 separate polygons; only the largest was taken, number 1."));
  EXPECT_TRUE(has_note(*largest, "The third numbers of the positions (heights) were left out: a plan is flat."));
  EXPECT_DOUBLE_EQ(read_plan_boundary(kThree, {.feature = "0", .crs = "", .proj_database = ""})->area, 50);
  EXPECT_DOUBLE_EQ(read_plan_boundary(kThree, {.feature = "name=small", .crs = "", .proj_database = ""})->area, 50);
  EXPECT_DOUBLE_EQ(read_plan_boundary(kThree, {.feature = "number=7", .crs = "", .proj_database = ""})->area, 5000);
}

TEST(PlanBoundary, ChoiceErrors) {
  const auto choose = [](const std::string& feature) {
    return boundary_error_of(kThree, {.feature = feature, .crs = "", .proj_database = ""});
  };
  EXPECT_EQ(choose("3"), "feature: There is no feature 3: the file has 3, counted from 0.");
  EXPECT_EQ(
      choose("1"),
      "features/1: This feature has no polygon. A plan boundary must be a Polygon or a MultiPolygon: choose another feature.");
  EXPECT_EQ(choose("kind=plot"), "features: 2 features have kind=plot: choose one by its index (0, 2).");
  EXPECT_EQ(choose("name=lage"), "features: No feature has name=lage, did you mean `large`? There are: small, tree, large.");
  EXPECT_EQ(choose("nam=large"),
            "features: No feature has a property `nam`, did you mean `name`? There are: kind, name, number.");
  EXPECT_EQ(choose("first"), "feature: The option `feature` is `first`. Write an index such as 3, or property=value.");
}

TEST(PlanBoundary, RingErrors) {
  EXPECT_EQ(
      boundary_error_of(polygon("[[[85000,446000],[85010,446010],[85010,446000],[85000,446010],[85000,446000]]]", "EPSG:28992")),
      "coordinates/0: The ring meets itself at (85005.000, 446005.000) in the file, which is (0.000, 0.000) in local metres: "
      "edge "
      "0 from (-5.000, -5.000) to (5.000, 5.000) and edge 2 from (5.000, -5.000) to (-5.000, 5.000). Redraw it without crossing "
      "or "
      "touching itself.");
  const std::string degrees = boundary_error_of(polygon("[[[4.3,52],[4.301,52.001],[4.301,52],[4.3,52.001],[4.3,52]]]"));
  EXPECT_NE(degrees.find("The ring meets itself at (4.3005000, 52.0005000) in the file, which is ("), std::string::npos)
      << degrees;
  EXPECT_EQ(boundary_error_of(polygon("[[[85000,446000],[85010,446010],[85000,446000]]]", "EPSG:28992")),
            "coordinates/0: A ring needs at least 3 different points; this one has 2.");
  EXPECT_EQ(boundary_error_of(polygon("[[]]")), "coordinates/0: A ring needs at least 3 different points; this one has 0.");
  EXPECT_EQ(boundary_error_of(polygon("[]")),
            "There is no polygon in the file (1 other feature). A plan boundary must be a Polygon or a MultiPolygon.");
  EXPECT_EQ(boundary_error_of(polygon(kDutchSquare)),
            "coordinates/0/0: (85000.000, 446000.000) is no longitude and latitude. The coordinates are probably projected, and "
            "the file does not say "
            "how: give the CRS, such as EPSG:28992.");
  EXPECT_EQ(boundary_error_of(polygon("[[[4.3,52],[4.3001,52.0001],[4.3000000001,52.0002],[4.3,52]]]", "EPSG:28992")),
            "coordinates/0: A ring needs at least 3 different points; this one has 1.");
  EXPECT_EQ(boundary_error_of(polygon("[[[0,0],[10,0.0001],[20,0],[0,0]]]", "EPSG:28992")),
            "coordinates/0: The ring encloses no area (0.0010 m²). Are its points on a line, or is the CRS wrong?");
  EXPECT_EQ(boundary_error_of(polygon("[[[0,50],[5,50],[5,51],[0,50]]]")),
            "coordinates: The polygon is 358 km wide. A plan boundary is a site of at most 100 km: check the CRS, or choose "
            "another feature.");
  EXPECT_EQ(
      boundary_error_of(polygon("[[[85000,446000],[85100,446000],[85100,446050],[85000,446050],[85000,446000]],[[86000,446000],["
                                "86010,446000],[86010,446010],[86000,446000]]]",
                                "EPSG:28992")),
      "coordinates/1: The hole lies outside the outer ring. Remove it, or make it a polygon of its own.");
}

TEST(PlanBoundary, FormatErrors) {
  EXPECT_EQ(boundary_error_of(""), "line 1, column 1: The file is empty: GeoJSON is needed.");
  EXPECT_EQ(boundary_error_of("{\n\"type\": oops}"),
            "line 2, column 9: The text is not valid JSON from here on: it is damaged, or no GeoJSON at all.");
  EXPECT_EQ(boundary_error_of("[1, 2]"),
            "This is JSON but not GeoJSON: it has no member `type`. A FeatureCollection, a Feature or a geometry is needed.");
  EXPECT_EQ(boundary_error_of(R"({"type":"Polygn","coordinates":[]})"),
            "type: The geometry type `Polygn` is not one of GeoJSON, did you mean `Polygon`?");
  EXPECT_EQ(boundary_error_of(R"({"type":"FeatureCollection"})"),
            "features: A FeatureCollection needs an array `features`; it is missing or no array.");
  EXPECT_EQ(boundary_error_of(polygon("[[[4,52],[4,\"x\"]]]")),
            "coordinates/0/1: A position must be an array of two numbers [x, y] (longitude, latitude); this is [4,\"x\"].");
  EXPECT_EQ(boundary_error_of(polygon("[[[4,52],[1e999,3]]]")),
            "The text cannot be read as JSON: a number or a character in it is out of range.");
  EXPECT_EQ(boundary_error_of(R"({"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[1,2]}})"),
            "There is no polygon in the file (1 other feature). A plan boundary must be a Polygon or a MultiPolygon.");
}

TEST(PlanBoundary, CrsErrors) {
  EXPECT_EQ(
      boundary_error_of(polygon(kDutchSquare, "EPSG:99999")),
      "crs: The CRS `EPSG:99999` is not known. Write an EPSG code such as EPSG:28992, or OGC:CRS84 for longitude and latitude.");
  EXPECT_EQ(boundary_error_of(R"({"type":"Polygon","crs":5,"coordinates":[]})"),
            "crs: The member `crs` is not understood. Write {\"type\": \"name\", \"properties\": {\"name\": \"EPSG:28992\"}}, or "
            "give the CRS as an option.");
  EXPECT_EQ(boundary_error_of(polygon(kDutchSquare), {.feature = "", .crs = "EPSG:28992", .proj_database = "/nowhere/proj.db"}),
            "crs: The CRS `EPSG:28992` needs PROJ's database proj.db, which was not found at `/nowhere/proj.db`. Install the "
            "package proj-data, or name "
            "the folder of proj.db in the environment variable PROJ_LIB.");
  EXPECT_EQ(tidy_crs_name("urn:ogc:def:crs:OGC:1.3:CRS84"), "OGC:CRS84");
  EXPECT_EQ(tidy_crs_name("urn:ogc:def:crs:EPSG:9.8:28992"), "EPSG:28992");
  EXPECT_EQ(tidy_crs_name("http://www.opengis.net/def/crs/EPSG/0/3857"), "EPSG:3857");
  EXPECT_EQ(tidy_crs_name("epsg:4326"), "OGC:CRS84");
}

TEST(PlanBoundary, ThreadsDoNotDisturbEachOther) {
  std::vector<std::thread> threads;
  std::vector<double> areas(4);
  for (std::size_t k = 0; k < areas.size(); ++k)
    threads.emplace_back(
        [&areas, k] { areas[k] = read_plan_boundary(polygon(kDutchSquare, k % 2 ? "EPSG:28992" : "EPSG:3857"))->area; });
  for (std::thread& thread : threads) thread.join();
  EXPECT_DOUBLE_EQ(areas[1], 5000);
  EXPECT_EQ(areas[0], areas[2]);
}

TEST(PlanBoundaryData, DutchPlansMatchTheShoelace) {
  std::vector<std::size_t> corners;
  for (const std::string& text : texts_of("plan_dutch.geojson", "tudelft_campus_domain.geojson")) {
    const auto plan = read_plan_boundary(text);
    ASSERT_TRUE(plan) << plan.error().text();
    const auto ring = nlohmann::json::parse(text)["features"][0]["geometry"]["coordinates"][0][0];
    double twice = 0;
    for (std::size_t i = 0; i + 1 < ring.size(); ++i)
      twice += (ring[i][0].get<double>() - 85000) * (ring[i + 1][1].get<double>() - 446000) -
               (ring[i + 1][0].get<double>() - 85000) * (ring[i][1].get<double>() - 446000);
    EXPECT_NEAR(plan->area, std::abs(twice) / 2, 1e-3);
    EXPECT_FALSE(plan->is_convex);
    EXPECT_GT(plan->hull_area, plan->area);
    EXPECT_NEAR(plan->reference.latitude, 52.0, 0.02);
    corners.push_back(plan->outer.size());
  }
  EXPECT_EQ(corners[0], 5u);
  if (corners.size() > 1) { EXPECT_EQ(corners[1], 15u); }
}

TEST(PlanBoundaryData, MercatorPlotsAreUnstretched) {
  const std::array<double, 2> latitudes{45.0, 50.1};
  const std::array<std::size_t, 2> least{3, 20};
  std::size_t k = 0;
  for (const std::string& text : texts_of("plots_mercator.geojson", "prague_bubenec_plots.geojson")) {
    const auto features = nlohmann::json::parse(text)["features"];
    std::size_t read = 0;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (i == 24) break;  // each call reads the whole file again
      const auto plan = read_plan_boundary(text, {.feature = std::to_string(i), .crs = "", .proj_database = ""});
      if (!plan) continue;
      ++read;
      const auto ring = features[i]["geometry"]["coordinates"][0];
      geometry::Ring raw;
      for (const auto& p : ring)
        raw.push_back({p[0].get<double>() - ring[0][0].get<double>(), p[1].get<double>() - ring[0][1].get<double>(), 0});
      const double latitude = plan->reference.latitude * 3.14159265358979323846 / 180, cosine = std::cos(latitude);
      // Web Mercator is spherical: against the ellipsoid its north scale differs by e² terms of some 0.3 %.
      EXPECT_NEAR(plan->outer_area / std::abs(geometry::signed_area(raw)), cosine * cosine, 0.004 * cosine * cosine) << i;
      EXPECT_NEAR(plan->reference.latitude, latitudes[k], 0.02);
    }
    EXPECT_GE(read, least[k]);
    ++k;
  }
}

TEST(PlanBoundaryData, EuropeanEqualAreaIsUndistorted) {
  const std::array<double, 2> latitudes{52.0, 48.9};
  std::size_t k = 0;
  for (const std::string& text : texts_of("land_use_laea.geojson", "paris_landuse_west_laea.geojson")) {
    const auto plan = read_plan_boundary(text);
    ASSERT_TRUE(plan) << plan.error().text();
    EXPECT_TRUE(has_note(*plan, "polygon features the largest was taken"));
    EXPECT_NEAR(plan->reference.latitude, latitudes[k], 0.1);
    if (k++ == 0) { EXPECT_NEAR(plan->area, 120 * 80, 1); }
  }
}

}  // namespace
}  // namespace bl::importing
