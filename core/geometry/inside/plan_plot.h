// The plot on which volumes stand, as convex pieces, and the same eroded by a distance.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/geometry/domain.h"
#include "core/geometry/footprint.h"
#include "core/geometry/inside/plan_clip.h"

namespace bl::geometry {

/// How far inside each kind of side [m].
struct PlotOffset {
  double border = 0;    ///< of the border where that is no street
  double street = 0;    ///< of sides along streets
  double left_out = 0;  ///< of ground inside the border that the plot leaves out
  auto operator<=>(const PlotOffset&) const = default;
};

/// The section of a domain, as convex polygons: those that can meet the box from `low` to `high`.
std::vector<PlanPolygon> sections_at(const Domain& domain, double z, const PlanPoint& low, const PlanPoint& high);
/// [m²]; negative where the corners are clockwise.
double area_of(const PlanPolygon& polygon);

class PlanPlot {
 public:
  struct Piece {
    PlanPolygon polygon;  // in plan coordinates
    PlanPoint low, high;  // of the box around it
  };
  using Pieces = std::vector<Piece>;

  /// The horizontal section of the domain a little above its bottom. `land`: the same with the ground that it leaves out, whose
  /// border then is the border of the plot; nullptr: the domain leaves out nothing.
  static Result<PlanPlot> section(const Domain& domain, std::span<const StreetAxis> streets = {}, const Domain* land = nullptr);

  /// All points of the plot that lie at least so far [m] from each side of its border. Exact for a convex plot with one distance.
  /// Else arcs about corners are chords with the area of their sectors, on a grid of ten nanometres. Kept until `keep_only`:
  /// distances are few, because set-backs are rules of a whole plot.
  const Pieces& eroded(const PlotOffset& by);
  /// The same where it has been asked for before, else nullptr.
  const Pieces* made(const PlotOffset& by) const;
  /// Forgets what is eroded by other distances than these. While somebody drags a distance, each frame has a new one.
  void keep_only(std::vector<PlotOffset> used);
  std::size_t kept() const { return eroded_.size(); }
  double area() const { return area_; }
  const PlanPoint& low() const { return low_; }
  const PlanPoint& high() const { return high_; }

 private:
  Pieces erode_convex(double by) const;
  Pieces erode_rings(const PlotOffset& by) const;
  // Tells the sides of ground that is left out from those of the border of the land. Are there any?
  bool mark_left_out(const Pieces& land);
  static void mark_streets(Pieces& pieces, std::span<const StreetAxis> streets);
  // The pieces whose sides are the border.
  const Pieces& bordered() const { return land_.empty() ? pieces_ : land_; }
  // The box around both, by which distances are too far.
  void measure_box();
  // Without sides of one kind their distance makes no difference.
  PlotOffset effective(const PlotOffset& by) const;
  // Is no point so far from the sides, whatever the plot is like inside its box? A disc in it is no wider than the box, and no
  // two points are farther apart than the corners of the box.
  bool is_too_far(const PlotOffset& by) const {
    return std::min(by.border, by.street) > widest_ || std::max({by.border, by.street, by.left_out}) > farthest_;
  }

  Pieces pieces_;  // as they are
  Pieces land_;    // with the ground that is left out; none where nothing is
  double area_ = 0;
  PlanPoint low_, high_;
  double widest_ = 0, farthest_ = 0;                // half of its smaller side, and its diagonal [m], with room for rounding
  bool has_streets_ = false, has_borders_ = false;  // sides of each kind
  std::map<PlotOffset, Pieces> eroded_;
  Pieces none_;
};

}  // namespace bl::geometry
