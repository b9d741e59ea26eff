// Near pairs by a sweep along one direction.
#include "core/geometry/coincidence.h"

#include <algorithm>
#include <utility>

#include "core/geometry/none.h"

namespace bl {

void find_coincident(std::span<const PowerSite> sites, double tolerance, std::vector<std::uint32_t>& twin) {
  // No lattice is aligned with this direction, so few sites share a place along it.
  constexpr Vector3 kSweep{0.5298129428260175, 0.6620846521871357, 0.5300936459732351};
  twin.assign(sites.size(), kNone);
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) order.emplace_back(dot(kSweep, sites[i].position), i);
  std::sort(order.begin(), order.end());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size() && order[b].first - order[a].first <= 1.001 * tolerance; ++b) {
      const std::uint32_t i = order[a].second, j = order[b].second;
      if (distance(sites[i].position, sites[j].position) <= tolerance) {
        pairs.emplace_back(i, j);
        pairs.emplace_back(j, i);
      }
    }
  }
  if (pairs.empty()) return;
  std::sort(pairs.begin(), pairs.end());
  const auto is_before = [&](std::uint32_t i, std::uint32_t j) {
    return sites[i].weight != sites[j].weight ? sites[i].weight > sites[j].weight : i < j;
  };
  std::vector<std::uint32_t> involved;
  for (const auto& pair : pairs) {
    if (involved.empty() || involved.back() != pair.first) involved.push_back(pair.first);
  }
  std::sort(involved.begin(), involved.end(), is_before);
  std::vector<std::uint8_t> lives(sites.size(), 0);
  for (const std::uint32_t i : involved) {
    auto at = std::lower_bound(pairs.begin(), pairs.end(), std::pair{i, 0u});
    for (; at != pairs.end() && at->first == i; ++at) {
      const std::uint32_t j = at->second;
      if (lives[j] && (twin[i] == kNone || is_before(j, twin[i]))) twin[i] = j;
    }
    if (twin[i] == kNone) lives[i] = 1;
  }
}

}  // namespace bl
