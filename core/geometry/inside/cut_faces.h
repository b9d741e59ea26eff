// Where a convex part is split next, when a surface passes through it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/geometry/solid_part.h"

namespace bl::geometry {

/// A face of the surface that parts are split along.
struct CutFace {
  Polygon polygon;
  Plane plane;
};

/// The faces among `candidates` (indices into `faces`) that pass through the inside of the part.
std::vector<std::uint32_t> crossing_faces(const SolidPart& part, std::span<const CutFace> faces,
                                          std::span<const std::uint32_t> candidates, double tolerance);

/// Of the planes of the crossing faces: upright ones first, so that columns stay columns; then one that cuts few of the other
/// faces; then that of the largest face. None where nothing crosses.
std::optional<Plane> best_plane(const SolidPart& part, std::span<const CutFace> faces, std::span<const std::uint32_t> crossing,
                                double tolerance);

}  // namespace bl::geometry
