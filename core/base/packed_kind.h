// Packed files and archives, known by how they begin, whatever they are called.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// "a zip archive or an office document", "a file packed with bzip2"; empty where the bytes begin otherwise.
std::string_view packed_kind(std::string_view bytes);

/// What is said of a packed file where none is read; nothing where the bytes are none.
std::optional<Error> packed_refusal(std::string_view bytes);

}  // namespace bl
