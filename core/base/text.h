// Numbers and names as text, independent of the locale.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace bl {

/// The shortest text that reads back as the same double (std::to_chars).
std::string shortest(double number);
/// With a fixed number of decimals (from 0), for people; never "-0.00".
std::string fixed(double number, int decimals);
/// With three significant digits, in scientific notation where that is shorter: for errors and shares.
std::string rough(double number);
/// The whole text as a finite double with a decimal point; nothing where anything is left over.
std::optional<double> parse_number(std::string_view text);
/// Of `names`, the one that `name` was probably meant to be (few edits away), or empty.
std::string nearest_name(std::string_view name, std::span<const std::string> names);
/// ", did you mean `x`?" or an empty text where nothing is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> names);
/// Is it a legal id: 1 to 64 of a-z, 0-9, `_`, `-`, `.`, `#`, starting with a letter or digit?
bool is_identifier(std::string_view text);
/// Text from people (names, uses) as an identifier: lower case, other characters folded to `_`; never empty.
std::string to_identifier(std::string_view text);

/// ASCII letters in lower case.
std::string lower_case(std::string_view text);

}  // namespace bl
