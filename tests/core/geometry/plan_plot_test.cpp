// A plot eroded by distances: what is farther from the sides than the plot is wide is nothing, and costs nothing.
#include "core/geometry/inside/plan_plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <string>

#include "core/base/random.h"
#include "core/geometry/inside/footprint_workshop.h"
#include "core/geometry/plan_ring.h"
#include "core/geometry/plates.h"
#include "tests/core/geometry/standing_zoo.h"

namespace bl::geometry {
namespace {

double area_of_pieces(const PlanPlot::Pieces& pieces) {
  double area = 0;
  for (const PlanPlot::Piece& piece : pieces) {
    Ring ring;
    for (const PlanPolygon::Corner& corner : piece.polygon.corners) ring.push_back({corner.at.x, corner.at.y, 0});
    area += signed_area(ring);
  }
  return area;
}

// 48 sides, one of them along a street.
Domain round_plot(double radius) {
  std::vector<Point3> ring;
  for (int k = 0; k < 48; ++k) ring.push_back({radius * std::cos(k * 0.1309), radius * std::sin(k * 0.1309), 0});
  return test::plot_of(ring);
}

// The depth of a footprint is 1000 m where nobody asks for a courtyard.
TEST(PlanPlot, WhatIsFartherInThanThePlotIsWideIsNotMade) {
  const std::vector<StreetAxis> streets{{{{40, -10, 0}, {40, 10, 0}}, 5}};
  PlanPlot plot = PlanPlot::section(round_plot(40), streets).value();
  EXPECT_TRUE(plot.eroded({1000, 1003}).empty());
  EXPECT_TRUE(plot.eroded({41, 45}).empty());
  EXPECT_TRUE(plot.eroded({2, 120}).empty()) << "no point is so far from the street";
  EXPECT_EQ(plot.kept(), 0u);
  ASSERT_NE(plot.made({1000, 1003}), nullptr);
  EXPECT_TRUE(plot.made({1000, 1003})->empty());
  EXPECT_FALSE(plot.eroded({3, 5}).empty());
  EXPECT_EQ(plot.kept(), 1u);
}

// Against places of which all sides are farther away.
TEST(PlanPlotLaws, NothingIsLeftOnlyWhereNoPlaceIsSoFarIn) {
  for (const test::PlotShape shape : test::kPlotShapes) {
    const Domain domain = test::plot_of(shape);
    PlanPlot plot = PlanPlot::section(domain).value();
    std::vector<Ring> rings;
    for (const PlanPlot::Piece& piece : plot.eroded({})) {
      Ring& ring = rings.emplace_back();
      for (const PlanPolygon::Corner& corner : piece.polygon.corners) ring.push_back({corner.at.x, corner.at.y, 0});
    }
    // The widest disc about a place of a fine grid, by all outer sides.
    double deepest = 0;
    for (double x = 0.5; x < 80; x += 0.5)
      for (double y = 0.5; y < 80; y += 0.5) {
        double away = 1e9;
        bool is_inside = false;
        for (std::size_t r = 0; r < rings.size(); ++r) {
          is_inside |= ring_contains(rings[r], {x, y, 0});
          for (std::size_t k = 0; k < rings[r].size(); ++k) {
            if (plot.eroded({})[r].polygon.corners[k].beyond == PlanSide::kInner) continue;
            const std::vector<Point3> side{rings[r][k], rings[r][(k + 1) % rings[r].size()]};
            away = std::min(away, distance(nearest_on_ring(side, {x, y, 0}), {x, y, 0}));
          }
        }
        if (is_inside) deepest = std::max(deepest, away);
      }
    EXPECT_GT(area_of_pieces(plot.eroded({deepest - 0.01, deepest - 0.01})), 0) << static_cast<int>(shape);
    EXPECT_EQ(area_of_pieces(plot.eroded({deepest + 1, deepest + 1})), 0) << static_cast<int>(shape);
    double last = area_of_pieces(plot.eroded({}));
    for (double by = 1; by < 60; by += 1) {
      const double area = area_of_pieces(plot.eroded({by, by}));
      EXPECT_LE(area, last);
      last = area;
    }
  }
}

// A distance that is dragged is another one in each frame.
TEST(PlanPlot, DistancesThatNobodyHasAnyMoreAreForgotten) {
  FootprintDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(test::plot_of(test::PlotShape::with_hole)));
  std::vector<StandingSite> sites = test::random_standing(5, 3);
  for (StandingSite& site : sites) site.form = FootprintForm::cell, site.runs = {{2, 0}, {2, 1.5}};
  for (int frame = 0; frame < 60; ++frame) {
    sites[0].depth = 4 + 0.01 * frame;
    ASSERT_TRUE(diagram.update(sites));
    EXPECT_LE(diagram.workshop().plot.kept(), FootprintDiagram::Workshop::kMostUnused + 4);
  }
  FootprintDiagram fresh;
  ASSERT_TRUE(fresh.set_domain(test::plot_of(test::PlotShape::with_hole)));
  ASSERT_TRUE(fresh.update(sites));
  for (std::size_t i = 0; i < sites.size(); ++i) {
    EXPECT_EQ(diagram.footprints()[i].plates, fresh.footprints()[i].plates);
    EXPECT_TRUE(body_of(diagram, static_cast<std::uint32_t>(i)) == body_of(fresh, static_cast<std::uint32_t>(i)));
  }
}

// A hole of many corners: each corner is looked up, and not sought among all others for each pair of sides.
TEST(PlanPlot, AHoleOfManyCornersIsErodedQuickly) {
  std::vector<Point3> hole;
  for (int k = 0; k < 1500; ++k) {
    const double angle = -2 * std::numbers::pi * k / 1500, radius = 100 + 5 * (k % 2);
    hole.push_back({200 + radius * std::cos(angle), 200 + radius * std::sin(angle), 0});
  }
  const Domain domain = test::plot_of({{0, 0, 0}, {400, 0, 0}, {400, 400, 0}, {0, 400, 0}}, {hole});
  PlanPlot plot = PlanPlot::section(domain).value();
  const std::clock_t start = std::clock();
  const double area = area_of_pieces(plot.eroded({3, 3}));
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  // The tips of the hole lie at 105 m, less than a metre apart.
  EXPECT_NEAR(area, 394.0 * 394 - std::numbers::pi * 108 * 108, 40);
  EXPECT_LT(seconds, 5) << "it took a minute where corners were sought";
  RecordProperty("seconds", std::to_string(seconds));
}

// One volume that is lost far away does not bring all others into one square.
TEST(PlanGrid, OneFarAwayCostsTheOthersNothing) {
  Random random(3);
  std::vector<StandingSite> sites(6000);
  for (StandingSite& site : sites) {
    site.site = {{random.uniform(0, 2000), random.uniform(0, 2000), 0}, random.uniform(30, 90)};
    site.runs = {{3, 0}};
  }
  const Domain plot = test::plot_of({{0, 0, 0}, {2000, 0, 0}, {2000, 2000, 0}, {0, 2000, 0}});
  const auto seconds = [&] {
    double least = 1e9;
    for (int run = 0; run < 3; ++run) {
      FootprintDiagram diagram;
      EXPECT_TRUE(diagram.set_domain(plot));
      const std::clock_t start = std::clock();
      EXPECT_TRUE(diagram.update(sites));
      least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return least;
  };
  const double near = seconds();
  sites[17].site.position = {90000, 40000, 0};
  const double far = seconds();
  EXPECT_LT(far, 4 * near) << "it was thirty times as much";
  // Whoever it is asked for, the sites around a place are among those that it finds.
  PlanGrid grid;
  grid.fill(sites);
  for (int k = 0; k < 50; ++k) {
    const Point3 at{random.uniform(-500, 2500), random.uniform(-500, 2500), 0};
    const double distance_there = k == 0 ? 1e5 : random.uniform(1, 200);
    std::vector<std::uint8_t> is_found(sites.size(), 0);
    grid.around(at, distance_there, [&](std::uint32_t i) { is_found[i] = 1; });
    for (std::uint32_t i = 0; i < sites.size(); ++i)
      if (distance(sites[i].site.position, at) <= distance_there) { ASSERT_EQ(is_found[i], 1) << k << ", " << i; }
  }
}

}  // namespace
}  // namespace bl::geometry
