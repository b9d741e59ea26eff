// The feedback loop: each weight follows its own error, with acceleration, limits and repair.
#include "core/geometry/demand_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/hash.h"
#include "core/base/text.h"
#include "core/geometry/fit_numbers.h"
#include "core/geometry/response_system.h"

namespace bl {

namespace {

// In one step r³ at most doubles, and loses at most half: beyond that the linear response says nothing any more.
constexpr double kMostGrowth = 2, kMostLoss = 0.5;
// An emptied cell's site is put back into its own cell by this margin (1 would put it on the bisector).
constexpr double kRepair = 0.8;
// Newton's step leaves at least this share of r³.
constexpr double kLeastOfCube = 0.1;
// Newton's step is halved no further than this.
constexpr double kLeastStep = 1.0 / 256;
// Share of the diagonal step: the response matrix, scaled by its diagonal, has eigenvalues between 0 and 2.
constexpr double kStep = 0.8;
// A weight never falls below this share of the weight whose whole ball has the demanded volume.
constexpr double kLeastShare = 1e-4;
// A free ball never exceeds so many times what it takes to hold the whole domain: more weight only drowns the others.
constexpr double kMostReach = 4;

// The position itself where it is inside; else the nearest place on the way to the middle of the nearest piece.
Point3 place_inside(const Domain& domain, const Point3& position) {
  if (domain.contains(position)) return position;
  const ConvexDomain& piece = domain.nearest_piece(position);
  const Vector3 way = position - piece.centroid;
  return piece.centroid + (0.99 * piece.share_inside(way, 1)) * way;
}

class Fit {
 public:
  Fit(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands,
      std::span<const std::uint8_t> locked, const FitState& state, const FitOptions& options)
      : domain_(domain), options_(options), sites_(sites.begin(), sites.end()), free_(sites.size(), 1) {
    for (std::size_t i = 0; i < locked.size(); ++i) free_[i] = locked[i] == 0;
    report_.demands.assign(demands.begin(), demands.end());
    report_.state = state;
    if (report_.state.previous_move.size() != sites.size()) {
      report_.state = {};
      report_.state.previous_move.assign(sites.size(), 0);
    }
    recognise(sites, demands);
    start_fresh_sites();
    keep_in_bounds();
  }

  Result<FitReport> run() {
    PowerDiagram diagram;
    if (auto set = diagram.set_domain(domain_); !set) return set.error();
    CellOptions cells;
    cells.with_shape = false;
    cells.pool = options_.pool;
    for (int step = 0; step < std::max(1, options_.steps); ++step) {
      const auto measured = diagram.update(sites_, cells);
      if (!measured) return measured.error();
      if (step == 0) grant(*measured);
      report_.steps = step + 1;
      judge(*measured);
      if (report_.is_met) break;
      move(*measured);
      keep_in_bounds();
    }
    for (const PowerSite& site : sites_) report_.weights.push_back(site.weight);
    return std::move(report_);
  }

 private:
  // Free sites without a weight yet: all of them alike where no site has one, else each by its own demand.
  void start_fresh_sites() {
    const bool all_fresh = std::none_of(sites_.begin(), sites_.end(), [](const PowerSite& s) { return s.weight > 0; });
    std::vector<double> start;
    if (all_fresh) start = initial_weights(domain_, sites_, report_.demands);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (!free_[i] || sites_[i].weight > 0) continue;
      sites_[i].weight = all_fresh ? start[i] : weight_of_volume(report_.demands[i]);
    }
  }

  void keep_in_bounds() {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      const double reach = kMostReach * (domain_.size() + distance(sites_[i].position, domain_.centroid));
      if (free_[i]) sites_[i].weight = std::clamp(sites_[i].weight, 0.0, std::min(kLargestWeight, reach * reach));
    }
  }

  // What can be granted: coincident sites get nothing, and the rest is scaled where it exceeds the domain.
  void grant(std::span<const CellMeasure> cells) {
    const std::vector<double> asked = report_.demands;
    double wanted = 0, taken = 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (!free_[i]) {
        taken += cells[i].volume;
      } else if (cells[i].state == SiteState::coincident) {
        report_.demands[i] = 0;
      } else {
        wanted += asked[i];
      }
    }
    const double room = std::max(0.0, domain_.volume - taken);
    if (wanted > room * (1 + 1e-12)) {
      const double share = room / wanted;
      for (std::size_t i = 0; i < sites_.size(); ++i) {
        if (free_[i]) report_.demands[i] *= share;
      }
      report_.infeasible = "the demands exceed the domain: " + fixed(wanted, 1) + " m³ are asked for, " + fixed(room, 1) +
                           " m³ are there; each site gets " + fixed(100 * share, 1) + " % of its demand";
    }
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
      if (free_[i] && report_.demands[i] < asked[i]) report_.losses.push_back({i, asked[i], report_.demands[i]});
      if (free_[i] && !(report_.demands[i] > 0)) sites_[i].weight = 0;
    }
  }

  bool is_fitted(std::size_t i) const { return free_[i] && report_.demands[i] > 0; }

  void judge(std::span<const CellMeasure> cells) {
    report_.volumes.resize(cells.size());
    report_.error = 0;
    report_.worst_site = 0;
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
      report_.volumes[i] = cells[i].volume;
      if (!is_fitted(i)) continue;
      const double error = std::abs(cells[i].volume - report_.demands[i]) / report_.demands[i];
      if (error > report_.error) {
        report_.error = error;
        report_.worst_site = i;
      }
    }
    report_.is_met = report_.error <= options_.tolerance;
  }

  // Weight that brings an emptied cell back: with it the site wins at its own position (or at a place inside the domain).
  double repaired_weight(std::size_t i) const {
    const Point3 place = place_inside(domain_, sites_[i].position);
    double best = 0.1 * weight_of_volume(report_.demands[i]);
    for (std::size_t j = 0; j < sites_.size(); ++j) {
      if (j != i) best = std::max(best, sites_[j].weight - kRepair * squared_norm(sites_[j].position - place));
    }
    return std::max(sites_[i].weight, best + squared_norm(place - sites_[i].position));
  }

  // The change of weight [m²] that brings one cell to its demand while the others stay. A cell bounded by its neighbours
  // grows like the cube of the change, a free ball slower, so a cell far too small is led by its cube root, and one too
  // large by its volume: of the two estimates always the more careful one.
  static double response_step(const CellMeasure& cell, double demand) {
    const double linear = (demand - cell.volume) / cell.volume_by_own_weight;
    if (demand <= cell.volume) return linear;
    const double side = cube_root(cell.volume);
    return std::min(linear, 3 * side * side * (cube_root(demand) - side) / cell.volume_by_own_weight);
  }

  void move(std::span<const CellMeasure> cells) {
    if (options_.method == FitMethod::newton) return move_together(cells);
    if (options_.gain > 0) return move_by_gain(cells);
    move_alone(cells);
  }

  // Feedback: each site by its own response, with Nesterov's acceleration in radius³ (the ball's volume is linear in it).
  void move_alone(std::span<const CellMeasure> cells) {
    FitState& state = report_.state;
    // Against the slope: the acceleration has overshot and starts again (O'Donoghue and Candès 2015).
    double agreement = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (is_fitted(i))
        agreement += (report_.demands[i] - cells[i].volume) * state.previous_move[i] / std::max(1e-300, sites_[i].weight);
    }
    if (agreement < 0) state.momentum = 1;
    const double next = 0.5 * (1 + std::sqrt(1 + 4 * state.momentum * state.momentum));
    const double share = (state.momentum - 1) / next;
    state.momentum = next;
    std::vector<double> weights(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      weights[i] = sites_[i].weight;
      if (!is_fitted(i)) continue;
      if (!(cells[i].volume > 0) || !(cells[i].volume_by_own_weight > 0)) {
        // Emptied by its own last move: half of that back. Otherwise its neighbours did it.
        const double back = -0.5 * state.previous_move[i];
        weights[i] = back > 0 ? weight_of_cube(cube_of_radius(sites_[i].weight) + back) : repaired_weight(i);
        state.previous_move[i] = 0;
        continue;
      }
      const double cube = cube_of_radius(sites_[i].weight), stretch = 1.5 * std::sqrt(sites_[i].weight);
      const double step = options_.damping * kStep * stretch * response_step(cells[i], report_.demands[i]);
      const double volume = cells[i].volume, per_volume = stretch / cells[i].volume_by_own_weight;
      const double least = std::max((kMostLoss - 1) * cube, (kMostLoss - 1) * volume * per_volume);
      const double most =
          std::min((kMostGrowth - 1) * cube, (kMostGrowth - 1) * std::max(volume, 0.1 * report_.demands[i]) * per_volume);
      const double move = std::clamp(step + share * state.previous_move[i], least, most);
      state.previous_move[i] = move;
      weights[i] = std::max(weight_of_cube(cube + move), kLeastShare * weight_of_volume(report_.demands[i]));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
  }

  // Damped Newton. The last move is judged by what it led to: taken back by half where it went too far (Kitagawa, Mérigot and
  // Thibert 2019: cells must not vanish, the residual has to fall), else followed by the next step.
  void move_together(std::span<const CellMeasure> cells) {
    FitState& state = report_.state;
    double squares = 0, ratio = 1;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!is_fitted(i)) continue;
      const double error = cells[i].volume - report_.demands[i];
      squares += error * error / report_.demands[i];
      ratio = std::min(ratio, cells[i].volume / report_.demands[i]);
    }
    const double residual = std::sqrt(squares);
    if (state.residual >= 0 && state.share > kLeastStep &&
        (ratio < state.least_ratio || residual > (1 - 0.1 * state.share) * state.residual)) {
      state.share *= 0.5;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (is_fitted(i)) follow(i, cube_of_radius(sites_[i].weight) - state.previous_move[i]);
      }
      return;
    }
    // A round of repair first; what is empty even then must not hold up the others.
    if (ratio <= 0 && state.share > 0) return repair(cells);
    if (state.residual < 0) state.least_ratio = 0.5 * ratio;
    step_together(cells, residual);
  }

  void repair(std::span<const CellMeasure> cells) {
    report_.state.residual = -1;
    report_.state.share = 0;
    std::vector<double> weights(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      weights[i] = is_fitted(i) && !(cells[i].volume > 0) ? repaired_weight(i) : sites_[i].weight;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
  }

  void step_together(std::span<const CellMeasure> cells, double residual) {
    FitState& state = report_.state;
    std::vector<double> wanted(cells.size(), 0);
    std::vector<std::uint8_t> fitted(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      fitted[i] = is_fitted(i);
      if (fitted[i]) wanted[i] = report_.demands[i] - cells[i].volume;
    }
    const std::vector<double> change =
        ResponseSystem(sites_, cells, fitted).solve(wanted, std::min(1e-3, 0.1 * std::max(1e-9, report_.error)));
    state.residual = residual;
    state.share = options_.damping;
    state.direction.assign(cells.size(), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (fitted[i] && cells[i].volume > 0) state.direction[i] = 1.5 * std::sqrt(sites_[i].weight) * change[i];
      if (fitted[i]) follow(i, cube_of_radius(sites_[i].weight));
    }
  }

  // Goes the current share of the step from a place. The bounds bend the way, but less and less as the share shrinks.
  void follow(std::size_t i, double from) {
    FitState& state = report_.state;
    const double cube = std::max(from + state.share * state.direction[i], kLeastOfCube * from);
    sites_[i].weight = std::max(weight_of_cube(cube), kLeastShare * weight_of_volume(report_.demands[i]));
    state.previous_move[i] = cube_of_radius(sites_[i].weight) - from;
  }

  // Moves of the last call are comparable only while the problem is the same.
  void recognise(std::span<const PowerSite> sites, std::span<const double> demands) {
    Hash hash;
    for (const Domain::Piece& piece : domain_.pieces) {
      for (const Point3& v : piece.shape.vertices) hash.add(v);
    }
    for (std::size_t i = 0; i < sites.size(); ++i) {
      hash.add(sites[i].position);
      hash.add(demands[i]);
      hash.add(std::uint64_t{free_[i]});
      if (!free_[i]) hash.add(sites[i].weight);
    }
    if (report_.state.problem != hash.value()) report_.state.residual = -1;
    report_.state.problem = hash.value();
  }

  // The constant gain of 2007.
  void move_by_gain(std::span<const CellMeasure> cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (!is_fitted(i)) continue;
      const double weight = sites_[i].weight + options_.gain * (report_.demands[i] - cells[i].volume);
      sites_[i].weight = std::max(weight, kLeastShare * weight_of_volume(report_.demands[i]));
    }
  }

  const Domain& domain_;
  FitOptions options_;
  std::vector<PowerSite> sites_;
  std::vector<std::uint8_t> free_;
  FitReport report_;
};

}  // namespace

Result<FitReport> adapt_weights(const Domain& domain, std::span<const PowerSite> sites, std::span<const double> demands,
                                std::span<const std::uint8_t> locked, const FitState& state, const FitOptions& options) {
  if (demands.size() != sites.size() || (!locked.empty() && locked.size() != sites.size())) {
    return Error{ErrorCode::out_of_range, "", "there has to be one demand, and one lock or none, for each site"};
  }
  for (std::size_t i = 0; i < demands.size(); ++i) {
    if (!std::isfinite(demands[i]))
      return Error{ErrorCode::not_finite, "", "the demand of site " + std::to_string(i) + " is not a number"};
    if (demands[i] < 0) return Error{ErrorCode::out_of_range, "", "the demand of site " + std::to_string(i) + " is negative"};
  }
  if (!(options.gain >= 0) || !std::isfinite(options.gain) || !(options.damping > 0 && options.damping <= 1) ||
      !(options.tolerance >= 0)) {
    return Error{ErrorCode::out_of_range, "", "gain and tolerance have to be zero or more, damping between 0 and 1"};
  }
  return Fit(domain, sites, demands, locked, state, options).run();
}

}  // namespace bl
