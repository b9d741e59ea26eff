// JSON of strangers: parsed only where it is neither nested too deeply nor made of more values than memory can be asked for.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"

namespace bl {

/// Deeper than this no scene and no format of surroundings goes; a tree of that depth is also torn down without harm to the
/// stack.
inline constexpr std::size_t kMostJsonDepth = 64;
/// Some 80 bytes each in memory at worst.
inline constexpr std::size_t kMostJsonValues = 40000000;

/// "line 3, column 7" of the byte `at`, counted from 0.
std::string place_in_text(std::string_view text, std::size_t at);

/// Whether it is within both bounds and holds no zero byte, before a parser builds anything of it. The place of an error is its
/// line and column.
Result<void> check_json_bounds(std::string_view text);

/// The one value of the text. `format` is what the text should be, for the sentence of an error, whose place is its line and
/// column. A stop wish of this thread (`core/base/stop.h`) ends it early, as `cancelled`.
Result<nlohmann::json> read_bounded_json(std::string_view text, std::string_view format);

/// The end of the array or object that the text begins with; npos where it does not begin with one, or does not end it.
std::size_t end_of_first_value(std::string_view text);

}  // namespace bl
