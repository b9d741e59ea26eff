// The one-call fit: steps until the demands are met, floor areas by way of volumes, and reasons where it cannot be.
#include "core/geometry/volume_fit.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <span>
#include <utility>

#include "core/base/stop_check.h"
#include "core/base/text.h"
#include "core/geometry/inside/cell_workshop.h"
#include "core/geometry/inside/fit_outcome.h"
#include "core/geometry/inside/fit_targets.h"

namespace bl::geometry {

namespace {

// Floor areas are met by correcting the volumes asked for, which mostly takes three or four rounds; where it does not, it ends.
constexpr int kMostCorrections = 25;
// No nearer for so many evaluations, and the fit is going nowhere; or for so many, where there is another way to start.
constexpr int kStalled = 40, kStalledEarly = 15;
// Nearer to the demands by less than this is nowhere.
constexpr double kNearer = 0.9;
constexpr double kNoNumber = std::numeric_limits<double>::infinity();
// Beyond so many, a start with rays has brought nothing that one without would not.
constexpr int kMostWithRays = 40;

// Demands that differ by less than this are not brought apart by and by; each stage does so by the square root of it.
constexpr double kWideDemands = 1e4;
constexpr double kStageFactor = 1e2;
// A stage need only come near, and has so many evaluations for it.
constexpr double kStageTolerance = 0.2;
constexpr int kStageSteps = 25, kMostSpreadHalvings = 4;

// What a fit starts from: one after the other, until it gets somewhere. `eased`: from the weights of demands that lie nearer
// together.
enum class Start : std::uint8_t { given, rays, even, eased };

class Attempt {
 public:
  Attempt(const Domain& domain, const FitProblem& problem, const VolumeFitOptions& options)
      : domain_(domain), asked_(problem), problem_(problem), options_(options) {}

  Result<VolumeFit> run() {
    has_floors_ = ask_for_volumes(problem_);
    // Volumes a little closer than floor areas have to be, so that these have room to miss.
    const double tolerance = has_floors_ ? 0.3 * options_.tolerance : options_.tolerance;
    if (auto done = fit(tolerance); !done) return done.error();
    for (int k = 0; has_floors_ && k < kMostCorrections && result_.last.is_met && result_.last.infeasible.empty(); ++k) {
      if (result_.is_stopped || result_.evaluations >= options_.most_steps || is_stop_wished()) break;
      const auto cells = measure();
      if (!cells) return cells.error();
      if (correct_floors(asked_, *cells, options_.tolerance, problem_)) break;
      if (auto done = fit(tolerance); !done) return done.error();
    }
    return finish();
  }

 private:
  struct Outcome {
    FitReport last;
    bool is_stopped = false;
    int iterations = 0, evaluations = 0;
  };

  // How far a fit has come since its last start.
  struct Search {
    Start start = Start::given;
    double best = kNoNumber, error = kNoNumber, residual = kNoNumber;  // of all starts; of this one
    int evaluations = 0, since = 0;                                    // since the start, and since it last came much nearer
    std::vector<double> best_weights, best_volumes;

    void begin(Start with) {
      start = with;
      error = residual = kNoNumber;
      evaluations = since = 0;
    }
    void take(const FitReport& last) {
      ++evaluations;
      // Where one cell can only grow slowly its error stays the largest for long, while all others come nearer.
      const double left = last.state.residual < 0 ? kNoNumber : last.state.residual;
      ++since;
      if (last.error < kNearer * error) {
        error = last.error;
        since = 0;
      }
      if (left < kNearer * residual) {
        residual = left;
        since = 0;
      }
      if (best_weights.empty() || last.error < best) {
        best = last.error;
        best_weights = last.evaluated;
        best_volumes = last.volumes;
      }
    }
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
    Search search;
    search.begin(has_weights() ? Start::given : Start::rays);
    while (true) {
      step.with_rays = search.start != Start::even;
      auto report = adapt_weights(domain_, problem_, state, step);
      if (is_stop_wished()) return end_at_once(search);
      if (!report) return report.error();
      ++result_.evaluations;
      result_.iterations += report->iterations;
      result_.last = std::move(*report);
      const FitReport& last = result_.last;
      const bool goes_on = !options_.progress || options_.progress(result_.evaluations, last.error);
      search.take(last);
      // No rays, or none that led anywhere: what was measured is no start to be compared with.
      if (search.start == Start::rays && search.evaluations == 1 && !last.began_with_rays) search.begin(Start::even);
      if (last.is_met || !goes_on || result_.evaluations >= options_.most_steps || search.since > kStalled) {
        result_.is_stopped = !goes_on;
        // A step that went too far is no result: the best one is.
        if (!last.is_met) {
          result_.last.evaluated = search.best_weights;
          result_.last.volumes = search.best_volumes;
        }
        return {};
      }
      if (is_time_for_another(search)) {
        search.begin(search.start == Start::given ? Start::rays : search.start == Start::rays ? Start::even : Start::eased);
        state = {};
        forget_weights();
        if (search.start == Start::eased && !ease(step)) return end_at_once(search);
      } else {
        state = last.state;
        use(last.weights);
      }
    }
  }

  // What an evaluation has left that was stopped on the way is nothing to go by: the best one before it counts.
  Result<void> end_at_once(const Search& search) {
    result_.is_stopped = is_cut_short_ = true;
    result_.last.is_met = false;
    result_.last.evaluated = search.best_weights;
    result_.last.volumes = search.best_volumes;
    return {};
  }

  // Weights to start from may be a place that no step leads out of, and so may those that rays have found.
  bool is_time_for_another(const Search& search) const {
    if (search.start == Start::eased) return false;
    if (search.start == Start::even) return search.since > kStalledEarly && spread_of_demands() > kWideDemands;
    const bool is_late = search.start == Start::rays && search.evaluations >= kMostWithRays;
    return search.since > kStalledEarly || is_late;
  }

  // The largest demand as a multiple of the smallest one.
  double spread_of_demands() const {
    double least = kNoNumber, most = 0;
    for (const VolumeDemand& demand : problem_.demands) {
      if (!(demand.least > 0)) continue;
      least = std::min(least, demand.least);
      most = std::max(most, demand.least);
    }
    return most > 0 ? most / least : 1;
  }

  // The same sum, with demands nearer together: each raised to a power below one, which the stages bring up to it. A small cell
  // then never has to be found beside one that is millions of times larger, but only kept. False where the work was stopped.
  bool ease(FitOptions step) {
    const std::vector<VolumeDemand> wanted = problem_.demands;
    int halvings = 0;
    for (double reach = kStageFactor; reach < spread_of_demands() && halvings < kMostSpreadHalvings; reach *= reach) ++halvings;
    const unsigned stages = 1u << static_cast<unsigned>(halvings);
    step.with_rays = false;
    step.tolerance = kStageTolerance;
    for (unsigned stage = 1; stage < stages && result_.evaluations < options_.most_steps; ++stage) {
      ease_demands(wanted, stage, halvings);
      FitState state;
      for (int k = 0; k < kStageSteps && result_.evaluations < options_.most_steps; ++k) {
        auto report = adapt_weights(domain_, problem_, state, step);
        if (is_stop_wished() || !report) break;
        ++result_.evaluations;
        result_.iterations += report->iterations;
        use(report->weights);
        state = std::move(report->state);
        if (options_.progress && !options_.progress(result_.evaluations, report->error)) {
          problem_.demands = wanted;
          return false;
        }
        if (report->is_met) break;
      }
    }
    problem_.demands = wanted;
    return !is_stop_wished();
  }

  // x to the power numerator / 2^halvings, by square roots, which are the same everywhere.
  static double dyadic_power(double x, unsigned numerator, int halvings) {
    double power = 1;
    for (int bit = halvings - 1; bit >= 0; --bit) {
      x = std::sqrt(x);
      if ((numerator >> static_cast<unsigned>(bit) & 1u) != 0) power *= x;
    }
    return power;
  }

  void ease_demands(const std::vector<VolumeDemand>& wanted, unsigned numerator, int halvings) {
    double sum = 0, eased = 0;
    for (const VolumeDemand& demand : wanted) {
      sum += demand.least;
      eased += dyadic_power(demand.least, numerator, halvings);
    }
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      if (!(wanted[k].least > 0)) continue;
      const double factor = sum / eased * dyadic_power(wanted[k].least, numerator, halvings) / wanted[k].least;
      problem_.demands[k].least = factor * wanted[k].least;
      problem_.demands[k].most = factor * wanted[k].most;
    }
  }

  bool has_weights() const {
    return std::any_of(problem_.demands.begin(), problem_.demands.end(), [&](const VolumeDemand& demand) {
      return std::any_of(demand.sites.begin(), demand.sites.end(), [&](std::uint32_t i) { return problem_.sites[i].weight > 0; });
    });
  }
  void forget_weights() {
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
    const std::vector<double> storeys = storey_heights_of(domain_, asked_);
    cells.storey_heights = storeys;
    if (auto set = with_floors_.set_domain(domain_); !set) return set.error();
    return with_floors_.update(evaluated(), cells);
  }

  // Without measuring once more.
  VolumeFit finish_at_once() const {
    VolumeFit fit;
    fit.status = FitStatus::cancelled;
    fit.iterations = result_.iterations;
    fit.evaluations = result_.evaluations;
    fit.weights = result_.last.evaluated;
    fit.volumes = result_.last.volumes;
    for (std::size_t i = fit.weights.size(); i < asked_.sites.size(); ++i) fit.weights.push_back(asked_.sites[i].weight);
    fit.max_relative_error = std::numeric_limits<double>::quiet_NaN();  // floors and stopped evaluations have none
    for (std::uint32_t k = 0; k < asked_.demands.size() && !fit.volumes.empty() && !has_floors_; ++k) {
      const VolumeDemand& demand = asked_.demands[k];
      double has = 0;
      for (const std::uint32_t i : demand.sites) has += fit.volumes[i];
      const double bound = std::clamp(has, demand.least, demand.most);
      const double error = bound > 0 ? std::abs(has - bound) / bound : has > 0 ? 1.0 : 0.0;
      if (error > options_.tolerance) fit.losses.push_back({k, bound, has});
      if (error <= fit.max_relative_error) continue;
      fit.max_relative_error = error;
      fit.worst_demand = k;
    }
    return fit;
  }

  Result<VolumeFit> finish() {
    if (is_cut_short_ || is_stop_wished()) return finish_at_once();
    VolumeFit fit;
    const auto cells = measure();
    if (!cells) return cells.error();
    fit.iterations = result_.iterations;
    fit.evaluations = result_.evaluations;
    fit.weights = result_.last.evaluated;
    for (const CellMeasure& cell : *cells) fit.volumes.push_back(cell.volume);
    for (std::uint32_t k = 0; k < asked_.demands.size(); ++k) {
      const VolumeDemand& demand = asked_.demands[k];
      const double has = had(demand, *cells), bound = std::clamp(has, demand.least, demand.most);
      const double error = bound > 0 ? std::abs(has - bound) / bound : has > 0 ? 1.0 : 0.0;
      if (error > options_.tolerance) fit.losses.push_back({k, bound, has});
      if (!(error > fit.max_relative_error)) continue;
      fit.max_relative_error = error;
      fit.worst_demand = k;
    }
    // Whoever has nothing may only not have been found yet: that is no proof.
    const bool cannot = !result_.last.infeasible.empty() || !result_.last.losses.empty();
    // Of a fit that was stopped with its volumes met, the floors may not have been.
    const bool is_cancelled = result_.is_stopped && (!result_.last.is_met || (has_floors_ && !fit.losses.empty() && !cannot));
    fit.status = is_cancelled         ? FitStatus::cancelled
                 : fit.losses.empty() ? FitStatus::met
                 : cannot             ? FitStatus::infeasible
                                      : FitStatus::step_limit;
    explain(*cells, fit);
    return fit;
  }

  void explain(std::span<const CellMeasure> cells, VolumeFit& fit) const {
    if (!result_.last.infeasible.empty()) fit.reasons.push_back(result_.last.infeasible);
    if (fit.status == FitStatus::step_limit && !has_floors_) {
      fit.reasons.push_back("not met after " + std::to_string(fit.evaluations) +
                            (fit.evaluations == 1 ? " evaluation" : " evaluations") + ", with an error of " +
                            shortest(fit.max_relative_error) + " at " + sites_text(asked_.demands[fit.worst_demand]));
    }
    explain_losses(asked_, cells, fit);
  }

  const Domain& domain_;
  const FitProblem& asked_;
  FitProblem problem_;
  const VolumeFitOptions& options_;
  PowerDiagram diagram_, with_floors_;
  Outcome result_;
  bool has_floors_ = false, is_cut_short_ = false;
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

}  // namespace bl::geometry
