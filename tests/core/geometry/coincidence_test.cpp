// Sites at one place: who lives, by the words of the header, and how long it takes where very many lie there.
#include "core/geometry/inside/coincidence.h"

#include <algorithm>
#include <ctime>

#include "core/geometry/inside/none.h"
#include "tests/core/geometry/geometry_support.h"

namespace bl::test {
namespace {

// Heaviest first, each against all that live: the definition, as slow as it is.
std::vector<std::uint32_t> twins_by_definition(const std::vector<geometry::PowerSite>& sites, double tolerance) {
  std::vector<std::uint32_t> order(sites.size()), twin(sites.size(), kNone), living;
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return sites[i].weight > sites[j].weight; });
  for (const std::uint32_t i : order) {
    for (const std::uint32_t j : living)
      if (twin[i] == kNone && distance(sites[i].position, sites[j].position) <= tolerance) twin[i] = j;
    if (twin[i] == kNone) living.push_back(i);
  }
  return twin;
}

TEST(Coincidence, IsWhatItsWordsSay) {
  for (std::uint64_t round = 0; round < 200; ++round) {
    Random random(round);
    const double tolerance = round % 3 == 0 ? 1e-6 : 0.01;
    const Vector3 origin = round % 2 == 0 ? Vector3{} : Vector3{4e6, -3e5, 7};
    std::vector<geometry::PowerSite> sites;
    for (int k = 0; k < 60; ++k) {
      const Point3 place = random_point(random, {0, 0, 0}, {3 * tolerance, 2 * tolerance, 2 * tolerance});
      const Point3 centre = origin + 5.0 * static_cast<double>(random.below(3)) * Vector3{tolerance, 1, tolerance};
      sites.push_back({centre + place, std::floor(random.uniform(0, 8))});
    }
    std::vector<std::uint32_t> twin;
    find_coincident(sites, tolerance, twin);
    EXPECT_EQ(twin, twins_by_definition(sites, tolerance)) << round;
  }
}

// Of the processor, and the shortest of a few: others work on this machine, too [s].
double seconds_for_sites_on_one_place(std::uint32_t count) {
  std::vector<geometry::PowerSite> sites(count, {{5, 5, 5}, 4});
  sites[count / 2].weight = 5;
  sites.push_back({{2, 2, 2}, 4});
  double least = 1e9;
  for (int round = 0; round < 3; ++round) {
    const std::clock_t begin = std::clock();
    const auto cells = cells_of(box({0, 0, 0}, {10, 10, 10}), sites);
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    const geometry::CellTotals totals = totals_of(cells);
    EXPECT_EQ(totals.alive, 2u);
    EXPECT_EQ(totals.coincident, count - 1);
    EXPECT_EQ(cells[count / 2].state, geometry::SiteState::alive);
  }
  return least;
}

// Four times as many may take a little more than four times as long; pair by pair it would be sixteen times, and gigabytes.
TEST(Coincidence, ManySitesOnOnePlaceCostLittle) {
  const double some = seconds_for_sites_on_one_place(7500), many = seconds_for_sites_on_one_place(30000);
  EXPECT_LT(many, 9 * some + 0.1) << some << " s for 7 500, " << many << " s for 30 000";
}

}  // namespace
}  // namespace bl::test
