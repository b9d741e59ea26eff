// Reads the polygons, lines and points of a GeoJSON text with their properties and CRS, and judges none of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace bl::importing {

/// One polygon as written: rings[0] is the outer one, the others are holes; x (longitude) first, in units of the CRS.
struct GeoPolygon {
  std::string place;  ///< such as "features/3/geometry/coordinates/0"
  std::vector<std::vector<std::array<double, 2>>> rings;
};

/// One line as written, x (longitude) first.
struct GeoLine {
  std::string place;
  std::vector<std::array<double, 2>> points;
};

/// One point as written.
struct GeoPoint {
  std::string place;
  std::array<double, 2> position{};
};

/// One feature; a bare geometry counts as a feature without properties.
struct GeoFeature {
  std::string place;                                            ///< "features/3", or empty for a bare feature or geometry
  std::string crs;                                              ///< tidy name; "OGC:CRS84" where the text says nothing
  std::vector<std::pair<std::string, std::string>> properties;  ///< plain values as text, in the order of the JSON library
  std::vector<GeoPolygon> polygons;
  std::vector<GeoLine> lines;
  std::vector<GeoPoint> points;
  std::optional<Error> fault;  ///< why it cannot be read; it has no geometry then
  bool is_fault_of_crs = false;
  /// What cannot be read of it, as a reason in reports.
  const char* unread() const { return is_fault_of_crs ? "its CRS is not understood" : "its geometry cannot be read"; }
};

struct GeoDocument {
  std::vector<GeoFeature> features;
  std::vector<std::string> notes;
};

/// Understands FeatureCollection, Feature, all geometries of RFC 7946 and the older `crs` member of the 2008 format. A fault of
/// one feature of several is told with it, and leaves the others as they are; only where every one has a fault is it an error.
/// Whoever knows the CRS (`has_crs`) does not ask the text, whatever that says of it.
Result<GeoDocument> read_geojson_polygons(std::string_view text, bool has_crs = false);

}  // namespace bl::importing
