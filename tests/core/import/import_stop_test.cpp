// Whoever stops an import need not wait for the end of a file: every parser asks within the text, and ends where it is told so.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/base/stop.h"
#include "core/import/cityjson_context.h"
#include "core/import/data_layer.h"
#include "core/import/geojson_context.h"
#include "core/import/inflate.h"
#include "core/import/terrain_grid.h"
#include "tests/support/gzip.h"

namespace bl::importing {
namespace {

constexpr int kPatience = 3;  // asked so often, people still want it

// How often the work asked whether to go on, and what it answered where nobody wanted it from the third question on.
template <class Work>
std::pair<int, std::string> stopped(const Work& work) {
  int asked = 0;
  const StopScope scope([&asked] { return ++asked > kPatience; });
  const auto result = work();
  return {asked, result.ok() ? "done" : result.error().code == ErrorCode::cancelled ? "stopped" : result.error().text()};
}

// Without a wish it is read to its end; with one it is stopped long before, whatever is wrong further behind.
template <class Work>
void expect_to_stop(const char* what, const Work& work) {
  const auto whole = work();
  EXPECT_TRUE(whole.ok()) << what << ": " << (whole.ok() ? "" : whole.error().text());
  const auto [asked, answer] = stopped(work);
  EXPECT_EQ(answer, "stopped") << what;
  // Each layer above may ask once more on the way out.
  EXPECT_LE(asked, kPatience + 3) << what;
}

std::string repeated(const std::string& text, int count) {
  std::string all;
  for (int k = 0; k < count; ++k) all += text;
  return all;
}

const std::string kPoint =
    R"({"type": "Feature", "properties": {"v": 1}, "geometry": {"type": "Point", "coordinates": [4.1, 52]}},)";

std::string features(int count) {
  std::string list = repeated(kPoint, count);
  list.pop_back();
  return R"({"type": "FeatureCollection", "features": [)" + list + "]}";
}

TEST(ImportStop, ParsersAskWithinTheText) {
  const std::string geojson = features(20000), gz = test::gzip_of(repeated("0123456789", 200000));
  expect_to_stop("GeoJSON", [&] { return read_geojson_context(geojson, {}); });
  expect_to_stop("gzip", [&] { return unpacked(gz); });
  const std::string grid = "ncols 1000\nnrows 400\nxllcorner 85000\nyllcorner 446000\ncellsize 1\n" + repeated("1 ", 400000);
  expect_to_stop("grid", [&] { return read_terrain_grid(grid); });
  const std::string table = "lon,lat,noise\n" + repeated("4.1,52,60\n", 40000);
  expect_to_stop("table", [&] { return read_layer_csv(table, {}, ""); });
  const std::string head =
      R"({"type": "CityJSON", "version": "2.0", "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]},)"
      R"( "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/7415"}, "CityObjects": {}, "vertices": []})";
  const std::string line =
      R"({"type": "CityJSONFeature", "id": "a", "CityObjects": {"a": {"type": "Building", "geometry": [{"type": "MultiSurface", )"
      R"("lod": "1", "boundaries": [[[0, 1, 2]]]}]}}, "vertices": [[85000, 446000, 0], [85010, 446000, 0], [85010, 446010, 0]]})";
  expect_to_stop("CityJSON sequence", [&] { return read_cityjson_context(head + "\n" + repeated(line + "\n", 40), {}); });
}

// A parser that is stopped within the text must not take the rest for missing.
TEST(ImportStop, WhatIsStoppedIsNotCalledIncomplete) {
  const auto [asked, answer] = stopped([] { return read_geojson_context(features(20000) + " and more", {}); });
  EXPECT_EQ(answer, "stopped");
}

}  // namespace
}  // namespace bl::importing
