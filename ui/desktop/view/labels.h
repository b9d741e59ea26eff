// Ids as people read them.
#pragma once

#include <string>
#include <string_view>

namespace bl::desktop {

/// "storey_height" as "Storey height".
std::string label_of(std::string_view id);
/// What people call a use: the same; "No use" where there is none.
std::string label_of_use(std::string_view use);

}  // namespace bl::desktop
