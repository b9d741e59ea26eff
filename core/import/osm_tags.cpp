// The tags as the OpenStreetMap wiki describes them; defaults of streets by class are ours and marked as assumed.
#include "core/import/osm_tags.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"

namespace bl::importing {

namespace {

constexpr double kFoot = 0.3048, kInch = 0.0254, kMile = 1609.344, kNauticalMile = 1852;

// The number that a text begins with (decimal point or comma), and what follows it.
std::optional<double> leading_number(std::string_view text, std::string_view& rest) {
  std::string digits;
  std::size_t i = 0;
  for (; i < text.size(); ++i) {
    const char c = text[i];
    const bool is_sign = (c == '-' || c == '+') && digits.empty();
    if (!is_sign && !(c >= '0' && c <= '9') && c != '.' && c != ',') break;
    if (c != '+') digits += c == ',' ? '.' : c;
  }
  rest = csv::trimmed(text.substr(i));
  if (digits.starts_with(".")) digits.insert(0, "0");
  if (digits.ends_with(".")) digits.pop_back();
  return parse_number(digits);
}

struct RoadClass {
  std::string_view name;
  double lanes, speed;  // of both directions together; [km/h]
  bool for_cars, for_cycles, for_feet;
};
constexpr std::array kRoads = {
    RoadClass{"motorway", 2, 120, true, false, false},  RoadClass{"motorway_link", 1, 80, true, false, false},
    RoadClass{"trunk", 2, 100, true, true, false},      RoadClass{"trunk_link", 1, 60, true, true, false},
    RoadClass{"primary", 2, 50, true, true, true},      RoadClass{"primary_link", 1, 50, true, true, true},
    RoadClass{"secondary", 2, 50, true, true, true},    RoadClass{"secondary_link", 1, 50, true, true, true},
    RoadClass{"tertiary", 2, 50, true, true, true},     RoadClass{"tertiary_link", 1, 50, true, true, true},
    RoadClass{"unclassified", 2, 50, true, true, true}, RoadClass{"residential", 2, 50, true, true, true},
    RoadClass{"road", 2, 50, true, true, true},         RoadClass{"living_street", 1, 20, true, true, true},
    RoadClass{"service", 1, 20, true, true, true},      RoadClass{"track", 1, 20, true, true, true},
    RoadClass{"busway", 1, 50, false, false, false},    RoadClass{"bus_guideway", 1, 50, false, false, false},
    RoadClass{"pedestrian", 1, 5, false, true, true},   RoadClass{"footway", 1, 5, false, false, true},
    RoadClass{"path", 1, 5, false, true, true},         RoadClass{"cycleway", 1, 20, false, true, true},
    RoadClass{"bridleway", 1, 5, false, false, true},   RoadClass{"steps", 1, 3, false, false, true},
    RoadClass{"corridor", 1, 5, false, false, true},
};

const RoadClass* road_class(std::string_view name) {
  for (const RoadClass& row : kRoads)
    if (row.name == name) return &row;
  return nullptr;
}

bool is_no(std::string_view value) { return value == "no" || value == "private" || value == "use_sidepath"; }

// Who may drive here does so to the fields, the yard or the shop, and not on through.
bool is_for_few(std::string_view value) {
  return value == "agricultural" || value == "forestry" || value == "delivery" || value == "customers";
}

void read_access(const OsmTags& tags, OsmRoad& road) {
  const auto allow = [&tags](const char* key, bool& mode) {
    const std::string& value = tag_of(tags, key);
    if (is_no(value)) mode = false;
    else if (value == "yes" || value == "designated" || value == "permissive") mode = true;
  };
  for (const char* key : {"access", "vehicle"}) {
    const bool no = is_no(tag_of(tags, key));
    if (no) road.for_cars = road.for_cycles = false;
    if (no && std::string_view(key) == "access") road.for_feet = false;
    if (is_for_few(tag_of(tags, key))) road.for_cars = false;
  }
  for (const char* key : {"motor_vehicle", "motorcar"}) {
    allow(key, road.for_cars);
    if (is_for_few(tag_of(tags, key))) road.for_cars = false;
  }
  allow("bicycle", road.for_cycles);
  allow("foot", road.for_feet);
}

void read_direction(const OsmTags& tags, OsmRoad& road) {
  const std::string& oneway = tag_of(tags, "oneway");
  const std::string& junction = tag_of(tags, "junction");
  if (oneway == "yes" || oneway == "true" || oneway == "1") road.direction = 1;
  else if (oneway == "-1" || oneway == "reverse") road.direction = -1;
  else if (oneway != "no" && (junction == "roundabout" || junction == "circular" || road.road_class == "motorway"))
    road.direction = 1;
  if (!oneway.empty() && oneway != "no" && oneway != "false" && oneway != "0" && road.direction == 0)
    road.fault = "oneway=" + oneway;
}

}  // namespace

std::optional<double> osm_length(std::string_view text) {
  text = csv::trimmed(text);
  std::string_view rest;
  const auto number = leading_number(text, rest);
  if (!number) return std::nullopt;
  if (rest.empty() || rest == "m" || rest == "metres" || rest == "meters" || rest == "metre" || rest == "meter") return *number;
  if (rest == "cm") return *number / 100;
  if (rest == "km") return *number * 1000;
  if (rest == "ft" || rest == "feet" || rest == "foot") return *number * kFoot;
  if (rest.starts_with("'") || rest.starts_with("\xE2\x80\xB2")) {
    std::string_view inches = csv::trimmed(rest.substr(rest.starts_with("'") ? 1 : 3));
    if (inches.empty()) return *number * kFoot;
    std::string_view mark;
    const auto more = leading_number(inches, mark);
    if (more && (mark == "\"" || mark == "''" || mark == "in" || mark == "\xE2\x80\xB3" || mark.empty()))
      return *number * kFoot + *more * kInch;
  }
  return std::nullopt;
}

std::optional<double> osm_speed(std::string_view text) {
  text = csv::trimmed(text);
  if (text == "walk") return 5 / 3.6;
  std::string_view rest;
  const auto number = leading_number(text, rest);
  if (!number || !(*number > 0)) return std::nullopt;
  if (rest.empty() || rest == "km/h" || rest == "kmh" || rest == "kph") return *number / 3.6;
  if (rest == "mph") return *number * kMile / 3600;
  if (rest == "knots") return *number * kNauticalMile / 3600;
  return std::nullopt;
}

std::optional<double> osm_number(std::string_view text) {
  std::string_view rest;
  const auto number = leading_number(csv::trimmed(text), rest);
  return rest.empty() ? number : std::nullopt;
}

OsmHeight osm_height(const OsmTags& tags, double storey_height) {
  OsmHeight result;
  const auto read = [&](std::initializer_list<const char*> keys, auto parse) -> std::optional<double> {
    for (const char* key : keys) {
      const std::string& text = tag_of(tags, key);
      if (text.empty()) continue;
      if (const auto value = parse(text); value && *value >= 0 && *value < 10000) return value;
      result.fault += (result.fault.empty() ? "" : ", ") + std::string(key) + "=" + text.substr(0, 40);
    }
    return std::nullopt;
  };
  const auto top = read({"height", "building:height", "est_height"}, osm_length);
  const auto levels = read({"building:levels", "levels"}, osm_number);
  const auto roof_height = read({"roof:height"}, osm_length);
  const auto roof_levels = read({"roof:levels"}, osm_number);
  const auto base = read({"min_height", "building:min_height"}, osm_length);
  const auto base_levels = read({"building:min_level", "min_level"}, osm_number);
  // Levels are counted from the ground, those of the roof come on top, and so does its height.
  result.base = base.value_or(base_levels.value_or(0) * storey_height);
  double summit = 0;
  if (top) summit = *top;
  else if (levels) {
    summit = *levels * storey_height + roof_height.value_or(roof_levels.value_or(0) * storey_height);
    result.is_from_levels = true;
  }
  if (summit > result.base) result.height = summit - result.base;
  else if (summit > 0 || (top && *top == 0))
    result.fault += (result.fault.empty() ? "" : ", ") + std::string("its top is not above its underside");
  if (result.height == 0) result.is_from_levels = false;
  return result;
}

OsmRoad osm_road(const OsmTags& tags) {
  OsmRoad road;
  road.road_class = tag_of(tags, "highway");
  const RoadClass* known = road_class(road.road_class);
  if (road.road_class.empty()) return road;
  if (known == nullptr) {
    road.why_not = "no way to travel on";
    return road;
  }
  if (tag_of(tags, "area") == "yes") {
    road.why_not = "a paved area, not a line";
    return road;
  }
  road.is_road = true;
  road.for_cars = known->for_cars;
  road.for_cycles = known->for_cycles;
  road.for_feet = known->for_feet;
  read_access(tags, road);
  read_direction(tags, road);
  road.lanes = road.direction != 0 && known->lanes == 2 && road.road_class != "motorway" ? 1 : known->lanes;
  road.speed = known->speed / 3.6;
  if (const std::string& lanes = tag_of(tags, "lanes"); !lanes.empty()) {
    const auto number = osm_number(lanes);
    road.is_lanes_assumed = !(number && *number > 0 && *number <= 20);
    if (!road.is_lanes_assumed) road.lanes = *number;
    else road.fault += (road.fault.empty() ? "" : ", ") + std::string("lanes=") + lanes.substr(0, 40);
  }
  if (const auto width = osm_length(tag_of(tags, "width")); width && *width > 0 && *width <= 200) road.width = *width;
  if (const std::string& speed = tag_of(tags, "maxspeed"); !speed.empty()) {
    const auto number = osm_speed(speed);
    road.is_speed_assumed = !(number && *number <= 200);
    if (!road.is_speed_assumed) road.speed = *number;
    else if (speed != "none" && speed != "signals" && speed.find(':') == std::string::npos)
      road.fault += (road.fault.empty() ? "" : ", ") + std::string("maxspeed=") + speed.substr(0, 40);
  }
  return road;
}

std::string osm_rail(const OsmTags& tags) {
  constexpr std::array kTracks{"rail", "light_rail", "narrow_gauge", "tram", "subway", "funicular", "preserved"};
  const std::string &value = tag_of(tags, "railway"), &tunnel = tag_of(tags, "tunnel");
  if (std::find(kTracks.begin(), kTracks.end(), value) == kTracks.end()) return {};
  return tunnel.empty() || tunnel == "no" ? value : std::string();
}

std::string osm_ground(const OsmTags& tags) {
  for (const char* key : {"landuse", "natural", "leisure", "waterway", "amenity"}) {
    const std::string& value = tag_of(tags, key);
    if (value.empty() || value == "no") continue;
    const std::string_view name = key;
    if (name == "natural" && (value == "tree" || value == "tree_row" || value == "coastline" || value == "cliff")) continue;
    if (name == "waterway" && value != "riverbank" && value != "dock") continue;
    if (name == "amenity" && value != "parking" && value != "school" && value != "university" && value != "hospital" &&
        value != "grave_yard" && value != "marketplace")
      continue;
    return std::string(name) + "=" + value;
  }
  return {};
}

bool is_osm_building(const OsmTags& tags) {
  const std::string& value = tag_of(tags, "building");
  return !value.empty() && value != "no";
}

bool is_osm_part(const OsmTags& tags) {
  const std::string& value = tag_of(tags, "building:part");
  return !value.empty() && value != "no";
}

}  // namespace bl::importing
