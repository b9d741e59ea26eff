// The diagram after any history of changes is the diagram made anew, bit for bit.
#include <cmath>

#include "tests/core/geometry/site_zoo.h"

namespace bl::test {
namespace {

bool same_measure_bits(const geometry::CellMeasure& a, const geometry::CellMeasure& b) {
  return a.state == b.state && a.volume == b.volume && a.cell_volume == b.cell_volume && a.surface_area == b.surface_area &&
         a.spherical_area == b.spherical_area && a.centroid == b.centroid && a.facets == b.facets &&
         a.volume_by_own_weight == b.volume_by_own_weight;
}

// One of the ways in which a link, a person or a fit changes sites.
void change(std::vector<geometry::PowerSite>& sites, const std::vector<geometry::PowerSite>& before, Random& random) {
  const std::size_t i = random.below(sites.size()), j = random.below(sites.size());
  switch (random.below(9)) {
    case 0: sites[i].position += 0.01 * random_point(random, {-1, -1, -1}, {1, 1, 1}); break;
    case 1: sites[i].position = random_point(random, {0, 0, 0}, {1, 1, 1}); break;
    case 2: sites[i].position = random_point(random, {-0.5, -0.5, -0.5}, {1.5, 1.5, 1.5}); break;
    case 3: sites[i].weight *= random.uniform(0.5, 1.5); break;
    case 4: sites[i].weight = sites[j].weight * random.uniform(1, 20); break;
    case 5: sites[i].weight = random.below(2) ? 0 : -std::abs(sites[i].weight); break;
    case 6: {
      for (std::size_t k = 0; k < 1 + sites.size() / 8; ++k) sites[random.below(sites.size())].weight *= random.uniform(0.9, 1.1);
      break;
    }
    case 7: sites[i].position = sites[j].position + Vector3{random.uniform(-0.02, 0.02), 0.01, 0}; break;
    default: sites[i] = before[i]; break;
  }
}

void expect_history_leaves_no_trace(const SiteSet& set, bool with_shape, std::uint64_t seed, int changes) {
  geometry::CellOptions options;
  options.with_shape = options.with_centroid = with_shape;
  geometry::PowerDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(set.domain).ok());
  ASSERT_TRUE(diagram.update(set.sites, options).ok());
  std::vector<geometry::PowerSite> sites = set.sites;
  Random random(seed);
  for (int step = 0; step < changes; ++step) {
    change(sites, set.sites, random);
    const auto cells = diagram.update(sites, options);
    ASSERT_TRUE(cells.ok()) << cells.error().text();
    const auto fresh = power_cells(set.domain, sites, options);
    ASSERT_TRUE(fresh.ok());
    for (std::size_t i = 0; i < sites.size(); ++i) {
      ASSERT_TRUE(same_measure_bits((*cells)[i], (*fresh)[i]))
          << "site " << i << " after " << step + 1 << " changes, shape " << with_shape << ": volume " << (*cells)[i].volume
          << " instead of " << (*fresh)[i].volume << ", " << (*cells)[i].facets.size() << " facets instead of "
          << (*fresh)[i].facets.size();
    }
  }
}

TEST(CellHistory, AHundredChangesLeaveNoTrace) {
  for (int k = 0; k < rounds(40) && !HasFailure(); ++k) {
    const SiteSet set = zoo_set(k % kZooKinds, 30 + static_cast<std::size_t>(k) % 50, 500 + static_cast<std::uint64_t>(k));
    SCOPED_TRACE(set.name);
    for (const bool with_shape : {true, false})
      expect_history_leaves_no_trace(set, with_shape, 70 + static_cast<std::uint64_t>(k), 100);
  }
}

// A site that suddenly outweighs cells that it does not border: they are gone, although no neighbour of it tells.
TEST(CellHistory, CellsSwallowedBeyondTheNeighboursAreGone) {
  for (const bool with_shape : {true, false}) {
    geometry::CellOptions options;
    options.with_shape = options.with_centroid = with_shape;
    auto sites = random_sites(200, 3, 0.004, 0.006);
    geometry::PowerDiagram diagram;
    ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
    ASSERT_TRUE(diagram.update(sites, options).ok());
    sites[7] = {{0.5, 0.5, 0.5}, 0.12};
    const auto cells = diagram.update(sites, options);
    const auto fresh = power_cells(unit_cube(), sites, options);
    ASSERT_TRUE(cells.ok() && fresh.ok());
    EXPECT_NEAR(totals_of(*cells).volume, totals_of(*fresh).volume, 1e-12) << with_shape;
    for (std::size_t i = 0; i < sites.size(); ++i)
      EXPECT_TRUE(same_measure_bits((*cells)[i], (*fresh)[i])) << i << " " << with_shape;
  }
}

// Sites that leave the box in which they were when they were sorted find each other out there.
TEST(CellHistory, SitesThatLeaveTheirOldBoxFindEachOther) {
  for (const bool with_shape : {true, false}) {
    geometry::CellOptions options;
    options.with_shape = options.with_centroid = with_shape;
    auto sites = random_sites(60, 4, 0.5, 0.501);
    for (geometry::PowerSite& site : sites) site.position = 0.1 * site.position;
    geometry::PowerDiagram diagram;
    ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
    Random random(9);
    for (int step = 0; step < 60; ++step) {
      ASSERT_TRUE(diagram.update(sites, options).ok());
      // The outermost ones go on outwards.
      for (geometry::PowerSite& site : sites) {
        if (site.position.x + site.position.y + site.position.z > 0.2) {
          site.position = {std::min(0.95, 1.1 * site.position.x), std::min(0.95, 1.1 * site.position.y),
                           std::min(0.95, 1.1 * site.position.z)};
        }
      }
      const auto cells = diagram.update(sites, options);
      const auto fresh = power_cells(unit_cube(), sites, options);
      ASSERT_TRUE(cells.ok() && fresh.ok());
      for (std::size_t i = 0; i < sites.size(); ++i)
        ASSERT_TRUE(same_measure_bits((*cells)[i], (*fresh)[i])) << i << " step " << step;
    }
  }
}

bool same_shape_bits(const geometry::CellMeasure& a, const geometry::CellMeasure& b) {
  return same_measure_bits(a, b) && a.reason == b.reason && a.floor_area == b.floor_area && a.footprint == b.footprint &&
         a.height == b.height && a.bottom == b.bottom && (a.mesh == nullptr) == (b.mesh == nullptr) &&
         (a.mesh == nullptr || (*a.mesh).vertices == (*b.mesh).vertices);
}

// Made without storeys, some times over, and completed now and then: every cell is as if it had been made with all at once, and
// what complete() does not name has not changed.
TEST(CellHistory, WhatIsCompletedLaterIsWhatIsMadeAtOnce) {
  std::size_t kept = 0;
  for (int k = 0; k < rounds(40) && !HasFailure(); ++k) {
    const SiteSet set = zoo_set(k % kZooKinds, 30 + static_cast<std::size_t>(k) % 50, 900 + static_cast<std::uint64_t>(k));
    SCOPED_TRACE(set.name);
    Random random(40 + static_cast<std::uint64_t>(k));
    std::vector<double> heights(set.sites.size(), 0.1);
    geometry::PowerDiagram diagram;
    ASSERT_TRUE(diagram.set_domain(set.domain).ok());
    std::vector<geometry::PowerSite> sites = set.sites;
    std::vector<geometry::CellMeasure> before;
    for (int step = 0; step < 25; ++step) {
      for (std::size_t n = random.below(3); n > 0; --n) {
        change(sites, set.sites, random);
        ASSERT_TRUE(diagram.update(sites, {.with_storeys = false, .with_outlines = true}).ok());
      }
      if (random.below(4) == 0) heights[random.below(heights.size())] = random.uniform(0.05, 0.2);
      ASSERT_TRUE(diagram.update(sites, {.with_storeys = false, .with_outlines = true}).ok());
      const geometry::CellOptions asked{.storey_heights = heights, .tessellation_depth = random.below(8) == 0 ? 1 : 0};
      const auto cells = diagram.complete(asked);
      ASSERT_TRUE(cells.ok()) << cells.error().text();
      const auto fresh = power_cells(set.domain, sites, asked);
      ASSERT_TRUE(fresh.ok());
      std::vector<std::uint8_t> is_completed(sites.size(), 0);
      for (const std::uint32_t i : diagram.completed()) is_completed[i] = 1;
      for (std::size_t i = 0; i < sites.size(); ++i) {
        ASSERT_TRUE(same_shape_bits((*cells)[i], (*fresh)[i])) << "site " << i << " in step " << step;
        if (is_completed[i]) continue;
        ++kept;
        ASSERT_TRUE(same_shape_bits((*cells)[i], before[i])) << "site " << i << " in step " << step;
      }
      before.assign(cells->begin(), cells->end());
    }
  }
  EXPECT_GT(kept, 0u);
}

TEST(CellHistory, OnlyCellsWithOutlinesAndCentroidsCanBeCompleted) {
  geometry::PowerDiagram diagram;
  ASSERT_TRUE(diagram.set_domain(unit_cube()).ok());
  EXPECT_FALSE(diagram.complete({}).ok());
  const auto sites = random_sites(20, 1, 0.01, 0.02);
  ASSERT_TRUE(diagram.update(sites).ok());
  EXPECT_FALSE(diagram.complete({}).ok());
  ASSERT_TRUE(diagram.update(sites, {.with_centroid = false, .with_outlines = true}).ok());
  EXPECT_FALSE(diagram.complete({}).ok());
  ASSERT_TRUE(diagram.update(sites, {.with_outlines = true}).ok());
  EXPECT_TRUE(diagram.complete({}).ok());
}

}  // namespace
}  // namespace bl::test
