// Stands for the reader of OpenStreetMap files in a build without it.
#include "core/import/osm_store.h"

namespace bl::importing {

Result<OsmStore> read_osm(std::string_view, ImportWatch*) {
  return Error{
      ErrorCode::missing, "",
      "This program was built without OpenStreetMap: configure the build with -DBL_OSM=ON, or give the data as GeoJSON."};
}

}  // namespace bl::importing
