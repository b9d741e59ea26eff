// Reads the number in a message from any sender.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::live {

/// Longer messages are refused: what a number needs is far less, and whoever sends more may mean harm [bytes].
inline constexpr std::size_t kLongestPayload = 65536;

/// The number that a message holds: its whole text, or of a JSON text the part that `field` names (a key, or a JSON pointer
/// with its slash). Truth values count as 1 and 0. Else the sentence why there is none, without a place.
Result<double> number_in(std::string_view payload, std::string_view field);

/// A text from outside as it may stand in a sentence: printable, short, between back ticks.
std::string in_quotes(std::string_view text);

}  // namespace bl::live
