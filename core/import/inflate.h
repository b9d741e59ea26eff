// Unpacks gzip, by zlib, up to a declared size.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace bl::importing {

/// Files unpack to no more than this.
inline constexpr std::size_t kMostUnpacked = std::size_t{1} << 29;

/// What is said of a file that unpacks to more.
Error too_large_unpacked(std::size_t limit);

/// The bytes themselves where they are not packed; what a gzip file holds where they are. All else that is packed
/// (bzip2, xz, zstd, zip, 7z, rar) is refused.
Result<std::string> unpacked(std::string_view bytes, std::size_t limit = kMostUnpacked);

}  // namespace bl::importing
