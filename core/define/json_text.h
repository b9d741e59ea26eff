// Strict reading and diff-friendly writing of JSON text.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "core/base/result.h"

namespace bl {

using Json = nlohmann::ordered_json;

/// Parses one JSON value. Refuses comments, NaN, numbers beyond a double, a key given twice in one object, nesting deeper
/// than 64 levels, zero bytes and text that is not UTF-8; the place of an error is "line L, column C". Takes time in proportion
/// to the text, whatever its shape.
Result<Json> parse_json(std::string_view text);

/// Adds a field at the end of an object without searching for its key, so that an object of a hundred thousand nodes is filled
/// fast. The caller must know that the key is new.
Json& append_field(Json& object, std::string key);

/// Moves the fields of an object behind those of another one. The caller must know that they share no key.
void append_fields(Json& object, Json&& more);

/// Writes with two-space indents; what fits into 120 columns stays on one line, but for the outermost `open_levels` levels, which
/// are always one element per line. Shortest round-trip numbers, no locale. Ends without a line feed; depends on the value alone.
std::string write_json(const Json& value, int open_levels = 0);

/// Everything on one line.
std::string write_json_line(const Json& value);

}  // namespace bl
