// Finds weights that meet demanded volumes, step by step: by the feedback of 2007 without its gain, or by a damped Newton method.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/geometry/fit_problem.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// How weights follow the errors.
enum class FitMethod : std::uint8_t {
  feedback,  ///< each site by its own error, as in 2007; tens of steps, more in fuller domains
  newton,    ///< all sites together by the exact linear response; few steps at any fill
};

struct FitOptions {
  FitMethod method = FitMethod::feedback;
  double gain = 0;          ///< [1/m]: w += gain · (demand - volume), as in 2007; 0: each site by its own response dV/dw.
                            ///< Only for `feedback`
  int steps = 1;            ///< at most so many evaluations of the diagram
  double tolerance = 0.01;  ///< stop when no site differs from its (possibly scaled) demand by more than this share of it
  double damping = 1;       ///< share of the step that is taken with gain 0, in (0, 1]
  bool with_rays = true;    ///< `newton`: sites without weights start with those of `weights_by_rays`, where it finds any
  bool is_local = false;    ///< `newton`: where few of many sites miss their demands, only these and those around them move. It
                            ///< saves most of the work after a small change, and leaves errors within the tolerance as they are
  ThreadPool* pool = nullptr;
  PowerDiagram* diagram = nullptr;  ///< kept between calls, it reuses cells that cannot have changed; it changes no bit
  bool with_whole_cells = false;    ///< the diagram's cells are made whole and with outlines, for who completes them afterwards;
                                    ///< else only as far as their balls reach. It changes last bits of volumes
};

/// The state of the fit besides the weights. It is plain data, saved with the scene, so that a tick is a pure function of it.
struct FitState {
  std::vector<double> previous_move;  ///< last change of radius³ per site [m³]; empty: none yet
  std::vector<double> direction;      ///< newton: change of radius³ per site that the full step would be [m³]
  double momentum = 1;                ///< feedback: counter of the acceleration (Nesterov's t); 1: starting afresh
  std::uint64_t problem = 0;          ///< hash of domain, positions, demands and locks that the fields below belong to
  double residual = -1;    ///< newton: sqrt(sum of (V - D)²/D) before the last move [m^1.5]; negative: no move to be judged
  double share = 1;        ///< newton: share of the full step that the last move was; negative: after it, a few cells that
                           ///< it had nearly emptied were repaired; 0: emptied cells were repaired
  double least_ratio = 0;  ///< newton: smallest V/D that a step may lead to
  bool operator==(const FitState&) const = default;
};

/// A demand that cannot be met, and the volume that it gets instead.
struct DemandLoss {
  std::uint32_t site = 0;          ///< index of the demand: of the site, where each site has its own
  double demand = 0, granted = 0;  ///< [m³]
};

struct FitReport {
  std::vector<double> weights;     ///< [m²], to be used next
  std::vector<double> evaluated;   ///< [m²], those of the last evaluation
  FitState state;                  ///< to be handed to the next call
  std::vector<double> demands;     ///< [m³] per demand, what was aimed at: as given, or scaled where infeasible
  std::vector<double> volumes;     ///< [m³] per site at the last evaluation, which is of `weights` where `is_met`
  double error = 0;                ///< largest |volume - demand| / demand of those that are free, at the last evaluation
  std::uint32_t worst_site = 0;    ///< which demand has it
  int steps = 0;                   ///< evaluations made
  int iterations = 0;              ///< steps begun: evaluations less those that judged a repair or a step taken back
  bool began_with_rays = false;    ///< and continues from there: where that fails, a start without rays may succeed
  bool is_met = false;             ///< error <= tolerance: `weights` are those that were evaluated
  std::string infeasible;          ///< a sentence where the demands exceed the domain; else empty
  std::vector<DemandLoss> losses;  ///< one for each site that gets less than it asked for
};

/// Equal weights [m²] from which no site inside the domain is empty (the diagram is then an ordinary Voronoi diagram):
/// a common radius from the mean demand, enlarged with the fill f by -ln(1-f)/f.
std::vector<double> initial_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands);

/// Takes up to `options.steps` steps from the weights of `sites` towards volume = demand [m³] for each site that is not locked
/// (`locked` empty: all free). Weights of locked sites stay. Pure: the same arguments give the same bits. If the sum of the
/// demands exceeds the domain, all are scaled by one factor, and the report lists the loss of each site.
Result<FitReport> adapt_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands,
                                std::span<const std::uint8_t> locked, const FitState& state, const FitOptions& options);

/// The same for demands of groups of sites and between two bounds. The sum of a group meets its demand, all of its weights
/// moving alike; a demand that lies between its bounds leaves its weights as they are. Demands are volumes here.
Result<FitReport> adapt_weights(const Domain& domain, const FitProblem& problem, const FitState& state,
                                const FitOptions& options);

}  // namespace bl::geometry
