// Recognises bytes that are not the expected text, and names their format; the bytes themselves are never quoted.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// "a picture (PNG)", "binary data of no known kind"; empty where they can be text.
std::string foreign_kind(std::string_view bytes);

/// "This is no GeoJSON but a picture (PNG): ..."; nothing where they can be text. `wanted` is the format, `remedy` what to do.
std::optional<Error> foreign_bytes(std::string_view bytes, std::string_view wanted, std::string_view remedy);

}  // namespace bl
