// Who can give way no further, and the words for it.
#include "core/base/demand_limit.h"

#include <cmath>

#include "core/base/text.h"

namespace bl {

namespace {

constexpr double kGrantRounding = 1e-6;  // of a demand
constexpr double kShapeFollowed = 0.02;  // how near a shape is to what is wanted of it, once it has followed
constexpr std::size_t kMostHolders = 4;

}  // namespace

bool is_at_least(const HeldBack& held, std::size_t i, double least) {
  const double bottom = least * held.demands[i];
  const bool is_down = held.limits[i] <= bottom * (1 + kGrantRounding) || held.demands[i] <= 0;
  return is_down && std::abs(held.volumes[i] - held.wanted[i]) <= kShapeFollowed * held.wanted[i];
}

bool is_exhausted(const HeldBack& held, const std::vector<std::size_t>& which, double least) {
  return std::all_of(which.begin(), which.end(), [&](std::size_t i) { return is_at_least(held, i, least); });
}

std::string held_by(const HeldBack& held, const std::vector<std::size_t>& which, double least) {
  if (which.empty()) return "held by volumes that this link does not lead to";
  std::vector<std::size_t> holding;
  for (const std::size_t i : which)
    if (held.wanted[i] > least * held.demands[i] * (1 + kGrantRounding)) holding.push_back(i);
  if (holding.empty()) return "all are down to " + shortest(100 * least) + " % of their demands";
  std::stable_sort(holding.begin(), holding.end(), [&](std::size_t a, std::size_t b) { return held.wanted[a] > held.wanted[b]; });
  std::string text = "held by";
  for (std::size_t k = 0; k < std::min(kMostHolders, holding.size()); ++k)
    text += (k == 0 ? " `" : ", `") + held.ids[holding[k]] + "` (" + fixed(held.wanted[holding[k]], 0) + " m³ are insisted on)";
  if (holding.size() > kMostHolders) text += " and " + std::to_string(holding.size() - kMostHolders) + " more";
  return text;
}

}  // namespace bl
