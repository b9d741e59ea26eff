// `cells`: the raw geometry of given sites and weights, for scripts and for checks against other programs.
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/define/json_text.h"
#include "core/file/file_io.h"
#include "core/geometry/power_cells.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

struct CellCase {
  ConvexDomain domain;
  std::vector<PowerSite> sites;
  bool is_made_of_vertices = false;
};

std::string slash(const std::string& place, const std::string& key) { return place.empty() ? key : place + "/" + key; }

Result<double> number_at(const Json& json, const std::string& place) {
  if (!json.is_number())
    return Error{ErrorCode::wrong_kind, place, "expects a finite number, found " + write_json_line(json).substr(0, 60)};
  return json.get<double>();
}

Result<std::vector<double>> numbers_at(const Json& json, std::size_t count, const std::string& form, const std::string& place) {
  if (!json.is_array() || json.size() != count)
    return Error{ErrorCode::wrong_kind, place, "expects " + form + ", found " + write_json_line(json).substr(0, 60)};
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    auto number = number_at(json[i], place + "/" + std::to_string(i));
    if (!number) return number.error();
    numbers.push_back(*number);
  }
  return numbers;
}

Result<const Json*> list_at(const Json& json, const char* key, const std::string& place) {
  const auto it = json.find(key);
  if (it == json.end()) return Error{ErrorCode::missing, slash(place, key), std::string("`") + key + "` is missing"};
  if (!it->is_array()) return Error{ErrorCode::wrong_kind, slash(place, key), "expects a list"};
  return &*it;
}

Result<std::vector<Point3>> points_at(const Json& list, const std::string& place) {
  std::vector<Point3> points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto point = numbers_at(list[i], 3, "a point [x, y, z]", place + "/" + std::to_string(i));
    if (!point) return point.error();
    points.push_back({(*point)[0], (*point)[1], (*point)[2]});
  }
  return points;
}

Result<ConvexDomain> domain_at(const Json& json, const std::string& place, bool& is_made_of_vertices) {
  if (!json.is_object())
    return Error{ErrorCode::wrong_kind, place, "expects {\"planes\": [[a, b, c, d], ...]} or {\"vertices\": [[x, y, z], ...]}"};
  is_made_of_vertices = !json.contains("planes");
  if (is_made_of_vertices && !json.contains("vertices"))
    return Error{ErrorCode::missing, place, "expects `planes` or `vertices`"};
  const char* key = is_made_of_vertices ? "vertices" : "planes";
  const std::string here = slash(place, key);
  const auto list = list_at(json, key, place);
  if (!list) return list.error();
  Result<ConvexDomain> domain = Error{};
  if (is_made_of_vertices) {
    const auto vertices = points_at(**list, here);
    if (!vertices) return vertices.error();
    domain = convex_hull(*vertices);
  } else {
    std::vector<Plane> planes;
    for (std::size_t k = 0; k < (*list)->size(); ++k) {
      const auto plane = numbers_at((**list)[k], 4, "a plane [a, b, c, d]", here + "/" + std::to_string(k));
      if (!plane) return plane.error();
      planes.push_back({{(*plane)[0], (*plane)[1], (*plane)[2]}, (*plane)[3]});
    }
    domain = from_planes(planes);
  }
  if (!domain) return domain.error().within(here);
  return domain;
}

Result<CellCase> case_at(const Json& json, const std::string& place) {
  if (!json.is_object())
    return Error{ErrorCode::wrong_kind, place, "expects {\"boundary\": ..., \"sites\": [...], \"weights\": [...]}"};
  const auto boundary = json.find("boundary");
  if (boundary == json.end()) return Error{ErrorCode::missing, slash(place, "boundary"), "`boundary` is missing"};
  CellCase result;
  auto domain = domain_at(*boundary, slash(place, "boundary"), result.is_made_of_vertices);
  if (!domain) return domain.error();
  result.domain = std::move(*domain);
  const auto sites = list_at(json, "sites", place), weights = list_at(json, "weights", place);
  if (!sites) return sites.error();
  if (!weights) return weights.error();
  const auto points = points_at(**sites, slash(place, "sites"));
  if (!points) return points.error();
  if ((*weights)->size() != points->size())
    return Error{ErrorCode::conflict, slash(place, "weights"),
                 "there are " + counted(points->size(), "site") + ", but " + counted((*weights)->size(), "weight")};
  for (std::size_t i = 0; i < points->size(); ++i) {
    const auto weight = number_at((**weights)[i], slash(place, "weights/" + std::to_string(i)));
    if (!weight) return weight.error();
    result.sites.push_back({(*points)[i], *weight});
  }
  return result;
}

Json cell_json(const CellMeasure& cell) {
  Json facets = Json::object();
  for (const FacetArea& facet : cell.facets)
    facets[(facet.kind == FacetArea::Kind::plane ? "plane:" : "site:") + std::to_string(facet.index)] = facet.area;
  return {{"volume", cell.volume},
          {"cell_volume", cell.cell_volume},
          {"surface_area", cell.surface_area},
          {"spherical_area", cell.spherical_area},
          {"facet_areas", std::move(facets)},
          {"centroid", {cell.centroid.x, cell.centroid.y, cell.centroid.z}},
          {"state", std::string(name_of(cell.state))},
          {"reason", cell.reason}};
}

Result<Json> solved(const CellCase& input, const std::string& place, ThreadPool& pool) {
  CellOptions options;
  options.with_shape = false;
  options.pool = &pool;
  const auto cells = power_cells(input.domain, input.sites, options);
  if (!cells) return cells.error().within(place);
  Json result = Json::object();
  result["cells"] = Json::array();
  for (const CellMeasure& cell : *cells) result["cells"].push_back(cell_json(cell));
  if (input.is_made_of_vertices) {
    result["planes"] = Json::array();
    for (const Plane& plane : input.domain.planes)
      result["planes"].push_back({plane.normal.x, plane.normal.y, plane.normal.z, plane.offset});
  }
  return result;
}

// All cases, or all of what is wrong with them.
std::optional<Json> all_cases(const Json& input, const std::string& file, ThreadPool& pool) {
  const bool is_list = input.is_object() && input.contains("cases");
  if (is_list && !input["cases"].is_array()) {
    print_error(file, {ErrorCode::wrong_kind, "cases", "expects a list of cases"});
    return std::nullopt;
  }
  bool is_all_well = true;
  Progress progress;
  Json results = Json::array();
  const std::size_t count = is_list ? input["cases"].size() : 1;
  for (std::size_t i = 0; i < count && !is_interrupted(); ++i) {
    const std::string place = is_list ? "cases/" + std::to_string(i) : "";
    const auto parsed = case_at(is_list ? input["cases"][i] : input, place);
    auto result = parsed ? solved(*parsed, place, pool) : Result<Json>(parsed.error());
    if (!result) print_error(file, result.error());
    is_all_well &= result.ok();
    if (result) results.push_back(std::move(*result));
    progress.show("case " + std::to_string(i + 1) + " of " + std::to_string(count));
  }
  if (!is_all_well) return std::nullopt;
  return is_list ? Json{{"cases", std::move(results)}} : results.empty() ? Json::object() : std::move(results.front());
}

}  // namespace

int cells_command(const CellsOptions& options) {
  const auto text = read_file(options.input);
  if (!text) {
    print_error(options.input, text.error());
    return kBadInput;
  }
  const auto input = parse_json(*text);
  if (!input) {
    print_error(options.input, input.error());
    return kBadInput;
  }
  catch_interrupts();
  ThreadPool pool(options.threads);
  const auto output = all_cases(*input, options.input, pool);
  if (!output) return kBadInput;
  if (auto written = write_file(options.json, write_json(*output) + "\n"); !written) {
    print_error(options.json, written.error());
    return kBadInput;
  }
  return is_interrupted() ? interrupt_exit_code() : kDone;
}

}  // namespace bl::cli
