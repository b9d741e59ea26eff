// How rules that hold back demands go on from what is granted now: what they answer to, where they rest, and where they end.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bl::demand {

/// Never quite nothing is granted, so that a demand can grow again by shares of itself.
inline constexpr double kLeastGranted = 1e-6;

/// The share of a demand that its limit leaves now, at most 1.
inline double granted_share(double demand, double limit) {
  return demand > 0 ? std::clamp(limit / demand, kLeastGranted, 1.0) : kLeastGranted;
}

/// The limit that grants a share of a demand. Nothing where all of it is granted: a limit above the demand would hold back
/// nobody, and would still be there when the demand grows.
inline std::optional<double> limit_that_grants(double demand, double share) {
  if (share >= 1) return std::nullopt;
  return demand * std::max(kLeastGranted, share);
}

/// What a rule answers that keeps an amount at or below `most`: how many times what there is now it wants, at most twice. In a
/// band below `most`, `tolerance` times it wide, it rests; from outside it aims at the middle of the band. Volumes miss their
/// demands by errors of their own, which come and go as weights adapt: without the band the answer to them would swing for ever,
/// and if it aimed at the edge it would rest on the edge. Amounts below `little` come and go faster than volumes can follow: for
/// these the answer is to what is missing of `little`, and the band is a share of that.
inline double answer_within(double most, double now, double tolerance, double little = 0) {
  const double band = tolerance * std::max(most, little), middle = most - 0.5 * band;
  if (now <= most && now >= most - band) return 1;
  if (now >= little && now > 0) return std::clamp(middle / now, 0.0, 2.0);
  if (little > 0) return std::min(1 + (middle - now) / little, 2.0);
  return most > 0 ? 2 : 1;
}

/// "9000 of 8000": what there is and what is allowed, with as many decimals from `decimals` on as tell the two apart and show
/// small limits as they were typed. The unit follows each number, with its space.
std::string found_of_allowed(double found, double allowed, int decimals, std::string_view unit = "");

/// Volumes that a rule holds back, side by side.
struct LimitedVolumes {
  std::span<const std::string> ids;
  std::span<const double> demands, limits, wanted, volumes;  ///< [m³]; wanted: what the solver aims at
  const std::vector<bool>& locked;                           ///< limits that people hold where they are
};

/// The proportion of their demands that the limits of `which` leave now: that of the least limited one, because limits of others
/// may hold back some. One whose limit is locked follows nobody, so that it does not count beside others.
double share_granted(const LimitedVolumes& held, const std::vector<std::size_t>& which);

/// Can one give way no further: has it come down to the least share that a rule leaves it or to what is insisted on, or is its
/// limit locked, and has its shape followed, if it has one?
bool is_at_least(const LimitedVolumes& held, std::size_t i, double least);
/// Have all of `which` come down to that, and their shapes with them? Then the rule has no more to give.
bool is_exhausted(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);
/// Who keeps a rule from being met: those of `which` that are held above the least share, with what they have, largest first; or
/// that all are down to that share, or that there are none.
std::string held_by(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);
/// " unlock the limits," where a lock of people keeps one of `which` above the least share: a part of what to do about it.
std::string unlocking(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);

}  // namespace bl::demand
