// Near pairs by a sweep along one direction; where there may be some, the heaviest come first into cells as wide as the
// tolerance.
#include "core/geometry/inside/coincidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

// A little more than the tolerance, so that rounding brings no two sites that are near into cells that do not touch.
constexpr double kSweepWidth = 1.001;

// Those whose neighbour along a direction is near, which all that lie near another one are.
std::vector<std::uint32_t> crowded_sites(std::span<const PowerSite> sites, double tolerance) {
  // No lattice is aligned with this direction, so few sites share a place along it.
  constexpr Vector3 kSweep{0.5298129428260175, 0.6620846521871357, 0.5300936459732351};
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) order.emplace_back(dot(kSweep, sites[i].position), i);
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> found;
  const auto is_near = [&](std::size_t a) { return order[a + 1].first - order[a].first <= kSweepWidth * tolerance; };
  for (std::size_t a = 0; a < order.size(); ++a)
    if ((a > 0 && is_near(a - 1)) || (a + 1 < order.size() && is_near(a))) found.push_back(order[a].second);
  return found;
}

}  // namespace

void find_coincident(std::span<const PowerSite> sites, double tolerance, std::vector<std::uint32_t>& twin) {
  twin.assign(sites.size(), kNone);
  std::vector<std::uint32_t> crowded = crowded_sites(sites, tolerance);
  if (crowded.empty()) return;
  const auto is_before = [&](std::uint32_t i, std::uint32_t j) {
    return sites[i].weight != sites[j].weight ? sites[i].weight > sites[j].weight : i < j;
  };
  std::sort(crowded.begin(), crowded.end(), is_before);
  // Who lives lies farther from all others that live than the tolerance, so a cell holds few of them, however many lie there.
  using Cell = std::array<double, 3>;
  std::map<Cell, std::vector<std::uint32_t>> living;
  for (const std::uint32_t i : crowded) {
    const Vector3 at = sites[i].position / (kSweepWidth * tolerance);
    const Cell own{std::floor(at.x), std::floor(at.y), std::floor(at.z)};
    for (int k = 0; k < 27; ++k) {
      const auto cell = living.find({own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1});
      if (cell == living.end()) continue;
      for (const std::uint32_t j : cell->second)
        if (distance(sites[i].position, sites[j].position) <= tolerance && (twin[i] == kNone || is_before(j, twin[i])))
          twin[i] = j;
    }
    if (twin[i] == kNone) living[own].push_back(i);
  }
}

}  // namespace bl::geometry
