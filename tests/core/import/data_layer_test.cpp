// Data layers: tables and points by hand, what has no value, and real layers against their own sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/import/data_layer.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::reason_of, test::shared_bytes;

const ContextOptions kDutch = test::in_crs("EPSG:28992");

TEST(DataLayerImport, ATableWithCoordinates) {
  const auto plain =
      read_layer_csv("name;x_m;y_m;noise\na;85000;447000;50,5\nb;85010;447000;\nc;;447000;3\nd;85020;447000;60,5\n", kDutch);
  ASSERT_TRUE(plain.ok()) << plain.error().text();
  EXPECT_EQ(plain->value_name, "noise");
  ASSERT_EQ(plain->points.size(), 2u);
  EXPECT_EQ(plain->points[0].value, 50.5);
  EXPECT_EQ(plain->points[1].x - plain->points[0].x, 20);
  EXPECT_EQ(reason_of(plain->report, "line 3"), "skipped: no value");
  EXPECT_EQ(reason_of(plain->report, "line 4"), "skipped: no coordinates");
  EXPECT_EQ(plain->report.total("record"), 4u);
}

TEST(DataLayerImport, DegreesNeedNoCrsAndMetresDo) {
  const auto degrees = read_layer_csv("lat,lon,value\n60.0,25.0,1\n60.001,25.0,2\n", {});
  ASSERT_TRUE(degrees.ok()) << degrees.error().text();
  EXPECT_NEAR(std::abs(degrees->points[1].y - degrees->points[0].y), 111.41, 0.05);
  EXPECT_EQ(read_layer_csv("x,y,value\n1,2,3\n", {}).error().place, "crs");
}

TEST(DataLayerImport, TheValueHasToBeClear) {
  EXPECT_EQ(read_layer_csv("x,y,a,b\n1,2,3,4\n", kDutch).error().message,
            "Several columns hold numbers (`a`, `b`): choose the one with the values.");
  EXPECT_EQ(read_layer_csv("x,y,a,b\n1,2,3,4\n", kDutch, "c").error().code, ErrorCode::not_found);
  EXPECT_EQ(read_layer_csv("a,b\n1,2\n", kDutch).error().place, "line 1");
  EXPECT_FALSE(read_layer_csv("", kDutch).ok());
  EXPECT_FALSE(read_layer_csv("x,y,v\n", kDutch).ok());
}

TEST(DataLayerImport, RealLayersHaveTheirSums) {
  const std::string tartu = shared_bytes("layers/tartu_population_points_utm35n.csv");
  if (tartu.empty()) return;
  // `awk -F, 'NR>1{n++;s+=$3;if($3>m)m=$3}' FILE`: 22654 rows, sum 94947.83, most 143.08.
  const auto population = read_layer_csv(tartu, test::in_crs("EPSG:32635"));
  ASSERT_TRUE(population.ok()) << population.error().text();
  EXPECT_EQ(population->value_name, "pop");
  EXPECT_EQ(population->points.size(), 22654u);
  EXPECT_EQ(population->report.total("record"), 22654u);
  double sum = 0, most = 0;
  for (const LayerPoint& point : population->points) sum += point.value, most = std::max(most, point.value);
  EXPECT_NEAR(sum, 94947.83, 0.005);
  EXPECT_EQ(most, 143.08);
  const std::string noise = shared_bytes("layers/noise_receivers_chateaudun_l93.geojson");
  EXPECT_FALSE(read_layer_geojson(noise, {}).ok()) << "ten properties are numbers";
  const auto levels = read_layer_geojson(noise, {}, "laeq");
  ASSERT_TRUE(levels.ok()) << levels.error().text();
  EXPECT_EQ(levels->points.size(), 740u);
  EXPECT_EQ(levels->reference.crs, "EPSG:2154");
  EXPECT_EQ(levels->points[0].value, 57.35);
  const auto grid = read_terrain_grid(shared_bytes("layers/elevation_luxembourg_wgs84.tif"));
  const auto raster = layer_of_grid(*grid, {});
  ASSERT_TRUE(raster.ok()) << raster.error().text();
  EXPECT_EQ(raster->points.size(), raster->report.count(ImportOutcome::taken, "cell"));
}

TEST(DataLayer, PointsOfSeveralSystemsAreRefused) {
  const auto point = [](const std::string& crs, const std::string& place) {
    return R"({"type": "Feature", "crs": {"type": "name", "properties": {"name": ")" + crs +
           R"("}}, "properties": {"level": 50}, "geometry": {"type": "Point", "coordinates": )" + place + "}}";
  };
  const std::string text = R"({"type": "FeatureCollection", "features": [)" + point("EPSG:28992", "[85000, 447000]") + "," +
                           point("EPSG:32631", "[593000, 5763000]") + "]}";
  const auto layer = read_layer_geojson(text, {}, "level");
  ASSERT_FALSE(layer.ok());
  EXPECT_EQ(layer.error().place, "features/1");
  EXPECT_TRUE(read_layer_geojson(text, test::in_crs("EPSG:28992"), "level").ok()) << "the option holds for all";
}

}  // namespace
}  // namespace bl::importing
