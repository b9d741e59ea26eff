// Feeds the fit with nasty sites and problems: groups, intervals, floor areas, locks, too much demand, and nonsense.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/domain_makers.h"
#include "core/geometry/power_cells.h"
#include "core/geometry/volume_fit.h"
#include "tests/fuzz/nasty_sets.h"
#include "tests/fuzz/require.h"

namespace {

using bl::fuzz::Bytes;
using bl::fuzz::require;
using bl::geometry::Domain;
using bl::geometry::FitProblem;
using bl::geometry::FitStatus;
using bl::geometry::VolumeDemand;
using bl::geometry::VolumeFit;
using bl::geometry::VolumeFitOptions;

// A convex domain, or an L with a hole.
bl::geometry::Domain make_solid(Bytes& bytes) {
  if (bytes.next() % 3 != 0) return bl::fuzz::make_domain(bytes);
  const std::vector<bl::Point3> plan{{0, 0, 0}, {10, 0, 0}, {10, 5, 0}, {5, 5, 0}, {5, 10, 0}, {0, 10, 0}};
  const std::vector<std::vector<bl::Point3>> holes{{{1, 1, 0}, {2, 1, 0}, {2, 3, 0}}};
  return bl::geometry::extrude_plan(plan, holes, 0, 10).value();
}

double make_amount(Bytes& bytes, double fair) {
  switch (bytes.next() % 8) {
    case 0: return 0;
    case 1: return 1e-12 * fair;
    case 2: return 50 * fair;
    case 3: return 1e25;
    default: return 2 * fair * bytes.share();
  }
}

// Each site joins the demand before it, starts one of its own, or keeps its weight.
bl::geometry::FitProblem make_problem(Bytes& bytes, const bl::geometry::Domain& domain) {
  bl::geometry::FitProblem problem;
  std::array<std::uint8_t, 6> choices{};  // short inputs shall have sites, too: later sites vary those of the first
  for (std::uint8_t& choice : choices) choice = bytes.next();
  const std::uint8_t mode = bytes.next();
  problem.sites = bl::fuzz::make_sites(bytes, domain.minimum, 24);
  const double fair = domain.volume / static_cast<double>(problem.sites.size() + 1);
  for (std::uint32_t site = 0; site < problem.sites.size(); ++site) {
    const auto choice = static_cast<std::uint8_t>(choices[site % 6] + 53 * (site / 6));
    if ((mode & 1u) != 0) problem.sites[site].weight = 0;
    if (choice < 32) continue;
    if (choice < 80 && !problem.demands.empty()) {
      problem.demands.back().sites.push_back(site);
      continue;
    }
    bl::geometry::VolumeDemand demand;
    demand.sites = {site};
    demand.least = (mode & 2u) != 0 ? make_amount(bytes, fair) : 0.8 * fair;
    demand.most = (choice & 3u) == 0 ? demand.least + make_amount(bytes, fair) : demand.least;
    if ((choice & 28u) == 0) {
      demand.kind = bl::geometry::VolumeDemand::Kind::floor_area;
      demand.storey_height = (choice & 32u) != 0 ? 3 : 0.01;
    }
    problem.demands.push_back(demand);
  }
  return problem;
}

// One thing that makes no sense; false where the problem has no room for it.
bool spoil(Bytes& bytes, bl::geometry::FitProblem& problem) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  if (problem.demands.empty()) return false;
  bl::geometry::VolumeDemand& demand = problem.demands[bytes.next() % problem.demands.size()];
  switch (bytes.next() % 8) {
    case 0: demand.sites.push_back(static_cast<std::uint32_t>(problem.sites.size())); return true;
    case 1: demand.sites.push_back(0xffffffffu); return true;
    case 2: demand.sites.push_back(demand.sites.front()); return true;
    case 3: problem.demands.push_back(demand); return true;
    case 4: demand.least = demand.most = nan; return true;
    case 5: demand.most = infinity; return true;
    case 6: problem.sites[demand.sites.front()].position.y = nan; return true;
    default: demand.least = demand.most = -1; return true;
  }
}

void check_weights(const bl::geometry::FitProblem& problem, const bl::geometry::VolumeFit& fit) {
  const std::size_t count = problem.sites.size();
  require(fit.weights.size() == count && fit.volumes.size() == count, "every site is accounted for");
  std::vector<bool> is_free(count, false);
  for (const bl::geometry::VolumeDemand& demand : problem.demands)
    for (const std::uint32_t site : demand.sites) is_free[site] = true;
  for (std::size_t i = 0; i < count; ++i) {
    require(std::isfinite(fit.weights[i]) && std::abs(fit.weights[i]) <= bl::geometry::kLargestWeight, "weights are finite");
    require(std::isfinite(fit.volumes[i]) && fit.volumes[i] >= 0, "volumes are finite");
    require(is_free[i] || fit.weights[i] == problem.sites[i].weight, "who has no demand keeps the weight");
  }
}

void check_report(const bl::geometry::FitProblem& problem, const bl::geometry::VolumeFit& fit,
                  const bl::geometry::VolumeFitOptions& options) {
  require(fit.evaluations <= options.most_steps && fit.iterations <= options.most_steps, "the number of steps is bounded");
  require(!std::isnan(fit.max_relative_error) && fit.max_relative_error >= 0, "the error is a number");
  require(problem.demands.empty() || fit.worst_demand < problem.demands.size(), "the worst demand is one of them");
  require(fit.status != bl::geometry::FitStatus::met || fit.max_relative_error <= options.tolerance,
          "met means within the tolerance");
  require(fit.status != bl::geometry::FitStatus::infeasible || !fit.reasons.empty(), "what is infeasible has a reason");
  for (const bl::geometry::VolumeLoss& loss : fit.losses)
    require(loss.demand < problem.demands.size() && std::isfinite(loss.wanted) && std::isfinite(loss.had),
            "losses are of demands");
}

// The volumes of the report are those of its weights.
void check_volumes(const bl::geometry::Domain& domain, const bl::geometry::FitProblem& problem,
                   const bl::geometry::VolumeFit& fit) {
  if (fit.evaluations == 0) return;
  std::vector<bl::geometry::PowerSite> sites = problem.sites;
  for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = fit.weights[i];
  const auto cells = bl::geometry::power_cells(domain, sites, {.with_shape = false});
  require(cells.ok() && cells->size() == sites.size(), "the weights can be used");
  if (fit.status != bl::geometry::FitStatus::met) return;
  for (std::size_t i = 0; i < sites.size(); ++i)
    require(std::abs((*cells)[i].volume - fit.volumes[i]) <= 1e-9 * domain.volume, "the volumes are those of the weights");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const std::uint8_t mode = bytes.next();
  const bl::geometry::Domain domain = make_solid(bytes);
  bl::geometry::VolumeFitOptions options;
  options.method = (mode & 1u) != 0 ? bl::geometry::FitMethod::feedback : bl::geometry::FitMethod::newton;
  options.most_steps = 1 + mode / 16;
  options.tolerance = (mode & 2u) != 0 ? 1e-2 : 1e-6;
  const int last_step = (mode & 4u) != 0 ? 1 + bytes.next() % 4 : std::numeric_limits<int>::max();
  options.progress = [&](int steps, double) { return steps < last_step; };
  bl::geometry::FitProblem problem = make_problem(bytes, domain);
  if ((mode & 8u) != 0 && spoil(bytes, problem)) {
    const auto refused = bl::geometry::fit_volumes(domain, problem, options);
    require(!refused.ok() && !refused.error().message.empty(), "nonsense is refused with a sentence");
    return 0;
  }
  const auto fit = bl::geometry::fit_volumes(domain, problem, options);
  require(fit.ok(), "a problem that makes sense gets an answer");
  check_weights(problem, *fit);
  check_report(problem, *fit, options);
  check_volumes(domain, problem, *fit);
  require(fit->status != bl::geometry::FitStatus::cancelled || fit->evaluations <= last_step, "a fit stops where it is told to");
  const auto again = bl::geometry::fit_volumes(domain, problem, options);
  require(again.ok() && again->weights == fit->weights, "the same problem gives the same bits");
  return 0;
}
