// Reads the fields of hand-written JSON input; every error has a place and quotes what was found there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/vector.h"
#include "core/define/json_text.h"

namespace bl::cli {

/// "place/key", or the key alone where there is no place.
std::string slash(const std::string& place, const std::string& key);
std::string slash(const std::string& place, std::size_t index);
/// The value on one line, cut where it is long.
std::string excerpt(const Json& json);

Result<double> number_at(const Json& json, const std::string& place);
/// `form` describes the list: "a point [x, y, z]".
Result<std::vector<double>> numbers_at(const Json& json, std::size_t count, const std::string& form, const std::string& place);
/// The list under a key; an error where it is missing or no list.
Result<const Json*> list_at(const Json& json, const char* key, const std::string& place);
Result<std::vector<Point3>> points_at(const Json& list, const std::string& place);
/// Indices from 0 of things of which there are `count`, each at most once; `noun` names such a thing.
Result<std::vector<std::uint32_t>> indices_at(const Json& json, std::size_t count, const std::string& noun,
                                              const std::string& place);
/// An error where the object has a key that is not among `known`.
Result<void> check_keys(const Json& object, const std::vector<std::string>& known, const std::string& place);

}  // namespace bl::cli
