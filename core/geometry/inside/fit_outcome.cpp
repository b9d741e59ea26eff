// Sums and sentences that both fits end with.
#include "core/geometry/inside/fit_outcome.h"

#include <algorithm>
#include <cmath>

#include "core/base/text.h"

namespace bl::geometry {

namespace {

// Reasons that are written out; more are counted.
constexpr std::size_t kMostReasons = 20;
// Sites of a group that are named; more are counted.
constexpr std::size_t kMostNamed = 6;

std::string loss_text(const VolumeLoss& loss, const VolumeDemand& demand, const CellMeasure& first) {
  const bool is_floor = demand.kind == VolumeDemand::Kind::floor_area;
  std::string text = sites_text(demand) + " has " + shortest(loss.had) + (is_floor ? " m² of floor" : " m³") + " instead of " +
                     shortest(loss.wanted);
  if (!first.reason.empty() && demand.sites.size() == 1) text += ": " + first.reason;
  return text;
}

}  // namespace

bool ask_for_volumes(FitProblem& problem) {
  bool has_floors = false;
  for (VolumeDemand& demand : problem.demands) {
    if (demand.kind != VolumeDemand::Kind::floor_area) continue;
    has_floors = true;
    demand.least *= demand.storey_height;
    demand.most *= demand.storey_height;
  }
  return has_floors;
}

std::vector<double> storey_heights_of(const Domain& domain, const FitProblem& problem) {
  std::vector<double> heights(problem.sites.size(), domain.maximum.z - domain.minimum.z);
  for (const VolumeDemand& demand : problem.demands) {
    if (demand.kind != VolumeDemand::Kind::floor_area) continue;
    for (const std::uint32_t i : demand.sites) heights[i] = demand.storey_height;
  }
  return heights;
}

bool correct_floors(const FitProblem& asked, std::span<const CellMeasure> cells, double tolerance, FitProblem& problem) {
  bool all_met = true;
  for (std::size_t k = 0; k < problem.demands.size(); ++k) {
    const VolumeDemand& demand = asked.demands[k];
    if (demand.kind != VolumeDemand::Kind::floor_area) continue;
    const double floors = had(demand, cells), bound = std::clamp(floors, demand.least, demand.most);
    if (std::abs(floors - bound) <= tolerance * bound || !(floors > 0)) continue;
    all_met = false;
    double volume = 0;
    for (const std::uint32_t i : demand.sites) volume += cells[i].volume;
    problem.demands[k].least = problem.demands[k].most = volume * std::clamp(bound / floors, 0.7, 1.4);
  }
  return all_met;
}

double had(const VolumeDemand& demand, std::span<const CellMeasure> cells) {
  double sum = 0;
  for (const std::uint32_t i : demand.sites) {
    sum += demand.kind == VolumeDemand::Kind::floor_area ? cells[i].floor_area : cells[i].volume;
  }
  return sum;
}

std::string sites_text(const VolumeDemand& demand) {
  if (demand.sites.size() == 1) return "site " + std::to_string(demand.sites.front());
  const std::size_t count = demand.sites.size();
  std::string text = "the group of sites";
  for (std::size_t i = 0; i < std::min(count, kMostNamed); ++i) text += (i == 0 ? " " : ", ") + std::to_string(demand.sites[i]);
  return count > kMostNamed ? text + " and " + std::to_string(count - kMostNamed) + " more" : text;
}

void explain_losses(const FitProblem& problem, std::span<const CellMeasure> cells, VolumeFit& fit) {
  for (std::uint32_t i = 0; i < cells.size() && fit.reasons.size() < kMostReasons; ++i) {
    if (cells[i].state == SiteState::coincident) fit.reasons.push_back("site " + std::to_string(i) + " " + cells[i].reason);
  }
  // The one that misses most comes first: it is often the reason why the others miss theirs.
  std::vector<VolumeLoss> losses = fit.losses;
  const auto rank = [](const VolumeLoss& loss) {
    const double missed = std::abs(loss.wanted - loss.had) / std::max(1e-300, loss.wanted);
    return loss.had < loss.wanted ? 1 + missed : std::min(1.0, missed);
  };
  std::stable_sort(losses.begin(), losses.end(), [&](const VolumeLoss& a, const VolumeLoss& b) { return rank(a) > rank(b); });
  std::size_t more = 0;
  for (const VolumeLoss& loss : losses) {
    if (fit.reasons.size() >= kMostReasons) {
      ++more;
      continue;
    }
    const VolumeDemand& demand = problem.demands[loss.demand];
    fit.reasons.push_back(loss_text(loss, demand, cells[demand.sites.front()]));
  }
  if (more > 0) fit.reasons.push_back("and " + std::to_string(more) + " more demands that are not met");
}

}  // namespace bl::geometry
