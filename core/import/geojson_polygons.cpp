// GeoJSON by nlohmann/json; its exceptions end here.
#include "core/import/geojson_polygons.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/base/foreign_bytes.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/define/bounded_json.h"
#include "core/import/context_shape.h"
#include "core/import/local_frame.h"

namespace bl::importing {

namespace {

using SortedJson = nlohmann::json;

std::string join(const std::string& place, std::string_view step) {
  return place.empty() ? std::string(step) : place + "/" + std::string(step);
}
std::string join(const std::string& place, std::size_t step) { return join(place, std::to_string(step)); }

const SortedJson* member(const SortedJson& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

std::string type_of(const SortedJson& object) {
  const SortedJson* type = object.is_object() ? member(object, "type") : nullptr;
  return type && type->is_string() ? type->get<std::string>() : std::string();
}

std::string plain_text(const SortedJson& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return shortest(value.get<double>());
  return value.dump();
}

// A value in a few characters. The library's own dump recurses, and would overflow the stack on deeply nested arrays.
std::string brief(const SortedJson& value) {
  if (value.is_object()) return "{...}";
  if (!value.is_array()) return value.dump().substr(0, 40);
  std::string text = "[";
  for (std::size_t i = 0; i < value.size() && i < 4; ++i)
    text.append(i > 0 ? "," : "").append(value[i].is_structured() ? "..." : value[i].dump().substr(0, 40));
  return text.append(value.size() > 4 ? ",...]" : "]");
}

const std::vector<std::string> kTypes = {"FeatureCollection",  "Feature", "Polygon",    "MultiPolygon",
                                         "GeometryCollection", "Point",   "MultiPoint", "LineString",
                                         "MultiLineString"};

class PolygonReader {
 public:
  explicit PolygonReader(bool has_crs) : has_crs_(has_crs) {}
  Result<GeoDocument> read(const SortedJson& root);

 private:
  Result<std::string> crs_of(const SortedJson& object, const std::string& place, const std::string& inherited);
  Result<void> read_feature(const SortedJson& object, const std::string& place, const std::string& crs, GeoFeature& feature);
  Result<void> read_geometry(const SortedJson& object, const std::string& place, GeoFeature& feature);
  Result<void> read_polygon(const SortedJson& coordinates, const std::string& place, GeoFeature& feature);
  Result<void> read_places(const SortedJson& coordinates, const std::string& place, const std::string& type, GeoFeature& feature);
  Result<std::vector<std::array<double, 2>>> read_positions(const SortedJson& list, const std::string& place);
  Result<std::array<double, 2>> read_position(const SortedJson& position, const std::string& place);

  GeoDocument document_;
  bool has_crs_;
  bool heights_ = false;
  bool is_crs_at_fault_ = false;
};

// The member `crs` of the 2008 format: {"type": "name", "properties": {"name": ...}} or {"type": "EPSG", ... "code"}.
Result<std::string> PolygonReader::crs_of(const SortedJson& object, const std::string& place, const std::string& inherited) {
  const SortedJson* crs = member(object, "crs");
  if (crs == nullptr || has_crs_) return inherited;
  if (crs->is_null()) {
    document_.notes.push_back(
        "The member `crs` is null, which says that the CRS is not known; WGS84 longitude and latitude were assumed.");
    return inherited;
  }
  const SortedJson* properties = crs->is_object() ? member(*crs, "properties") : nullptr;
  if (properties && properties->is_object()) {
    const SortedJson* name = member(*properties, "name");
    const SortedJson* code = member(*properties, "code");
    if (name && name->is_string()) return tidy_crs_name(name->get<std::string>());
    if (code && (code->is_number_integer() || code->is_string())) return tidy_crs_name("EPSG:" + plain_text(*code));
  }
  is_crs_at_fault_ = true;
  return Error{ErrorCode::parse, join(place, "crs"),
               "The member `crs` is not understood. Write {\"type\": \"name\", \"properties\": {\"name\": \"EPSG:28992\"}}, or "
               "give the CRS as an option."};
}

Result<GeoDocument> PolygonReader::read(const SortedJson& root) {
  const std::string type = type_of(root);
  if (type.empty())
    return Error{
        ErrorCode::parse, "",
        "This is JSON but not GeoJSON: it has no member `type`. A FeatureCollection, a Feature or a geometry is needed."};
  auto crs = crs_of(root, "", "OGC:CRS84");
  if (!crs) return crs.error();
  if (type == "FeatureCollection") {
    const SortedJson* features = member(root, "features");
    if (features == nullptr || !features->is_array())
      return Error{ErrorCode::missing, "features", "A FeatureCollection needs an array `features`; it is missing or no array."};
    std::size_t faults = 0;
    for (std::size_t i = 0; i < features->size(); ++i) {
      if (i % 256 == 0 && is_stop_wished()) return stopped_error();
      const std::string place = "features/" + std::to_string(i);
      GeoFeature feature;
      feature.place = place;
      feature.crs = *crs;
      if (auto done = read_feature((*features)[i], place, *crs, feature); !done) {
        feature.polygons.clear(), feature.lines.clear(), feature.points.clear();
        feature.fault = done.error();
        feature.is_fault_of_crs = std::exchange(is_crs_at_fault_, false);
        ++faults;
      }
      document_.features.push_back(std::move(feature));
    }
    // Where there is nothing else, the first fault is that of the file.
    if (faults > 0 && faults == features->size()) return *document_.features.front().fault;
  } else {
    GeoFeature feature;
    if (auto done = read_feature(root, "", *crs, feature); !done) return done.error();
    document_.features.push_back(std::move(feature));
  }
  if (heights_) document_.notes.push_back("The third numbers of the positions (heights) were left out: a plan is flat.");
  return std::move(document_);
}

Result<void> PolygonReader::read_feature(const SortedJson& object, const std::string& place, const std::string& crs,
                                         GeoFeature& feature) {
  if (!object.is_object())
    return Error{ErrorCode::parse, place, "A feature must be an object; this is " + std::string(object.type_name()) + "."};
  const bool is_feature = type_of(object) == "Feature";
  auto own_crs = place.empty() ? Result<std::string>(crs) : crs_of(object, place, crs);
  if (!own_crs) return own_crs.error();
  feature.crs = *own_crs;
  const SortedJson* geometry = is_feature ? member(object, "geometry") : &object;
  if (is_feature) {
    const SortedJson* properties = member(object, "properties");
    if (properties && properties->is_object())
      for (const auto& [name, value] : properties->items())
        if (value.is_primitive() && !value.is_null()) feature.properties.emplace_back(name, plain_text(value));
    const SortedJson* id = member(object, "id");
    if (id && (id->is_string() || id->is_number())) feature.properties.emplace_back("id", plain_text(*id));
  }
  if (geometry && !geometry->is_null()) {
    if (auto done = read_geometry(*geometry, is_feature ? join(place, "geometry") : place, feature); !done) return done.error();
  }
  return {};
}

Result<void> PolygonReader::read_geometry(const SortedJson& object, const std::string& place, GeoFeature& feature) {
  const std::string type = type_of(object);
  if (std::find(kTypes.begin() + 2, kTypes.end(), type) == kTypes.end())
    return Error{ErrorCode::unknown_type, join(place, "type"),
                 "The geometry type `" + type + "` is not one of GeoJSON" + did_you_mean(type, kTypes) +
                     (did_you_mean(type, kTypes).empty() ? ". Write Polygon or MultiPolygon." : "")};
  auto crs = crs_of(object, place, feature.crs);
  if (!crs) return crs.error();
  feature.crs = *crs;
  if (type == "GeometryCollection") {
    const SortedJson* parts = member(object, "geometries");
    if (parts == nullptr || !parts->is_array())
      return Error{ErrorCode::missing, join(place, "geometries"), "A GeometryCollection needs an array `geometries`."};
    // A collection within a collection is legal but discouraged; refusing it bounds the depth of this recursion.
    for (std::size_t i = 0; i < parts->size(); ++i) {
      const std::string part_place = join(join(place, "geometries"), i);
      if (type_of((*parts)[i]) == "GeometryCollection")
        return Error{ErrorCode::parse, part_place,
                     "A GeometryCollection inside another one is not read; put its parts into the outer one."};
      if (auto done = read_geometry((*parts)[i], part_place, feature); !done) return done;
    }
    return {};
  }
  const SortedJson* coordinates = member(object, "coordinates");
  const std::string coordinates_place = join(place, "coordinates");
  if (coordinates == nullptr || !coordinates->is_array())
    return Error{ErrorCode::missing, coordinates_place,
                 "A " + type + " needs an array `coordinates`; it is missing or no array."};
  if (type != "Polygon" && type != "MultiPolygon") return read_places(*coordinates, coordinates_place, type, feature);
  if (type == "Polygon") return read_polygon(*coordinates, coordinates_place, feature);
  for (std::size_t i = 0; i < coordinates->size(); ++i)
    if (auto done = read_polygon((*coordinates)[i], join(coordinates_place, i), feature); !done) return done;
  return {};
}

Result<void> PolygonReader::read_places(const SortedJson& coordinates, const std::string& place, const std::string& type,
                                        GeoFeature& feature) {
  if (type == "Point") {
    if (coordinates.empty()) return {};  // RFC 7946: an empty one is like none
    auto position = read_position(coordinates, place);
    if (!position) return position.error();
    feature.points.push_back({place, *position});
  } else if (type == "MultiPoint") {
    auto positions = read_positions(coordinates, place);
    if (!positions) return positions.error();
    for (std::size_t i = 0; i < positions->size(); ++i) feature.points.push_back({join(place, i), (*positions)[i]});
  } else {
    const bool is_one = type == "LineString";
    for (std::size_t i = 0; i < (is_one ? 1 : coordinates.size()); ++i) {
      const std::string line_place = is_one ? place : join(place, i);
      auto positions = read_positions(is_one ? coordinates : coordinates[i], line_place);
      if (!positions) return positions.error();
      feature.lines.push_back({line_place, std::move(*positions)});
    }
  }
  return {};
}

Result<std::vector<std::array<double, 2>>> PolygonReader::read_positions(const SortedJson& list, const std::string& place) {
  if (!list.is_array()) return Error{ErrorCode::parse, place, "A line must be an array of positions [x, y]."};
  std::vector<std::array<double, 2>> positions;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto position = read_position(list[i], join(place, i));
    if (!position) return position.error();
    positions.push_back(*position);
  }
  return positions;
}

Result<void> PolygonReader::read_polygon(const SortedJson& coordinates, const std::string& place, GeoFeature& feature) {
  GeoPolygon polygon;
  polygon.place = place;
  if (!coordinates.is_array()) return Error{ErrorCode::parse, place, "A polygon must be an array of rings."};
  for (std::size_t r = 0; r < coordinates.size(); ++r) {
    const SortedJson& ring = coordinates[r];
    const std::string ring_place = join(place, r);
    if (!ring.is_array()) return Error{ErrorCode::parse, ring_place, "A ring must be an array of positions [x, y]."};
    polygon.rings.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      auto position = read_position(ring[i], join(ring_place, i));
      if (!position) return position.error();
      polygon.rings.back().push_back(*position);
    }
  }
  if (!polygon.rings.empty()) feature.polygons.push_back(std::move(polygon));
  return {};
}

Result<std::array<double, 2>> PolygonReader::read_position(const SortedJson& position, const std::string& place) {
  if (!position.is_array() || position.size() < 2 || !position[0].is_number() || !position[1].is_number())
    return Error{ErrorCode::parse, place,
                 "A position must be an array of two numbers [x, y] (longitude, latitude); this is " + brief(position) + "."};
  heights_ = heights_ || position.size() > 2;
  const std::array<double, 2> point{position[0].get<double>(), position[1].get<double>()};
  if (!std::isfinite(point[0]) || !std::isfinite(point[1]))
    return Error{ErrorCode::not_finite, place, "A position must have finite numbers."};
  return point;
}

}  // namespace

Result<GeoDocument> read_geojson_polygons(std::string_view text, bool has_crs) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    return Error{ErrorCode::missing, "line 1, column 1", "The file is empty: GeoJSON is needed."};
  if (auto foreign = foreign_bytes(text, "GeoJSON", "export it as GeoJSON, which is text")) return *foreign;
  const auto json = read_bounded_json(text, "GeoJSON");
  if (!json) return json.error();
  try {
    return PolygonReader(has_crs).read(*json);
  } catch (const SortedJson::exception&) {
    return Error{ErrorCode::parse, "", "The text cannot be read as JSON: a number or a character in it is out of range."};
  }
}

}  // namespace bl::importing
