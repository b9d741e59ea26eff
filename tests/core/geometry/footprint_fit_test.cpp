// Fits of footprints: whole cells beside discs and blocks on one plot, by hand and over random sets.
#include "core/geometry/footprint_fit.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "tests/core/geometry/standing_zoo.h"

namespace bl::test {
namespace {

using geometry::FloorDemand;
using geometry::FootprintDiagram;
using geometry::FootprintFit;
using geometry::FootprintFitOptions;
using geometry::FootprintForm;
using geometry::StandingSite;

StandingSite site_of(FootprintForm form, double x, double y, int storeys = 1) {
  StandingSite site;
  site.site = {{x, y, 0}, 0};
  site.form = form;
  site.runs = {{storeys, 0}};
  return site;
}

struct Fitted {
  FootprintFit report;
  std::vector<StandingSite> sites;
  std::vector<double> floors;
};

Fitted fitted(const geometry::Domain& plot, std::vector<StandingSite> sites, const std::vector<FloorDemand>& demands,
              const FootprintFitOptions& options = {}) {
  FootprintDiagram diagram;
  EXPECT_TRUE(diagram.set_domain(plot));
  auto report = geometry::fit_footprints(diagram, sites, demands, options);
  EXPECT_TRUE(report) << report.error().text();
  Fitted found{report ? *report : FootprintFit{}, std::move(sites), {}};
  for (const geometry::FootprintMeasure& m : diagram.footprints()) found.floors.push_back(m.floor_area);
  return found;
}

std::vector<FloorDemand> floor_demands(const std::vector<double>& areas) {
  std::vector<FloorDemand> demands;
  for (std::uint32_t i = 0; i < areas.size(); ++i) demands.push_back({{i}, areas[i], areas[i]});
  return demands;
}

geometry::Domain fit_square(double side = 40) { return plot_of({{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}}); }

// 40 m by 40 m: the block covers 20 m by 20 m about x = 10 m, and the cell all east of x = 30 m. Open ground lies between.
TEST(FootprintFit, ACellBesideABlockHasWhatItAsksFor) {
  const auto found = fitted(fit_square(), {site_of(FootprintForm::block, 10, 20), site_of(FootprintForm::cell, 30, 20)},
                            floor_demands({400, 400}));
  EXPECT_TRUE(found.report.is_met);
  EXPECT_EQ(found.report.infeasible, "");
  EXPECT_NEAR(found.floors[0], 400, 1e-3);
  EXPECT_NEAR(found.floors[1], 400, 1e-3);
  EXPECT_NEAR(found.sites[0].site.weight, 100, 1e-3);
  EXPECT_NEAR(found.sites[1].site.weight, -300, 1e-2) << "the bisector at (400 + 100 + 300) / 40 = 20 m from the block";
}

// The cell takes what lies between them, and the bisector ends where the block begins.
TEST(FootprintFit, ACellTakesAllThatABlockLeaves) {
  const auto found = fitted(fit_square(), {site_of(FootprintForm::block, 10, 20), site_of(FootprintForm::cell, 30, 20)},
                            floor_demands({400, 799}));
  EXPECT_TRUE(found.report.is_met) << found.report.infeasible;
  EXPECT_NEAR(found.floors[0], 400, 1e-3);
  EXPECT_NEAR(found.floors[1], 799, 1e-3);
}

// Weights so large that the form of the block ends nowhere inside its cell: no step says how large it should be.
TEST(FootprintFit, FormsThatFillTheirCellsAreLoosened) {
  std::vector<StandingSite> sites{site_of(FootprintForm::block, 10, 20), site_of(FootprintForm::cell, 30, 20)};
  for (const double weight : {1e3, 1e4, 1e6}) {
    for (const double apart : {0.0, 300.0, -300.0}) {
      sites[0].site.weight = weight;
      sites[1].site.weight = weight + apart;
      const auto found = fitted(fit_square(), sites, floor_demands({400, 400}));
      EXPECT_TRUE(found.report.is_met) << weight << ", " << apart << ": " << found.report.infeasible;
      EXPECT_NEAR(found.sites[1].site.weight, -300, 1e-2);
    }
  }
}

TEST(FootprintFit, WhatDoesNotFitIsSharedInProportionAndNamed) {
  const auto found = fitted(fit_square(), {site_of(FootprintForm::block, 10, 20), site_of(FootprintForm::cell, 30, 20)},
                            floor_demands({1200, 800}));
  EXPECT_FALSE(found.report.is_met);
  EXPECT_NEAR(found.report.factor, 0.8, 0.01);
  EXPECT_NE(found.report.infeasible.find("the demands cannot be met together: 79"), std::string::npos) << found.report.infeasible;
  ASSERT_EQ(found.report.losses.size(), 2u);
  EXPECT_NEAR(found.floors[0] / 1200, found.report.factor, 1e-4);
  EXPECT_NEAR(found.floors[1] / 800, found.report.factor, 1e-4);
}

// 15 m from the border there are 100 m² for the one in the middle, however heavy it is. The others touch it nowhere.
TEST(FootprintFit, WhoCannotGrowTakesNothingFromThoseWhoTouchNobodyInTheWay) {
  std::vector<StandingSite> sites{site_of(FootprintForm::round, 6, 6), site_of(FootprintForm::block, 20, 20),
                                  site_of(FootprintForm::round, 34, 6), site_of(FootprintForm::block, 34, 34)};
  sites[1].border_distance = sites[1].street_distance = 15;
  const std::vector<double> wanted{80, 150, 60, 90};
  const auto found = fitted(fit_square(), sites, floor_demands(wanted));
  EXPECT_FALSE(found.report.is_met);
  EXPECT_LE(found.floors[1], 100 + 1e-6);
  EXPECT_GE(found.floors[1], 97);
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_NEAR(found.floors[i], wanted[i], 1e-3) << i;
  EXPECT_NE(found.report.infeasible.find("1 of the demands cannot be met: 6"), std::string::npos) << found.report.infeasible;
  ASSERT_EQ(found.report.losses.size(), 1u);
  EXPECT_EQ(found.report.losses[0].demand, 1u);
  // The same from these weights: nobody loses it again.
  const auto warm = fitted(fit_square(), found.sites, floor_demands(wanted));
  for (const std::size_t i : {0u, 2u, 3u}) EXPECT_NEAR(warm.floors[i], wanted[i], 1e-3) << i;
}

// A block in the place of a cell has nothing, so that cells are all there is, and these fill the plot.
TEST(FootprintFit, CellsAloneShareThePlotWhoeverStandsInTheirPlace) {
  const std::vector<StandingSite> sites{site_of(FootprintForm::cell, 10, 20), site_of(FootprintForm::block, 10, 20),
                                        site_of(FootprintForm::cell, 30, 20)};
  const auto found = fitted(fit_square(), sites, floor_demands({600, 100, 600}));
  EXPECT_FALSE(found.report.is_met);
  EXPECT_NEAR(found.floors[0], 800, 1e-3);
  EXPECT_NEAR(found.floors[2], 800, 1e-3);
  EXPECT_NE(found.report.infeasible.find("all footprints are whole cells, which share the plot"), std::string::npos)
      << found.report.infeasible;
  EXPECT_NE(found.report.infeasible.find("1 of the demands can have nothing"), std::string::npos) << found.report.infeasible;
}

// One that keeps its weight, or wants nothing and has a form, takes what cells do not ask for.
TEST(FootprintFit, CellsBesideOneThatKeepsItsWeightAreExact) {
  std::vector<StandingSite> sites{site_of(FootprintForm::cell, 10, 10), site_of(FootprintForm::cell, 30, 10),
                                  site_of(FootprintForm::cell, 20, 30)};
  const std::vector<FloorDemand> two{{{0}, 300, 300}, {{1}, 500, 500}};
  const auto found = fitted(fit_square(), sites, two);
  EXPECT_TRUE(found.report.is_met) << found.report.infeasible;
  EXPECT_EQ(found.sites[2].site.weight, 0);
  EXPECT_NEAR(found.floors[2], 800, 2e-3);
  sites[2].form = FootprintForm::round;
  const auto open = fitted(fit_square(), sites, floor_demands({300, 500, 0}));
  EXPECT_TRUE(open.report.is_met) << open.report.infeasible;
  EXPECT_NEAR(open.floors[0], 300, 1e-3);
  EXPECT_NEAR(open.floors[1], 500, 1e-3);
  EXPECT_EQ(open.floors[2], 0);
}

// --- Laws over random mixtures -----------------------------------------------------------------------------------------------

// Where the demands take less ground than there is, whole cells can divide the plot among all so that everybody has enough.
// Weights with which nobody has too little can be lowered until nobody has too much (see the README), so that all is exact.
struct Mixture {
  std::vector<StandingSite> sites;
  std::vector<double> areas;
};

double plot_area_of(const geometry::Domain& plot) {
  FootprintDiagram diagram;
  EXPECT_TRUE(diagram.set_domain(plot));
  return diagram.plot_area();
}

bool is_on(const geometry::Domain& plot, const Point3& at) {
  return std::ranges::any_of(plot.pieces, [&](const geometry::Domain::Piece& piece) {
    return std::ranges::all_of(piece.shape.planes,
                               [&](const geometry::Plane& plane) { return dot(plane.normal, at) <= plane.offset; });
  });
}

// Sites on the plot.
Mixture random_mixture(const geometry::Domain& plot, std::uint64_t seed) {
  constexpr double kCovers[] = {0.1, 0.3, 0.5, 0.7, 0.85};
  constexpr int kKinds[][3] = {{1, 1, 1}, {1, 1, 6}, {3, 0, 1}, {0, 1, 3}};  // how often a disc, a block, a cell
  Random random(seed);
  Mixture made;
  const std::uint64_t count = 2 + random.below(9);
  const auto& kinds = kKinds[random.below(4)];
  std::vector<double> shares;
  double sum = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    auto at = static_cast<int>(random.below(static_cast<std::uint64_t>(kinds[0] + kinds[1] + kinds[2])));
    int form = 0;
    while (at >= kinds[form]) at -= kinds[form++];
    if (i == 0 && form == 2) form = kinds[0] > 0 ? 0 : 1;
    StandingSite site = site_of(static_cast<FootprintForm>(form), 0, 0, 1 + static_cast<int>(random.below(5)));
    do {
      site.site.position.x = random.uniform(1, 79);
      site.site.position.y = random.uniform(1, 79);
    } while (!is_on(plot, site.site.position + Vector3{0, 0, 1}));
    site.angle = random.uniform(-3, 3);
    site.aspect = random.uniform(0.4, 2.5);
    made.sites.push_back(site);
    shares.push_back(random.uniform(1, 6));
    sum += shares.back();
  }
  const double cover = kCovers[random.below(5)];
  for (std::size_t i = 0; i < count; ++i)
    made.areas.push_back(cover * plot_area_of(plot) * shares[i] / sum * made.sites[i].storeys());
  return made;
}

TEST(FootprintFitLaws, WhatFitsIsMetWhateverFormsAreBesideEachOther) {
  std::size_t cells = 0;
  for (const PlotShape shape : kPlotShapes) {
    const geometry::Domain plot = plot_of(shape);
    for (std::uint64_t seed = 1; seed <= 120; ++seed) {
      const Mixture made = random_mixture(plot, 1000 * static_cast<std::uint64_t>(shape) + seed);
      const auto found = fitted(plot, made.sites, floor_demands(made.areas));
      EXPECT_TRUE(found.report.is_met) << static_cast<int>(shape) << ", seed " << seed << ": " << found.report.infeasible;
      EXPECT_TRUE(found.report.losses.empty());
      for (std::size_t i = 0; i < made.sites.size(); ++i) {
        EXPECT_NEAR(found.floors[i], made.areas[i], 2e-6 * made.areas[i]) << "seed " << seed << ", site " << i;
        cells += made.sites[i].form == FootprintForm::cell ? 1 : 0;
      }
    }
  }
  EXPECT_GT(cells, 1000u);
}

// One that asks for more than it can have takes nothing from those whose footprints touch nobody in the way: these have all, and
// everybody has the share that all can have.
TEST(FootprintFitLaws, WhoStandsInNobodysWayHasAllThatItAsksFor) {
  std::size_t shared = 0, raised = 0;
  for (const PlotShape shape : kPlotShapes) {
    const geometry::Domain plot = plot_of(shape);
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      Mixture made = random_mixture(plot, 7000 * static_cast<std::uint64_t>(shape) + seed);
      const std::size_t large = seed % made.areas.size();
      made.areas[large] *= seed % 3 == 0 ? 6 : 2;
      // Most of the ground is too near to the border for it.
      if (seed % 2 == 0) made.sites[large].border_distance = made.sites[large].street_distance = 25;
      const auto found = fitted(plot, made.sites, floor_demands(made.areas));
      if (found.report.is_met || !(found.report.factor < 1) || found.report.infeasible.find(" can") == std::string::npos)
        continue;
      ++shared;
      std::size_t in_full = 0;
      for (std::size_t i = 0; i < made.sites.size(); ++i) {
        EXPECT_GE(found.floors[i], found.report.factor * made.areas[i] * (1 - 1e-5)) << "seed " << seed << ", site " << i;
        EXPECT_LE(found.floors[i], made.areas[i] * (1 + 1e-5)) << "seed " << seed << ", site " << i;
        in_full += found.floors[i] >= made.areas[i] * (1 - 1e-5) ? 1 : 0;
      }
      EXPECT_EQ(found.report.losses.size(), made.sites.size() - in_full);
      const std::string some = std::to_string(found.report.losses.size()) + " of the demands cannot be met: ";
      EXPECT_EQ(found.report.infeasible.find(some) != std::string::npos, in_full > 0) << found.report.infeasible;
      raised += in_full;
    }
  }
  EXPECT_GT(shared, 50u);
  EXPECT_GT(raised, 20u) << "of those that would have had a share only";
}

// From whatever weights: those of a session in which somebody has just changed forms, storeys and demands.
TEST(FootprintFitLaws, WarmEqualsCold) {
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const geometry::Domain plot = plot_of(seed % 2 == 0 ? PlotShape::square : PlotShape::hexagon);
    const Mixture made = random_mixture(plot, seed);
    const FootprintFitOptions exact{.tolerance = 1e-9, .progress = {}};
    const auto cold = fitted(plot, made.sites, floor_demands(made.areas), exact);
    ASSERT_TRUE(cold.report.is_met) << seed;
    Random random(seed);
    for (int way = 0; way < 3; ++way) {
      std::vector<StandingSite> sites = cold.sites;
      for (StandingSite& site : sites) {
        if (way == 0) site.site.weight *= random.uniform(0.7, 1.4);
        if (way == 1) site.site.weight = random.uniform(1, 6000);
        if (way == 2) site.form = static_cast<FootprintForm>(random.below(3));
      }
      if (way == 2) {
        sites = fitted(plot, sites, floor_demands(made.areas)).sites;
        for (std::size_t i = 0; i < sites.size(); ++i) sites[i].form = made.sites[i].form;
      }
      const auto warm = fitted(plot, sites, floor_demands(made.areas), exact);
      EXPECT_TRUE(warm.report.is_met) << "seed " << seed << ", way " << way << ": " << warm.report.infeasible;
      for (std::size_t i = 0; i < sites.size(); ++i)
        EXPECT_NEAR(warm.sites[i].site.weight, cold.sites[i].site.weight, 1e-3) << "seed " << seed << ", way " << way;
    }
  }
}

TEST(FootprintFitLaws, ThreadsChangeNoBit) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const geometry::Domain plot = plot_of(kPlotShapes[seed % 5]);
    const Mixture made = random_mixture(plot, seed);
    const auto one = fitted(plot, made.sites, floor_demands(made.areas));
    for (const int threads : {2, 3}) {
      ThreadPool pool(threads);
      const auto found = fitted(plot, made.sites, floor_demands(made.areas), {.pool = &pool, .progress = {}});
      EXPECT_EQ(found.floors, one.floors) << seed;
      EXPECT_TRUE(found.sites == one.sites) << seed;
    }
  }
}

// More than there is: everybody has the same share of what it asks for, and each loss is told.
TEST(FootprintFitLaws, WhatDoesNotFitIsSharedInProportion) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const geometry::Domain plot = plot_of(seed % 2 == 0 ? PlotShape::square : PlotShape::hexagon);
    Mixture made = random_mixture(plot, seed);
    double needed = 0;
    for (std::size_t i = 0; i < made.sites.size(); ++i) needed += made.areas[i] / made.sites[i].storeys();
    for (double& area : made.areas) area *= 1.3 * plot_area_of(plot) / needed;
    const auto found = fitted(plot, made.sites, floor_demands(made.areas));
    EXPECT_FALSE(found.report.is_met);
    EXPECT_GT(found.report.factor, 0.6) << "seed " << seed << ": at least nine tenths of the plot are found to be enough";
    EXPECT_EQ(found.report.losses.size(), made.sites.size()) << seed;
    for (std::size_t i = 0; i < made.sites.size(); ++i)
      EXPECT_NEAR(found.floors[i] / made.areas[i], found.report.factor, 1e-5) << "seed " << seed << ", site " << i;
  }
}

}  // namespace
}  // namespace bl::test
