// Long texts deflated, with a hash that tells whether they are still the same.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::journal {

struct Packed {
  std::string bytes;      ///< as zlib packs them
  std::int64_t size = 0;  ///< of the text
  std::string digest;     ///< of the text: sixteen hexadecimal digits
};

Packed pack(std::string_view text);
/// Refuses what is not the text that was packed.
Result<std::string> unpack(const Packed& packed);

}  // namespace bl::journal
