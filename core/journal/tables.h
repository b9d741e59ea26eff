// The tables of a session file, and what marks a file as one.
#pragma once

#include <cstdint>

namespace bl::journal {

/// "BLse", at byte 68 of the file.
inline constexpr std::int64_t kApplicationId = 0x424c7365;
/// Of the tables. A program reads files of its own version and of older ones.
inline constexpr std::int64_t kVersion = 1;

/// All tables, empty. Rows have the names of core/room/record.h.
extern const char* const kTables;

}  // namespace bl::journal
