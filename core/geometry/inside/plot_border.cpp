// Strips along the sides of a plot and sectors about their corners, on a grid of ten nanometres.
#include "core/geometry/inside/plot_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "core/base/mathematics.h"

namespace bl::geometry {

namespace {

constexpr double kGrid = 1e8;  // steps of the Clipper library's integers in a metre
// About the largest distance of a chord from its arc [m]: of arcs that are seen whole, so that the area is right all the same,
// and of others.
constexpr double kArcTolerance = 1e-4, kPartTolerance = 4e-6;
constexpr ClipperLib::cInt kSameStep = 4;
constexpr double kStripMargin = 1e-6;  // [m]

ClipperLib::cInt grid_step(double metres) { return static_cast<ClipperLib::cInt>(std::llround(metres * kGrid)); }

// The sector of a disc about a corner, from one direction clockwise to another one.
struct Fan {
  PlanPoint at, from, to;
  double by = 0;                     // [m]
  double tolerance = kArcTolerance;  // [m]
};

// Where all sides have one distance: what is too near to an inner corner lies between the feet of its two sides, or in front of
// one of them.
std::optional<Fan> fan_between(const BorderSide& before, const BorderSide& after) {
  const PlanPoint &n = before.normal, &m = after.normal;
  // To the right of the way, by more than rounding does.
  const bool is_inner = n.x * m.y - n.y * m.x < -1e-9;
  return is_inner ? std::optional<Fan>({after.from, n, m, before.by, kArcTolerance}) : std::nullopt;
}

// Both ends of a side. Where distances differ, what is too near to one may lie behind another side.
std::array<Fan, 2> ends_of(const BorderSide& side) {
  const PlanPoint &n = side.normal, opposite{-n.x, -n.y};
  return {Fan{side.from, opposite, n, side.by, kPartTolerance}, Fan{side.to, n, opposite, side.by, kPartTolerance}};
}

// With chords in place of its arc that cut as much away as they add, so that the area is that of the sector.
ClipperLib::Path path_of(const Fan& fan, PlotGrid& grid) {
  const PlanPoint &n = fan.from, &m = fan.to, &at = fan.at;
  const double by = fan.by;
  double angle = mathematics::arc_tangent(n.y * m.x - n.x * m.y, n.x * m.x + n.y * m.y);
  if (angle < 0) angle += 2 * std::numbers::pi;
  const double widest = 2 * std::sqrt(2 * fan.tolerance / by);
  const int count = std::clamp(static_cast<int>(std::ceil(angle / widest)), 3, 4096);
  const double step = angle / count, inner = count - 2.0;
  const double radius = by * (std::sqrt(1 + inner * angle / mathematics::sine(step)) - 1) / inner;
  ClipperLib::Path path{grid.of(at), grid.exactly({at.x + by * n.x, at.y + by * n.y})};
  for (int k = 1; k < count; ++k) {
    const double x = mathematics::cosine(k * step), y = -mathematics::sine(k * step);
    path.push_back(grid.exactly({at.x + radius * (n.x * x - n.y * y), at.y + radius * (n.x * y + n.y * x)}));
  }
  path.push_back(grid.exactly({at.x + by * m.x, at.y + by * m.y}));
  return path;
}

// What is in front of a side, and where distances differ as far behind it. Longer and wider by next to nothing, so that strips,
// sectors and the border have no sides in common.
ClipperLib::Path strip_of(const BorderSide& side, bool is_behind, const PlotGrid& grid) {
  const PlanPoint& n = side.normal;
  const double by = side.by, behind = is_behind ? by : kStripMargin;
  const PlanPoint a{side.from.x - kStripMargin * n.y, side.from.y + kStripMargin * n.x},
      b{side.to.x + kStripMargin * n.y, side.to.y - kStripMargin * n.x};
  return {grid.exactly({a.x - behind * n.x, a.y - behind * n.y}), grid.exactly({b.x - behind * n.x, b.y - behind * n.y}),
          grid.exactly({b.x + by * n.x, b.y + by * n.y}), grid.exactly({a.x + by * n.x, a.y + by * n.y})};
}

}  // namespace

std::size_t PlotGrid::number_of(const PlanPoint& p) {
  const ClipperLib::IntPoint at = exactly(p);
  const Square square = square_of(at);
  std::size_t first = known_.size();
  for (ClipperLib::cInt x = square.first - 1; x <= square.first + 1; ++x)
    for (ClipperLib::cInt y = square.second - 1; y <= square.second + 1; ++y)
      if (const auto found = squares_.find({x, y}); found != squares_.end())
        for (const std::size_t k : found->second)
          if (std::abs(known_[k].X - at.X) <= kSameStep && std::abs(known_[k].Y - at.Y) <= kSameStep) first = std::min(first, k);
  if (first < known_.size()) return first;
  squares_[square].push_back(first);
  known_.push_back(at);
  return first;
}

ClipperLib::IntPoint PlotGrid::exactly(const PlanPoint& p) const {
  return {grid_step(p.x - origin_.x), grid_step(p.y - origin_.y)};
}

PlanCorner PlotGrid::back(const ClipperLib::IntPoint& p, std::size_t number) const {
  return {origin_.x + static_cast<double>(p.X) / kGrid, origin_.y + static_cast<double>(p.Y) / kGrid, number};
}

// Places that are the same lie in one square or in squares side by side.
PlotGrid::Square PlotGrid::square_of(const ClipperLib::IntPoint& p) {
  const auto of = [](ClipperLib::cInt at) { return at / kSameStep - (at % kSameStep < 0 ? 1 : 0); };
  return {of(p.X), of(p.Y)};
}

void take_away(const std::vector<BorderSide>& sides, SideEnds kind, PlotGrid& grid, ClipperLib::Clipper& clipper) {
  const auto take = [&clipper, &grid](const Fan& fan) {
    ClipperLib::Path path = path_of(fan, grid);
    if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
    clipper.AddPath(path, ClipperLib::ptClip, true);
  };
  const bool is_mixed = kind == SideEnds::both;
  std::vector<std::vector<std::size_t>> leaving;  // per corner: the sides that begin there
  for (std::size_t k = 0; !is_mixed && k < sides.size(); ++k) {
    const std::size_t corner = grid.number_of(sides[k].from);
    leaving.resize(grid.count());
    leaving[corner].push_back(k);
  }
  std::set<std::size_t> reached;  // corners where sides end
  if (kind == SideEnds::of_lines)
    for (const BorderSide& side : sides) reached.insert(grid.number_of(side.to));
  for (const BorderSide& side : sides) {
    if (!(side.by > 0)) continue;
    clipper.AddPath(strip_of(side, is_mixed, grid), ClipperLib::ptClip, true);
    const std::array<Fan, 2> ends = ends_of(side);
    if (is_mixed) {
      for (const Fan& end : ends) take(end);
      continue;
    }
    const std::size_t corner = grid.number_of(side.to);
    const bool goes_on = corner < leaving.size() && !leaving[corner].empty();
    for (std::size_t k = 0; goes_on && k < leaving[corner].size(); ++k)
      if (const std::optional<Fan> fan = fan_between(side, sides[leaving[corner][k]])) take(*fan);
    if (kind != SideEnds::of_lines) continue;
    if (!reached.contains(grid.number_of(side.from))) take(ends[0]);
    if (!goes_on) take(ends[1]);
  }
}

}  // namespace bl::geometry
