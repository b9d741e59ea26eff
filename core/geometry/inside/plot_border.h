// The sides of a plot, and what lies too near to them, as paths on the grid of the Clipper library.
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <clipper.hpp>

#include "core/geometry/inside/plan_clip.h"
#include "core/geometry/inside/plan_corners.h"

namespace bl::geometry {

/// Places on the grid. Corners of several pieces at one place get the same numbers, whichever way each was rounded: those of the
/// first one that is near enough.
class PlotGrid {
 public:
  explicit PlotGrid(const PlanPoint& origin) : origin_(origin) {}

  std::size_t number_of(const PlanPoint& p);
  std::size_t count() const { return known_.size(); }
  ClipperLib::IntPoint of(const PlanPoint& p) { return known_[number_of(p)]; }
  ClipperLib::IntPoint exactly(const PlanPoint& p) const;
  PlanCorner back(const ClipperLib::IntPoint& p, std::size_t number) const;

 private:
  using Square = std::pair<ClipperLib::cInt, ClipperLib::cInt>;

  static Square square_of(const ClipperLib::IntPoint& p);

  PlanPoint origin_;
  std::vector<ClipperLib::IntPoint> known_;
  std::map<Square, std::vector<std::size_t>> squares_;
};

/// A side with the inside of the plot on its left; `normal` points inwards. Nothing is built nearer than `by` to it [m].
struct BorderSide {
  PlanPoint from, to, normal;
  double by = 0;
};

/// What is taken away about the ends of sides: of those that have different distances both ends of each. Of others what the
/// strips of two sides leave out between them; where they are lines that begin and end at the border, these ends too.
enum class SideEnds { both, between, of_lines };

/// Has the clipper take away what is too near to sides: a strip along each, and sectors of discs about its ends.
void take_away(const std::vector<BorderSide>& sides, SideEnds kind, PlotGrid& grid, ClipperLib::Clipper& clipper);

}  // namespace bl::geometry
