// Power cells that can be checked by hand, and the degenerate arrangements.
#include "core/geometry/power_cells.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

constexpr double kPiOfCells = std::numbers::pi;

TEST(PowerCells, TwoSitesShareTheFacetWhereTheirPowersMeet) {
  // d = 4, so the facet lies at (d² + w1 - w2) / (2 d) = (16 + 9 - 5) / 8 = 2.5 from the first site.
  const std::vector<geometry::PowerSite> sites{{{1, 2, 2}, 9}, {{5, 2, 2}, 5}};
  const auto cells = cells_of(box({0, 0, 0}, {10, 4, 4}), sites);
  EXPECT_NEAR(cells[0].cell_volume, 3.5 * 16, 1e-12);
  EXPECT_NEAR(cells[1].cell_volume, 6.5 * 16, 1e-12);
  // Rim of both balls on the facet: sqrt(9 - 6.25) = sqrt(2.75) < 2, so a whole disc.
  ASSERT_FALSE(cells[1].facets.empty());
  const geometry::FacetArea shared = cells[0].facets.back();
  EXPECT_EQ(shared.kind, geometry::FacetArea::Kind::site);
  EXPECT_EQ(shared.index, 1u);
  EXPECT_NEAR(shared.area, kPiOfCells * 2.75, 1e-12);
}

TEST(PowerCells, BallCutByAPlane) {
  // Radius 2, plane at 1 below the centre: the cap of height 1 is missing, pi h² (3 r - h) / 3.
  const auto cells = cells_of(box({-5, -5, 0}, {5, 5, 10}), std::vector<geometry::PowerSite>{{{0, 0, 1}, 4}});
  const geometry::CellMeasure& cell = cells[0];
  EXPECT_NEAR(cell.volume, 4 * kPiOfCells * 8 / 3 - kPiOfCells * 5 / 3, 1e-12);
  EXPECT_NEAR(cell.spherical_area, 2 * kPiOfCells * 2 * 3, 1e-12);
  EXPECT_NEAR(cell.surface_area, 12 * kPiOfCells + 3 * kPiOfCells, 1e-12);
  EXPECT_NEAR(cell.height, 3, 1e-12);
  EXPECT_NEAR(cell.bottom, 0, 1e-12);
  EXPECT_NEAR(cell.footprint, 4 * kPiOfCells, 1e-12);
  // One storey of 3 m: its section at 1.5 m has squared radius 4 - 0.25.
  EXPECT_NEAR(cell.floor_area, 3.75 * kPiOfCells, 1e-12);
  EXPECT_NEAR(
      cell.centroid.z,
      1 + (kPiOfCells * 81.0 / 4 / 9) / (9 * kPiOfCells) * 0 +
          [] {
            // First moment of the cut-off cap about the centre: pi/4 (r² - h²)², towards -z; so the rest has it towards +z.
            return (kPiOfCells / 4 * 9) / (32 * kPiOfCells / 3 - 5 * kPiOfCells / 3);
          }(),
      1e-12);
}

TEST(PowerCells, BoxInsideAHugeBall) {
  const auto cells = cells_of(box({0, 0, 0}, {2, 3, 7}), std::vector<geometry::PowerSite>{{{1, 1, 1}, 1e6}});
  const geometry::CellMeasure& cell = cells[0];
  EXPECT_DOUBLE_EQ(cell.volume, 42);
  EXPECT_DOUBLE_EQ(cell.surface_area, 2 * (6 + 14 + 21));
  EXPECT_EQ(cell.spherical_area, 0);
  EXPECT_DOUBLE_EQ(cell.footprint, 6);
  EXPECT_DOUBLE_EQ(cell.height, 7);
  EXPECT_DOUBLE_EQ(cell.floor_area, 14);  // two storeys of 3 m, and a third of one in the metre above them
  EXPECT_NEAR(distance(cell.centroid, {1, 1.5, 3.5}), 0, 1e-14);
  EXPECT_EQ(cell.facets.size(), 6u);
}

// A facet that rounding tilts has its highest point next to its middle, not on the ball (found by the fuzzer).
TEST(PowerCells, AFacetThatIsLevelButForRoundingReachesNoHigherThanItIs) {
  const geometry::Domain cube = box({0, 0, 0}, {10, 10, 10});
  for (int k = 1; k <= 400; ++k) {
    const double low = 0.5 + 0.01 * k, apart = 0.013 * k, tilt = k % 3 == 0 ? 1e-17 : 0;
    const std::vector<geometry::PowerSite> sites = {{{5, 5, low}, 100}, {{5 + tilt, 5, low + apart}, 100}};
    const auto cells = power_cells(cube, sites).value();
    const double middle = low + 0.5 * apart;
    EXPECT_NEAR(cells[0].height, middle, 1e-9) << k;
    EXPECT_NEAR(cells[1].height, 10 - middle, 1e-9) << k;
    EXPECT_NEAR(cells[1].bottom, middle, 1e-9) << k;
  }
}

TEST(PowerCells, LowShapesHaveOneFloorAtMidHeight) {
  const auto cells = cells_of(box({0, 0, 0}, {2, 3, 1}), std::vector<geometry::PowerSite>{{{1, 1, 0.5}, 1e6}});
  EXPECT_DOUBLE_EQ(cells[0].floor_area, 6);
}

// Under a flat roof, between two sites one above the other whose level border moves, and where a ball grows over a storey.
TEST(PowerCells, FloorAreaIsContinuousInPlacesAndWeights) {
  const geometry::Domain plot = box({0, 0, 0}, {20, 20, 14});
  double before[3] = {0, 0, 0};
  constexpr int kSteps = 4000;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = static_cast<double>(k) / kSteps;
    const std::vector<geometry::PowerSite> sites = {{{10, 10, 2 + 6 * t}, 400}, {{10, 10, 11}, 400}};
    const auto cells = power_cells(plot, sites).value();
    const auto ball = power_cells(plot, std::vector<geometry::PowerSite>{{{10, 10, 7}, 0.5 + 45 * t}}).value();
    const double now[3] = {cells[0].floor_area, cells[1].floor_area, ball[0].floor_area};
    for (int i = 0; i < 3; ++i) {
      if (k > 0) { EXPECT_NEAR(now[i], before[i], 1) << i << " at " << t; }
      before[i] = now[i];
    }
    for (const auto& cell : cells) EXPECT_NEAR(cell.floor_area * 3, cell.volume, 0.03 * cell.volume) << t;
  }
}

TEST(PowerCells, EveryStateSaysWhy) {
  std::vector<geometry::PowerSite> sites = sites_in_every_state();
  sites.push_back({{1, 1, 3}, 1});  // 6 lives
  sites.push_back({{1, 1, 3}, 1});  // 7 same as 6
  const auto cells = cells_of(box({0, 0, 0}, {10, 10, 10}), sites);
  const auto expect = [&](std::size_t i, geometry::SiteState state, const char* word) {
    EXPECT_EQ(cells[i].state, state) << i << " " << name_of(cells[i].state);
    EXPECT_NE(cells[i].reason.find(word), std::string::npos) << cells[i].reason;
  };
  expect(0, geometry::SiteState::alive, "");
  expect(1, geometry::SiteState::coincident, "site 0");
  expect(2, geometry::SiteState::hidden, "site 0");
  expect(3, geometry::SiteState::outside, "outside");
  expect(4, geometry::SiteState::outside, "reaches in");
  EXPECT_GT(cells[4].volume, 0);
  expect(5, geometry::SiteState::starved, "not positive");
  EXPECT_GT(cells[5].cell_volume, 0);
  expect(6, geometry::SiteState::alive, "");
  expect(7, geometry::SiteState::coincident, "site 6");
  const geometry::CellTotals totals = totals_of(cells);
  EXPECT_EQ(totals.alive + totals.hidden + totals.outside + totals.coincident + totals.starved, sites.size());
}

TEST(PowerCells, SiteThatItsOwnBallDoesNotReachIsStarved) {
  // The facet lies at (1 + 0.01 - 4) / 2 < -0.1, behind the light site's ball.
  const std::vector<geometry::PowerSite> sites{{{5, 5, 5}, 0.01}, {{6, 5, 5}, 4}};
  const auto cells = cells_of(box({0, 0, 0}, {10, 10, 10}), sites);
  EXPECT_EQ(cells[0].state, geometry::SiteState::starved);
  EXPECT_GT(cells[0].cell_volume, 0);
  EXPECT_EQ(cells[0].volume, 0);
  EXPECT_EQ(cells[0].mesh, nullptr);
}

TEST(PowerCells, AbsurdInputIsRefusedWithASentence) {
  const geometry::ConvexDomain domain = unit_cube();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const geometry::PowerSite& bad : {geometry::PowerSite{{nan, 0, 0}, 1}, geometry::PowerSite{{0, 0, 0}, nan},
                                         geometry::PowerSite{{1e9, 0, 0}, 1}, geometry::PowerSite{{0, 0, 0}, 1e19}}) {
    const auto cells = power_cells(domain, std::vector<geometry::PowerSite>{{{0.5, 0.5, 0.5}, 1}, bad});
    ASSERT_FALSE(cells.ok());
    EXPECT_NE(cells.error().message.find("site 1"), std::string::npos);
  }
  geometry::CellOptions options;
  options.storey_height = 0;
  EXPECT_FALSE(power_cells(domain, std::vector<geometry::PowerSite>{{{0.5, 0.5, 0.5}, 1}}, options).ok());
  options.storey_height = 3;
  options.tessellation_depth = 5;
  EXPECT_FALSE(power_cells(domain, std::vector<geometry::PowerSite>{{{0.5, 0.5, 0.5}, 1}}, options).ok());
  EXPECT_FALSE(power_cells(geometry::ConvexDomain{}, std::vector<geometry::PowerSite>{{{0.5, 0.5, 0.5}, 1}}).ok());
  EXPECT_TRUE(cells_of(domain, std::vector<geometry::PowerSite>{}).empty());
}

// Whatever the arrangement: every site accounted for, numbers finite, cells tile the domain, meshes closed.
void expect_sound(const char* name, const geometry::ConvexDomain& domain, std::span<const geometry::PowerSite> sites) {
  SCOPED_TRACE(name);
  const auto cells = cells_of(domain, sites, 1);
  ASSERT_EQ(cells.size(), sites.size());
  const geometry::CellTotals totals = totals_of(cells);
  EXPECT_EQ(totals.alive + totals.hidden + totals.outside + totals.coincident + totals.starved, sites.size());
  if (!sites.empty()) { EXPECT_NEAR(totals.cell_volume, domain.volume, 1e-9 * domain.volume); }
  EXPECT_LE(totals.volume, domain.volume * (1 + 1e-9));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const geometry::CellMeasure& cell = cells[i];
    EXPECT_EQ(cell.reason.empty(), cell.state == geometry::SiteState::alive);
    EXPECT_EQ(cell.volume > 0, cell.mesh != nullptr) << i;
    for (const double number : {cell.volume, cell.cell_volume, cell.surface_area, cell.floor_area, cell.footprint, cell.height,
                                cell.bottom, cell.volume_by_own_weight, cell.centroid.x, cell.centroid.y, cell.centroid.z}) {
      EXPECT_TRUE(std::isfinite(number)) << i;
    }
    EXPECT_TRUE(
        std::is_sorted(cell.facets.begin(), cell.facets.end(), [](const geometry::FacetArea& a, const geometry::FacetArea& b) {
          return std::pair(a.kind, a.index) < std::pair(b.kind, b.index);
        }));
    if (!cell.mesh) continue;
    EXPECT_TRUE(is_closed(*cell.mesh)) << i;
    EXPECT_GE(enclosed_volume(*cell.mesh), -1e-12);
    EXPECT_LE(enclosed_volume(*cell.mesh), cell.volume * (1 + 1e-6) + 1e-12) << i;
  }
}

TEST(PowerCells, DegenerateZoo) {
  const geometry::ConvexDomain domain = box({0, 0, 0}, {4, 4, 4});
  const auto grid = [](double weight) {
    std::vector<geometry::PowerSite> sites;
    for (int x = 0; x < 4; ++x) {
      for (int y = 0; y < 4; ++y) {
        for (int z = 0; z < 4; ++z) sites.push_back({{x + 0.5, y + 0.5, z + 0.5}, weight});
      }
    }
    return sites;
  };
  expect_sound("none", domain, {});
  expect_sound("one", domain, std::vector<geometry::PowerSite>{{{1, 1, 1}, 1}});
  expect_sound("two", domain, std::vector<geometry::PowerSite>{{{1, 1, 1}, 1}, {{3, 1, 1}, 1}});
  expect_sound("three", domain, std::vector<geometry::PowerSite>{{{1, 1, 1}, 1}, {{3, 1, 1}, 1}, {{2, 3, 1}, 2}});
  expect_sound("collinear", domain,
               std::vector<geometry::PowerSite>{
                   {{1, 1, 1}, 1}, {{2, 2, 2}, 1}, {{3, 3, 3}, 1}, {{3.5, 3.5, 3.5}, 1}, {{2.5, 2.5, 2.5}, 9}});
  expect_sound("lattice", domain, grid(0.3));
  expect_sound("lattice, full", domain, grid(10));
  expect_sound("lattice, tangent balls", domain, grid(0.25));
  expect_sound("lattice, balls through corners", domain, grid(0.75));
  auto layer = grid(0.4);
  layer.resize(16);
  expect_sound("coplanar", domain, layer);
  auto mixed = grid(0.3);
  for (std::size_t i = 0; i < mixed.size(); ++i) mixed[i].weight = i % 5 == 0 ? 0 : i % 7 == 0 ? -1 : i % 11 == 0 ? 1e12 : 1e-12;
  expect_sound("tiny, huge, zero and negative", domain, mixed);
  std::vector<geometry::PowerSite> sphere;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) sphere.push_back({{2 + x, 2 + y, 2 + z}, 1});
    }
  }
  for (const double a : {-1.0, 1.0}) {
    sphere.push_back({{2 + a * std::sqrt(3), 2, 2}, 1});
    sphere.push_back({{2, 2 + a * std::sqrt(3), 2}, 1});
  }
  expect_sound("cospherical", domain, sphere);
  sphere.push_back({{2, 2, 2}, 1});
  expect_sound("cospherical with centre", domain, sphere);
  expect_sound("all at one place", domain, std::vector<geometry::PowerSite>(20, {{1, 2, 3}, 0.5}));
  expect_sound("all outside", domain, std::vector<geometry::PowerSite>{{{-1, 1, 1}, 4}, {{5, 1, 1}, 1}, {{9, 9, 9}, 0.1}});
  expect_sound("on corners and edges", domain,
               std::vector<geometry::PowerSite>{{{0, 0, 0}, 1}, {{4, 4, 4}, 1}, {{0, 0, 4}, 16}, {{4, 0, 2}, 1}});
  std::vector<geometry::PowerSite> close;
  for (int i = 0; i < 12; ++i) close.push_back({{1 + 1e-5 * i, 1, 1 + 1e-5 * (i % 3)}, 1});
  expect_sound("very close", domain, close);
  std::vector<geometry::PowerSite> negative = grid(-2);
  expect_sound("all negative", domain, negative);
}

TEST(PowerCells, LatticeCellsAreExactCubes) {
  std::vector<geometry::PowerSite> sites;
  for (int x = 0; x < 5; ++x) {
    for (int y = 0; y < 5; ++y) {
      for (int z = 0; z < 5; ++z) sites.push_back({{x + 0.5, y + 0.5, z + 0.5}, 100});
    }
  }
  for (const geometry::CellMeasure& cell : cells_of(box({0, 0, 0}, {5, 5, 5}), sites)) {
    EXPECT_NEAR(cell.volume, 1, 1e-13);
    EXPECT_EQ(cell.facets.size(), 6u);
    EXPECT_NEAR(cell.surface_area, 6, 1e-12);
  }
}

TEST(PowerCells, ABallThatOnlyTouchesItsCellHasNoShape) {
  const auto cube = geometry::extrude(std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0, 1);
  geometry::CellOptions options;
  options.tessellation_depth = 1;
  for (const double more : {0.0, 1e-16, 4e-16, 1e-9}) {
    const auto cells = power_cells(*cube, std::vector<geometry::PowerSite>{{{2, 0.5, 0.5}, (1 + more) * (1 + more)}}, options);
    ASSERT_TRUE(cells.ok());
    const geometry::CellMeasure& cell = cells->front();
    EXPECT_EQ(cell.mesh != nullptr, cell.volume > 0) << more;
    if (cell.mesh) { EXPECT_LE(enclosed_volume(*cell.mesh), cell.volume + 1e-6) << more; }
  }
}

// From a fuzzer: touched at a corner, the ball had a volume of rounding, and a mesh beside its cell.
TEST(PowerCells, ABallThatTouchesACornerHasNoMesh) {
  const auto cube = geometry::extrude(std::vector<Point3>{{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}}, 0, 10);
  const std::vector<geometry::PowerSite> sites{
      {{1.66, 1.66, 1.68}, 1.69}, {{3, 3, 5}, 1.69}, {{3, 4, 5}, 1.69}, {{-2, -2, -2}, 25}, {{10, 10, 11}, 1}};
  geometry::CellOptions options;
  options.tessellation_depth = 2;
  const auto cells = power_cells(*cube, sites, options);
  ASSERT_TRUE(cells.ok());
  const geometry::CellMeasure& cell = cells->back();
  EXPECT_EQ(cell.volume, 0);
  EXPECT_EQ(cell.mesh, nullptr);
  EXPECT_FALSE(cell.reason.empty());
}

}  // namespace
}  // namespace bl::test
