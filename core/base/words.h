// Words that people type: in one form, and without what hides or moves others.
#pragma once

#include <string>
#include <string_view>

namespace bl {

/// Nothing of the text would be written out by printable(); line breaks may be there.
bool is_harmless(std::string_view text);
/// The text with letters and their accents as one character each, where Unicode has one (NFC, UAX 15): two names that look the
/// same are the same. What is no UTF-8 stays as it is.
std::string composed(std::string_view text);

}  // namespace bl
