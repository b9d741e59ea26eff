// Makes the plates of one standing site: its power cell, form and plot, each eroded by the set-back, and what they share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/footprint.h"
#include "core/geometry/inside/plan_clip.h"
#include "core/geometry/inside/plan_plot.h"

namespace bl::geometry {

/// The distances by which the parts of a footprint are eroded [m].
struct PlateOffset {
  double own = 0;        ///< the sides of the form
  double neighbour = 0;  ///< those towards other sites
  PlotOffset plot;       ///< those of the plot
};

/// Of the plates of a run; and of the courtyard in them, where the depth leaves one.
PlateOffset outer_offset(const StandingSite& site, const StoreyRun& run);
PlateOffset courtyard_offset(const StandingSite& site, const StoreyRun& run);

/// Does the form, eroded so far, leave anything? Without a form there is always something.
bool leaves_form(const StandingSite& site, const PlateOffset& offset);

/// Another site near enough to have a side with this one.
struct PlanNeighbour {
  std::uint32_t site = 0;
  double distance = 0;   // [m]
  HalfPlane half_plane;  // this site's side of the bisector, relative to this site
};

/// The sites by squares of the plan, so that those near one are found without looking at all.
class PlanGrid {
 public:
  void fill(std::span<const StandingSite> sites);

  /// Those whose bisector can cut what of site i lies within `reach` of it [m]; infinity: the box from `low` to `high`. In
  /// ascending distance. Sites in the same place have no bisector and are left out.
  void near(std::uint32_t i, std::span<const StandingSite> sites, double reach, const PlanPoint& low, const PlanPoint& high,
            std::vector<PlanNeighbour>& found) const;
  /// Calls `visit` for all sites that are no farther from a place than `distance` [m], and for some that are.
  template <class Visit>
  void around(const Point3& at, double distance, const Visit& visit) const {
    if (sites_.empty() || !(distance >= 0)) return;
    for (std::size_t row = row_of(at.y - distance); row <= row_of(at.y + distance); ++row)
      for (std::size_t column = column_of(at.x - distance); column <= column_of(at.x + distance); ++column)
        for (std::uint32_t k = starts_[row * columns_ + column]; k < starts_[row * columns_ + column + 1]; ++k) visit(sites_[k]);
  }

 private:
  // Squares over the box from `low_` to `high`; who lies beyond it is in the nearest square of its edge.
  void sort_in(std::span<const StandingSite> sites, const PlanPoint& high);
  // Has one square a large part of all sites, because a few lie far away?
  bool is_crowded() const;
  std::size_t column_of(double x) const;
  std::size_t row_of(double y) const;

  PlanPoint low_;
  double width_ = 1;
  std::size_t columns_ = 1, rows_ = 1;
  double largest_weight_ = 0;
  std::vector<std::uint32_t> starts_, sites_;
};

/// The distance from a site within which its form lies [m]; infinity for form `cell`.
double reach_of(const StandingSite& site);

/// With memory for one thread.
class FootprintMaker {
 public:
  FootprintMaker(const PlanPlot& plot, const PlanGrid& grid, std::span<const StandingSite> sites)
      : plot_(plot), grid_(grid), sites_(sites) {}

  /// Returns how far from the site its footprint can reach [m].
  double measure(std::uint32_t i, FootprintMeasure& into);
  /// The convex parts of what is left of site i, relative to the site. `beyond` of a side is a site, or one of PlanSide.
  const std::vector<PlanPolygon>& parts(std::uint32_t i, const PlateOffset& offset);

 private:
  struct Sum {
    double area = 0, arc = 0, along = 0, across = 0;  // [m²], [m]
  };
  void find_neighbours(std::uint32_t i);
  bool cut(const PlanPlot::Piece& piece, std::uint32_t i, const PlateOffset& offset);
  // The area of what is left, and the lengths of its sides: those of the neighbours into `lengths_`.
  Sum measure_offset(std::uint32_t i, const PlateOffset& offset);

  const PlanPlot& plot_;
  const PlanGrid& grid_;
  std::span<const StandingSite> sites_;
  std::vector<PlanNeighbour> neighbours_;
  std::vector<double> lengths_, responses_, walls_, side_lengths_;
  std::vector<PlanPolygon> parts_;
  PlanPolygon polygon_, spare_;
};

}  // namespace bl::geometry
