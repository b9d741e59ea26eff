// Reads and writes whole files; an interrupted write never leaves half a file.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// The bytes of a file of at most 1 GiB.
Result<std::string> read_file(const std::string& path);

/// The bytes of a file that a scene names, at most `most` of them. Only plain files are read, since devices and pipes may have no
/// end.
Result<std::string> read_plain_file(const std::string& path, std::uintmax_t most);

// With those of private_file.h, the only ways in which this program writes files, but for session files (core/journal). Links are
// followed to the file that they mean, unless somebody else has laid them in a folder of everybody's.

/// Writes to a temporary file beside it, flushes to disk, then renames, so that an interrupted save leaves the old file whole.
/// Mode and group of the old file are kept. The next save removes the temporary file of an interrupted one.
Result<void> write_file(const std::string& path, std::string_view content);

/// Checks whether a file of that name can be written, by a trial in its folder that leaves nothing behind. It is for tasks that
/// compute for long before they write.
Result<void> may_write_file(const std::string& path);

/// Opens a file that grows line by line, such as a log; it is empty at first. A file that must be new is refused as `duplicate`
/// where it exists. The caller closes it.
Result<std::FILE*> open_growing_file(const std::string& path, bool must_be_new = false);

}  // namespace bl
