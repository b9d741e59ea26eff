// Who has a session file open: a note beside the file, because the file itself cannot be read meanwhile.
#pragma once

#include <cstdint>
#include <string>

namespace bl::journal {

/// Notes this process as the holder of the file. Without the right to write there, nobody can be told who it is; that is no
/// failure. `since`: [ms since 1970]; 0: unknown.
void note_holder(const std::string& path, std::int64_t since);
void forget_holder(const std::string& path);
/// "another program has this file open: process 4711 on the computer desk, since 2026-03-01 09:30 UTC"; without the note, its
/// first half.
std::string sentence_of_holder(const std::string& path);

}  // namespace bl::journal
