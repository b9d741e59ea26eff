// Reading both forms, writing arrays.
#include "core/define/list_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace bl {

namespace {

template <class T, class IsOne>
std::optional<NumberList<T>> list_in(const Json& json, std::optional<std::vector<T>> (*of_digits)(std::string_view),
                                     IsOne is_one) {
  std::optional<std::vector<T>> numbers;
  if (json.is_string()) numbers = of_digits(json.get_ref<const std::string&>());
  else if (json.is_array() && std::all_of(json.begin(), json.end(), is_one)) numbers = json.get<std::vector<T>>();
  return numbers ? std::optional(NumberList<T>(std::move(*numbers))) : std::nullopt;
}

}  // namespace

std::optional<Numbers> numbers_in(const Json& json) {
  return list_in<double>(json, numbers_of_digits, [](const Json& one) { return one.is_number(); });
}

std::optional<Indices> indices_in(const Json& json) {
  return list_in<std::uint32_t>(json, indices_of_digits, [](const Json& one) {
    return one.is_number_unsigned() && one.get<std::uint64_t>() <= kLargestIndex;
  });
}

Json field_to_json(const Scalar& field) {
  if (const auto* number = std::get_if<double>(&field)) return *number;
  if (const auto* numbers = std::get_if<Numbers>(&field)) return **numbers;
  if (const auto* indices = std::get_if<Indices>(&field)) return **indices;
  return std::get<std::string>(field);
}

}  // namespace bl
