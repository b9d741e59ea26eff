// Grids: values by hand, local metres, hostile input, and real rasters against an independent reader.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/import/data_layer.h"
#include "core/import/inflate.h"
#include "core/import/terrain_grid.h"
#include "tests/core/import/context_data.h"

namespace bl::importing {
namespace {

using test::shared_bytes;

const std::string kPacked(
    "\x1f"
    "\x8b"
    "\x08"
    "\x00"
    "\x00"
    "\x00"
    "\x00"
    "\x00"
    "\x02"
    "\x03"
    "\xcb"
    "\x4b"
    "\xce"
    "\xcf"
    "\x29"
    "\x56"
    "\x30"
    "\xe2"
    "\xca"
    "\x2b"
    "\xca"
    "\x2f"
    "\x07"
    "\xd1"
    "\x15"
    "\x39"
    "\x39"
    "\xc9"
    "\xf9"
    "\x45"
    "\x79"
    "\xa9"
    "\x45"
    "\x0a"
    "\x06"
    "\x5c"
    "\x95"
    "\x48"
    "\xec"
    "\xe4"
    "\xd4"
    "\x9c"
    "\x9c"
    "\xe2"
    "\xcc"
    "\xaa"
    "\x54"
    "\x05"
    "\x43"
    "\x03"
    "\x2e"
    "\x3f"
    "\x7f"
    "\x17"
    "\xc7"
    "\x10"
    "\xc7"
    "\xf8"
    "\xb2"
    "\xc4"
    "\x9c"
    "\xd2"
    "\x54"
    "\x05"
    "\x5d"
    "\x4b"
    "\x20"
    "\xe0"
    "\x32"
    "\x04"
    "\x6a"
    "\x35"
    "\x86"
    "\xb2"
    "\x01"
    "\xc0"
    "\xb9"
    "\x10"
    "\x2b"
    "\x53"
    "\x00"
    "\x00"
    "\x00"
    "",
    83);

TEST(TerrainGrid, ThePackedGridIsThePlainOne) {
  const auto grid = read_terrain_grid(kPacked);
  ASSERT_TRUE(grid.ok()) << grid.error().text();
  EXPECT_EQ(grid->columns, 2u);
  EXPECT_EQ(grid->rows, 2u);
  EXPECT_EQ(grid->without_value, 1u);
  EXPECT_EQ(grid->west, 5);
  EXPECT_EQ(grid->north, 15);
  EXPECT_EQ(grid->lowest, 1);
  EXPECT_EQ(grid->highest, 3);
  EXPECT_EQ(grid->sample(5, 15), 1);
  EXPECT_EQ(grid->sample(10, 15), 1.5);
  // Three of four cells have a value and weigh three quarters: their mean.
  EXPECT_DOUBLE_EQ(grid->sample(10, 10).value(), 2);
  EXPECT_FALSE(grid->sample(15, 5).has_value());
  EXPECT_FALSE(grid->sample(4, 15).has_value());
  EXPECT_EQ(unpacked(kPacked, 20).error().code, ErrorCode::out_of_range) << "no more is unpacked than is allowed";
  EXPECT_EQ(unpacked(kPacked.substr(0, 30)).error().code, ErrorCode::parse);
}

TEST(TerrainGrid, HeadersMayNameTheCentreAndUseCommas) {
  const auto grid = read_terrain_grid("NCOLS 2\r\nNROWS 1\r\nXLLCENTER 100\r\nYLLCENTER 200\r\nCELLSIZE 5\r\n1,5 2,5\r\n");
  ASSERT_TRUE(grid.ok()) << grid.error().text();
  EXPECT_EQ(grid->west, 100);
  EXPECT_EQ(grid->north, 200);
  EXPECT_EQ(grid->sample(102.5, 200), 2);
}

TEST(TerrainGrid, MetricCellsAreKeptAndOthersSampledAnew) {
  std::string text = "ncols 30\nnrows 20\nxllcorner 85000\nyllcorner 447000\ncellsize 10\n";
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 30; ++column) text += std::to_string(100 + column - row) + " ";
  const auto grid = read_terrain_grid(text);
  ASSERT_TRUE(grid.ok());
  ContextOptions options;
  EXPECT_EQ(local_terrain(*grid, options).error().place, "crs");
  options.crs = "EPSG:28992";
  const auto kept = local_terrain(*grid, options);
  ASSERT_TRUE(kept.ok()) << kept.error().text();
  EXPECT_FALSE(kept->is_resampled);
  EXPECT_EQ(kept->values, grid->values);
  EXPECT_EQ(kept->report.total("cell"), 600u);
  options.target = GeoReference{
      "+proj=tmerc +lat_0=52.01 +lon_0=4.36 +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m +no_defs", 0, 0, 52.01, 4.36, 0};
  const auto turned = local_terrain(*grid, options);
  ASSERT_TRUE(turned.ok()) << turned.error().text();
  EXPECT_TRUE(turned->is_resampled);
  EXPECT_NEAR(turned->cell, 10, 0.2);
  options.target.reset();
  options.radius = 45;
  const auto near = local_terrain(*grid, options);
  EXPECT_LE(near->values.size(), 100u);
  EXPECT_EQ(near->report.total("cell"), 600u) << "cells beyond the radius have their row";
  const auto coarse = local_terrain(*grid, test::in_crs("EPSG:28992"), 100);
  EXPECT_LE(coarse->values.size(), 100u);
  EXPECT_EQ(coarse->cell, 40);
}

TEST(TerrainGrid, HostileInputIsAnErrorWithAPlace) {
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n";
  const std::pair<std::string, std::string> rows[] = {
      {"", "byte 0"},
      {"noise \x01\x02", "byte 0"},
      {head + "1 2 3", "end of the file"},
      {head + "1 2 3 x", "line 6"},
      {head, "end of the file"},
      {"ncols 2\nnrows x\n", "line 2"},
      {"ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 10\n1", "header"},
      {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1 2 3 4", "header"},
      {"ncols 2\nnrows 2\ncellsize 1\n1 2 3 4", "header"},
      {"ncols 2.5\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3 4", "header"},
      {std::string("II*\0\x08\0\0\0", 8), "TIFF"},
      {std::string("II*\0\xff\xff\xff\x7f", 8), "TIFF"}};
  for (const auto& [text, place] : rows) {
    const auto grid = read_terrain_grid(text);
    ASSERT_FALSE(grid.ok()) << text;
    EXPECT_EQ(grid.error().place, place) << text;
    EXPECT_GT(grid.error().message.size(), 15u);
  }
}

TEST(TerrainGrid, RealRastersAgreeWithAnIndependentReader) {
  const std::string loire = shared_bytes("layers/terrain_loire_15m_l93.asc.gz");
  if (loire.empty()) return;
  // `zcat FILE | tail -n +7 | awk ...`: 196862 values, sum 9.58922e+06, from -17.37 to 77.5.
  const auto grid = read_terrain_grid(loire);
  ASSERT_TRUE(grid.ok()) << grid.error().text();
  EXPECT_EQ(grid->values.size(), 196862u);
  EXPECT_EQ(grid->without_value, 0u);
  EXPECT_EQ(grid->lowest, -17.37);
  EXPECT_EQ(grid->highest, 77.5);
  double sum = 0;
  for (const double value : grid->values) sum += value;
  EXPECT_NEAR(sum, 9.58922e6, 6);
  const std::string luxembourg = shared_bytes("layers/elevation_luxembourg_wgs84.tif");
  // `gdal_translate -of XYZ FILE`: 4608 of 95 x 90 pixels have a value, sum 1605135, from 141 to 547;
  // `gdallocationinfo -geoloc FILE 6.13 49.81`: pixel (46, 45) is 293; 5.9 50.0: pixel (19, 23) is 481.
  const auto tiff = read_terrain_grid(luxembourg);
  ASSERT_TRUE(tiff.ok()) << tiff.error().text();
  EXPECT_EQ(tiff->crs, "OGC:CRS84");
  EXPECT_EQ(tiff->columns, 95u);
  EXPECT_EQ(tiff->rows, 90u);
  EXPECT_EQ(tiff->values.size() - tiff->without_value, 4608u);
  EXPECT_EQ(tiff->lowest, 141);
  EXPECT_EQ(tiff->highest, 547);
  EXPECT_EQ(tiff->values[45 * 95 + 46], 293);
  EXPECT_EQ(tiff->values[23 * 95 + 19], 481);
  EXPECT_NEAR(tiff->west, 5.741666666666666 + 0.5 / 120, 1e-12);
  double total = 0;
  for (const double value : tiff->values) total += std::isfinite(value) ? value : 0;
  EXPECT_EQ(total, 1605135);
  for (std::size_t cut = 0; cut < luxembourg.size(); cut += 97) {
    const auto part = read_terrain_grid(luxembourg.substr(0, cut));
    EXPECT_FALSE(part.ok()) << "cut off at byte " << cut;
  }
}

// A GeoTIFF of five by five pixels of 32 bits, 10 units wide, as GDAL writes it; the one in the middle is `middle`.
std::string tiff(float others, float middle, const std::string& nodata, int epsg, int vertical_unit = 0) {
  std::string out, extra;
  const auto put = [](std::string& text, auto number) { text.append(reinterpret_cast<const char*>(&number), sizeof number); };
  const std::size_t entries = 15, base = 8 + 2 + entries * 12 + 4;
  const auto later = [&](const std::string& bytes) {
    const std::size_t at = base + extra.size();
    extra += bytes + (bytes.size() % 2 != 0 ? std::string(1, '\0') : "");
    return static_cast<std::uint32_t>(at);
  };
  std::string pixels, scale, tie, keys;
  for (int i = 0; i < 25; ++i) put(pixels, i == 12 ? middle : others);
  for (const double number : {10.0, 10.0, 0.0}) put(scale, number);
  for (const double number : {0.0, 0.0, 0.0, epsg == 2263 ? 985000.0 : 85000.0, epsg == 2263 ? 200000.0 : 447000.0, 0.0})
    put(tie, number);
  std::vector<int> words{1, 1, 0, vertical_unit > 0 ? 4 : 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, epsg};
  if (vertical_unit > 0) words.insert(words.end(), {4099, 0, 1, vertical_unit});
  for (const int word : words) put(keys, static_cast<std::uint16_t>(word));
  const std::string tag = nodata + std::string(1, '\0');
  out = std::string("II*\0", 4);
  put(out, std::uint32_t{8});
  put(out, static_cast<std::uint16_t>(entries));
  const auto entry = [&](int name, int type, std::size_t count, std::uint32_t value) {
    put(out, static_cast<std::uint16_t>(name));
    put(out, static_cast<std::uint16_t>(type));
    put(out, static_cast<std::uint32_t>(count));
    put(out, value);
  };
  entry(256, 4, 1, 5), entry(257, 4, 1, 5), entry(258, 3, 1, 32), entry(259, 3, 1, 1), entry(262, 3, 1, 1);
  entry(273, 4, 1, later(pixels)), entry(277, 3, 1, 1), entry(278, 4, 1, 5);
  entry(279, 4, 1, static_cast<std::uint32_t>(pixels.size())), entry(284, 3, 1, 1), entry(339, 3, 1, 3);
  entry(33550, 12, 3, later(scale)), entry(33922, 12, 6, later(tie));
  entry(34735, 3, keys.size() / 2, later(keys)), entry(42113, 2, tag.size(), later(tag));
  put(out, std::uint32_t{0});
  return out + extra;
}

TEST(TerrainGrid, NodataOfSinglePixelsIsComparedAsSingle) {
  const std::pair<float, const char*> rows[] = {{-9999.9f, "-9999.9"},
                                                {-3.40282346638528859e38f, "-3.4028234660000000e+38"},
                                                {-3.40282346638528859e38f, "-3.40282346638528859e+38"},
                                                {-32768.0f, "-32768"}};
  for (const auto& [value, text] : rows) {
    const auto grid = read_terrain_grid(tiff(5, value, text, 28992));
    ASSERT_TRUE(grid.ok()) << grid.error().text();
    EXPECT_EQ(grid->without_value, 1u) << text;
    EXPECT_EQ(grid->lowest, 5) << text;
  }
  EXPECT_EQ(read_terrain_grid(tiff(5, -9998, "-9999.9", 28992))->without_value, 0u) << "a value of its own";
}

TEST(TerrainGrid, HeightsNobodyReachesAreNoValues) {
  const auto grid = read_terrain_grid(tiff(5, -3.4e38f, "", 28992));
  ASSERT_TRUE(grid.ok()) << grid.error().text();
  EXPECT_EQ(grid->without_value, 0u) << "a raster of any numbers may have it";
  const auto terrain = local_terrain(*grid, {});
  ASSERT_TRUE(terrain.ok()) << terrain.error().text();
  EXPECT_EQ(terrain->report.count(ImportOutcome::taken), 24u);
  EXPECT_EQ(terrain->report.count(ImportOutcome::skipped), 1u);
  EXPECT_TRUE(std::any_of(terrain->notes.begin(), terrain->notes.end(),
                          [](const std::string& note) { return note.find("1 cell has a height beyond") == 0; }));
}

TEST(TerrainGrid, HeightsInFeetBecomeMetres) {
  const auto height = [](const std::string& bytes, double given = 0) {
    ContextOptions options;
    options.height_unit = given;
    const auto grid = read_terrain_grid(bytes);
    const auto terrain = local_terrain(*grid, options);
    EXPECT_TRUE(terrain.ok()) << terrain.error().text();
    return terrain ? *std::find_if(terrain->values.begin(), terrain->values.end(), [](double v) { return std::isfinite(v); }) : 0;
  };
  EXPECT_NEAR(height(tiff(100, 100, "-1", 2263)), 100 * 1200.0 / 3937, 1e-6);
  EXPECT_NEAR(height(tiff(100, 100, "-1", 2263, 9001)), 100, 1e-9) << "the file says that its heights are metres";
  EXPECT_NEAR(height(tiff(100, 100, "-1", 28992, 9002)), 30.48, 1e-9) << "or feet";
  EXPECT_NEAR(height(tiff(100, 100, "-1", 2263), 1), 100, 1e-9) << "or the option";
  EXPECT_NEAR(height(tiff(100, 100, "-1", 28992)), 100, 1e-9);
}

TEST(TerrainGrid, CellsOfNoWidthAreAnErrorOfTheFile) {
  const auto grid = read_terrain_grid("ncols 2\nnrows 2\nxllcorner 85000\nyllcorner 447000\ncellsize 1e-9\n1 2\n3 4\n");
  ASSERT_TRUE(grid.ok());
  EXPECT_EQ(local_terrain(*grid, test::in_crs("EPSG:28992")).error().place, "header");
}

}  // namespace
}  // namespace bl::importing
