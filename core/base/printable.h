// Makes foreign text safe for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace bl {

/// The text with control characters, marks that turn the direction of writing, and what is no UTF-8 written out (`\x1b`,
/// `\u202e`): names, scripts and files are by others, and a terminal obeys such characters.
std::string printable(std::string_view text);

}  // namespace bl
