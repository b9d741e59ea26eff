// The minutes of a session: a page, tables, the log and the scenes, in one folder.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/minutes/account.h"

namespace bl::minutes {

/// The file that people read.
inline constexpr std::string_view kMinutesPage = "minutes.html";

/// All files of the minutes, by their names in the folder, the page first. They depend on the account alone.
std::vector<std::pair<std::string, std::string>> files_of(const Account& account);

/// Writes minutes.html, decisions.csv, comments.csv, votes.csv, log.jsonl, and in scenes/ one scene file for each scenario and
/// end.json into `directory`, which is made where it is missing. Returns how many there are. What others have put there is not
/// written over: `may_fill_with_minutes`, and the folder holds no minutes of another session.
Result<std::size_t> write_minutes(const std::string& directory, const Account& account);

/// Checks that minutes overwrite no other file in `directory`: files under their names must be empty or of earlier minutes. A
/// missing folder is accepted.
Result<void> may_fill_with_minutes(const std::string& directory);

}  // namespace bl::minutes
