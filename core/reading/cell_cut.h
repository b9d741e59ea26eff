// Cuts coarse cells at a height, so that what is left is such a cell again.
#pragma once

#include <cstdint>

#include "core/base/mesh.h"

namespace bl::reading {

enum class Kept : std::uint8_t { below, above };

/// The part of a coarse cell on that side of a height [m], closed by a flat face, with a wrap onto the same ball; null where
/// nothing of it is left.
MeshPointer cut_cell(const Mesh& cell, double height, Kept kept);

}  // namespace bl::reading
