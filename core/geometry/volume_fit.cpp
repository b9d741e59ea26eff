// The one-call fit: steps until the demands are met, floor areas by way of volumes, and reasons where it cannot be.
#include "core/geometry/volume_fit.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <utility>

#include "core/base/text.h"
#include "core/geometry/cell_workshop.h"
#include "core/geometry/fit_targets.h"

namespace bl {

namespace {

// Floor areas are met by correcting the volumes asked for; they jump where a storey comes or goes, so this ends.
constexpr int kMostCorrections = 25;
// No smaller error for so many evaluations, and the fit is going nowhere.
constexpr int kStalled = 40;
// The same with weights to start from: there is another way.
constexpr int kStalledWarm = 15;
// Reasons that are written out; more are counted.
constexpr std::size_t kMostReasons = 20;

std::string sites_text(const VolumeDemand& demand) {
  if (demand.sites.size() == 1) return "site " + std::to_string(demand.sites.front());
  std::string text = "the group of sites";
  for (std::size_t i = 0; i < demand.sites.size() && i < 6; ++i) text += (i == 0 ? " " : ", ") + std::to_string(demand.sites[i]);
  return demand.sites.size() > 6 ? text + " and " + std::to_string(demand.sites.size() - 6) + " more" : text;
}

class Attempt {
 public:
  Attempt(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options)
      : domain_(domain), asked_(problem), problem_(problem), options_(options) {}

  Result<VolumeFit> run() {
    for (VolumeDemand& demand : problem_.demands) {
      if (demand.kind != VolumeDemand::Kind::floor_area) continue;
      has_floors_ = true;
      demand.least *= demand.storey_height;
      demand.most *= demand.storey_height;
    }
    // Volumes a little closer than floor areas have to be, so that these have room to miss.
    const double tolerance = has_floors_ ? 0.3 * options_.tolerance : options_.tolerance;
    if (auto done = fit(tolerance); !done) return done.error();
    for (int k = 0; has_floors_ && k < kMostCorrections && result_.last.is_met && result_.last.infeasible.empty(); ++k) {
      if (result_.evaluations >= options_.most_steps) break;
      auto corrected = correct_floors();
      if (!corrected) return corrected.error();
      if (*corrected) break;
      if (auto done = fit(tolerance); !done) return done.error();
    }
    return finish();
  }

 private:
  struct Outcome {
    FitReport last;
    bool is_cancelled = false;
    int iterations = 0, evaluations = 0;
  };

  Result<void> fit(double tolerance) {
    FitOptions step{.method = options_.method,
                    .gain = options_.gain,
                    .steps = 1,
                    .tolerance = tolerance,
                    .pool = options_.pool,
                    .diagram = &diagram_};
    // A corrected demand goes on from the weights that were found.
    if (!result_.last.evaluated.empty()) problem_.sites = evaluated();
    FitState state;
    double best = std::numeric_limits<double>::infinity();
    std::vector<double> best_weights(problem_.sites.size(), 0);
    bool is_warm = has_weights();
    int since = 0;
    while (true) {
      auto report = adapt_weights(domain_, problem_, state, step);
      if (!report) return report.error();
      ++result_.evaluations;
      result_.iterations += report->iterations;
      result_.last = std::move(*report);
      const FitReport& last = result_.last;
      const bool goes_on = !options_.progress || options_.progress(result_.evaluations, last.error);
      since = last.error < 0.9 * best ? 0 : since + 1;
      if (last.error < best) {
        best = last.error;
        best_weights = last.evaluated;
      }
      // Weights to start from may be a place that no step leads out of: then it starts by itself.
      if (is_warm && since > kStalledWarm && !last.is_met && goes_on && result_.evaluations < options_.most_steps) {
        is_warm = false;
        since = 0;
        state = {};
        start_afresh();
        continue;
      }
      if (last.is_met || !goes_on || result_.evaluations >= options_.most_steps || since > kStalled) {
        result_.is_cancelled = !goes_on && !last.is_met;
        // A step that went too far is no result: the best one is.
        if (!last.is_met) result_.last.evaluated = best_weights;
        return {};
      }
      state = last.state;
      use(last.weights);
    }
  }

  bool has_weights() const {
    return std::any_of(problem_.demands.begin(), problem_.demands.end(), [&](const VolumeDemand& demand) {
      return std::any_of(demand.sites.begin(), demand.sites.end(), [&](std::uint32_t i) { return problem_.sites[i].weight > 0; });
    });
  }
  void start_afresh() {
    for (const VolumeDemand& demand : problem_.demands) {
      for (const std::uint32_t i : demand.sites) problem_.sites[i].weight = 0;
    }
  }

  void use(std::span<const double> weights) {
    for (std::size_t i = 0; i < problem_.sites.size(); ++i) problem_.sites[i].weight = weights[i];
  }

  // The sites with the weights that were last evaluated.
  std::vector<PowerSite> evaluated() const {
    std::vector<PowerSite> sites = problem_.sites;
    for (std::size_t i = 0; i < sites.size(); ++i) sites[i].weight = result_.last.evaluated[i];
    return sites;
  }

  // The cells of the weights that were last evaluated; where no floors count, they are still there. Valid until the next call.
  Result<std::span<const CellMeasure>> measure() {
    CellOptions cells;
    cells.pool = options_.pool;
    cells.with_shape = has_floors_;
    cells.with_centroid = false;
    if (!has_floors_) return diagram_.update(evaluated(), cells);
    std::vector<double> storeys(problem_.sites.size(), domain_.maximum.z - domain_.minimum.z);
    for (const VolumeDemand& demand : asked_.demands) {
      for (const std::uint32_t i : demand.sites) {
        if (demand.kind == VolumeDemand::Kind::floor_area) storeys[i] = demand.storey_height;
      }
    }
    cells.storey_heights = storeys;
    return with_floors_.update(evaluated(), cells);
  }

  // Asks for other volumes where floor areas miss their demand. True where all are met, or nothing can be bettered.
  Result<bool> correct_floors() {
    const auto cells = measure();
    if (!cells) return cells.error();
    bool all_met = true;
    for (std::size_t k = 0; k < problem_.demands.size(); ++k) {
      if (asked_.demands[k].kind != VolumeDemand::Kind::floor_area) continue;
      double floors = 0, volume = 0;
      for (const std::uint32_t i : asked_.demands[k].sites) {
        floors += (*cells)[i].floor_area;
        volume += (*cells)[i].volume;
      }
      const double bound = std::clamp(floors, asked_.demands[k].least, asked_.demands[k].most);
      if (std::abs(floors - bound) <= options_.tolerance * bound || !(floors > 0)) continue;
      all_met = false;
      // By the cube root of what is missing: a smaller change is less likely to jump past a storey.
      const double factor = std::clamp(bound / floors, 0.7, 1.4);
      problem_.demands[k].least = problem_.demands[k].most = volume * (0.4 + 0.6 * factor);
    }
    return all_met;
  }

  double had(std::size_t k, std::span<const CellMeasure> cells) const {
    double sum = 0;
    for (const std::uint32_t i : asked_.demands[k].sites) {
      sum += asked_.demands[k].kind == VolumeDemand::Kind::floor_area ? cells[i].floor_area : cells[i].volume;
    }
    return sum;
  }

  Result<VolumeFit> finish() {
    VolumeFit fit;
    const auto cells = measure();
    if (!cells) return cells.error();
    fit.iterations = result_.iterations;
    fit.evaluations = result_.evaluations;
    fit.weights = result_.last.evaluated;
    for (const CellMeasure& cell : *cells) fit.volumes.push_back(cell.volume);
    for (std::uint32_t k = 0; k < asked_.demands.size(); ++k) {
      const VolumeDemand& demand = asked_.demands[k];
      const double has = had(k, *cells), bound = std::clamp(has, demand.least, demand.most);
      const double error = bound > 0 ? std::abs(has - bound) / bound : has > 0 ? 1.0 : 0.0;
      if (error > options_.tolerance) fit.losses.push_back({k, bound, has});
      if (!(error > fit.max_relative_error)) continue;
      fit.max_relative_error = error;
      fit.worst_demand = k;
    }
    fit.status = result_.is_cancelled                                                                     ? FitStatus::cancelled
                 : fit.losses.empty()                                                                     ? FitStatus::met
                 : !result_.last.infeasible.empty() || !result_.last.losses.empty() || is_held_up(*cells) ? FitStatus::infeasible
                                                                                                          : FitStatus::step_limit;
    explain(*cells, fit);
    return fit;
  }

  // Does a demand fail because its sites have no cell, or because sites of fixed weight leave it no room?
  bool is_held_up(std::span<const CellMeasure> cells) const {
    const bool has_fixed = problem_.sites.size() > demanded_sites();
    return std::any_of(asked_.demands.begin(), asked_.demands.end(), [&](const VolumeDemand& demand) {
      double sum = 0;
      for (const std::uint32_t i : demand.sites) sum += cells[i].volume;
      return demand.least > 0 && sum < 0.5 * demand.least && (has_fixed || sum == 0) && demand.kind == VolumeDemand::Kind::volume;
    });
  }

  std::size_t demanded_sites() const {
    std::size_t count = 0;
    for (const VolumeDemand& demand : asked_.demands) count += demand.sites.size();
    return count;
  }

  void explain(std::span<const CellMeasure> cells, VolumeFit& fit) const {
    if (!result_.last.infeasible.empty()) fit.reasons.push_back(result_.last.infeasible);
    if (fit.status == FitStatus::step_limit && !has_floors_) {
      fit.reasons.push_back("not met after " + std::to_string(fit.evaluations) +
                            (fit.evaluations == 1 ? " evaluation" : " evaluations") + ", with an error of " +
                            shortest(fit.max_relative_error) + " at " + sites_text(asked_.demands[fit.worst_demand]));
    }
    for (std::uint32_t i = 0; i < cells.size() && fit.reasons.size() < kMostReasons; ++i) {
      if (cells[i].state == SiteState::coincident) fit.reasons.push_back("site " + std::to_string(i) + " " + cells[i].reason);
    }
    std::size_t more = 0;
    for (const VolumeLoss& loss : fit.losses) {
      if (fit.reasons.size() >= kMostReasons) {
        ++more;
        continue;
      }
      const VolumeDemand& demand = asked_.demands[loss.demand];
      const bool is_floor = demand.kind == VolumeDemand::Kind::floor_area;
      std::string text = sites_text(demand) + " has " + shortest(loss.had) + (is_floor ? " m² of floor" : " m³") +
                         " instead of " + shortest(loss.wanted);
      const CellMeasure& cell = cells[demand.sites.front()];
      if (!cell.reason.empty() && demand.sites.size() == 1) text += ": " + cell.reason;
      if (is_floor && loss.had > 0 && fit.status == FitStatus::step_limit) {
        text += ": floor areas jump when a storey comes or goes, so this one cannot be met more closely";
      }
      fit.reasons.push_back(text);
    }
    if (more > 0) fit.reasons.push_back("and " + std::to_string(more) + " more demands that are not met");
  }

  const Domain& domain_;
  const FitProblem& asked_;
  FitProblem problem_;
  const VolumeFitOptions& options_;
  PowerDiagram diagram_, with_floors_;
  Outcome result_;
  bool has_floors_ = false;
};

}  // namespace

std::string_view name_of(FitStatus status) {
  switch (status) {
    case FitStatus::met: return "met";
    case FitStatus::infeasible: return "infeasible";
    case FitStatus::step_limit: return "step limit";
    case FitStatus::cancelled: return "cancelled";
  }
  return "unknown";
}

Result<VolumeFit> fit_volumes(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options) try {
  if (domain.pieces.empty()) return Error{ErrorCode::geometry, "", "the domain is empty"};
  if (auto checked = check_sites(problem.sites); !checked) return checked.error();
  if (auto checked = check_demands(problem); !checked) return checked.error();
  if (options.most_steps < 1) return Error{ErrorCode::out_of_range, "", "a fit takes at least one step"};
  if (!(options.tolerance > 0)) return Error{ErrorCode::out_of_range, "", "the tolerance has to be above zero"};
  return Attempt(domain, problem, options).run();
} catch (const std::exception& trouble) {
  return Error{ErrorCode::internal, "", std::string("the fit failed: ") + trouble.what()};
}

}  // namespace bl
