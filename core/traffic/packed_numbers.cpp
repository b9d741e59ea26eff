// Writing and reading digits of base 64, two at a time.
#include "core/traffic/packed_numbers.h"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace bl {

namespace {

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kPerNumber = 11, kPerIndex = 4;
constexpr std::uint8_t kNone = 64;
// Larger ones, and what is no number, come from a broken file.
constexpr double kLargest = 1e15;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  for (std::uint8_t& value : values) value = kNone;
  for (std::size_t d = 0; d < kDigits.size(); ++d) values[static_cast<unsigned char>(kDigits[d])] = static_cast<std::uint8_t>(d);
  return values;
}

template <class Bits>
void write(Bits bits, std::size_t digits, char* at) {
  for (std::size_t d = 0; d < digits; ++d, bits >>= 6) at[d] = kDigits[bits & 63];
}

// Nothing where a character is no digit.
template <class Bits>
std::optional<Bits> read(std::string_view digits) {
  static constexpr std::array<std::uint8_t, 256> kValues = values_of_digits();
  Bits bits = 0;
  for (std::size_t d = 0; d < digits.size(); ++d) {
    const std::uint8_t value = kValues[static_cast<unsigned char>(digits[d])];
    if (value == kNone) return std::nullopt;
    bits |= static_cast<Bits>(value) << (6 * d);
  }
  return bits;
}

}  // namespace

std::string packed(std::span<const double> numbers) {
  std::string text(kPerNumber * numbers.size(), '\0');
  for (std::size_t i = 0; i < numbers.size(); ++i)
    write(std::bit_cast<std::uint64_t>(numbers[i]), kPerNumber, &text[kPerNumber * i]);
  return text;
}

std::string packed(std::span<const std::uint32_t> indices) {
  std::string text(kPerIndex * indices.size(), '\0');
  for (std::size_t i = 0; i < indices.size(); ++i) {
    assert(indices[i] < 1u << (6 * kPerIndex));
    write(indices[i], kPerIndex, &text[kPerIndex * i]);
  }
  return text;
}

std::optional<std::vector<double>> unpacked_numbers(std::string_view text) {
  if (text.size() % kPerNumber != 0) return std::nullopt;
  std::vector<double> numbers;
  numbers.reserve(text.size() / kPerNumber);
  for (std::size_t at = 0; at < text.size(); at += kPerNumber) {
    const auto bits = read<std::uint64_t>(text.substr(at, kPerNumber));
    if (!bits || !(std::abs(std::bit_cast<double>(*bits)) <= kLargest)) return std::nullopt;
    numbers.push_back(std::bit_cast<double>(*bits));
  }
  return numbers;
}

std::optional<std::vector<std::uint32_t>> unpacked_indices(std::string_view text) {
  if (text.size() % kPerIndex != 0) return std::nullopt;
  std::vector<std::uint32_t> indices;
  indices.reserve(text.size() / kPerIndex);
  for (std::size_t at = 0; at < text.size(); at += kPerIndex) {
    const auto bits = read<std::uint32_t>(text.substr(at, kPerIndex));
    if (!bits) return std::nullopt;
    indices.push_back(*bits);
  }
  return indices;
}

}  // namespace bl
