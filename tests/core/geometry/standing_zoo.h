// Plots and random sets of standing volumes for tests.
#pragma once

#include <numbers>
#include <vector>

#include "core/base/random.h"
#include "core/geometry/domain_makers.h"
#include "core/geometry/footprint.h"

namespace bl::test {

/// Area of a disc of radius 1, and half of its circle.
inline constexpr double kUnitDisc = std::numbers::pi;

inline geometry::Domain plot_of(const std::vector<Point3>& plan, const std::vector<std::vector<Point3>>& holes = {}) {
  return geometry::extrude_plan(plan, holes, 0, 60).value();
}

enum class PlotShape { square, hexagon, l_shape, u_shape, with_hole };
inline constexpr PlotShape kPlotShapes[] = {PlotShape::square, PlotShape::hexagon, PlotShape::l_shape, PlotShape::u_shape,
                                            PlotShape::with_hole};

/// Each about 80 m wide.
inline geometry::Domain plot_of(PlotShape shape) {
  switch (shape) {
    case PlotShape::square: return plot_of({{0, 0, 0}, {80, 0, 0}, {80, 80, 0}, {0, 80, 0}});
    case PlotShape::hexagon: return plot_of({{20, 0, 0}, {64, 3, 0}, {80, 41, 0}, {55, 80, 0}, {13, 76, 0}, {0, 30, 0}});
    case PlotShape::l_shape: return plot_of({{0, 0, 0}, {80, 0, 0}, {80, 34, 0}, {37, 34, 0}, {37, 80, 0}, {0, 80, 0}});
    case PlotShape::u_shape:
      return plot_of({{0, 0, 0}, {80, 0, 0}, {80, 70, 0}, {52, 80, 0}, {50, 35, 0}, {29, 31, 0}, {29, 80, 0}, {0, 80, 0}});
    case PlotShape::with_hole: break;
  }
  return plot_of({{0, 0, 0}, {80, 0, 0}, {80, 80, 0}, {0, 80, 0}}, {{{30, 25, 0}, {30, 55, 0}, {55, 60, 0}, {50, 30, 0}}});
}

/// All forms, set-backs, depths and party walls among each other, on the plots above; some sites have no room.
inline std::vector<geometry::StandingSite> random_standing(std::size_t count, std::uint64_t seed) {
  constexpr double kSetbacks[] = {0, 0, 1, 1.5, 3}, kDepths[] = {4, 7, geometry::StandingSite::kAnyDepth};
  Random random(seed);
  std::vector<geometry::StandingSite> sites(count);
  for (geometry::StandingSite& s : sites) {
    s.site.position.x = random.uniform(0, 80);
    s.site.position.y = random.uniform(0, 80);
    s.site.weight = random.uniform(0.2, 1.8) * 80 * 80 / (3.14 * static_cast<double>(count));
    s.form = static_cast<geometry::FootprintForm>(random.below(3));
    s.angle = random.uniform(-3, 3);
    s.aspect = random.uniform(0.4, 2.5);
    for (std::uint64_t runs = 1 + random.below(3); runs > 0; --runs)
      s.runs.push_back({1 + static_cast<int>(random.below(4)), kSetbacks[random.below(5)]});
    s.storey_height = random.uniform(2.5, 4);
    s.depth = kDepths[random.below(3)];
    s.has_party_walls = random.below(4) == 0;
  }
  return sites;
}

}  // namespace bl::test
