// The sampled diagram: cells to check by hand, the exact cells as its limit, and laws of every metric.
#include "core/geometry/inside/sampled_diagram.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/domain_makers.h"
#include "core/geometry/inside/line_blocks.h"
#include "core/geometry/inside/line_envelope.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kMetrics{geometry::Metric::power, geometry::Metric::additive, geometry::Metric::multiplicative};

geometry::SampledCells sampled(const geometry::Domain& domain, std::span<const geometry::PowerSite> sites,
                               geometry::Metric metric, int samples, bool with_storeys = false) {
  auto cells = sampled_cells(domain, sites, {.metric = metric, .samples = samples, .with_storeys = with_storeys});
  EXPECT_TRUE(cells.ok()) << (cells.ok() ? "" : cells.error().text());
  return cells.ok() ? *cells : geometry::SampledCells{};
}

std::string sentence_of(const geometry::Domain& domain, std::span<const geometry::PowerSite> sites,
                        const geometry::SampleOptions& options) {
  const auto cells = sampled_cells(domain, sites, options);
  return cells.ok() ? "no error" : cells.error().message;
}

geometry::Domain ell() {
  const std::vector<Point3> plan{{0, 0, 0}, {30, 0, 0}, {30, 10, 0}, {12, 10, 0}, {12, 25, 0}, {0, 25, 0}};
  return geometry::extrude_plan(plan, {}, 0, 15).value();
}

// Sites in the unit cube whose balls fill about two thirds of it.
std::vector<geometry::PowerSite> crowd(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<geometry::PowerSite> sites;
  const double radius = 0.7 * std::cbrt(1.0 / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 p = random_point(random, {0, 0, 0}, {1, 1, 1});
    const double r = radius * random.uniform(0.7, 1.3);
    sites.push_back({p, r * r});
  }
  return sites;
}

double closeness_of(geometry::Metric metric, const geometry::PowerSite& site, const Point3& x) {
  const double squared = squared_norm(x - site.position), radius = std::sqrt(site.weight);
  return metric == geometry::Metric::power      ? squared - site.weight
         : metric == geometry::Metric::additive ? std::sqrt(squared) - radius
                                                : std::sqrt(squared) / radius;
}

TEST(SampledDiagram, ApolloniusBall) {
  // |x - p|/1 <= |x - q|/2 with |p - q| = 4 is a ball of radius k d / (1 - k²), k = 1/2, about (p - k² q) / (1 - k²).
  const std::vector<geometry::PowerSite> sites{{{0, 0, 0}, 1}, {{4, 0, 0}, 4}};
  const geometry::SampledCells cells = sampled(box({-8, -8, -8}, {8, 8, 8}), sites, geometry::Metric::multiplicative, 128);
  const double radius = 0.5 * 4 / 0.75;
  EXPECT_NEAR(cells.cells[0].cell_volume, 4 * kPi / 3 * radius * radius * radius, 0.002 * cells.cells[0].cell_volume);
  // Of the site's own ball, of radius 1, nothing is cut off.
  EXPECT_NEAR(cells.cells[0].volume, 4 * kPi / 3, cells.errors[0]);
  EXPECT_NEAR(cells.cells[0].spherical_area, 4 * kPi, 0.01 * 4 * kPi);
  EXPECT_NEAR(distance(cells.cells[0].centroid, {0, 0, 0}), 0, 0.005);
  EXPECT_NEAR(cells.cells[0].cell_volume + cells.cells[1].cell_volume, 4096, 0.01);
}

TEST(SampledDiagram, HyperboloidOfTheAdditiveMetric) {
  // Foci at ±2, difference of the radii 2: the sheet x²/1 - ρ²/3 = 1 around the lighter site, up to the wall at x = 3, where
  // ρ² = 24 still fits into the box. Volume: π · 3 · ((27 - 1)/3 - 2) = 20 π.
  const std::vector<geometry::PowerSite> sites{{{-2, 0, 0}, 9}, {{2, 0, 0}, 1}};
  const geometry::SampledCells cells = sampled(box({-5, -5, -5}, {3, 5, 5}), sites, geometry::Metric::additive, 160);
  EXPECT_NEAR(cells.cells[1].cell_volume, 20 * kPi, 0.002 * 20 * kPi);
  // The two balls, of radii 3 and 1 and 4 apart, touch in the vertex of the hyperboloid: neither loses anything to the other.
  EXPECT_NEAR(cells.cells[1].volume, 4 * kPi / 3, cells.errors[1]);
}

TEST(SampledDiagram, EqualRadiiAreAnOrdinaryVoronoiDiagramUnderEveryMetric) {
  const std::vector<geometry::PowerSite> sites = random_sites(20, 5, 0.09, 0.09);
  const geometry::SampledCells power = sampled(unit_cube(), sites, geometry::Metric::power, 32);
  for (const geometry::Metric metric : {geometry::Metric::additive, geometry::Metric::multiplicative}) {
    const geometry::SampledCells other = sampled(unit_cube(), sites, metric, 32);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(other.cells[i].volume, power.cells[i].volume, 1e-12) << name_of(metric) << " " << i;
      EXPECT_NEAR(other.cells[i].surface_area, power.cells[i].surface_area, 1e-9) << name_of(metric) << " " << i;
      EXPECT_EQ(other.cells[i].facets.size(), power.cells[i].facets.size());
    }
  }
}

TEST(SampledDiagram, ConvergesToTheExactCellsWithTheSquareOfTheStep) {
  const std::vector<geometry::PowerSite> sites = crowd(30, 3);
  geometry::CellOptions storeys;
  storeys.storey_height = 0.05;
  const auto exact = power_cells(unit_cube(), sites, storeys).value();
  double last = 0;
  for (const int samples : {16, 32, 64, 128}) {
    const auto cells =
        sampled_cells(unit_cube(), sites, {.metric = geometry::Metric::power, .samples = samples, .storey_height = 0.05}).value();
    double squares = 0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      const geometry::CellMeasure& cell = cells.cells[i];
      squares += (cell.volume - exact[i].volume) * (cell.volume - exact[i].volume);
      if (samples < 128 || !(exact[i].volume > 0.005)) continue;
      EXPECT_NEAR(cell.volume, exact[i].volume, 0.005 * exact[i].volume) << i;
      EXPECT_NEAR(cell.cell_volume, exact[i].cell_volume, 0.005 * exact[i].cell_volume) << i;
      EXPECT_NEAR(cell.surface_area, exact[i].surface_area, 0.01 * exact[i].surface_area) << i;
      EXPECT_NEAR(cell.spherical_area, exact[i].spherical_area, 0.01 * exact[i].surface_area) << i;
      EXPECT_NEAR(cell.floor_area, exact[i].floor_area, 0.05 * exact[i].floor_area) << i;
      EXPECT_NEAR(cell.footprint, exact[i].footprint, 0.02 * exact[i].footprint) << i;
      EXPECT_NEAR(cell.height, exact[i].height, 3 * cells.step) << i;
      EXPECT_NEAR(cell.bottom, exact[i].bottom, 3 * cells.step) << i;
      EXPECT_NEAR(distance(cell.centroid, exact[i].centroid), 0, 0.2 * cells.step) << i;
      EXPECT_NEAR(cell.volume_by_own_weight, exact[i].volume_by_own_weight, 0.03 * exact[i].volume_by_own_weight) << i;
    }
    if (last > 0) { EXPECT_LT(std::sqrt(squares), 0.4 * last) << samples; }
    last = std::sqrt(squares);
  }
}

TEST(SampledDiagram, DeclaredErrorsHold) {
  std::size_t inside = 0, count = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    for (const std::size_t many : {10u, 60u}) {
      const std::vector<geometry::PowerSite> sites = crowd(many, seed);
      const auto exact = power_cells(unit_cube(), sites).value();
      for (const int samples : {12, 24, 48}) {
        const geometry::SampledCells cells = sampled(unit_cube(), sites, geometry::Metric::power, samples);
        for (std::size_t i = 0; i < many; ++i) {
          ++count;
          inside += std::abs(cells.cells[i].volume - exact[i].volume) <= 0.25 * cells.errors[i] ? 1 : 0;
          EXPECT_LE(std::abs(cells.cells[i].volume - exact[i].volume), cells.errors[i]) << samples << " " << i;
        }
      }
    }
  }
  // Nor are they far too careful.
  EXPECT_LT(inside, 0.97 * static_cast<double>(count));
}

TEST(SampledDiagram, DeclaredErrorsHoldUnderTheOtherMetrics) {
  for (const geometry::Metric metric : {geometry::Metric::additive, geometry::Metric::multiplicative}) {
    const std::vector<geometry::PowerSite> sites = crowd(25, 9);
    const geometry::SampledCells coarse = sampled(unit_cube(), sites, metric, 24),
                                 fine = sampled(unit_cube(), sites, metric, 192);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      EXPECT_NEAR(coarse.cells[i].volume, fine.cells[i].volume, coarse.errors[i] + fine.errors[i]) << name_of(metric) << i;
    }
  }
}

TEST(SampledDiagram, UnshrunkCellsTileTheSampledDomain) {
  Random random(4);
  std::vector<geometry::PowerSite> sites;
  for (int i = 0; i < 40; ++i) {
    const Point3 p = random_point(random, {0, 0, 0}, {30, 25, 15});
    sites.push_back({p, random.uniform(1, 60)});
  }
  for (const geometry::Domain& domain : {ell(), geometry::Domain(box({0, 0, 0}, {30, 25, 15}))}) {
    for (const geometry::Metric metric : kMetrics) {
      const geometry::SampledCells cells = sampled(domain, sites, metric, 40);
      double sum = 0;
      for (const geometry::CellMeasure& cell : cells.cells) {
        sum += cell.cell_volume;
        EXPECT_LE(cell.volume, cell.cell_volume * (1 + 1e-12));
      }
      EXPECT_NEAR(sum, cells.domain_volume, 1e-10 * sum) << name_of(metric);
      EXPECT_NEAR(sum, domain.volume, 1e-3 * sum) << name_of(metric);
    }
  }
}

TEST(SampledDiagram, DomainsOfManyPiecesAreWhole) {
  // One ball that holds the whole ell: its surface is the ell's, and faces between pieces do not count.
  const std::vector<geometry::PowerSite> sites{{{5, 5, 5}, 1e4}};
  const geometry::SampledCells cells = sampled(ell(), sites, geometry::Metric::multiplicative, 60, true);
  const double plan = 300 + 180, walls = (30 + 25) * 2 * 15;
  EXPECT_NEAR(cells.cells[0].volume, plan * 15, 1e-3 * plan * 15);
  EXPECT_NEAR(cells.cells[0].surface_area, 2 * plan + walls, 5e-3 * (2 * plan + walls));
  EXPECT_NEAR(cells.cells[0].footprint, plan, 5e-3 * plan);
  EXPECT_NEAR(cells.cells[0].floor_area, 5 * plan, 5e-3 * 5 * plan);
  EXPECT_DOUBLE_EQ(cells.cells[0].height, 15);
  EXPECT_DOUBLE_EQ(cells.cells[0].bottom, 0);
  ASSERT_EQ(cells.cells[0].facets.size(), 8u);
  EXPECT_NEAR(cells.cells[0].facets[0].area, plan, 1e-2 * plan);
}

TEST(SampledDiagram, NoOwnerIsLostHoweverHeavyAndFar) {
  for (const geometry::Metric metric : kMetrics) {
    std::vector<geometry::PowerSite> sites = crowd(80, 6);
    sites.push_back({{40, 3, -2}, 1610});  // beats small ones from afar, most of all where radii divide
    sites.push_back({{-3, 0.5, 0.5}, 9});
    geometry::Domain domain = unit_cube();
    const geometry::SampleFrame frame = tilted_frame(domain, 1.0 / 24);
    std::vector<geometry::FrameSite> framed;
    std::vector<std::uint32_t> all;
    for (const geometry::PowerSite& site : sites) {
      const Vector3 f = frame.to_frame(site.position);
      framed.push_back({{f.x, f.y, f.z}, site.weight, std::sqrt(site.weight)});
      all.push_back(static_cast<std::uint32_t>(all.size()));
    }
    Random random(8);
    std::size_t looked = 0;
    const auto look = [&](const geometry::LineBlock& block, std::span<const std::uint32_t> candidates) {
      for (int k = 0; k < 4; ++k) {
        Vector3 f;
        f.x = frame.low[0] + frame.step * random.uniform(block.low[0], block.high[0]);
        f.y = frame.low[1] + frame.step * random.uniform(block.low[1], block.high[1]);
        f.z = frame.low[2] + frame.step * random.uniform(block.low[2], block.high[2]);
        const Point3 x = frame.to_world(f);
        std::uint32_t best = 0;
        for (const std::uint32_t i : all) {
          if (closeness_of(metric, sites[i], x) < closeness_of(metric, sites[best], x)) best = i;
        }
        ++looked;
        EXPECT_TRUE(std::find(candidates.begin(), candidates.end(), best) != candidates.end()) << name_of(metric);
      }
    };
    const geometry::LineBlock whole{{0, 0, 0}, frame.count};
    if (metric == geometry::Metric::power)
      geometry::BlockDescent<geometry::Metric::power>(frame, framed, {true, true, true}, 4).go_down(whole, all, look);
    if (metric == geometry::Metric::additive)
      geometry::BlockDescent<geometry::Metric::additive>(frame, framed, {true, true, true}, 4).go_down(whole, all, look);
    if (metric == geometry::Metric::multiplicative)
      geometry::BlockDescent<geometry::Metric::multiplicative>(frame, framed, {true, true, true}, 4).go_down(whole, all, look);
    EXPECT_GT(looked, 400u);
  }
}

template <geometry::Metric M>
void expect_right_owners() {
  Random random(17);
  for (int round = 0; round < 2000; ++round) {
    std::vector<geometry::SiteOnLine> sites;
    const std::size_t count = 1 + random.below(7);
    for (std::size_t k = 0; k < count; ++k) {
      // Some share a foot, a distance or a radius: the special cases of the formulas.
      const double along = random.below(3) == 0 ? 0.5 : random.uniform(-1, 2);
      const double aside = random.below(4) == 0 ? (random.below(2) == 0 ? 0.04 : 0.0) : random.uniform(0, 1);
      const double radius = random.below(3) == 0 ? 0.5 : random.uniform(0.05, 1.5);
      sites.push_back({along, aside, radius * radius, radius});
    }
    double reached = 0;
    walk_line<M>(sites, 0, 1, 1e-12, [&](std::size_t c, double from, double to, std::size_t) {
      EXPECT_EQ(from, reached);
      reached = to;
      for (int k = 0; k < 3 && to - from > 1e-9; ++k) {
        const double t = random.uniform(from, to);
        for (const geometry::SiteOnLine& other : sites) {
          EXPECT_LE(closeness_at<M>(sites[c], t), closeness_at<M>(other, t) + 1e-7) << round << " at " << t;
        }
      }
    });
    EXPECT_EQ(reached, 1);
  }
}

TEST(SampledDiagram, LinesAreCutWhereOwnersChange) {
  expect_right_owners<geometry::Metric::power>();
  expect_right_owners<geometry::Metric::additive>();
  expect_right_owners<geometry::Metric::multiplicative>();
}

TEST(SampledDiagram, ResponsesAreThoseOfTheVolumes) {
  // Against differences of the volumes, in the potentials in which the response is symmetric.
  for (const geometry::Metric metric : kMetrics) {
    std::vector<geometry::PowerSite> sites = crowd(12, 2);
    const geometry::SampledCells before = sampled(unit_cube(), sites, metric, 128);
    const std::size_t moved = 4;
    const double radius = std::sqrt(sites[moved].weight), change = 1e-3 * radius;
    sites[moved].weight = (radius + change) * (radius + change);
    const geometry::SampledCells after = sampled(unit_cube(), sites, metric, 128);
    const double potential = change / radius_by_potential(metric, radius);
    double own = before.free_responses[moved];
    for (const geometry::SampledBond& bond : before.bonds) {
      if (bond.a != moved && bond.b != moved) continue;
      own += bond.response;
      const std::size_t other = bond.a == moved ? bond.b : bond.a;
      EXPECT_NEAR((after.cells[other].volume - before.cells[other].volume) / potential, -bond.response, 0.05 * own + 1e-6)
          << name_of(metric) << " " << other;
    }
    EXPECT_NEAR((after.cells[moved].volume - before.cells[moved].volume) / potential, own, 0.05 * own) << name_of(metric);
    const double by_weight = (after.cells[moved].volume - before.cells[moved].volume) / (2 * radius * change);
    EXPECT_NEAR(before.cells[moved].volume_by_own_weight, by_weight, 0.05 * by_weight) << name_of(metric);
  }
}

TEST(SampledDiagram, ThreadsLeaveNoTrace) {
  const std::vector<geometry::PowerSite> sites = crowd(150, 12);
  for (const geometry::Metric metric : kMetrics) {
    geometry::SampleOptions options{.metric = metric, .samples = 40};
    const auto one = sampled_cells(unit_cube(), sites, options).value();
    for (const int threads : {2, 3}) {
      ThreadPool pool(threads);
      options.pool = &pool;
      const auto many = sampled_cells(unit_cube(), sites, options).value();
      for (std::size_t i = 0; i < sites.size(); ++i) {
        const geometry::CellMeasure &a = one.cells[i], &b = many.cells[i];
        EXPECT_TRUE(a.volume == b.volume && a.surface_area == b.surface_area && a.centroid == b.centroid &&
                    a.floor_area == b.floor_area && a.facets == b.facets && one.errors[i] == many.errors[i] &&
                    a.height == b.height && a.footprint == b.footprint)
            << name_of(metric) << " " << i;
      }
    }
  }
}

TEST(SampledDiagram, EveryStateSaysWhy) {
  std::vector<geometry::PowerSite> sites = sites_in_every_state();
  sites.push_back({{2, 8, 8}, 0.000001});
  const geometry::SampledCells cells = sampled(box({0, 0, 0}, {10, 10, 10}), sites, geometry::Metric::additive, 40);
  const auto expect = [&](std::size_t i, geometry::SiteState state, const char* reason) {
    EXPECT_EQ(cells.cells[i].state, state) << i << " " << name_of(cells.cells[i].state);
    EXPECT_EQ(cells.cells[i].reason, reason) << i;
  };
  expect(0, geometry::SiteState::alive, "");
  expect(1, geometry::SiteState::coincident, "lies at the position of site 0, which is heavier or comes first");
  expect(2, geometry::SiteState::hidden, "swallowed: site 0 outweighs it at its position");
  expect(3, geometry::SiteState::outside, "lies outside the domain; its cell lies outside the domain");
  expect(4, geometry::SiteState::outside, "lies outside the domain; its cell reaches in");
  expect(5, geometry::SiteState::starved, "its weight is not positive, so it has no ball");
  expect(6, geometry::SiteState::starved, "its shape slips between the sample lines, which are 0.250 m apart: take more samples");
  // Divided by no radius every distance is infinite, so there is no cell either.
  const geometry::SampledCells divided = sampled(box({0, 0, 0}, {10, 10, 10}), sites, geometry::Metric::multiplicative, 40);
  EXPECT_EQ(divided.cells[5].state, geometry::SiteState::hidden);
  EXPECT_EQ(divided.cells[5].reason, "its weight is not positive, so it has no ball");
}

TEST(SampledDiagram, BadInputGetsASentence) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<geometry::PowerSite> good{{{0.5, 0.5, 0.5}, 1}}, negative{{{0.5, 0.5, 0.5}, -1}},
      broken{{{0.5, nan, 0.5}, 1}};
  EXPECT_EQ(sentence_of(unit_cube(), broken, {}), "site 0 has a position or weight that is not a number");
  EXPECT_EQ(sentence_of(unit_cube(), negative, {.metric = geometry::Metric::additive}),
            "the weight of site 0 is negative: under the additive metric a weight is the square of a radius");
  EXPECT_EQ(sentence_of(unit_cube(), negative, {.metric = geometry::Metric::power}), "no error");
  EXPECT_EQ(sentence_of(unit_cube(), good, {.samples = 0}), "sampling takes at least one sample along the longest side");
  EXPECT_EQ(sentence_of(unit_cube(), good, {.samples = 5000}),
            "5000 samples along the longest side do not fit into memory: 1024 are the most");
  EXPECT_EQ(sentence_of(unit_cube(), good, {.storey_height = 0}),
            "a storey height has to be positive, and the boundary no higher than 10000 storeys");
  EXPECT_EQ(sentence_of(geometry::Domain{}, good, {}),
            "the domain is empty: make it with convex_hull, from_planes, extrude or from_mesh");
  EXPECT_EQ(geometry::SampledDiagram().measure(good, {}).error().message, "the sampled diagram has no domain yet");
  EXPECT_EQ(sentence_of(unit_cube(), {}, {}), "no error");
  EXPECT_EQ(sentence_of(unit_cube(), good, {.samples = 1}), "no error");
}

}  // namespace
}  // namespace bl::test
