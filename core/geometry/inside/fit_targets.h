// The demands of a fit, as they are aimed at: which sites each has, what it may have, what it has.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/demand_fit.h"

namespace bl::geometry {

/// Bounds that make sense, sites that are there and belong to one demand only; or an error that names what is wrong.
Result<void> check_demands(const FitProblem& problem);
/// The same for one demand per site, `locked` or not; no `locked`: none is.
Result<void> check_demands(std::size_t site_count, std::span<const double> demands, std::span<const std::uint8_t> locked);

/// Demands with their sites. A demand without sites (a locked site's, say) takes no part.
class FitTargets {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// One demand per site.
  FitTargets(std::span<const double> demands, std::span<const std::uint8_t> locked);
  explicit FitTargets(const FitProblem& problem);

  std::size_t size() const { return least_.size(); }
  std::span<const std::uint32_t> sites(std::size_t target) const {
    return std::span(members_).subspan(first_[target], first_[target + 1] - first_[target]);
  }
  /// The demand that a site belongs to, or kNone.
  std::uint32_t owner(std::size_t site) const { return owner_[site]; }
  /// Is the site's weight to be found?
  bool is_fitted(std::size_t site) const { return owner_[site] != kNone && most_[owner_[site]] > 0; }
  /// Has every site a demand of its own, and that one volume?
  bool is_plain() const;
  double least(std::size_t target) const { return least_[target]; }
  double most(std::size_t target) const { return most_[target]; }
  /// A site's part of what its demand aims at [m³].
  double part(std::size_t site) const {
    const std::uint32_t k = owner_[site];
    return aim_[k] / static_cast<double>(first_[k + 1] - first_[k]);
  }

  /// Does any demand have several sites?
  bool has_groups() const { return has_groups_; }

  /// What can be granted: lost sites, such as coincident ones and those out of reach (one flag for each site), bring nothing, and
  /// all demands are scaled alike where their least sum exceeds what the others (locked, or of no demand) leave of the domain.
  /// Volumes are per site here and below.
  void grant(std::span<const double> volumes, double domain_volume, std::span<const std::uint8_t> is_lost);
  const std::string& infeasible() const { return infeasible_; }
  const std::vector<DemandLoss>& losses() const { return losses_; }
  /// Do the demands take the whole domain, so that no surface is left free?
  bool is_full() const { return is_full_; }

  /// Sums volumes per demand, and finds what each aims at: the nearer bound where it is out of bounds.
  void measure(std::span<const double> volumes);
  double total(std::size_t target) const { return total_[target]; }
  double aim(std::size_t target) const { return aim_[target]; }
  const std::vector<double>& aims() const { return aim_; }
  /// Has its weights to move: it is out of bounds, or at one of them.
  bool is_active(std::size_t target) const { return is_active_[target] != 0; }
  double error(std::size_t target) const {
    if (!(most_[target] > 0) || sites(target).empty()) return 0;
    const double bound = std::clamp(total_[target], least_[target], most_[target]);
    return bound > 0 ? std::abs(total_[target] - bound) / bound : 0;
  }

 private:
  std::vector<double> least_, most_, total_, aim_;
  std::vector<std::uint32_t> first_, members_, owner_;
  std::vector<std::uint8_t> is_active_;
  std::string infeasible_;
  std::vector<DemandLoss> losses_;
  bool is_full_ = false, has_groups_ = false;
  bool is_each_its_own_ = false;  // demand k is that of site k alone, and one volume
};

}  // namespace bl::geometry
