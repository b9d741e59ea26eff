// The number that stands for no index.
#pragma once

#include <cstdint>

namespace bl::geometry {

inline constexpr std::uint32_t kNone = 0xffffffffu;

}  // namespace bl::geometry
