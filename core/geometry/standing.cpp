// The ground under a point, and the stances of sites that nobody has asked about before.
#include "core/geometry/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/inside/stance_finder.h"

namespace bl::geometry {

namespace {

struct HeightSpan {
  double bottom, top;
};

// The stretch of a vertical line inside one piece; empty where bottom > top.
HeightSpan height_span_inside(const ConvexDomain& piece, const Point3& point) {
  HeightSpan heights{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (const Plane& plane : piece.planes) {
    const double room = plane.offset - plane.normal.x * point.x - plane.normal.y * point.y;
    if (std::abs(plane.normal.z) < 1e-12) {
      if (room < -1e-9) return {1, 0};
    } else if (plane.normal.z > 0) {
      heights.top = std::min(heights.top, room / plane.normal.z);
    } else {
      heights.bottom = std::max(heights.bottom, room / plane.normal.z);
    }
  }
  return heights;
}

}  // namespace

double ground_under(const Domain& domain, const Point3& point) {
  constexpr double kTouching = 1e-6;  // [m] between pieces that touch
  std::vector<HeightSpan> spans;
  for (const Domain::Piece& piece : domain.pieces)
    if (const HeightSpan heights = height_span_inside(piece.shape, point); heights.bottom <= heights.top)
      spans.push_back(heights);
  if (spans.empty()) return domain.minimum.z;
  std::sort(spans.begin(), spans.end(), [](const HeightSpan& a, const HeightSpan& b) { return a.bottom < b.bottom; });
  double best = spans.front().bottom, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < spans.size();) {
    HeightSpan whole = spans[k];
    for (++k; k < spans.size() && spans[k].bottom <= whole.top + kTouching; ++k) whole.top = std::max(whole.top, spans[k].top);
    const double away = std::max({0.0, whole.bottom - point.z, point.z - whole.top});
    if (away >= nearest) continue;
    nearest = away;
    best = whole.bottom;
  }
  return best;
}

std::vector<Stance> stances_of(const Domain& domain, std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                               std::span<const Standing> rules) {
  StanceFinder finder;
  finder.update(domain, sites, cells, rules, {});
  return finder.stances();
}

}  // namespace bl::geometry
