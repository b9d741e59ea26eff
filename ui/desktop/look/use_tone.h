// Colours of uses in the window: those of reports, pages and files.
#pragma once

#include <cstddef>
#include <string>

namespace bl::desktop {

/// A volume without a use stands outside of the series.
inline constexpr std::size_t kNoUse = static_cast<std::size_t>(-1);

/// 0xRRGGBB of a use; kNoUse where it has no name.
std::size_t tone_of_use(const std::string& use);

}  // namespace bl::desktop
