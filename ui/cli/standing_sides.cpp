// Reads what holds for each kind of side of standing volumes: party walls, the border of the plot, streets and courtyards.
#include "ui/cli/standing_sides.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bl::cli {

namespace {

Result<double> distance_at(const Json& json, const std::string& noun, const std::string& place) {
  const auto number = number_at(json, place);
  if (!number) return number.error();
  if (*number < 0 || *number > geometry::kLargestCoordinate)
    return Error{ErrorCode::out_of_range, place, noun + " is 0 or more, in m, found " + excerpt(json)};
  return number;
}

Result<geometry::StreetAxis> street_at(const Json& json, const std::string& place) {
  if (!json.is_object())
    return Error{ErrorCode::wrong_kind, place, "expects {\"points\": [[x, y], ...], \"reach\": m}, found " + excerpt(json)};
  if (auto checked = check_keys(json, {"points", "reach"}, place); !checked) return checked.error();
  geometry::StreetAxis street;
  const auto points = list_at(json, "points", place);
  if (!points) return points.error();
  for (std::size_t k = 0; k < (*points)->size(); ++k) {
    const auto point = numbers_at((**points)[k], 2, "a point [x, y]", slash(slash(place, "points"), k));
    if (!point) return point.error();
    street.points.push_back({(*point)[0], (*point)[1], 0});
  }
  if (street.points.size() < 2)
    return Error{ErrorCode::wrong_kind, slash(place, "points"), "the axis of a street has at least 2 points"};
  if (!json.contains("reach")) return Error{ErrorCode::missing, slash(place, "reach"), "`reach` is missing: a distance in m"};
  const auto reach = distance_at(json["reach"], "the reach of a street", slash(place, "reach"));
  if (!reach) return reach.error();
  street.reach = *reach;
  return street;
}

Result<void> read_bool(const Json& sides, const char* key, const std::string& place, bool& into) {
  if (!sides.contains(key)) return {};
  if (!sides[key].is_boolean())
    return Error{ErrorCode::wrong_kind, slash(place, key), "expects true or false, found " + excerpt(sides[key])};
  into = sides[key].get<bool>();
  return {};
}

Result<void> read_distance(const Json& sides, const char* key, const std::string& noun, const std::string& place, double& into) {
  if (!sides.contains(key)) return {};
  const auto distance = distance_at(sides[key], noun, slash(place, key));
  if (!distance) return distance.error();
  into = *distance;
  return {};
}

}  // namespace

Result<std::vector<double>> distances_at(const Json& object, const char* key, const std::string& noun, const std::string& place) {
  std::vector<double> distances;
  if (!object.contains(key)) return distances;
  const auto list = list_at(object, key, place);
  if (!list) return list.error();
  for (std::size_t k = 0; k < (*list)->size(); ++k) {
    const auto number = distance_at((**list)[k], noun, slash(slash(place, key), k));
    if (!number) return number.error();
    distances.push_back(*number);
  }
  return distances;
}

std::vector<geometry::StoreyRun> runs_of(int storeys, const std::vector<double>& setbacks,
                                         const std::vector<double>& courtyards) {
  const auto at = [](const std::vector<double>& list, std::size_t k) {
    return list.empty() ? 0 : list[std::min(k, list.size() - 1)];
  };
  std::vector<geometry::StoreyRun> runs;
  for (std::size_t k = 0; k < static_cast<std::size_t>(storeys); ++k) {
    const geometry::StoreyRun run{1, at(setbacks, k), at(courtyards, k)};
    if (!runs.empty() && runs.back().setback == run.setback && runs.back().courtyard == run.courtyard) ++runs.back().storeys;
    else runs.push_back(run);
  }
  return runs;
}

Result<StandingSides> read_sides(const Json& form, const std::string& form_place) {
  StandingSides sides;
  if (!form.contains("sides")) return sides;
  const Json& json = form["sides"];
  const std::string place = slash(form_place, "sides");
  if (!json.is_object()) return Error{ErrorCode::wrong_kind, place, "expects an object, found " + excerpt(json)};
  const std::vector<std::string> known{"party_walls", "border_walls", "border", "street", "wing_depth", "courtyards", "streets"};
  if (auto checked = check_keys(json, known, place); !checked) return checked.error();
  geometry::StandingSite& rules = sides.rules;
  if (auto read = read_bool(json, "party_walls", place, rules.has_party_walls); !read) return read.error();
  if (auto read = read_bool(json, "border_walls", place, rules.has_border_walls); !read) return read.error();
  if (auto read = read_distance(json, "border", "a distance from the border", place, rules.border_distance); !read)
    return read.error();
  if (auto read = read_distance(json, "street", "a distance from streets", place, rules.street_distance); !read)
    return read.error();
  if (auto read = read_distance(json, "wing_depth", "the depth of wings", place, rules.wing_depth); !read) return read.error();
  if (!(rules.wing_depth > 0))
    return Error{ErrorCode::out_of_range, slash(place, "wing_depth"), "must be a length above 0 in m, found 0"};
  auto courtyards = distances_at(json, "courtyards", "a set-back", place);
  if (!courtyards) return courtyards.error();
  sides.courtyards = std::move(*courtyards);
  if (!json.contains("streets")) return sides;
  const auto list = list_at(json, "streets", place);
  if (!list) return list.error();
  for (std::size_t k = 0; k < (*list)->size(); ++k) {
    auto street = street_at((**list)[k], slash(slash(place, "streets"), k));
    if (!street) return street.error();
    sides.streets.push_back(std::move(*street));
  }
  return sides;
}

}  // namespace bl::cli
