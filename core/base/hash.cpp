// Text form of hashes.
#include "core/base/hash.h"

namespace bl {

std::string hex_digits(std::uint64_t value) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 15; i >= 0; --i, value >>= 4) text[static_cast<std::size_t>(i)] = kDigits[value & 15];
  return text;
}

std::string Hash::hex() const { return hex_digits(state_); }

}  // namespace bl
