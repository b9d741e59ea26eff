// The ground that a cell covers is counted once, whatever pieces its domain is made of: against sampled lines and undivided
// domains.
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/site_domain.h"
#include "core/geometry/solid_part.h"
#include "tests/core/geometry/domain_laws.h"

namespace bl::test {
namespace {

// A stretch of an upright line.
struct Rise {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  void keep(const Vector3& normal, double offset, const Point3& foot) {
    const double room = offset - dot(normal, foot);
    if (normal.z > 0) high = std::min(high, room / normal.z);
    else if (normal.z < 0) low = std::max(low, room / normal.z);
    else if (room < 0) high = -std::numeric_limits<double>::infinity();
  }
};

// Does the upright line through a place in plan meet the cell of a site? From distances alone.
bool is_covered(const geometry::Domain& domain, std::span<const geometry::PowerSite> sites, std::size_t i, Point3 foot) {
  foot.z = 0;
  const geometry::PowerSite& own = sites[i];
  const double dx = foot.x - own.position.x, dy = foot.y - own.position.y, rest = own.weight - dx * dx - dy * dy;
  if (!(rest > 0)) return false;
  Rise cell{own.position.z - std::sqrt(rest), own.position.z + std::sqrt(rest)};
  for (std::size_t j = 0; j < sites.size(); ++j) {
    if (j == i) continue;
    const Vector3 to = sites[j].position - own.position;
    cell.keep(to, 0.5 * (squared_norm(sites[j].position) - squared_norm(own.position) + own.weight - sites[j].weight), foot);
  }
  return std::any_of(domain.pieces.begin(), domain.pieces.end(), [&](const geometry::Domain::Piece& piece) {
    Rise rise = cell;
    for (const geometry::Plane& plane : piece.shape.planes) rise.keep(plane.normal, plane.offset, foot);
    return rise.low < rise.high;
  });
}

std::vector<geometry::CellMeasure> cells_in(const geometry::Domain& domain, std::span<const geometry::PowerSite> sites) {
  auto cells = power_cells(domain, sites, {});
  EXPECT_TRUE(cells.ok()) << (cells.ok() ? "" : cells.error().text());
  return cells.ok() ? *cells : std::vector<geometry::CellMeasure>{};
}

std::vector<geometry::PowerSite> sites_within(const geometry::Domain& domain, Random& random, std::size_t count, double least,
                                              double most) {
  std::vector<geometry::PowerSite> sites;
  while (sites.size() < count) {
    const Point3 place = random_point(random, domain.minimum, domain.maximum);
    const double radius = domain.size() * random.uniform(least, most);
    sites.push_back({place, radius * radius});
  }
  return sites;
}

std::vector<Point3> ring_around(Random& random, const Point3& middle, double least, double most) {
  std::vector<Point3> ring;
  const auto corners = 3 + random.below(8);
  for (std::uint64_t k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.1) / static_cast<double>(corners);
    const double reach = random.uniform(least, most);
    ring.push_back({middle.x + reach * std::cos(angle), middle.y + reach * std::sin(angle), 0});
  }
  return ring;
}

// Stars and ells, with houses that stay: on the ground, up in the air, through the top.
geometry::SitePlan plan_with_houses(std::uint64_t seed, Random& random) {
  geometry::SitePlan plan;
  plan.top = random.uniform(8, 30);
  if (seed % 3 == 0) plan.plan = {{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {0, 60, 0}};
  else if (seed % 3 == 1) plan.plan = {{0, 0, 0}, {60, 0, 0}, {60, 25, 0}, {20, 25, 0}, {20, 60, 0}, {0, 60, 0}};
  else plan.plan = ring_around(random, {30, 30, 0}, 12, 40);
  for (std::uint64_t k = 0, n = seed % 4; k < n; ++k) {
    const double bottom = random.below(3) == 0 ? random.uniform(1, plan.top / 2) : 0;
    const double top = bottom + random.uniform(2, plan.top);
    const Point3 middle{random.uniform(0, 60), random.uniform(0, 60), 0};
    if (random.below(2) == 0) {
      plan.exclusions.push_back({ring_around(random, middle, 3, 14), bottom, top});
    } else {
      const double width = random.uniform(4, 15), depth = random.uniform(4, 15);
      const double x = middle.x, y = middle.y;
      plan.exclusions.push_back({{{x, y, 0}, {x + width, y, 0}, {x + width, y + depth, 0}, {x, y + depth, 0}}, bottom, top});
    }
  }
  return plan;
}

TEST(FootprintLaws, LinesThatMeetTheCellCountItsFootprint) {
  constexpr int kSide = 160;
  int in_several_pieces = 0, checked = 0;
  for (std::uint64_t seed = 0; seed < 48; ++seed) {
    Random random(900 + seed);
    const geometry::SitePlan plan = plan_with_houses(seed, random);
    const auto domain = site_domain(plan);
    ASSERT_TRUE(domain.ok()) << seed << ": " << domain.error().text();
    const auto sites = sites_within(*domain, random, 1 + random.below(8), 0.05, 0.5);
    const auto cells = cells_in(*domain, sites);
    ASSERT_EQ(cells.size(), sites.size());
    const Vector3 low = domain->minimum, step = (domain->maximum - low) / kSide;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      int met = 0, rim = 0;
      std::vector<std::uint8_t> row(kSide), below(kSide);
      for (int v = 0; v < kSide; ++v) {
        for (int u = 0; u < kSide; ++u) {
          const Point3 place{low.x + (u + 0.5) * step.x, low.y + (v + 0.5) * step.y, 0};
          row[static_cast<std::size_t>(u)] = is_covered(*domain, sites, i, place);
          met += row[static_cast<std::size_t>(u)];
          rim += u > 0 && row[static_cast<std::size_t>(u)] != row[static_cast<std::size_t>(u - 1)] ? 1 : 0;
          rim += v > 0 && row[static_cast<std::size_t>(u)] != below[static_cast<std::size_t>(u)] ? 1 : 0;
        }
        below = row;
      }
      // Each line of the grid that the rim passes between is wrong by half a mesh at most; they err to both sides.
      const double mesh = step.x * step.y, error = mesh * (2 + 4 * std::sqrt(static_cast<double>(rim)));
      EXPECT_NEAR(cells[i].footprint, met * mesh, error) << "seed " << seed << ", site " << i;
      ++checked;
      in_several_pieces += domain->pieces.size() > 1 && met > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(in_several_pieces, 80) << "of " << checked;
}

// Cut through by planes that lean any way: pieces lie above one another, and each has a part of the same ball.
geometry::Domain cut_apart(const geometry::ConvexDomain& whole, Random& random, int cuts, bool is_level) {
  std::vector<geometry::SolidPart> parts{part_of(geometry::Domain(whole).pieces.front())};
  const double tolerance = geometry::place_tolerance(whole.minimum, whole.maximum);
  for (int k = 0; k < cuts; ++k) {
    Vector3 normal{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    // Level, upright and leaning ones: faces that lie exactly above one another are the common case in sites.
    if (is_level) normal = random.below(2) == 0 ? Vector3{0, 0, 1} : random.below(2) == 0 ? Vector3{0, 1, 0} : Vector3{1, 0, 0};
    normal = normal / norm(normal);
    const geometry::Plane plane{normal, dot(normal, random_point(random, whole.minimum, whole.maximum))};
    std::vector<geometry::SolidPart> next;
    for (const geometry::SolidPart& part : parts) {
      geometry::Halves halves = cut_in_two(part, plane, tolerance, geometry::Domain::kInner);
      if (halves.inside) next.push_back(std::move(*halves.inside));
      if (halves.outside) next.push_back(std::move(*halves.outside));
    }
    parts = std::move(next);
  }
  std::vector<geometry::Domain::Piece> pieces;
  for (const geometry::SolidPart& part : parts) {
    auto piece = piece_of(part);
    if (piece.ok()) pieces.push_back(std::move(*piece));
  }
  return join_pieces(std::move(pieces)).value();
}

TEST(FootprintLaws, ADomainThatIsCutUpGivesWhatTheWholeOneGives) {
  const std::vector<Point3> points{{0, 0, 0},     {1, 0.1, 0},     {1.1, 1, 0.1}, {0, 0.9, -0.1},
                                   {0.2, 0.1, 1}, {0.9, 0.8, 1.2}, {0.1, 1, 0.9}};
  const geometry::ConvexDomain skew = geometry::convex_hull(points).value();
  int balls_cut = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const geometry::ConvexDomain whole = seed % 3 == 0 ? unit_cube() : skew;
    const geometry::Domain pieces = cut_apart(whole, random, 1 + static_cast<int>(seed % 6), seed % 2 == 0);
    ASSERT_NEAR(pieces.volume, whole.volume, 1e-12) << seed;
    const auto sites = sites_within(whole, random, 1 + random.below(10), 0.1, seed % 5 == 0 ? 2 : 0.4);
    const auto cells = cells_in(whole, sites), apart = cells_in(pieces, sites);
    ASSERT_EQ(cells.size(), apart.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      EXPECT_NEAR(apart[i].footprint, cells[i].footprint, 1e-9) << "seed " << seed << ", site " << i;
      EXPECT_NEAR(apart[i].floor_area, cells[i].floor_area, 1e-9) << "seed " << seed << ", site " << i;
      EXPECT_NEAR(apart[i].surface_area, cells[i].surface_area, 1e-9) << "seed " << seed << ", site " << i;
      EXPECT_NEAR(apart[i].height, cells[i].height, 1e-9) << "seed " << seed << ", site " << i;
      balls_cut += cells[i].spherical_area > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(balls_cut, 100);
}

TEST(FootprintLaws, AboveAndBelowAHouseItIsTheGroundOfBoth) {
  // A ball that reaches everywhere: the plan is 40 m by 30 m, the house in the air leaves a storey below and above it.
  const geometry::SitePlan plan{{{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}},
                                {},
                                0,
                                20,
                                {},
                                {{{{10, 10, 0}, {20, 10, 0}, {20, 18, 0}, {10, 18, 0}}, 5, 12}}};
  const auto domain = site_domain(plan);
  ASSERT_TRUE(domain.ok());
  const std::vector<geometry::PowerSite> sites{{{5, 5, 5}, 1e4}};
  const auto cells = cells_in(*domain, sites);
  EXPECT_NEAR(cells.at(0).footprint, 1200, 1e-9);
}

}  // namespace
}  // namespace bl::test
