// Finds the volumes that cannot be limited further, and describes them.
#include "core/demand/demand_limit.h"

#include <cmath>
#include <numeric>

#include "core/base/text.h"

namespace bl::demand {

namespace {

constexpr double kGrantRounding = 1e-6;  // of a demand
constexpr double kShapeFollowed = 0.02;  // how near a shape is to what is wanted of it, once it has followed
constexpr std::size_t kMostHolders = 4;
constexpr int kMostDecimals = 9;
constexpr double kAsTyped = 0.01;  // how near a limit has to read to what it is, as a share of it

// Above the least share, whoever holds it there.
bool is_above_least(const LimitedVolumes& held, std::size_t i, double least) {
  return held.wanted[i] > least * held.demands[i] * (1 + kGrantRounding);
}

// By a lock of people, which is more than what is insisted on.
bool is_locked_up(const LimitedVolumes& held, std::size_t i, double least) {
  return held.locked[i] && is_above_least(held, i, least) && held.limits[i] > least * held.demands[i] * (1 + kGrantRounding);
}

std::vector<std::size_t> all_of(const LimitedVolumes& held) {
  std::vector<std::size_t> all(held.ids.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// Of so many volumes, found by their number. Mostly the first one has all that it wants, and there is no larger share.
template <class Which>
double share_granted(const LimitedVolumes& held, std::size_t count, const Which& which) {
  bool is_any_free = false;
  for (std::size_t k = 0; k < count && !is_any_free; ++k) is_any_free = !held.locked[which(k)];
  double share = kLeastGranted;
  for (std::size_t k = 0; k < count && share < 1; ++k)
    if (const std::size_t i = which(k); !is_any_free || !held.locked[i])
      share = std::max(share, granted_share(held.demands[i], held.limits[i]));
  return share;
}

}  // namespace

std::string found_of_allowed(double found, double allowed, int decimals, std::string_view unit) {
  const auto is_clear = [&](int digits) {
    const std::string text = fixed(allowed, digits);
    return text != fixed(found, digits) && std::abs(std::stod(text) - allowed) <= kAsTyped * std::abs(allowed);
  };
  while (decimals < kMostDecimals && !is_clear(decimals)) ++decimals;
  return fixed(found, decimals) + std::string(unit) + " of " + fixed(allowed, decimals) + std::string(unit);
}

double share_granted(const LimitedVolumes& held, const std::vector<std::size_t>& which) {
  return share_granted(held, which.size(), [&](std::size_t k) { return which[k]; });
}

bool is_at_least(const LimitedVolumes& held, std::size_t i, double least) {
  const double bottom = least * held.demands[i];
  const bool is_down = held.locked[i] || held.limits[i] <= bottom * (1 + kGrantRounding) || held.demands[i] <= 0;
  // Whoever has nothing, outside of the boundary or below others, has nothing to give.
  const bool has_followed = held.volumes[i] <= 0 || std::abs(held.volumes[i] - held.wanted[i]) <= kShapeFollowed * held.wanted[i];
  return is_down && has_followed;
}

bool is_exhausted(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least) {
  return std::all_of(which.begin(), which.end(), [&](std::size_t i) { return is_at_least(held, i, least); });
}

std::string held_by(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least) {
  if (which.empty()) return "held by volumes that are not at the end of this link";
  std::vector<std::size_t> holding;
  for (const std::size_t i : which)
    if (is_above_least(held, i, least)) holding.push_back(i);
  if (holding.empty() && which.size() == 1)
    return "held by `" + held.ids[which.front()] + "`, which is down to " + shortest(100 * least) + " % of its demand";
  if (holding.empty()) return "all are down to " + shortest(100 * least) + " % of their demands";
  std::stable_sort(holding.begin(), holding.end(), [&](std::size_t a, std::size_t b) { return held.wanted[a] > held.wanted[b]; });
  std::string text = "held by";
  for (std::size_t k = 0; k < std::min(kMostHolders, holding.size()); ++k)
    text += (k == 0 ? " `" : ", `") + held.ids[holding[k]] + "` (" + fixed(held.wanted[holding[k]], 0) + " m³" +
            (is_locked_up(held, holding[k], least) ? ", its limit is locked)" : " are insisted on)");
  if (holding.size() > kMostHolders) text += " and " + std::to_string(holding.size() - kMostHolders) + " more";
  return text;
}

std::string unlocking(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least) {
  const bool is_any = std::any_of(which.begin(), which.end(), [&](std::size_t i) { return is_locked_up(held, i, least); });
  return is_any ? " unlock the limits," : "";
}

std::vector<std::optional<double>> limits_under_cap(const LimitedVolumes& held, const Cap& cap) {
  const double answer = 1 + cap.gain * (answer_within(cap.most, cap.now, cap.tolerance) - 1);
  const double granted = share_granted(held, held.ids.size(), [](std::size_t i) { return i; });
  const double share = std::max(cap.least, granted * answer);
  std::vector<std::optional<double>> limits;
  if (share >= 1) return limits;
  limits.reserve(held.demands.size());
  for (const double demand : held.demands) limits.push_back(limit_that_grants(demand, share));
  return limits;
}

std::string why_cap_fails(const LimitedVolumes& held, const Cap& cap, const std::string& found, const std::string& raise) {
  const std::vector<std::size_t> all = all_of(held);
  if (!is_exhausted(held, all, cap.least)) return {};
  return found + ", " + held_by(held, all, cap.least) + "; raise " + raise + "," + unlocking(held, all, cap.least) +
         " or lower what is insisted on or `least`";
}

}  // namespace bl::demand
