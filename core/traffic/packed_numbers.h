// Lists of numbers as texts, bit for bit: what a network remembers is many numbers that only programs read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bl {

/// Eleven digits of base 64 (RFC 4648) for each number: its bits, the lowest six first.
std::string packed(std::span<const double> numbers);
/// Four digits for each, which suffices for 16 million.
std::string packed(std::span<const std::uint32_t> indices);

/// Nothing where the text is not such a list, or holds what is not finite or beyond 1e15.
std::optional<std::vector<double>> unpacked_numbers(std::string_view text);
std::optional<std::vector<std::uint32_t>> unpacked_indices(std::string_view text);

}  // namespace bl
