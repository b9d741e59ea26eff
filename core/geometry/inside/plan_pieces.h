// A plan with holes as few convex polygons.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/inside/plan_corners.h"

namespace bl::geometry {

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

/// A convex polygon, counter-clockwise, of the places that have one label.
struct LabelledPolygon {
  std::vector<PlanCorner> corners;
  int label = 0;
};

/// The plane cut along the sides of rings that may cross, touch and lie upon each other: for every place one polygon whose inside
/// has the label that `label_at` gives there. Negative labels are left out. Polygons are as large as the labels allow, so that a
/// corner of one may lie within a side of another.
Result<std::vector<LabelledPolygon>> labelled_pieces(const std::vector<std::vector<PlanCorner>>& rings,
                                                     const std::function<int(const Point3&)>& label_at);

}  // namespace bl::geometry
