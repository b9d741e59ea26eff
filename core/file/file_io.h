// Whole files in and out; writing never leaves half a file behind.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// The bytes of a file of at most 1 GiB.
Result<std::string> read_file(const std::string& path);

/// The bytes of a file that a scene names: of plain files alone, since devices and pipes need not end, and at most `most` of them.
Result<std::string> read_plain_file(const std::string& path, std::uintmax_t most);

/// Writes to a temporary name beside `path`, flushes to disk, then renames: an interrupted save leaves the old file whole.
Result<void> write_file(const std::string& path, std::string_view content);

}  // namespace bl
