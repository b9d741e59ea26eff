// What the rows of an import say of buildings whose height the file does not tell; whoever lists rows finds them by these words.
#pragma once

#include <string_view>

namespace bl::importing {

inline constexpr std::string_view kHeightOfNeighbours = "height taken from its neighbours",
                                  kHeightAssumed = "height not known, assumed";

}  // namespace bl::importing
