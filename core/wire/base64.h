// Bytes as text in base 64 (RFC 4648), for frames that hold packed scenes.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::wire {

std::string base64_of(std::string_view bytes);
/// Refuses every text that base64_of() does not give.
Result<std::string> bytes_of_base64(std::string_view text);

}  // namespace bl::wire
