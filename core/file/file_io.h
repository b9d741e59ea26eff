// Whole files in and out; writing never leaves half a file behind.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// The bytes of a file of at most 1 GiB.
Result<std::string> read_file(const std::string& path);

/// The bytes of a file that a scene names: of plain files alone, since devices and pipes need not end, and at most `most` of
/// them.
Result<std::string> read_plain_file(const std::string& path, std::uintmax_t most);

// The only two ways in which this program writes files. Links are followed to the file that they mean, unless somebody else has
// laid them in a folder of everybody's.

/// Writes to a temporary file beside it, flushes to disk, then renames: an interrupted save leaves the old file whole. Mode and
/// group of the old one are kept. What an interrupted save has left is cleared by the next one.
Result<void> write_file(const std::string& path, std::string_view content);

/// Would a file of that name be written? Tried in its folder, where nothing is left behind; for tasks that compute long before
/// they write.
Result<void> may_write_file(const std::string& path);

/// A file that grows line by line, such as a log; empty at first. One that has to be new is refused as `duplicate` where there is
/// one. The caller closes it.
Result<std::FILE*> open_growing_file(const std::string& path, bool must_be_new = false);

}  // namespace bl
