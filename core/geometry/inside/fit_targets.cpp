// Book-keeping of demands: grants, sums and errors.
#include "core/geometry/inside/fit_targets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/text.h"

namespace bl::geometry {

namespace {

// A demand between two bounds is held at a bound that it is this near to, so that it does not flutter there.
constexpr double kNearBound = 1e-3;
// Less than this share of the domain left free counts as full.
constexpr double kFullShare = 1e-7;

}  // namespace

Result<void> check_demands(const FitProblem& problem) {
  std::vector<std::uint32_t> owner(problem.sites.size(), FitTargets::kNone);
  for (std::uint32_t k = 0; k < problem.demands.size(); ++k) {
    const VolumeDemand& demand = problem.demands[k];
    const std::string name = "demand " + std::to_string(k);
    if (demand.sites.empty()) return Error{ErrorCode::out_of_range, "", name + " has no site"};
    if (!std::isfinite(demand.least) || std::isnan(demand.most))
      return Error{ErrorCode::not_finite, "", name + " is not a number"};
    if (demand.least < 0 || demand.most < demand.least) {
      return Error{ErrorCode::out_of_range, "", name + " has to be from zero or more up to no less than that"};
    }
    if (demand.kind == VolumeDemand::Kind::floor_area && !(demand.storey_height > 0 && std::isfinite(demand.storey_height))) {
      return Error{ErrorCode::out_of_range, "", name + " needs a storey height above zero"};
    }
    for (const std::uint32_t site : demand.sites) {
      if (site >= owner.size()) {
        return Error{ErrorCode::out_of_range, "", name + " names site " + std::to_string(site) + ", which is not there"};
      }
      if (owner[site] != FitTargets::kNone) {
        return Error{ErrorCode::conflict, "",
                     "site " + std::to_string(site) + " belongs to demand " + std::to_string(owner[site]) + " and to " + name};
      }
      owner[site] = k;
    }
  }
  return {};
}

Result<void> check_demands(std::size_t site_count, std::span<const double> demands, std::span<const std::uint8_t> locked) {
  if (demands.size() != site_count || (!locked.empty() && locked.size() != site_count)) {
    return Error{ErrorCode::out_of_range, "", "there has to be one demand, and one lock or none, for each site"};
  }
  for (std::size_t i = 0; i < demands.size(); ++i) {
    const auto refused = [&](ErrorCode code, const char* what) {
      return Error{code, "", "the demand of site " + std::to_string(i) + what};
    };
    if (!std::isfinite(demands[i])) return refused(ErrorCode::not_finite, " is not a number");
    if (demands[i] < 0) return refused(ErrorCode::out_of_range, " is negative");
  }
  return {};
}

FitTargets::FitTargets(std::span<const double> demands, std::span<const std::uint8_t> locked)
    : least_(demands.begin(), demands.end()),
      most_(least_),
      total_(least_.size(), 0),
      aim_(least_),
      first_(1, 0),
      owner_(demands.size(), kNone),
      is_active_(demands.size(), 1),
      is_each_its_own_(locked.empty()) {
  first_.reserve(demands.size() + 1);
  members_.reserve(demands.size());
  for (std::uint32_t i = 0; i < demands.size(); ++i) {
    if (locked.empty() || !locked[i]) {
      members_.push_back(i);
      owner_[i] = i;
    }
    first_.push_back(static_cast<std::uint32_t>(members_.size()));
  }
}

FitTargets::FitTargets(const FitProblem& problem) : first_(1, 0), owner_(problem.sites.size(), kNone) {
  for (std::uint32_t k = 0; k < problem.demands.size(); ++k) {
    const VolumeDemand& demand = problem.demands[k];
    least_.push_back(demand.least);
    most_.push_back(demand.most);
    for (const std::uint32_t site : demand.sites) {
      members_.push_back(site);
      owner_[site] = k;
    }
    has_groups_ = has_groups_ || demand.sites.size() > 1;
    first_.push_back(static_cast<std::uint32_t>(members_.size()));
  }
  total_.assign(least_.size(), 0);
  is_active_.assign(least_.size(), 1);
  for (std::size_t k = 0; k < least_.size(); ++k)
    aim_.push_back(std::isfinite(most_[k]) ? 0.5 * (least_[k] + most_[k]) : least_[k]);
}

bool FitTargets::is_plain() const {
  if (is_each_its_own_) return true;
  for (std::size_t i = 0; i < owner_.size(); ++i) {
    const std::uint32_t k = owner_[i];
    if (k == kNone || sites(k).size() != 1 || least_[k] != most_[k]) return false;
  }
  return true;
}

void FitTargets::grant(std::span<const double> volumes, double domain_volume, std::span<const std::uint8_t> is_lost) {
  std::vector<double> asked;  // where anything may be less than that
  double wanted = 0, taken = 0;
  if (is_each_its_own_ && std::none_of(is_lost.begin(), is_lost.end(), [](std::uint8_t lost) { return lost != 0; })) {
    for (const double least : least_) wanted += least;
  } else {
    asked = least_;
    for (std::size_t i = 0; i < volumes.size(); ++i)
      if (owner_[i] == kNone) taken += volumes[i];
    for (std::size_t k = 0; k < size(); ++k) {
      const auto members = sites(k);
      if (members.empty()) continue;
      if (std::all_of(members.begin(), members.end(), [&](std::uint32_t i) { return is_lost[i] != 0; })) least_[k] = most_[k] = 0;
      wanted += least_[k];
    }
  }
  const double room = std::max(0.0, domain_volume - taken);
  double share = 1;
  if (wanted > room * (1 + 1e-12)) {
    share = room / wanted;
    const int digits = wanted < 100 ? 4 : 1;
    infeasible_ = "the demands exceed the domain: " + fixed(wanted, digits) + " m³ are asked for, " + fixed(room, digits) +
                  " m³ are there; each site gets " + fixed(100 * share, 1) + " % of its demand";
  }
  if (share < 1 && asked.empty()) asked = least_;
  for (std::uint32_t k = 0; k < asked.size(); ++k) {
    if (sites(k).empty()) continue;
    least_[k] *= share;
    if (share < 1) most_[k] = least_[k];
    if (least_[k] < asked[k]) losses_.push_back({k, asked[k], least_[k]});
    aim_[k] = std::clamp(aim_[k] * share, least_[k], most_[k]);
  }
  is_full_ = std::min(wanted, room) >= (1 - kFullShare) * room && taken == 0;
}

void FitTargets::measure(std::span<const double> volumes) {
  if (is_each_its_own_) {
    // What the loop below comes to: such demands always aim at the same.
    total_.assign(volumes.begin(), volumes.end());
    return;
  }
  for (std::size_t k = 0; k < size(); ++k) {
    double sum = 0;
    for (const std::uint32_t i : sites(k)) sum += volumes[i];
    total_[k] = sum;
    if (sites(k).empty()) continue;
    const bool is_exact = least_[k] == most_[k];
    is_active_[k] = is_exact || sum < least_[k] * (1 + kNearBound) || sum > most_[k] * (1 - kNearBound);
    aim_[k] = !is_active_[k] || is_exact         ? std::clamp(sum, least_[k], most_[k])
              : sum - least_[k] < most_[k] - sum ? least_[k]
                                                 : most_[k];
  }
}

}  // namespace bl::geometry
