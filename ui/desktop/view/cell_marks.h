// A mark on corners of coarse cells that the renderer reads besides those of seams.
#pragma once

#include <cstdint>

#include "core/base/mesh.h"

namespace bl::desktop {

/// Of a first corner, in the seams of its wrap: its triangles have no edge opposite to it, because their face goes on there or
/// bends as little as the chords of an arc do.
inline constexpr std::uint32_t kNoRim = 1u << MeshWrap::kMostSeams;

}  // namespace bl::desktop
