// Imports a layer of data: points with one value each, from a table with coordinates, GeoJSON points, or a raster.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/import/context.h"
#include "core/import/terrain_grid.h"

namespace bl::importing {

struct LayerPoint {
  double x = 0, y = 0;  ///< local [m]
  double value = 0;
};

struct DataLayer {
  std::string source_crs;
  GeoReference reference;
  std::string value_name, unit;  ///< the column or property, and the unit that its header names
  std::vector<LayerPoint> points;
  ImportReport report;
  std::vector<std::string> notes;
};

/// Points of one layer at most.
inline constexpr std::size_t kMostLayerPoints = 1000000;

/// `value`: the column; empty: the only one with numbers beside the coordinates. The columns of coordinates are found by their
/// names (x, easting, lon, ...); longitude and latitude need no CRS.
Result<DataLayer> read_layer_csv(std::string_view bytes, const ContextOptions& options, const std::string& value = "");
/// `value`: the property; empty: the only one that is a number in all points.
Result<DataLayer> read_layer_geojson(std::string_view bytes, const ContextOptions& options, const std::string& value = "");
/// The cells of a raster that have a value; the most of them as in `local_terrain`.
Result<DataLayer> layer_of_grid(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells = 100000);

}  // namespace bl::importing
