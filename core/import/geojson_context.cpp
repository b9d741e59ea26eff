// Features to buildings, plots, areas and streets; each polygon and line of a feature becomes an element of its own.
#include "core/import/geojson_context.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/hash.h"
#include "core/base/plural.h"
#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/import/context_shape.h"
#include "core/import/geojson_polygons.h"
#include "core/import/inflate.h"
#include "core/import/osm_tags.h"

namespace bl::importing {

namespace {

// Our name of a property, and what it may be called in files; compared in lower case.
struct Alias {
  std::string_view ours;
  std::array<std::string_view, 9> theirs;
};
constexpr std::array kAliases = {
    Alias{"height",
          {"height", "measuredheight", "building:height", "bldg_height", "hoehe", "hauteur", "hoogte", "roof_height", "h"}},
    Alias{"levels",
          {"building:levels", "levels", "floors", "storeys", "stories", "num_floors", "bouwlagen", "geschosse", "etages"}},
    Alias{"base", {"min_height"}},                              // from the ground up, below a top that counts from there
    Alias{"ground", {"ground_height", "base_height", "base"}},  // above the sea, below the height
    Alias{"name", {"name", "title", "naam"}},
    Alias{"use", {"use", "function", "usage", "building:use", "building", "class", "landuse", "natural"}},
    Alias{"id", {"id", "uid", "osm_id", "identificatie", "gml_id", "fid", "gid"}},
    Alias{"lanes", {"lanes", "num_lanes"}},
    Alias{"width", {"width", "breite", "largeur", "breedte"}},
    Alias{"speed", {"maxspeed", "speed_limit", "speed"}},
    Alias{"oneway", {"oneway", "one_way"}},
    Alias{"class", {"highway", "road_class", "fclass", "class"}},
};

class Properties {
 public:
  Properties(const GeoFeature& feature, const ContextOptions& options) : options_(options) {
    for (const auto& [name, value] : feature.properties)
      if (!value.empty()) values_.emplace(lower_case(name), value);
  }
  bool has(std::string_view name) const { return values_.contains(std::string(name)); }
  std::string raw(std::string_view name) const {
    const auto it = values_.find(std::string(name));
    return it == values_.end() ? std::string() : it->second;
  }
  std::string get(std::string_view ours) const {
    for (const auto& [name, theirs] : options_.properties)
      if (const std::string named = raw(lower_case(theirs)); name == ours && !named.empty()) return named;
    for (const Alias& alias : kAliases)
      if (alias.ours == ours)
        for (const std::string_view name : alias.theirs)
          if (!name.empty() && has(name)) return raw(name);
    return {};
  }
  OsmTags tags() const {
    OsmTags tags;
    for (const auto& [name, value] : values_) tags.emplace(name, value);
    return tags;
  }

 private:
  const ContextOptions& options_;
  std::map<std::string, std::string> values_;
};

std::string geometry_id(const Hash& hash) { return kGeometryId + hash.hex().substr(0, 8); }

std::string geometry_id(const GeoFeature& feature) {
  Hash hash;
  const auto add = [&hash](const std::vector<std::array<double, 2>>& points) {
    hash.add(static_cast<std::uint64_t>(points.size()));
    for (const auto& [x, y] : points) {
      hash.add(x);
      hash.add(y);
    }
  };
  for (const GeoPolygon& polygon : feature.polygons)
    for (const auto& ring : polygon.rings) add(ring);
  for (const GeoLine& line : feature.lines) add(line.points);
  return geometry_id(hash);
}

void note_of_feature(std::string& text, const std::string& more) {
  if (!more.empty()) text += (text.empty() ? "" : ", ") + more;
}

class GeoImporter {
 public:
  GeoImporter(const ContextOptions& options, const LocalFrame& frame, Context& context)
      : options_(options), frame_(frame), context_(context) {}

  void read(const GeoFeature& feature) {
    const Properties properties(feature, options_);
    id_ = properties.get("id");
    if (id_.empty()) id_ = geometry_id(feature);
    const std::string shown = feature.place.empty() ? "the feature" : feature.place;
    if (feature.fault) context_.report.skip("feature", shown, feature.unread(), feature.fault->text());
    else if (!feature.polygons.empty()) polygons(feature, properties, shown);
    else if (!feature.lines.empty()) lines(feature, properties, shown);
    else if (!feature.points.empty()) context_.report.skip("feature", shown, "a single place: points are not read");
    else context_.report.skip("feature", shown, "it has no geometry");
    context_.report.locate(place_of(all_points(feature)));
  }

  std::size_t unsure = 0;  // polygons whose properties did not say what they are

 private:
  std::vector<Point3> local(const std::vector<std::array<double, 2>>& raw) const {
    std::vector<Point3> points;
    points.reserve(raw.size());
    for (const auto& p : raw) points.push_back(frame_.to_local(p[0], p[1]));
    return points;
  }

  std::vector<Point3> all_points(const GeoFeature& feature) const {
    std::vector<std::array<double, 2>> raw;
    for (const GeoPolygon& polygon : feature.polygons)
      raw.insert(raw.end(), polygon.rings.front().begin(), polygon.rings.front().end());
    for (const GeoLine& line : feature.lines) raw.insert(raw.end(), line.points.begin(), line.points.end());
    for (const GeoPoint& point : feature.points) raw.push_back(point.position);
    return local(raw);
  }

  // Each feature has one row: the next one is that of the feature which is being read.
  std::size_t next_row() const { return context_.report.rows().size(); }

  std::string kind_of(const Properties& p) {
    if (!options_.feature_kind.empty()) return options_.feature_kind;
    if (p.has("building") || !p.get("height").empty() || !p.get("levels").empty()) return "building";
    for (const char* name : {"landuse", "natural", "leisure", "waterway", "class", "code_2018"})
      if (p.has(name)) return "area";
    ++unsure;
    return "building";
  }

  void polygons(const GeoFeature& feature, const Properties& properties, const std::string& shown) {
    const std::string kind = kind_of(properties);
    if (kind == "street") return context_.report.skip("feature", shown, "street: it is a polygon, not a line");
    std::size_t taken = 0;
    std::string mended, fault, where;
    for (std::size_t i = 0; i < feature.polygons.size(); ++i) {
      const std::string id = feature.polygons.size() > 1 ? id_ + "/" + std::to_string(i + 1) : id_;
      std::string trouble;
      const std::string why = polygon(feature.polygons[i], properties, kind, id, trouble);
      if (why.empty()) {
        ++taken;
        note_of_feature(mended, trouble);
      } else {
        if (fault.empty()) fault = why;
        note_of_feature(where, trouble);
      }
    }
    if (taken == 0) return context_.report.skip("feature", shown, kind + ": " + fault, where);
    if (taken < feature.polygons.size())
      note_of_feature(mended, std::to_string(feature.polygons.size() - taken) + " of its polygons left out: " + fault);
    if (mended.empty()) context_.report.take("feature", shown, kind);
    else context_.report.repair("feature", shown, kind, mended);
  }

  // Empty where it was taken, else the reason why not.
  std::string polygon(const GeoPolygon& polygon, const Properties& properties, const std::string& kind, const std::string& id,
                      std::string& mended) {
    const std::vector<Point3> outline = local(polygon.rings.front());
    if (const std::string far = out_of_reach(options_, outline); !far.empty()) return far;
    SoundRing outer = sound_ring(outline, true);
    mended = outer.mended;
    if (!outer.fault.empty()) return outer.fault;
    std::vector<geometry::Ring> holes;
    for (std::size_t r = 1; r < polygon.rings.size(); ++r) {
      SoundRing hole = sound_ring(local(polygon.rings[r]), false);
      if (!hole.fault.empty()) note_of_feature(mended, "a hole left out: " + hole.fault);
      else {
        note_of_feature(mended, hole.mended);
        holes.push_back(std::move(hole.ring));
      }
    }
    if (kind != "area")
      if (const std::string fault = limit_corners(outer.ring, holes, mended); !fault.empty()) return fault;
    sort_holes(outer.ring, holes, mended);
    if (kind != "building") {
      context_.areas.push_back({id, properties.get("name"), properties.get("use"), std::move(outer.ring), std::move(holes),
                                kind == "plot", next_row()});
      return {};
    }
    OsmTags tags;
    for (const auto& [key, ours] : {std::pair{"height", "height"}, {"building:levels", "levels"}, {"min_height", "base"}})
      if (const std::string value = properties.get(ours); !value.empty()) tags.emplace(key, value);
    const OsmHeight height = osm_height(tags, options_.storey_height);
    ContextBuilding building;
    building.base = height.base;
    building.height = height.height;
    building.height_source = height.is_from_levels ? HeightSource::levels : HeightSource::tag;
    if (!height.fault.empty()) note_of_feature(mended, "not understood: " + height.fault);
    if (const std::string ground = properties.get("ground"); !ground.empty()) {
      const auto level = osm_length(ground);
      if (level) building.base += *level, building.is_above_sea = true;
      else note_of_feature(mended, "not understood: height of its ground " + ground.substr(0, 40));
    }
    if (const std::string beyond = out_of_heights(building.base, building.height); !beyond.empty()) return beyond;
    building.id = id;
    building.row = next_row();
    building.name = properties.get("name");
    building.use = properties.get("use");
    if (building.use == "yes") building.use.clear();
    building.outer = std::move(outer.ring);
    building.holes = std::move(holes);
    context_.buildings.push_back(std::move(building));
    return {};
  }

  void lines(const GeoFeature& feature, const Properties& properties, const std::string& shown) {
    if (!options_.feature_kind.empty() && options_.feature_kind != "street")
      return context_.report.skip("feature", shown, options_.feature_kind + ": it is a line, not a polygon");
    OsmTags tags = properties.tags();
    const std::string road_class = properties.get("class");
    // Without a class of its own a line is a street that all may use.
    tags["highway"] = road_class.empty() ? "road" : road_class;
    for (const auto& [key, ours] : {std::pair{"lanes", "lanes"}, {"maxspeed", "speed"}, {"oneway", "oneway"}, {"width", "width"}})
      if (const std::string value = properties.get(ours); !value.empty()) tags[key] = value;
    // As Geofabrik's extracts have it: forth, to (against the line), both.
    if (const std::string way = lower_case(tags["oneway"]); way == "f") tags["oneway"] = "yes";
    else if (way == "t") tags["oneway"] = "-1";
    else if (way == "b") tags["oneway"] = "no";
    const OsmRoad road = osm_road(tags);
    if (!road.is_road) return context_.report.skip("feature", shown, "street: " + road.why_not, "class=" + road_class);
    std::string mended = road.fault.empty() ? "" : "not understood: " + road.fault, fault;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < feature.lines.size(); ++i) {
      std::vector<Point3> line = local(feature.lines[i].points);
      const std::size_t given = line.size();
      line.erase(std::unique(line.begin(), line.end()), line.end());
      std::string why = out_of_reach(options_, line);
      if (why.empty() && line.size() < 2) why = "fewer than two different points";
      if (!why.empty()) {
        fault = why;
        continue;
      }
      if (line.size() < given) note_of_feature(mended, "repeated points dropped (" + std::to_string(given - line.size()) + ")");
      if (road.direction < 0) std::reverse(line.begin(), line.end());
      const std::string id = feature.lines.size() > 1 ? id_ + "/" + std::to_string(i + 1) : id_;
      raw_.push_back({std::move(line), road, id, properties.get("name"), next_row()});
      ++taken;
    }
    if (taken == 0) return context_.report.skip("feature", shown, "street: " + fault);
    if (taken < feature.lines.size())
      note_of_feature(mended, std::to_string(feature.lines.size() - taken) + " of its lines left out: " + fault);
    if (mended.empty()) context_.report.take("feature", shown, "street");
    else context_.report.repair("feature", shown, "street", mended);
  }

 public:
  // Lines meet where they have a point in common, to the millimetre: there they are cut.
  void cut_streets() {
    std::map<std::array<double, 2>, int> visits;
    for (const RawStreet& raw : raw_) {
      for (const Point3& p : raw.line) ++visits[key(p)];
      ++visits[key(raw.line.front())];
      ++visits[key(raw.line.back())];
    }
    for (const RawStreet& raw : raw_) {
      std::size_t first = 0, number = 0;
      for (std::size_t i = 1; i < raw.line.size(); ++i) {
        if (visits.at(key(raw.line[i])) < 2) continue;
        ContextStreet& street = context_.streets.emplace_back();
        street.id = raw.id + "/" + std::to_string(number++);
        street.name = raw.name;
        street.row = raw.row;
        street.street_class = raw.road.road_class;
        street.line.assign(raw.line.begin() + static_cast<std::ptrdiff_t>(first),
                           raw.line.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        street.start = junction(raw.line[first]);
        street.end = junction(raw.line[i]);
        street.lanes = raw.road.lanes;
        street.speed = raw.road.speed;
        street.width = raw.road.width;
        street.is_lanes_assumed = raw.road.is_lanes_assumed;
        street.is_speed_assumed = raw.road.is_speed_assumed;
        street.is_one_way = raw.road.direction != 0;
        street.for_cars = raw.road.for_cars;
        street.for_cycles = raw.road.for_cycles;
        street.for_feet = raw.road.for_feet;
        first = i;
      }
    }
  }

 private:
  struct RawStreet {
    std::vector<Point3> line;
    OsmRoad road;
    std::string id, name;
    std::size_t row = kNoRow;
  };

  static std::array<double, 2> key(const Point3& p) { return {std::round(p.x * 1000), std::round(p.y * 1000)}; }

  std::size_t junction(const Point3& p) {
    const auto [it, is_new] = junctions_.emplace(key(p), context_.junctions.size());
    if (is_new) {
      Hash hash;
      for (const double number : it->first) hash.add(number);
      context_.junctions.push_back({geometry_id(hash), p});
    }
    return it->second;
  }

  const ContextOptions& options_;
  const LocalFrame& frame_;
  Context& context_;
  std::string id_;
  std::vector<RawStreet> raw_;
  std::map<std::array<double, 2>, std::size_t> junctions_;
};

std::optional<std::array<double, 2>> middle(const GeoDocument& document) {
  std::vector<std::array<double, 2>> points;
  for (const GeoFeature& feature : document.features) {
    for (const GeoPolygon& polygon : feature.polygons)
      for (const auto& ring : polygon.rings) points.insert(points.end(), ring.begin(), ring.end());
    for (const GeoLine& line : feature.lines) points.insert(points.end(), line.points.begin(), line.points.end());
    for (const GeoPoint& point : feature.points) points.push_back(point.position);
  }
  return middle_of(std::move(points));
}

}  // namespace

std::vector<std::string> context_property_names() {
  std::vector<std::string> names;
  for (const Alias& alias : kAliases) names.emplace_back(alias.ours);
  return names;
}

Result<Context> read_geojson_context(std::string_view bytes, const ContextOptions& options) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  auto document = read_geojson_polygons(*text, !options.crs.empty());
  if (!document) return document.error();
  const auto centre = middle(*document);
  if (!centre) return Error{ErrorCode::missing, "features", "The file holds no positions: there is nothing to import."};
  // A feature that cannot be read says nothing of the others.
  std::string crs;
  for (const GeoFeature& feature : document->features)
    if (crs.empty() && !feature.fault) crs = feature.crs;
  for (const GeoFeature& feature : document->features)
    if (!feature.fault && feature.crs != crs && options.crs.empty())
      return Error{
          ErrorCode::conflict, feature.place,
          "This feature is in " + feature.crs + ", the first one in " + crs + ": split the file, or give one CRS for all."};
  auto frame = context_frame(options, crs, *centre);
  if (!frame) return frame.error();
  Context context;
  context.source_crs = context_crs(options, crs);
  context.reference = frame->reference();
  context.notes = document->notes;
  context.notes.insert(context.notes.end(), frame->notes().begin(), frame->notes().end());
  for (const GeoFeature& feature : document->features)
    for (const auto& [name, value] : feature.properties) context.properties.insert(name);
  GeoImporter importer(options, *frame, context);
  for (std::size_t i = 0; i < document->features.size(); ++i) {
    if (i % 256 == 0 && !goes_on(options.watch, "features", i, document->features.size())) return stopped_error();
    importer.read(document->features[i]);
  }
  importer.cut_streets();
  if (importer.unsure > 0)
    context.notes.push_back("The properties of " + how_many(importer.unsure, "polygon") +
                            by_number(importer.unsure, " do not say what it is: it was taken as a building.",
                                      " do not say what they are: they were taken as buildings.") +
                            " Say so by `--as plot` or `--as area` if that is wrong.");
  assume_heights(options, context);
  return context;
}

}  // namespace bl::importing
