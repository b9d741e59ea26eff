// CityJSON by nlohmann/json; its exceptions end here.
#include "core/import/cityjson_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/foreign_bytes.h"
#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/define/bounded_json.h"
#include "core/import/context_shape.h"
#include "core/import/inflate.h"
#include "core/import/local_frame.h"

namespace bl::importing {

namespace {

using SortedJson = nlohmann::json;

constexpr std::size_t kMostVertices = 20000000;

const SortedJson* city_member(const SortedJson& object, const char* name) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

std::string text_of(const SortedJson* value) {
  if (value == nullptr) return {};
  if (value->is_string()) return value->get<std::string>();
  if (value->is_number_float()) return shortest(value->get<double>());
  if (value->is_number() || value->is_boolean()) return value->dump();
  return {};
}

std::vector<std::string> texts_of(const SortedJson* list) {
  std::vector<std::string> texts;
  if (list != nullptr && list->is_array())
    for (const SortedJson& item : *list)
      if (item.is_string()) texts.push_back(item.get<std::string>());
  return texts;
}

struct Transform {
  std::array<double, 3> scale{1, 1, 1}, translate{0, 0, 0};
};

Result<Transform> transform_of(const SortedJson& root) {
  Transform transform;
  const SortedJson* given = city_member(root, "transform");
  if (given == nullptr) return transform;
  for (const auto& [name, target] : {std::pair{"scale", &transform.scale}, {"translate", &transform.translate}}) {
    const SortedJson* list = city_member(*given, name);
    const bool is_good = list != nullptr && list->is_array() && list->size() == 3 &&
                         std::all_of(list->begin(), list->end(), [](const SortedJson& n) { return n.is_number(); });
    if (!is_good) return Error{ErrorCode::parse, std::string("transform/") + name, "Three numbers are needed here."};
    for (std::size_t i = 0; i < 3; ++i) (*target)[i] = (*list)[i].get<double>();
  }
  return transform;
}

Error too_many(const std::string& place) {
  return {ErrorCode::out_of_range, place,
          "There are more than " + std::to_string(kMostVertices) + " vertices: cut out the part that you need."};
}

Result<std::vector<Point3>> vertices_of(const SortedJson& root, const Transform& t) {
  const SortedJson* list = city_member(root, "vertices");
  if (list == nullptr || !list->is_array())
    return Error{ErrorCode::missing, "vertices", "The array `vertices` is missing, which every CityJSON has."};
  if (list->size() > kMostVertices) return too_many("vertices");
  std::vector<Point3> vertices;
  vertices.reserve(list->size());
  for (std::size_t i = 0; i < list->size(); ++i) {
    const SortedJson& v = (*list)[i];
    if (!v.is_array() || v.size() != 3 || !v[0].is_number() || !v[1].is_number() || !v[2].is_number())
      return Error{ErrorCode::parse, "vertices/" + std::to_string(i), "A vertex must be an array of three numbers."};
    const Point3 p{v[0].get<double>() * t.scale[0] + t.translate[0], v[1].get<double>() * t.scale[1] + t.translate[1],
                   v[2].get<double>() * t.scale[2] + t.translate[2]};
    if (!is_finite(p)) return Error{ErrorCode::not_finite, "vertices/" + std::to_string(i), "A vertex must have finite numbers."};
    vertices.push_back(p);
  }
  return vertices;
}

// Reads boundaries of any depth: a list of lists of rings is a list of surfaces. `values` runs beside it.
class Boundaries {
 public:
  Boundaries(CityGeometry& geometry, std::size_t vertices, const SortedJson* semantics)
      : geometry_(geometry), vertices_(vertices), semantics_(city_member(semantics ? *semantics : kNothing, "surfaces")) {}

  // `depth`: lists above the surfaces.
  void read(const SortedJson& list, const SortedJson* values, int depth) {
    if (!geometry_.fault.empty()) return;
    if (!list.is_array()) {
      geometry_.fault = "its boundaries are not nested as the type of geometry asks";
      return;
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const SortedJson* value = values != nullptr && values->is_array() && i < values->size() ? &(*values)[i] : nullptr;
      if (depth > 0) read(list[i], value, depth - 1);
      else surface(list[i], value);
    }
  }

 private:
  static inline const SortedJson kNothing = SortedJson::object();

  void surface(const SortedJson& rings, const SortedJson* value) {
    CitySurface surface;
    if (semantics_ != nullptr && semantics_->is_array() && value != nullptr && value->is_number_unsigned() &&
        value->get<std::size_t>() < semantics_->size())
      surface.semantic = text_of(city_member((*semantics_)[value->get<std::size_t>()], "type"));
    if (!rings.is_array() || rings.empty()) {
      geometry_.fault = "a surface without rings";
      return;
    }
    for (const SortedJson& ring : rings) {
      auto& indices = surface.rings.emplace_back();
      if (!ring.is_array() || ring.size() < 3) {
        geometry_.fault = "a ring of fewer than three vertices";
        return;
      }
      for (const SortedJson& index : ring) {
        if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= vertices_) {
          geometry_.fault = "an index of a vertex that does not exist";
          return;
        }
        indices.push_back(index.get<std::uint32_t>());
      }
    }
    geometry_.surfaces.push_back(std::move(surface));
  }

  CityGeometry& geometry_;
  std::size_t vertices_;
  const SortedJson* semantics_;
};

CityGeometry geometry_of(const SortedJson& json, std::size_t vertices) {
  CityGeometry geometry;
  geometry.type = text_of(city_member(json, "type"));
  geometry.level_of_detail = parse_number(text_of(city_member(json, "lod"))).value_or(0);
  const SortedJson* boundaries = city_member(json, "boundaries");
  const SortedJson* semantics = city_member(json, "semantics");
  const int depth = geometry.type == "MultiSurface" || geometry.type == "CompositeSurface" ? 0
                    : geometry.type == "Solid"                                             ? 1
                    : geometry.type == "MultiSolid" || geometry.type == "CompositeSolid"   ? 2
                                                                                           : -1;
  if (geometry.type == "GeometryInstance") geometry.fault = "geometry templates are not read";
  else if (depth < 0) geometry.fault = "geometries of type `" + geometry.type.substr(0, 40) + "` are not read";
  else if (boundaries == nullptr) geometry.fault = "it has no boundaries";
  if (!geometry.fault.empty()) return geometry;
  geometry.solids = depth == 1 ? 1 : depth == 2 && boundaries->is_array() ? boundaries->size() : 0;
  Boundaries(geometry, vertices, semantics)
      .read(*boundaries, city_member(semantics ? *semantics : SortedJson::object(), "values"), depth);
  if (!geometry.fault.empty()) geometry.surfaces.clear();
  else if (geometry.surfaces.empty()) geometry.fault = "it has no surfaces";
  return geometry;
}

class CityReader {
 public:
  Result<CityModel> read(const std::string& text) {
    if (auto foreign = foreign_bytes(text, "CityJSON", "export it as CityJSON, which is text")) return *foreign;
    // A sequence is told by its first line, which is a value of its own, and by what follows.
    const std::size_t end = text.find('\n'), first = end_of_first_value(text);
    const bool is_sequence = end != std::string::npos && first != std::string_view::npos && first <= end &&
                             text.find_first_not_of(" \t\r\n", first) != std::string::npos;
    const auto head = read_bounded_json(is_sequence ? std::string_view(text).substr(0, end) : text, "CityJSON");
    if (!head) return head.error();
    if (auto done = header(*head); !done) return is_sequence ? done.error().within("line 1") : done.error();
    if (auto done = is_sequence ? sequence(*head, text, end) : feature(*head, ""); !done) return done.error();
    return std::move(model_);
  }

 private:
  Result<void> header(const SortedJson& root) {
    if (text_of(city_member(root, "type")) != "CityJSON")
      return Error{ErrorCode::parse, "type", "This is JSON but not CityJSON: its member `type` must be `CityJSON`."};
    model_.version = text_of(city_member(root, "version"));
    if (!model_.version.starts_with("1.") && !model_.version.starts_with("2."))
      return Error{ErrorCode::version, "version",
                   "Version `" + model_.version.substr(0, 20) + "` of CityJSON is not read: write 1.0, 1.1 or 2.0."};
    auto transform = transform_of(root);
    if (!transform) return transform.error();
    transform_ = *transform;
    if (const SortedJson* metadata = city_member(root, "metadata"))
      model_.crs = text_of(city_member(*metadata, "referenceSystem"));
    if (!model_.crs.empty()) model_.crs = tidy_crs_name(model_.crs);
    if (city_member(root, "geometry-templates") != nullptr)
      model_.notes.push_back("The file has geometry templates, which are not read: objects that use them are in the report.");
    return {};
  }

  Result<void> sequence(const SortedJson& head, const std::string& text, std::size_t end) {
    if (city_member(head, "CityObjects") != nullptr && !head["CityObjects"].empty())
      if (auto done = feature(head, "line 1"); !done) return done;
    for (std::size_t line = 2, start = end + 1; start < text.size(); ++line) {
      if (is_stop_wished()) return stopped_error();
      const std::size_t stop = std::min(text.find('\n', start), text.size());
      const std::string_view part = std::string_view(text).substr(start, stop - start);
      start = stop + 1;
      if (part.find_first_not_of(" \t\r") == std::string_view::npos) continue;
      const std::string place = "line " + std::to_string(line);
      const auto json = read_bounded_json(part, "CityJSON");
      if (!json) {
        const bool is_last = text.find_first_not_of(" \t\r\n", stop) == std::string::npos;
        return Error{json.error().code, place,
                     json.error().code != ErrorCode::parse ? json.error().message
                     : is_last && text.back() != '\n'      ? "The file is cut off within this line. Fetch or export it again."
                                                           : "This line is not valid JSON: it is damaged."};
      }
      if (text_of(city_member(*json, "type")) != "CityJSONFeature")
        return Error{ErrorCode::parse, place, "Every line after the first must be a CityJSONFeature."};
      if (auto done = feature(*json, place); !done) return done;
    }
    return {};
  }

  Result<void> feature(const SortedJson& root, const std::string& place) {
    auto vertices = vertices_of(root, transform_);
    if (!vertices) return place.empty() ? vertices.error() : vertices.error().within(place);
    const SortedJson* objects = city_member(root, "CityObjects");
    if (objects == nullptr || !objects->is_object())
      return Error{ErrorCode::missing, place, "The object `CityObjects` is missing, which every CityJSON has."};
    for (const auto& [id, json] : objects->items()) {
      if (model_.objects.size() % 64 == 0 && is_stop_wished()) return stopped_error();
      CityObject& object = model_.objects.emplace_back();
      object.id = id;
      object.place = (place.empty() ? "" : place + "/") + "CityObjects/" + id;
      object.type = text_of(city_member(json, "type"));
      object.parents = texts_of(city_member(json, "parents"));
      object.children = texts_of(city_member(json, "children"));
      object.vertices = model_.vertices.size();
      if (const SortedJson* attributes = city_member(json, "attributes"); attributes != nullptr && attributes->is_object())
        for (const auto& [name, value] : attributes->items())
          if (const std::string text = text_of(&value); !text.empty()) object.attributes.emplace_back(name, text);
      if (const SortedJson* list = city_member(json, "geometry"); list != nullptr && list->is_array())
        for (const SortedJson& geometry : *list) object.geometries.push_back(geometry_of(geometry, vertices->size()));
    }
    vertices_ += vertices->size();
    if (vertices_ > kMostVertices) return too_many(place);
    model_.vertices.push_back(std::move(*vertices));
    return {};
  }

  std::size_t vertices_ = 0;
  CityModel model_;
  Transform transform_;
};

}  // namespace

Result<CityModel> read_cityjson(std::string_view bytes) {
  auto text = unpacked(bytes);
  if (!text) return text.error();
  if (text->starts_with("\xEF\xBB\xBF")) text->erase(0, 3);
  if (text->find_first_not_of(" \t\r\n") == std::string::npos)
    return Error{ErrorCode::missing, "line 1", "The file is empty: CityJSON is needed."};
  try {
    return CityReader().read(*text);
  } catch (const SortedJson::exception&) {
    return Error{ErrorCode::parse, "", "The text cannot be read as CityJSON: a number or a character in it is out of range."};
  }
}

}  // namespace bl::importing
