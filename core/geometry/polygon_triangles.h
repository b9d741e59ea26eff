// Triangulates a flat polygon with holes over its own corners, and makes upright prisms: closed meshes for display.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mesh.h"
#include "core/base/vector.h"
#include "core/geometry/plan_ring.h"

namespace bl::geometry {

/// Triangles over the corners of all rings, numbered through: the first ring is the outer one, the others are holes, of either
/// orientation. Only x and y count; triangles run counter-clockwise. Ears are clipped (Meisters 1975), holes joined by bridges.
/// Every side of a ring belongs to one triangle and every other edge to two, whatever the rings look like, so that faces that
/// share corners stay closed; where rings cross themselves or each other, triangles overlap.
std::vector<std::array<std::uint32_t, 3>> polygon_triangles(std::span<const Ring> rings);

/// The closed mesh between two heights over a polygon with holes, oriented outward; rings may turn either way.
Mesh prism_mesh(const Ring& outer, std::span<const Ring> holes, double bottom, double top);

}  // namespace bl::geometry
