// Lists of numbers in JSON: arrays, and the digits by which older files held them; fields of tables, which may be such lists.
#pragma once

#include <optional>

#include "core/define/json_text.h"
#include "core/define/value.h"

namespace bl {

/// [1, 2.5, ...], or digits; nothing where the JSON is neither.
std::optional<Numbers> numbers_in(const Json& json);
/// [0, 7, ...] up to kLargestIndex, or digits; nothing where the JSON is neither.
std::optional<Indices> indices_in(const Json& json);
/// A list is an array.
Json field_to_json(const Scalar& field);

}  // namespace bl
