// A CityJSON text as plain data: objects with their geometries over vertices in the CRS of the file, unjudged.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/import/city_surfaces.h"

namespace bl::importing {

struct CityGeometry {
  std::string type;  ///< "Solid", "MultiSurface", ...
  double level_of_detail = 0;
  std::vector<CitySurface> surfaces;  ///< of all shells and solids; empty where `fault` says why
  std::size_t solids = 0;             ///< how many solids; 0: surfaces only
  std::string fault;
};

struct CityObject {
  std::string id, type, place;
  std::vector<std::string> parents, children;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< plain values as text
  std::vector<CityGeometry> geometries;
  std::size_t vertices = 0;  ///< which list of vertices its indices are of
};

struct CityModel {
  std::string version, crs;                   ///< crs: tidy name; empty where the file says nothing
  std::vector<std::vector<Point3>> vertices;  ///< one list, or one for each feature of a sequence
  std::vector<CityObject> objects;            ///< in the order of their ids, feature by feature
  std::vector<std::string> notes;
};

/// CityJSON 1.x and 2.0, and sequences of features (CityJSONSeq); plain or packed with gzip.
Result<CityModel> read_cityjson(std::string_view bytes);

}  // namespace bl::importing
