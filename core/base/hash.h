// A 64-bit hash that is the same on every machine and in every run: state hashes are built with it.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/vector.h"

namespace bl {

/// Folds values into 64 bits in the order given. Mixing as in the finaliser of SplitMix64 (Steele et al. 2014).
class Hash {
 public:
  void add(std::uint64_t word) { state_ = mix(state_ ^ (word + 0x9e3779b97f4a7c15ull + (state_ << 6) + (state_ >> 2))); }
  /// The bits of the number; both zeros hash alike, because they compare equal.
  void add(double number) { add(std::bit_cast<std::uint64_t>(number == 0 ? 0.0 : number)); }
  void add(const Vector3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    std::uint64_t word = 0;
    int filled = 0;
    for (const char c : text) {
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(c)) << (8 * filled);
      if (++filled == 8) {
        add(word);
        word = 0;
        filled = 0;
      }
    }
    if (filled > 0) add(word);
  }
  std::uint64_t value() const { return state_; }
  /// Sixteen lower-case hexadecimal digits.
  std::string hex() const;

  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_ = 0x243f6a8885a308d3ull;  // digits of pi: any fixed start does
};

/// Sixteen lower-case hexadecimal digits of a hash.
std::string hex_digits(std::uint64_t value);

}  // namespace bl
