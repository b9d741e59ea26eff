// The plot on which volumes stand, as convex pieces, and the same eroded by a distance.
#pragma once

#include <map>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/domain.h"
#include "core/geometry/inside/plan_clip.h"

namespace bl::geometry {

class PlanPlot {
 public:
  struct Piece {
    PlanPolygon polygon;  // in plan coordinates
    PlanPoint low, high;  // of the box around it
  };
  using Pieces = std::vector<Piece>;

  /// The horizontal section of the domain a little above its bottom.
  static Result<PlanPlot> section(const Domain& domain);

  /// All points of the plot that lie at least so far [m] inside its border. Exact for a convex plot. Of another one, arcs about
  /// its reflex corners are chords with the area of their sectors, on a grid of ten nanometres. Kept: distances are few, because
  /// set-backs are rules of a whole plot.
  const Pieces& eroded(double by);
  /// The same where it has been asked for before, else nullptr.
  const Pieces* made(double by) const;
  double area() const { return area_; }
  const PlanPoint& low() const { return low_; }
  const PlanPoint& high() const { return high_; }

 private:
  Pieces erode_convex(double by) const;
  Pieces erode_rings(double by) const;

  Pieces pieces_;  // as they are
  double area_ = 0;
  PlanPoint low_, high_;
  std::map<double, Pieces> eroded_;
};

}  // namespace bl::geometry
