// Three bytes are four letters; the last group is filled with `=`.
#include "core/wire/base64.h"

#include <array>
#include <cstdint>

namespace bl::wire {

namespace {

constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

constexpr std::array<int, 256> values() {
  std::array<int, 256> values{};
  for (int& value : values) value = -1;
  for (std::size_t k = 0; k < kLetters.size(); ++k) values[static_cast<unsigned char>(kLetters[k])] = static_cast<int>(k);
  return values;
}

}  // namespace

std::string base64_of(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < 3; ++n) group = group << 8 | (n < count ? static_cast<unsigned char>(bytes[k + n]) : 0u);
    for (std::size_t n = 0; n < 4; ++n) text += n <= count ? kLetters[group >> (18 - 6 * n) & 63u] : '=';
  }
  return text;
}

Result<std::string> bytes_of_base64(std::string_view text) {
  static constexpr std::array<int, 256> kValues = values();
  const Error wrong{ErrorCode::parse, "", "the text is not in base 64"};
  if (text.size() % 4 != 0) return wrong;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t k = 0; k < text.size(); k += 4) {
    const bool is_last = k + 4 == text.size();
    const std::size_t filled = is_last ? (text[k + 3] != '=' ? 0u : text[k + 2] != '=' ? 1u : 2u) : 0u;
    std::uint32_t group = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      const int value = n + filled >= 4 ? 0 : kValues[static_cast<unsigned char>(text[k + n])];
      if (value < 0) return wrong;
      group = group << 6 | static_cast<std::uint32_t>(value);
    }
    if ((filled == 1 && (group & 0xffu) != 0) || (filled == 2 && (group & 0xffffu) != 0)) return wrong;
    for (std::size_t n = 0; n + filled < 3; ++n) bytes += static_cast<char>(group >> (16 - 8 * n) & 0xffu);
  }
  return bytes;
}

}  // namespace bl::wire
