// Is a text from a script well-formed? Others could not be written to scene files, logs and reports.
#pragma once

#include <string>
#include <string_view>

namespace bl::script {

bool is_utf8(std::string_view text);
/// The text, or, where it is not well-formed, with `?` for every byte beyond ASCII.
std::string shown_as_utf8(std::string text);

}  // namespace bl::script
