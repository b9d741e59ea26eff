// Scores how well typed letters match a name: all in order, better at the beginnings of words and side by side.
#pragma once

#include <string_view>

namespace bl::desktop {

/// Higher is better; below 0: no match. Case is ignored; words of the pattern may be in any order.
int fuzzy_score(std::string_view pattern, std::string_view text);

}  // namespace bl::desktop
