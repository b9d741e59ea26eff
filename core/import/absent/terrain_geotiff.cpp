// Stands for the reader of GeoTIFF in a build without it.
#include "core/import/terrain_grid.h"

namespace bl::importing {

Result<TerrainGrid> read_geotiff(std::string_view) {
  return Error{
      ErrorCode::missing, "",
      "This program was built without GeoTIFF: configure the build with -DBL_GEOTIFF=ON, or give the terrain as ASCII grid."};
}

}  // namespace bl::importing
