// How well a few typed letters fit a name: all in order, better at the beginnings of words and side by side.
#pragma once

#include <string_view>

namespace bl::desktop {

/// The higher the better; below 0: does not fit. Case counts for nothing; words of the pattern may stand in any order.
int fuzzy_score(std::string_view pattern, std::string_view text);

}  // namespace bl::desktop
