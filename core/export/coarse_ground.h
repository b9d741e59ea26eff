// A surface of the ground with fewer triangles, for files that have no room for all of them.
#pragma once

#include <cstddef>

#include "core/base/mesh.h"

namespace bl::exporting {

/// At most so many triangles, at least 2: places that lie close to each other in plan fall together on one of them. The surface
/// keeps its border to half their distance. One that is small enough already stays as it is.
Mesh coarse_ground(const Mesh& ground, std::size_t most_triangles);

}  // namespace bl::exporting
