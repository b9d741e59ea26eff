// The surroundings of a site as plain data, whatever file they came from: buildings, streets, areas, and the report of it all.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/mesh.h"
#include "core/geometry/plan_ring.h"
#include "core/import/import_report.h"
#include "core/import/import_watch.h"
#include "core/import/local_frame.h"

namespace bl::importing {

/// The source of a building's height; the last two are assumed.
enum class HeightSource {
  geometry,   ///< measured on the solid of the source
  tag,        ///< an attribute with a height
  levels,     ///< a number of storeys times the storey height
  neighbour,  ///< the median of known buildings nearby
  assumed,    ///< the default of the import
};
std::string_view name_of(HeightSource source);

/// Ids of features that have none of their own begin so; a hash of their geometry follows, so that they hold wherever a feature
/// stands in its file. So do ids of junctions that are mere places.
inline constexpr const char* kGeometryId = "geo-";

/// For an element without a row in the report.
inline constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

/// All lengths in local metres.
struct ContextBuilding {
  std::string id, name, use;
  geometry::Ring outer;               ///< counter-clockwise, z = 0
  std::vector<geometry::Ring> holes;  ///< clockwise
  double base = 0;                    ///< height of the underside [m]
  double height = 0;                  ///< from the underside to the top [m]
  HeightSource height_source = HeightSource::assumed;
  double storey_height = 0;   ///< [m] of this building; 0: not known
  bool is_part = false;       ///< a part of a building that is represented by its parts
  std::string whole;          ///< id of the building that it is a part of; empty: none
  MeshPointer solid;          ///< closed and outward, where the source has one
  bool is_above_sea = false;  ///< `base` counts from the sea, not from the ground
  std::size_t row = kNoRow;   ///< of the report, which it came from
};

struct ContextJunction {
  std::string id;
  Point3 position;
};

/// A street between two junctions, with none in between.
struct ContextStreet {
  std::string id, name;
  std::string street_class;        ///< "residential", as OpenStreetMap has it; empty: not known
  std::vector<Point3> line;        ///< from `start` to `end`
  std::size_t start = 0, end = 0;  ///< indices of junctions
  double lanes = 1;                ///< of both directions together
  double speed = 0;                ///< allowed [m/s]
  double width = 0;                ///< [m]; 0: not known
  bool is_lanes_assumed = true, is_speed_assumed = true;
  bool is_one_way = false;  ///< from `start` to `end`
  bool for_cars = true, for_cycles = true, for_feet = true;
  std::size_t row = kNoRow;  ///< of the report
};

/// A line of rails on the ground.
struct ContextRail {
  std::string id, name;
  std::string rail_class;    ///< "rail", "tram", as OpenStreetMap has it
  std::vector<Point3> line;  ///< of one track
  std::size_t row = kNoRow;  ///< of the report
};

/// A turn that is forbidden, or the only one allowed, at a junction.
struct ContextRestriction {
  std::string id, rule;                   ///< "no_left_turn", "only_straight_on"
  std::size_t from = 0, to = 0, via = 0;  ///< two streets and the junction between them
  std::size_t row = kNoRow;               ///< of the report; of a rule for several streets the same for all of them
};

/// Land use, green and water: what the ground is.
struct ContextArea {
  std::string id, name, use;  ///< use: "landuse=grass", "natural=water"
  geometry::Ring outer;
  std::vector<geometry::Ring> holes;
  bool is_plot = false;      ///< a parcel of land
  std::size_t row = kNoRow;  ///< of the report
};

struct Context {
  std::string source_crs;
  GeoReference reference;
  std::vector<ContextBuilding> buildings;
  std::vector<ContextJunction> junctions;
  std::vector<ContextStreet> streets;
  std::vector<ContextRail> rails;
  std::vector<ContextRestriction> restrictions;
  std::vector<ContextArea> areas;
  std::set<std::string> properties;  ///< names that features of the file have, where it has features
  ImportReport report;
  std::vector<std::string> notes;
};

/// The common options of all importers of surroundings.
struct ContextOptions {
  std::string crs;                              ///< in place of what the file says
  std::optional<GeoReference> target;           ///< the frame of a scene that has one already
  std::optional<std::array<double, 2>> origin;  ///< of the local frame, in the CRS of the file; else the middle of the elements
  double radius = 0;                            ///< [m] about the origin; what begins farther away is skipped; 0: no limit
  double storey_height = 3.2;                   ///< [m] of storeys where nothing says otherwise
  double default_height = 9.6;                  ///< [m] of buildings that nothing is known about
  double neighbour_distance = 100;              ///< [m] distance within which heights of neighbours are used
  std::string feature_kind;                     ///< GeoJSON: "building", "street", "plot", "area"; empty: from the properties
  std::vector<std::pair<std::string, std::string>> properties;  ///< ours and the file's: {"height", "H_MAX"}
  double height_unit = 0;        ///< [m] of one unit of the heights of models and grids; 0: what the CRS says
  double level_of_detail = 9;    ///< CityJSON: the finest one up to this is taken
  std::string proj_database;     ///< path of proj.db; empty: PROJ finds its own
  ImportWatch* watch = nullptr;  ///< the progress of the import; may be null
};

/// The largest distance of an element from the origin [m]: over larger lengths no flat frame is exact.
inline constexpr double kContextExtent = 100000;

}  // namespace bl::importing
