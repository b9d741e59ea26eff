// Tokens and keys: random ones, and digests that say nothing about what they were made from.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace bl::room {

/// Random bytes. The program takes those of the system; tests hand in their own.
using RandomBytes = std::function<std::string(std::size_t count)>;
/// Of the system's source for keys; ends the program where there is none.
std::string system_random_bytes(std::size_t count);

/// As lower-case hexadecimal digits.
std::string hex_of(std::string_view bytes);
/// SHA-256 as 64 hexadecimal digits.
std::string digest_of(std::string_view text);
/// HMAC-SHA-256 (RFC 2104) as hexadecimal digits, so many of them from the front.
std::string keyed_digest_of(std::string_view key, std::string_view text, std::size_t digits);
/// Compares in a time that does not depend on where the texts differ.
bool is_same_secret(std::string_view a, std::string_view b);

}  // namespace bl::room
