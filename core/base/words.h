// Words that people type: in one form, without what hides or moves others, and what names are names of.
#pragma once

#include <string>
#include <string_view>

namespace bl {

/// Nothing of the text would be written out by printable(); line breaks may be there.
bool is_harmless(std::string_view text);
/// The text with letters and their accents as one character each, where Unicode has one (NFC, UAX 15): two names that look the
/// same are the same. What is no UTF-8 stays as it is.
std::string composed(std::string_view text);
/// What a name in English names, without what it lies at: "Flats above shops" are "Flats". All of a name without such a word,
/// or with one at its beginning or end.
std::string_view without_place(std::string_view name);

}  // namespace bl
