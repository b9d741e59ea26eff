// Each kind of vote has the JSON that says it in the fewest words.
#include "core/vote/ballot_json.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "core/define/codec.h"

namespace bl::vote {

namespace {

Error expects(const std::string& place, const std::string& what) { return {ErrorCode::wrong_kind, place, "expects " + what}; }

// A number or a point with the checks that all values of scenes have.
Result<Value> checked(ValueKind kind, const Json& json, const std::string& place) {
  PortDefinition port;
  port.kind = kind;
  return value_from_json(port, json, place);
}

Result<Ballot> ranking_from(const Json& json) {
  if (!json.is_array()) return expects("", "a list of options, the best first");
  Ballot ballot;
  for (std::size_t i = 0; i < json.size(); ++i) {
    if (!json[i].is_string()) return expects(std::to_string(i), "the id of an option as a text");
    ballot.options.push_back(json[i].get<std::string>());
  }
  return ballot;
}

Result<Ballot> coins_from(const Json& json) {
  if (!json.is_object()) return expects("", "{\"option\": coins, ...}");
  Ballot ballot;
  for (const auto& [option, coins] : json.items()) {
    const auto number = checked(ValueKind::number, coins, option);
    if (!number) return number.error();
    if (std::get<double>(*number) == 0) continue;
    ballot.options.push_back(option);
    ballot.coins.push_back(std::get<double>(*number));
  }
  return ballot;
}

Result<Ballot> dots_from(const Json& json) {
  if (!json.is_array()) return expects("", "a list of dots {\"place\": [x, y, z], \"option\": \"plus\"}");
  Ballot ballot;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const std::string place = std::to_string(i);
    if (!json[i].is_object() || !json[i].contains("place") || !json[i].contains("option") || !json[i]["option"].is_string())
      return expects(place, "a dot {\"place\": [x, y, z], \"option\": \"plus\"}");
    if (auto keys = check_keys(json[i], {"place", "option"}, place); !keys) return keys.error();
    const auto point = checked(ValueKind::point, json[i]["place"], place + "/place");
    if (!point) return point.error();
    ballot.options.push_back(json[i]["option"].get<std::string>());
    ballot.places.push_back(std::get<Vector3>(*point));
  }
  return ballot;
}

}  // namespace

Result<Ballot> ballot_from_json(Kind kind, const Json& json) {
  switch (kind) {
    case Kind::rank: return ranking_from(json);
    case Kind::coins: return coins_from(json);
    case Kind::dots: return dots_from(json);
    case Kind::yes_no:
      if (!json.is_string()) return expects("", "`yes` or `no` as a text");
      return Ballot{.options = {json.get<std::string>()}};
    case Kind::slider: break;
  }
  const auto number = checked(ValueKind::number, json, "");
  if (!number) return number.error();
  return Ballot{.value = std::get<double>(*number)};
}

Json ballot_to_json(Kind kind, const Ballot& ballot) {
  if (kind == Kind::slider) return ballot.value;
  if (kind == Kind::yes_no) return ballot.options.empty() ? Json() : Json(ballot.options.front());
  if (kind == Kind::rank) return ballot.options;
  Json json = kind == Kind::coins ? Json::object() : Json::array();
  for (std::size_t i = 0; i < ballot.options.size(); ++i) {
    if (kind == Kind::coins && i < ballot.coins.size()) json[ballot.options[i]] = ballot.coins[i];
    if (kind != Kind::dots || i >= ballot.places.size()) continue;
    const Point3& place = ballot.places[i];
    json.push_back({{"place", {place.x, place.y, place.z}}, {"option", ballot.options[i]}});
  }
  return json;
}

}  // namespace bl::vote
