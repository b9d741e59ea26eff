// Tables, points and rasters to one form; every record, feature and cell is accounted for.
#include "core/import/data_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/import/context_shape.h"
#include "core/import/geojson_polygons.h"
#include "core/import/inflate.h"
#include "core/import/number_column.h"
#include "core/import/programme_columns.h"

namespace bl::importing {

namespace {

// A point on its way: where it stands in the file, in the CRS of the file.
struct RawPoint {
  std::string place;
  double x = 0, y = 0, value = 0;
};

// An element that was skipped, although it has a place: the row that speaks of it.
struct SkippedPoint {
  std::size_t row = 0;
  double x = 0, y = 0;
};

Result<void> place_points(std::vector<RawPoint> raw, const std::vector<SkippedPoint>& skipped, const ContextOptions& options,
                          const std::string& crs, const char* kind, DataLayer& layer) {
  std::vector<std::array<double, 2>> positions;
  for (const RawPoint& point : raw) positions.push_back({point.x, point.y});
  const auto middle = middle_of(std::move(positions));
  if (!middle) return Error{ErrorCode::missing, "", "The file holds no point with a value: there is nothing to import."};
  if (raw.size() > kMostLayerPoints)
    return Error{ErrorCode::out_of_range, "",
                 "The layer has more than " + std::to_string(kMostLayerPoints) + " points: cut out the part that you need."};
  auto frame = context_frame(options, crs, *middle);
  if (!frame) return frame.error();
  layer.source_crs = context_crs(options, crs);
  layer.reference = frame->reference();
  layer.notes.insert(layer.notes.end(), frame->notes().begin(), frame->notes().end());
  for (const SkippedPoint& point : skipped) layer.report.locate(point.row, place_of({frame->to_local(point.x, point.y)}));
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (i % 1024 == 0 && !goes_on(options.watch, "points", i, raw.size())) return stopped_error();
    const RawPoint& point = raw[i];
    const Point3 at = frame->to_local(point.x, point.y);
    const std::string far = out_of_reach(options, {at});
    if (far.empty()) layer.points.push_back({at.x, at.y, point.value});
    if (far.empty()) layer.report.take(kind, point.place, "point with a value");
    else layer.report.skip(kind, point.place, far);
    layer.report.locate(place_of({at}));
  }
  return {};
}

struct LayerColumn {
  std::size_t index = 0;
  char decimal = '.';
  std::string unit;
};

class TableReader {
 public:
  TableReader(const csv::CsvText& csv, const std::string& value) : csv_(csv), wanted_(value) {}

  Result<void> match() {
    const csv::CsvRecord& header = csv_.records.front();
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const std::string name = normal_header(header.fields[i]).name;
      const auto is = [&name](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
      };
      if (!x_ && is({"x", "easting", "east", "x_coordinate", "coord_x"})) x_ = i;
      else if (!y_ && is({"y", "northing", "north", "y_coordinate", "coord_y"})) y_ = i;
      else if (!x_ && is({"lon", "long", "longitude", "lng"})) x_ = i, is_degrees = true;
      else if (!y_ && is({"lat", "latitude"})) y_ = i;
    }
    const std::string line = "line " + std::to_string(header.line);
    if (!x_ || !y_)
      return Error{ErrorCode::missing, line,
                   "There are no columns of coordinates: call them x and y, or longitude and latitude."};
    return choose_value(header, line);
  }

  Result<std::vector<RawPoint>> read(ImportReport& report, std::vector<SkippedPoint>& skipped) const {
    std::array<LayerColumn, 3> columns;
    for (const auto& [i, index] : {std::pair{0u, *x_}, {1u, *y_}, {2u, value_}}) {
      auto decimal = decimal_of(index);
      if (!decimal) return decimal.error();
      columns[i] = {index, *decimal, ""};
    }
    std::vector<RawPoint> points;
    for (std::size_t r = 1; r < csv_.records.size(); ++r) {
      const csv::CsvRecord& record = csv_.records[r];
      RawPoint point;
      point.place = "line " + std::to_string(record.line);
      const auto x = number(record, columns[0]), y = number(record, columns[1]), value = number(record, columns[2]);
      if (!x || !y) report.skip("record", point.place, "no coordinates");
      else if (!value) {
        skipped.push_back({report.rows().size(), *x, *y});
        report.skip("record", point.place, "no value", text(record, value_).substr(0, 40));
      } else {
        point.x = *x, point.y = *y, point.value = *value;
        points.push_back(std::move(point));
      }
    }
    return points;
  }

  std::string value_name() const { return csv_.records.front().fields[value_]; }
  bool is_degrees = false;

 private:
  static std::string text(const csv::CsvRecord& record, std::size_t index) {
    return index < record.fields.size() ? record.fields[index] : std::string();
  }

  static std::optional<double> number(const csv::CsvRecord& record, const LayerColumn& column) {
    const std::string field = text(record, column.index);
    if (field.empty()) return std::nullopt;
    std::string plain = field;
    if (column.decimal == ',') std::replace(plain.begin(), plain.end(), ',', '.');
    return parse_number(plain);
  }

  Result<char> decimal_of(std::size_t index) const {
    if (csv_.separator == ',') return '.';
    std::vector<NumberField> fields;
    for (std::size_t r = 1; r < csv_.records.size(); ++r) fields.push_back({csv_.records[r].line, text(csv_.records[r], index)});
    auto decimal = column_decimal(fields, "column `" + csv_.records.front().fields[index] + "`");
    if (decimal && *decimal == 0) return '.';
    return decimal;
  }

  bool is_numeric(std::size_t index) const {
    std::size_t numbers = 0, others = 0;
    for (std::size_t r = 1; r < csv_.records.size() && r < 200; ++r) {
      const std::string field = text(csv_.records[r], index);
      if (field.empty()) continue;
      ++(number(csv_.records[r], {index, '.', ""}) || number(csv_.records[r], {index, ',', ""}) ? numbers : others);
    }
    return numbers > 0 && others <= numbers / 10;
  }

  Result<void> choose_value(const csv::CsvRecord& header, const std::string& line) {
    std::vector<std::size_t> numeric;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      if (i == *x_ || i == *y_) continue;
      names.push_back(header.fields[i]);
      if (header.fields[i] == wanted_) {
        value_ = i;
        return {};
      }
      if (is_numeric(i)) numeric.push_back(i);
    }
    if (!wanted_.empty())
      return Error{
          ErrorCode::not_found, line,
          "There is no column `" + wanted_ + "`" + (did_you_mean(wanted_, names).empty() ? "." : did_you_mean(wanted_, names))};
    if (numeric.size() == 1) {
      value_ = numeric.front();
      return {};
    }
    std::string list;
    for (const std::size_t i : numeric) list += (list.empty() ? "`" : ", `") + header.fields[i].substr(0, 40) + "`";
    return Error{ErrorCode::missing, line,
                 numeric.empty() ? "There is no column with numbers beside the coordinates."
                                 : "Several columns hold numbers (" + list + "): choose the one with the values."};
  }

  const csv::CsvText& csv_;
  std::string wanted_;
  std::optional<std::size_t> x_, y_;
  std::size_t value_ = 0;
};

// The property that is a number in every point, or the reason why there is not one.
Result<std::string> value_property(const GeoDocument& document) {
  std::map<std::string, std::size_t> counts;
  std::size_t points = 0;
  for (const GeoFeature& feature : document.features) {
    if (feature.points.empty()) continue;
    ++points;
    for (const auto& [name, text] : feature.properties)
      if (name != "id" && parse_number(text)) ++counts[name];
  }
  std::string list, found;
  std::size_t hits = 0;
  for (const auto& [name, count] : counts)
    if (count == points) {
      list += (list.empty() ? "`" : ", `") + name.substr(0, 40) + "`";
      found = name;
      ++hits;
    }
  if (hits == 1) return found;
  return Error{ErrorCode::missing, "features",
               hits == 0 ? "No property is a number in every point: choose the one with the values."
                         : "Several properties are numbers (" + list + "): choose the one with the values."};
}

std::optional<std::array<double, 2>> first_position(const GeoFeature& feature) {
  if (!feature.polygons.empty() && !feature.polygons.front().rings.front().empty())
    return feature.polygons.front().rings.front().front();
  if (!feature.lines.empty() && !feature.lines.front().points.empty()) return feature.lines.front().points.front();
  return std::nullopt;
}

}  // namespace

Result<DataLayer> read_layer_csv(std::string_view bytes, const ContextOptions& options, const std::string& value) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  auto csv = csv::read_csv(*text);
  if (!csv) return csv.error();
  if (csv->records.empty())
    return Error{ErrorCode::missing, "line 1",
                 "The table is empty: it needs a header such as x,y,value and one row for each point."};
  TableReader reader(*csv, value);
  if (auto matched = reader.match(); !matched) return matched.error();
  DataLayer layer;
  layer.notes = csv->notes;
  std::vector<SkippedPoint> skipped;
  auto points = reader.read(layer.report, skipped);
  if (!points) return points.error();
  layer.value_name = reader.value_name();
  layer.unit = normal_header(layer.value_name).unit;
  if (auto placed = place_points(std::move(*points), skipped, options, reader.is_degrees ? "OGC:CRS84" : "", "record", layer);
      !placed)
    return placed.error();
  return layer;
}

Result<DataLayer> read_layer_geojson(std::string_view bytes, const ContextOptions& options, const std::string& value) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  auto document = read_geojson_polygons(*text, !options.crs.empty());
  if (!document) return document.error();
  DataLayer layer;
  layer.notes = document->notes;
  layer.value_name = value;
  if (value.empty()) {
    auto found = value_property(*document);
    if (!found) return found.error();
    layer.value_name = *found;
  }
  std::vector<RawPoint> points;
  std::vector<SkippedPoint> skipped;
  std::string crs;
  for (std::size_t i = 0; i < document->features.size(); ++i) {
    const GeoFeature& feature = document->features[i];
    const std::string place = feature.place.empty() ? "the feature" : feature.place;
    if (feature.fault) {
      layer.report.skip("feature", place, feature.unread(), feature.fault->text());
      continue;
    }
    if (feature.points.empty()) {
      if (const auto at = first_position(feature)) skipped.push_back({layer.report.rows().size(), (*at)[0], (*at)[1]});
      layer.report.skip("feature", place, "it is no point");
      continue;
    }
    if (crs.empty()) crs = feature.crs;
    if (feature.crs != crs && options.crs.empty())
      return Error{
          ErrorCode::conflict, place,
          "This feature is in " + feature.crs + ", the first point in " + crs + ": split the file, or give one CRS for all."};
    const auto property = std::find_if(feature.properties.begin(), feature.properties.end(),
                                       [&](const auto& p) { return p.first == layer.value_name; });
    const auto number = property == feature.properties.end() ? std::nullopt : parse_number(property->second);
    if (!number) {
      const auto& at = feature.points.front().position;
      skipped.push_back({layer.report.rows().size(), at[0], at[1]});
      layer.report.skip("feature", place, "no value", property == feature.properties.end() ? "" : property->second.substr(0, 40));
    } else
      for (const GeoPoint& point : feature.points) points.push_back({place, point.position[0], point.position[1], *number});
  }
  if (auto placed = place_points(std::move(points), skipped, options, crs, "feature", layer); !placed) return placed.error();
  return layer;
}

Result<DataLayer> layer_of_grid(const TerrainGrid& grid, const ContextOptions& options, std::size_t most_cells) {
  auto local = local_grid(grid, options, most_cells);
  if (!local) return local.error();
  DataLayer layer;
  layer.source_crs = context_crs(options, grid.crs);
  layer.reference = local->reference;
  layer.value_name = "value";
  layer.notes = local->notes;
  layer.report = local->report;
  for (std::size_t i = 0; i < local->values.size(); ++i)
    if (std::isfinite(local->values[i]))
      layer.points.push_back({local->west + local->cell * static_cast<double>(i % local->columns),
                              local->north - local->cell * static_cast<double>(i / local->columns), local->values[i]});
  return layer;
}

}  // namespace bl::importing
