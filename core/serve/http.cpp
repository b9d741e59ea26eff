// Forms as browsers send them (application/x-www-form-urlencoded).
#include "core/serve/http.h"

#include <optional>

namespace bl::serve {

namespace {

std::optional<int> digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

// An escape that is none stands for itself.
std::string unescaped(const std::string& text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto high = text[k] == '%' && k + 2 < text.size() ? digit_of(text[k + 1]) : std::nullopt;
    const auto low = high ? digit_of(text[k + 2]) : std::nullopt;
    if (low) {
      plain += static_cast<char>(*high * 16 + *low);
      k += 2;
    } else {
      plain += text[k] == '+' ? ' ' : text[k];
    }
  }
  return plain;
}

}  // namespace

std::map<std::string, std::string> form_fields(const std::string& text) {
  std::map<std::string, std::string> fields;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('&', begin), text.size());
    const std::string field = text.substr(begin, end - begin);
    const std::size_t equals = field.find('=');
    if (equals != std::string::npos && equals > 0)
      fields[unescaped(field.substr(0, equals))] = unescaped(field.substr(equals + 1));
    begin = end + 1;
  }
  return fields;
}

std::string form_text(std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789ABCDEF", kPlain = "-._";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (is_letter || kPlain.find(c) != std::string_view::npos) out += c;
    else (((out += '%') += kDigits[byte >> 4]) += kDigits[byte & 15]);
  }
  return out;
}

std::string path_of(const std::string& target) { return target.substr(0, target.find_first_of("?#")); }

}  // namespace bl::serve
