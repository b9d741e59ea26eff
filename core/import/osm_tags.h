// What the values of OpenStreetMap tags mean: lengths and speeds with units, numbers of storeys and lanes, directions.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/import/osm_store.h"

namespace bl::importing {

/// "12", "12 m", "12,5", "40'", "5'10\"", "40 ft", "1200 cm" in metres; nothing where it is not understood.
std::optional<double> osm_length(std::string_view text);
/// "50", "30 mph", "5 knots", "walk" in m/s; nothing for "none", "signals" and what is not understood.
std::optional<double> osm_speed(std::string_view text);
/// "3", "2.5": a plain number; of "2;3" nothing.
std::optional<double> osm_number(std::string_view text);

/// How tall a building is by its tags.
struct OsmHeight {
  double base = 0;    ///< [m] of the underside, 0 where no tag says otherwise
  double height = 0;  ///< [m] from there to the top, the roof included; 0: no tag says
  bool is_from_levels = false;
  std::string fault;  ///< what was not understood, such as "height=high"; empty: nothing
};
OsmHeight osm_height(const OsmTags& tags, double storey_height);

/// A street by its tags.
struct OsmRoad {
  bool is_road = false;
  std::string why_not;  ///< of other values of `highway`: the reason
  std::string road_class;
  double lanes = 1, speed = 0;  ///< speed [m/s]
  double width = 0;             ///< [m]; 0: no tag says
  bool is_lanes_assumed = true, is_speed_assumed = true;
  int direction = 0;  ///< 0 both, 1 along the line, -1 against it
  bool for_cars = true, for_cycles = true, for_feet = true;
  std::string fault;
};
OsmRoad osm_road(const OsmTags& tags);

/// "rail", "tram" and the like for tracks that are in use and on the ground; empty for all else, such as tunnels.
std::string osm_rail(const OsmTags& tags);

/// "landuse=grass" for what covers ground; empty for all else.
std::string osm_ground(const OsmTags& tags);
/// Is the element a building, or a part of one?
bool is_osm_building(const OsmTags& tags);
bool is_osm_part(const OsmTags& tags);

}  // namespace bl::importing
