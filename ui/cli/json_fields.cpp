// Small readers of JSON fields for the readers of cases.
#include "ui/cli/json_fields.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "ui/cli/scene_loading.h"

namespace bl::cli {

std::string slash(const std::string& place, const std::string& key) { return place.empty() ? key : place + "/" + key; }
std::string slash(const std::string& place, std::size_t index) { return slash(place, std::to_string(index)); }

std::string excerpt(const Json& json) {
  constexpr std::size_t kMost = 60;
  std::string line = write_json_line(json);
  if (line.size() <= kMost) return line;
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) --end;  // no half of a UTF-8 character
  return line.substr(0, end) + "...";
}

Result<double> number_at(const Json& json, const std::string& place) {
  if (!json.is_number()) return Error{ErrorCode::wrong_kind, place, "expects a finite number, found " + excerpt(json)};
  return json.get<double>();
}

Result<std::vector<double>> numbers_at(const Json& json, std::size_t count, const std::string& form, const std::string& place) {
  if (!json.is_array() || json.size() != count)
    return Error{ErrorCode::wrong_kind, place, "expects " + form + ", found " + excerpt(json)};
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    auto number = number_at(json[i], slash(place, i));
    if (!number) return number.error();
    numbers.push_back(*number);
  }
  return numbers;
}

Result<const Json*> list_at(const Json& json, const char* key, const std::string& place) {
  const auto it = json.find(key);
  if (it == json.end()) return Error{ErrorCode::missing, slash(place, key), std::string("`") + key + "` is missing"};
  if (!it->is_array()) return Error{ErrorCode::wrong_kind, slash(place, key), "expects a list, found " + excerpt(*it)};
  return &*it;
}

Result<std::vector<Point3>> points_at(const Json& list, const std::string& place) {
  std::vector<Point3> points;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto point = numbers_at(list[i], 3, "a point [x, y, z]", slash(place, i));
    if (!point) return point.error();
    points.push_back({(*point)[0], (*point)[1], (*point)[2]});
  }
  return points;
}

Result<std::vector<std::uint32_t>> indices_at(const Json& json, std::size_t count, const std::string& noun,
                                              const std::string& place) {
  if (!json.is_array())
    return Error{ErrorCode::wrong_kind, place, "expects a list of " + noun + " numbers [i, j, ...], found " + excerpt(json)};
  std::vector<std::uint32_t> indices;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const std::string here = slash(place, k);
    const auto number = number_at(json[k], here);
    if (!number) return number.error();
    if (*number != std::floor(*number))
      return Error{ErrorCode::wrong_kind, here, "expects a whole " + noun + " number, found " + excerpt(json[k])};
    if (*number < 0 || *number >= static_cast<double>(count))
      return Error{ErrorCode::not_found, here,
                   "there is no " + noun + " " + excerpt(json[k]) + ": " +
                       (count == 0 ? "the case has none" : "they are numbered from 0 to " + std::to_string(count - 1))};
    indices.push_back(static_cast<std::uint32_t>(*number));
  }
  std::vector<std::uint32_t> sorted = indices;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twin = std::adjacent_find(sorted.begin(), sorted.end()); twin != sorted.end())
    return Error{ErrorCode::duplicate, place, noun + " " + std::to_string(*twin) + " stands there twice; name it once"};
  return indices;
}

Result<void> check_keys(const Json& object, const std::vector<std::string>& known, const std::string& place) {
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string hint = did_you_mean(key, known);
    return Error{ErrorCode::unknown_field, slash(place, key.substr(0, 40)),
                 "unknown field" + (hint.empty() ? ", remove it" : hint)};
  }
  return {};
}

}  // namespace bl::cli
