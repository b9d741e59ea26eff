// A plan with holes as few convex polygons.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/plan_corners.h"

namespace bl {

/// One convex polygon of a plan, counter-clockwise.
struct PlanPiece {
  static constexpr std::uint32_t kNoWall = 0xffffffffu;
  std::vector<PlanCorner> corners;
  std::vector<std::uint32_t> walls;  ///< of side i (from corner i on): number of the wall, counted through all rings, or kNoWall
};

/// The first ring, counter-clockwise, without the others, clockwise. Each side of a piece is a whole side of a ring, or lies
/// between pieces. The pieces depend on the rings as curves only, not on where they begin; they are sorted by their lowest
/// corner.
Result<std::vector<PlanPiece>> plan_pieces(const std::vector<std::vector<PlanCorner>>& rings);

}  // namespace bl
