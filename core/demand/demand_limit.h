// How rules that limit demands change their limits: the gain, the dead band, and the end.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bl::demand {

/// The least share that is granted: above 0, so that a demand can grow again in proportion.
inline constexpr double kLeastGranted = 1e-6;

/// The share of a demand that its limit leaves now, at most 1.
inline double granted_share(double demand, double limit) {
  return demand > 0 ? std::clamp(limit / demand, kLeastGranted, 1.0) : kLeastGranted;
}

/// The limit that grants a share of a demand. Nothing where all of it is granted: a limit above the demand has no effect, and
/// would still be in force when the demand grows.
inline std::optional<double> limit_that_grants(double demand, double share) {
  if (share >= 1) return std::nullopt;
  return demand * std::max(kLeastGranted, share);
}

/// The factor, at most 2, by which a rule that keeps an amount at or below `most` changes it. Inside a dead band below `most`,
/// `tolerance` times `most` wide, it is 1; from outside, the rule aims at the middle of the band. Volumes miss their demands by
/// errors that vary as weights adapt: without the band the rule would oscillate without end, and with the edge as its aim it
/// would stop at the edge. Amounts below `little` change faster than volumes can follow: the factor then follows the difference
/// to the aim as a share of `little`, and the band is at least a share of `little`.
inline double answer_within(double most, double now, double tolerance, double little = 0) {
  const double band = tolerance * std::max(most, little), middle = most - 0.5 * band;
  if (now <= most && now >= most - band) return 1;
  if (now >= little && now > 0) return std::clamp(middle / now, 0.0, 2.0);
  if (little > 0) return std::min(1 + (middle - now) / little, 2.0);
  return most > 0 ? 2 : 1;
}

/// "9000 of 8000": the present and the allowed amount, with at least `decimals` decimals, and as many as the two need to differ
/// and to show small limits as typed. The unit follows each number, with its space.
std::string found_of_allowed(double found, double allowed, int decimals, std::string_view unit = "");

/// The volumes that a rule limits, as parallel lists.
struct LimitedVolumes {
  std::span<const std::string> ids;
  std::span<const double> demands, limits, wanted, volumes;  ///< [m³]; wanted: what the solver aims at
  const std::vector<bool>& locked;                           ///< limits that people have locked
};

/// The share of their demands that the limits of `which` leave now: that of the least limited volume, because other rules may
/// limit some. A volume whose limit is locked does not count beside others.
double share_granted(const LimitedVolumes& held, const std::vector<std::size_t>& which);

/// Can the volume be limited no further? Its limit is at the least share or at the demand minimum, or is locked; and its shape,
/// if it has one, has followed.
bool is_at_least(const LimitedVolumes& held, std::size_t i, double least);
/// Can none of `which` be limited further? The rule then has no more effect.
bool is_exhausted(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);
/// Names the volumes that keep a rule from being met: those of `which` that are held above the least share, with their volumes,
/// largest first; or says that all are at that share, or that there are none.
std::string held_by(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);
/// A cap on a sum that the volumes make up: what it is now, and how the volumes are held to it.
struct Cap {
  double most, now;
  double gain;       ///< the share of the deviation that one tick answers
  double tolerance;  ///< the dead band, as a share of `most`
  double least;      ///< the share of a demand that the cap does not take away
};
/// The limits that bring the sum under the cap: all demands in one proportion. Empty where all of them are granted whole.
std::vector<std::optional<double>> limits_under_cap(const LimitedVolumes& held, const Cap& cap);
/// Why limits cannot bring the sum under the cap, and what helps; empty while they can. `found` is the sum and the cap in words,
/// `raise` what people may raise.
std::string why_cap_fails(const LimitedVolumes& held, const Cap& cap, const std::string& found, const std::string& raise);
/// " unlock the limits," where a lock keeps one of `which` above the least share: a part of the advice.
std::string unlocking(const LimitedVolumes& held, const std::vector<std::size_t>& which, double least);

}  // namespace bl::demand
