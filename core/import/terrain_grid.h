// Imports a raster of heights (or of any numbers): Esri ASCII grid or GeoTIFF, brought into local metres.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/import/context.h"

namespace bl::importing {

/// As the file has it: rows from north to south, in the units of its CRS; cells without a value are not finite.
struct TerrainGrid {
  std::string crs;  ///< tidy name; empty where the file says nothing
  std::size_t columns = 0, rows = 0;
  double west = 0, north = 0;     ///< centre of the first cell of the first row
  double cell_x = 1, cell_y = 1;  ///< size of a cell, both positive
  double height_unit = 0;         ///< [m] of one unit of the values, where the file says so; 0: it does not
  std::vector<double> values;
  std::size_t without_value = 0;
  double lowest = 0, highest = 0;
  std::vector<std::string> notes;

  /// Bilinear between cell centres; nothing outside them, and where cells with a value weigh less than half.
  std::optional<double> sample(double x, double y) const;
};

/// Files hold at most so many cells.
inline constexpr std::size_t kMostGridCells = 25000000;

/// ASCII grid (plain or packed with gzip) or GeoTIFF, told apart by their first bytes. Of a GeoTIFF the first band is read.
Result<TerrainGrid> read_terrain_grid(std::string_view bytes);

/// A grid in local metres with square cells.
struct LocalTerrain {
  GeoReference reference;
  std::size_t columns = 0, rows = 0;
  double west = 0, north = 0, cell = 1;  ///< centre of the first cell, and the distance of cells [m]
  std::vector<double> values;
  bool is_resampled = false;
  ImportReport report;  ///< cells taken, without value, out of reach
  std::vector<std::string> notes;
};

/// Cells of a metric CRS are kept as they are; all others, and more than `most_cells`, are sampled anew.
Result<LocalTerrain> local_grid(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells);
/// The same with values that are heights: they are brought to metres, and those beyond 100 km count as none.
Result<LocalTerrain> local_terrain(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells = 1000000);

/// Of terrain_geotiff.cpp.
Result<TerrainGrid> read_geotiff(std::string_view bytes);
/// Fills in what follows from the values.
void summarise(TerrainGrid& grid);

}  // namespace bl::importing
