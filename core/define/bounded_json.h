// Parses JSON from untrusted sources, within limits on nesting and on the number of values.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"

namespace bl {

/// The deepest nesting. Scenes and the formats of surroundings need less, and a tree of this depth is destroyed without a stack
/// overflow.
inline constexpr std::size_t kMostJsonDepth = 64;
/// At most about 80 bytes each in memory.
inline constexpr std::size_t kMostJsonValues = 40000000;

/// "line 3, column 7" of the byte `at`, counted from 0.
std::string place_in_text(std::string_view text, std::size_t at);

/// Checks that the text is within both limits and holds no zero byte, before it is parsed. The place of an error is its line and
/// column.
Result<void> check_json_bounds(std::string_view text);

/// The value of the text. `format` names the expected format in the message of an error, whose place is its line and column. A
/// stop request of this thread (`core/base/stop.h`) ends it early with `cancelled`.
Result<nlohmann::json> read_bounded_json(std::string_view text, std::string_view format);

/// The end of the array or object at the beginning of the text; npos where there is none, or where it does not end.
std::size_t end_of_first_value(std::string_view text);

}  // namespace bl
