// Reads cases from JSON text and from tables; the errors of each case of a list are reported.
#include "ui/cli/site_case.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/csv/csv_reader.h"
#include "core/file/file_io.h"
#include "core/import/site_table.h"
#include "ui/cli/demand_fields.h"
#include "ui/cli/json_fields.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/standing_fields.h"
#include "ui/cli/terminal.h"

namespace bl::cli {

namespace {

bool is_table(const std::string& file) {
  const std::string name = lower_case(file);
  return name.ends_with(".csv") || name.ends_with(".tsv") || name.ends_with(".txt");
}

Result<Json> json_of(const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    return Error{ErrorCode::missing, "", "the file is empty: it needs a JSON object, see --help"};
  auto json = parse_json(text);
  if (json) return json;
  const std::string_view body = csv::trimmed(text), line = body.substr(0, body.find('\n'));
  const bool is_like_a_header =
      !line.empty() && line.front() != '{' && line.front() != '[' && line.find_first_of(",;\t") != line.npos;
  Error error = json.error();
  if (is_like_a_header) error.message += "; a table needs a name that ends in .csv";
  return error;
}

Result<void> check_site(const geometry::PowerSite& site, const std::string& place, const std::string& weight_place) {
  const Point3& p = site.position;
  if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > geometry::kLargestCoordinate)
    return Error{ErrorCode::out_of_range, place, "lies more than 1e8 m from the origin: move the origin near the sites"};
  if (std::abs(site.weight) > geometry::kLargestWeight)
    return Error{ErrorCode::out_of_range, weight_place,
                 "a weight is at most 1e18 m², found " + shortest(site.weight) + ": it is a squared radius"};
  return {};
}

// Where a demanding case names an optional list otherwise, leaving that out would fit something else than was meant.
Result<void> check_optional_lists(const Json& json, const std::string& place) {
  const std::vector<std::string> optional{"weights", "groups", "locked", "form"};
  for (const auto& [key, value] : json.items()) {
    const std::string near = nearest_name(key, optional);
    if (near.empty() || near == key || near.front() != key.front() || json.contains(near)) continue;
    return Error{ErrorCode::unknown_field, slash(place, key), "unknown field, did you mean `" + near + "`?"};
  }
  return {};
}

class Reader {
 public:
  Reader(const BoundaryReading* boundary, CasePurpose purpose) : boundary_(boundary), purpose_(purpose) {}

  CaseReading read(const std::string& text, bool is_table) {
    if (is_table) from_table(text);
    else from_json(text);
    return std::move(result_);
  }

 private:
  void fail(Error error) { result_.errors.push_back(std::move(error)); }

  void from_table(const std::string& text) {
    if (boundary_ == nullptr)
      return fail({ErrorCode::missing, "", "a table has no boundary: give one as JSON by --boundary FILE"});
    const auto table = importing::read_site_table(text);
    if (!table) return fail(table.error());
    result_.notes = table->notes;
    auto only = case_of(*table);
    if (!only) return fail(only.error());
    result_.content.cases.push_back(std::move(*only));
  }

  Result<SiteCase> case_of(const importing::SiteTable& table) const {
    const std::string header = "line " + std::to_string(table.header_line);
    if (table.rows.empty()) return Error{ErrorCode::missing, header, "there are no sites below the header: add a row for each"};
    if (purpose_ == CasePurpose::cells && !table.has_weights)
      return Error{ErrorCode::missing, header,
                   "there is no column weight or radius; accepted are " + importing::site_table_columns()};
    SiteCase result;
    result.boundary = *boundary_;
    for (const importing::SiteRow& row : table.rows) {
      const std::string line = "line " + std::to_string(row.line);
      if (purpose_ == CasePurpose::cells && !row.weight)
        return Error{ErrorCode::missing, line, "the site has no weight: give one, in m²"};
      result.problem.sites.push_back({row.position, row.weight.value_or(0)});
      if (auto checked = check_site(result.problem.sites.back(), line, line); !checked) return checked.error();
      result.names.push_back(row.name.empty() ? "site " + std::to_string(result.names.size()) : row.name);
    }
    const bool is_named =
        std::any_of(table.rows.begin(), table.rows.end(), [](const importing::SiteRow& row) { return !row.name.empty(); });
    if (!is_named) result.names.clear();
    if (purpose_ == CasePurpose::fit)
      if (auto read = read_demands(table, result); !read) return read.error();
    return result;
  }

  void from_json(const std::string& text) {
    const auto input = json_of(text);
    if (!input) return fail(input.error());
    SiteCases& content = result_.content;
    content.is_list = input->is_object() && input->contains("cases");
    if (content.is_list && !(*input)["cases"].is_array())
      return fail({ErrorCode::wrong_kind, "cases", "expects a list of cases"});
    const std::size_t count = content.is_list ? (*input)["cases"].size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
      auto read = content.is_list ? case_of((*input)["cases"][i], slash("cases", i)) : case_of(*input, "");
      if (!read) {
        fail(read.error());
        continue;
      }
      std::move(read->notes.begin(), read->notes.end(), std::back_inserter(result_.notes));
      content.cases.push_back(std::move(*read));
    }
  }

  Result<BoundaryReading> boundary_of(const Json& json, const std::string& place) const {
    const std::string here = slash(place, "boundary");
    const auto own = json.find("boundary");
    if (own != json.end() && boundary_ != nullptr)
      return Error{ErrorCode::conflict, here, "is given here and by --boundary: keep one of them"};
    if (own != json.end()) return boundary_at(*own, here);
    if (boundary_ != nullptr) return *boundary_;
    return Error{ErrorCode::missing, here, "`boundary` is missing: put it into the case, or give it by --boundary FILE"};
  }

  Result<SiteCase> case_of(const Json& json, const std::string& place) const {
    if (!json.is_object())
      return Error{ErrorCode::wrong_kind, place,
                   std::string("expects {\"boundary\": ..., \"sites\": [...], \"") +
                       (purpose_ == CasePurpose::cells ? "weights" : "demands") + "\": [...]}, found " + excerpt(json)};
    SiteCase result;
    result.place = place;
    auto boundary = boundary_of(json, place);
    if (!boundary) return boundary.error();
    result.boundary = std::move(*boundary);
    if (auto read = read_sites(json, result); !read) return read.error();
    if (purpose_ == CasePurpose::cells) return result;
    if (result.problem.sites.empty())
      return Error{ErrorCode::missing, slash(place, "sites"), "there are no sites: a fit needs at least one"};
    if (auto checked = check_optional_lists(json, place); !checked) return checked.error();
    if (json.contains("form"))
      if (auto read = read_form(json, result); !read) return read.error();
    if (auto read = read_demands(json, result); !read) return read.error();
    return result;
  }

  Result<void> read_sites(const Json& json, SiteCase& into) const {
    const std::string sites_place = slash(into.place, "sites"), weights_place = slash(into.place, "weights");
    const bool has_weights = purpose_ == CasePurpose::cells || json.contains("weights");
    const auto sites = list_at(json, "sites", into.place);
    if (!sites) return sites.error();
    const auto weights = has_weights ? list_at(json, "weights", into.place) : Result<const Json*>(nullptr);
    if (!weights) return weights.error();
    const auto points = points_at(**sites, sites_place);
    if (!points) return points.error();
    if (has_weights && (*weights)->size() != points->size())
      return Error{ErrorCode::conflict, weights_place,
                   "there are " + counted(points->size(), "site") + ", but " + counted((*weights)->size(), "weight")};
    for (std::size_t i = 0; i < points->size(); ++i) {
      geometry::PowerSite site{(*points)[i], 0};
      if (has_weights) {
        const auto weight = number_at((**weights)[i], slash(weights_place, i));
        if (!weight) return weight.error();
        site.weight = *weight;
      }
      if (auto checked = check_site(site, slash(sites_place, i), slash(weights_place, i)); !checked) return checked.error();
      into.problem.sites.push_back(site);
    }
    return {};
  }

  const BoundaryReading* boundary_;
  CasePurpose purpose_;
  CaseReading result_;
};

}  // namespace

CaseReading read_site_cases(const std::string& text, bool is_table, const BoundaryReading* boundary, CasePurpose purpose) {
  return Reader(boundary, purpose).read(text, is_table);
}

Result<BoundaryReading> read_boundary(const std::string& text) {
  const auto json = json_of(text);
  if (!json) return json.error();
  if (json->is_object() && json->contains("cases"))
    return Error{ErrorCode::wrong_kind, "cases", "holds a list of cases instead of one boundary: give one boundary"};
  return json->is_object() && json->contains("boundary") ? boundary_at((*json)["boundary"], "boundary") : boundary_at(*json, "");
}

std::optional<SiteCases> load_site_cases(const CaseFiles& files, CasePurpose purpose) {
  const auto text = read_file(files.input);
  if (!text) {
    print_error(files.input, text.error());
    return std::nullopt;
  }
  std::optional<BoundaryReading> boundary;
  if (!files.boundary.empty()) {
    const auto boundary_text = read_file(files.boundary);
    auto read = boundary_text ? read_boundary(*boundary_text) : Result<BoundaryReading>(boundary_text.error());
    if (!read) {
      print_error(files.boundary, read.error());
      return std::nullopt;
    }
    boundary = std::move(*read);
  }
  CaseReading reading = read_site_cases(*text, is_table(files.input), boundary ? &*boundary : nullptr, purpose);
  for (const std::string& note : reading.notes) print_line("note: " + files.input + ": " + note);
  for (const Error& error : reading.errors) print_error(files.input, error);
  if (!reading.errors.empty()) return std::nullopt;
  return std::move(reading.content);
}

}  // namespace bl::cli
