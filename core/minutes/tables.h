// The minutes as tables for spreadsheets.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/minutes/account.h"

namespace bl::minutes {

/// What was marked for the minutes, in order.
std::string decisions_csv(const Account& account);
/// All comments, in order.
std::string comments_csv(const Account& account);
/// For each round of each vote a row `vote`, then a row `option` for each option, then, of votes that were never secret, a row
/// `ballot` for each ballot.
std::string votes_csv(const Account& account);

/// The tables by the names of their files, each with what it begins with, whatever version of the program wrote it.
const std::vector<std::pair<std::string_view, std::string_view>>& table_beginnings();

}  // namespace bl::minutes
