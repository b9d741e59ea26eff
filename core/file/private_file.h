// Files that only their owner may read, such as those that hold keys.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl {

/// As write_file (core/file/file_io.h) does; the file has mode 0600 afterwards, whatever it had before.
Result<void> write_private_file(const std::string& path, std::string_view content);

/// Opens a growing file that goes on where it ended, with mode 0600, to read and to append. It is locked as long as it is open:
/// where somebody else has it open, that is `duplicate`. The caller closes it.
Result<std::FILE*> open_private_log(const std::string& path);

}  // namespace bl
