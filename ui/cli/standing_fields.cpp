// Reads the form of standing volumes, and checks it against the plot: a storey that can have no floor anywhere is an error.
#include "ui/cli/standing_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "ui/cli/json_fields.h"
#include "ui/cli/scene_loading.h"
#include "ui/cli/standing_sides.h"

namespace bl::cli {

namespace {

using geometry::FootprintForm;
using geometry::StandingSite;

constexpr const char* kFormHelp = "{\"kind\": \"round\", \"block\" or \"cell\", \"storeys\": [n, ...], \"storey_height\": 3}";
constexpr double kLeastAspect = 1e-3, kMostAspect = 1e3;

// A number above 0 and no larger than a coordinate may be, or the fallback where the key is missing.
Result<double> length_at(const Json& form, const char* key, double fallback, const std::string& place) {
  if (!form.contains(key)) return fallback;
  const std::string here = slash(place, key);
  const auto length = number_at(form[key], here);
  if (!length) return length.error();
  if (!(*length > 0) || *length > geometry::kLargestCoordinate)
    return Error{ErrorCode::out_of_range, here, "must be a length above 0 in m, found " + excerpt(form[key])};
  return length;
}

Result<FootprintForm> kind_at(const Json& form, const std::string& place) {
  const std::string here = slash(place, "kind");
  if (!form.contains("kind")) return Error{ErrorCode::missing, here, "`kind` is missing: round, block or cell"};
  const Json& kind = form["kind"];
  if (kind == "round") return FootprintForm::round;
  if (kind == "block") return FootprintForm::block;
  if (kind == "cell") return FootprintForm::cell;
  return Error{ErrorCode::wrong_kind, here, "expects \"round\", \"block\" or \"cell\", found " + excerpt(kind)};
}

Result<std::vector<int>> storeys_at(const Json& form, std::size_t sites, const std::string& place) {
  const auto list = list_at(form, "storeys", place);
  if (!list) return list.error();
  const std::string here = slash(place, "storeys");
  if ((*list)->size() != sites)
    return Error{
        ErrorCode::conflict, here,
        "expects the number of storeys of each site: " + counted(sites, "site") + ", " + counted((*list)->size(), "number")};
  std::vector<int> storeys;
  for (std::size_t i = 0; i < sites; ++i) {
    const auto number = number_at((**list)[i], slash(here, i));
    if (!number) return number.error();
    if (!(*number >= 1) || *number > geometry::kMostStoreys || *number != std::floor(*number))
      return Error{
          ErrorCode::out_of_range, slash(here, i),
          "must be a whole number of storeys from 1 to " + shortest(geometry::kMostStoreys) + ", found " + excerpt((**list)[i])};
    storeys.push_back(static_cast<int>(*number));
  }
  return storeys;
}

// What the whole plot leaves of storeys with each set-back: nobody can have more.
Result<void> check_plot(const std::vector<double>& setbacks, double depth, const std::string& place, SiteCase& into) {
  StandingSite whole = into.standing.front();
  whole.form = FootprintForm::cell;
  whole.depth = StandingSite::kAnyDepth;
  whole.runs.clear();
  for (const double setback : setbacks) whole.runs.push_back({1, setback});
  if (setbacks.empty()) whole.runs.push_back({1, 0});
  geometry::FootprintDiagram diagram;
  if (auto set = diagram.set_domain(into.boundary.domain, into.streets); !set) return set.error().within(into.place);
  const auto open = diagram.update(std::array{whole});
  if (!open) return open.error().within(into.place);
  const std::vector<double> plates = open->front().plates;
  if (setbacks.empty() && !(plates.front() > 0))
    return Error{ErrorCode::infeasible, slash(place, "sides"), "the distances from the border leave nothing of the plot"};
  for (std::size_t k = 0; k < setbacks.size(); ++k) {
    if (plates[k] > 0) continue;
    for (std::size_t i = 0; i < into.standing.size(); ++i)
      if (static_cast<std::size_t>(into.standing[i].storeys()) > k)
        return Error{ErrorCode::infeasible, slash(slash(place, "setbacks"), k),
                     "storey " + std::to_string(k + 1) + " of site " + std::to_string(i) + " has no floor: a set-back of " +
                         shortest(setbacks[k]) + " m leaves nothing of the plot"};
  }
  if (std::isinf(depth)) return {};
  whole.depth = depth;
  const auto deep = diagram.update(std::array{whole});
  if (!deep) return deep.error().within(into.place);
  if (deep->front().plates == plates)
    into.notes.push_back(slash(place, "depth") + ": " + shortest(depth) +
                         " m leaves no courtyard anywhere: the plot is not deep enough for one");
  return {};
}

}  // namespace

Result<void> read_form(const Json& json, SiteCase& into) {
  const std::string place = slash(into.place, "form");
  const Json& form = json["form"];
  if (!form.is_object())
    return Error{ErrorCode::wrong_kind, place, std::string("expects ") + kFormHelp + ", found " + excerpt(form)};
  const std::vector<std::string> known{"kind", "storeys", "storey_height", "setbacks", "depth", "angle", "aspect", "sides"};
  if (auto checked = check_keys(form, known, place); !checked) return checked.error();
  const auto kind = kind_at(form, place);
  if (!kind) return kind.error();
  const auto storeys = storeys_at(form, into.problem.sites.size(), place);
  if (!storeys) return storeys.error();
  const auto height = length_at(form, "storey_height", 3, place);
  if (!height) return height.error();
  const auto setbacks = distances_at(form, "setbacks", "a set-back", place);
  if (!setbacks) return setbacks.error();
  auto sides = read_sides(form, place);
  if (!sides) return sides.error();
  into.streets = std::move(sides->streets);
  const bool has_depth = form.contains("depth") && !form["depth"].is_null();
  const auto depth = has_depth ? length_at(form, "depth", 0, place) : Result<double>(StandingSite::kAnyDepth);
  if (!depth) return depth.error();
  const auto angle = form.contains("angle") ? number_at(form["angle"], slash(place, "angle")) : Result<double>(0.0);
  if (!angle) return angle.error();
  const auto aspect = form.contains("aspect") ? number_at(form["aspect"], slash(place, "aspect")) : Result<double>(1.0);
  if (!aspect) return aspect.error();
  if (!(*aspect >= kLeastAspect && *aspect <= kMostAspect))
    return Error{ErrorCode::out_of_range, slash(place, "aspect"),
                 "must be first side / second side, from 0.001 to 1000, found " + excerpt(form["aspect"])};
  for (std::size_t i = 0; i < into.problem.sites.size(); ++i) {
    StandingSite& site = into.standing.emplace_back(sides->rules);
    site.site = into.problem.sites[i];
    site.form = *kind;
    site.angle = std::fmod(*angle, 360) * std::numbers::pi / 180;
    site.aspect = *aspect;
    site.runs = runs_of((*storeys)[i], *setbacks, sides->courtyards);
    site.storey_height = *height;
    site.depth = *depth;
  }
  return check_plot(*setbacks, *depth, place, into);
}

}  // namespace bl::cli
