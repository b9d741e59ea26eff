// Composition by utf8proc; the only file that sees it.
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include <utf8proc.h>

namespace bl {

std::string composed(std::string_view text) {
  const bool is_ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (is_ascii) return std::string(text);
  utf8proc_uint8_t* raw = nullptr;
  constexpr auto kHow = static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE);
  const auto size = utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                 static_cast<utf8proc_ssize_t>(text.size()), &raw, kHow);
  const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> made(raw, std::free);
  if (size < 0) return std::string(text);
  return {reinterpret_cast<const char*>(made.get()), static_cast<std::size_t>(size)};
}

namespace {

// What follows such a word is what the thing itself lies at.
constexpr std::array<std::string_view, 10> kPlaceWords{"above", "over",       "atop", "below", "beneath",
                                                       "under", "underneath", "on",   "with",  "beside"};

bool is_letter_of_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte >= 0x80 || (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}
bool is_digit_of_word(char c) { return c >= '0' && c <= '9'; }

bool is_place_word(std::string_view word) {
  const auto is_same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b; };
  return std::any_of(kPlaceWords.begin(), kPlaceWords.end(), [&](std::string_view known) {
    return std::equal(word.begin(), word.end(), known.begin(), known.end(), is_same);
  });
}

}  // namespace

std::string_view without_place(std::string_view name) {
  const auto next = [&](std::size_t from, bool is_letter) {
    while (from < name.size() && is_letter_of_word(name[from]) != is_letter) ++from;
    return from;
  };
  bool is_first = true;
  for (std::size_t from = next(0, true), to = 0; from < name.size(); from = next(to, true), is_first = false) {
    to = next(from, false);
    if (is_first || next(to, true) == name.size() || !is_place_word(name.substr(from, to - from))) continue;
    // One half of a word such as `add-on` or `on-street` is no word of its own.
    if ((name[from - 1] == '-') != (name[to] == '-')) continue;
    std::size_t end = from;
    while (!is_letter_of_word(name[end - 1]) && !is_digit_of_word(name[end - 1])) --end;
    return name.substr(0, end);
  }
  return name;
}

}  // namespace bl
