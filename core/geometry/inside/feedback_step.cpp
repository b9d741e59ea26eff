// Feedback: each weight follows the error of its own volume.
#include <algorithm>
#include <cmath>

#include "core/geometry/inside/fit_numbers.h"
#include "core/geometry/inside/weight_fit.h"

namespace bl::geometry {

namespace {

// In one step r³ at most doubles, and loses at most half: beyond that the linear response says nothing any more.
constexpr double kMostGrowth = 2, kMostLoss = 0.5;
// Share of the diagonal step: the response matrix, scaled by its diagonal, has eigenvalues between 0 and 2.
constexpr double kStep = 0.8;

// The change of weight [m²] that brings one cell to its demand while the others stay. A cell bounded by its neighbours
// grows like the cube of the change, a free ball slower, so a cell far too small is led by its cube root, and one too
// large by its volume: of the two estimates always the more careful one.
double response_step(const CellMeasure& cell, double missing) {
  const double linear = missing / cell.volume_by_own_weight;
  if (missing <= 0) return linear;
  const double side = cube_root(cell.volume);
  return std::min(linear, 3 * side * side * (cube_root(cell.volume + missing) - side) / cell.volume_by_own_weight);
}

}  // namespace

// Feedback: each site by its own response, with Nesterov's acceleration in radius³ (the ball's volume is linear in it).
void WeightFit::move_alone(std::span<const CellMeasure> cells) {
  FitState& state = report_.state;
  // Against the slope: the acceleration has overshot and starts again (O'Donoghue and Candès 2015).
  double agreement = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (moves(i)) agreement += missing(cells, i) * state.previous_move[i] / std::max(1e-300, sites_[i].weight);
  }
  if (agreement < 0) state.momentum = 1;
  const double next = 0.5 * (1 + std::sqrt(1 + 4 * state.momentum * state.momentum));
  const double share = (state.momentum - 1) / next;
  state.momentum = next;
  std::vector<double> weights(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    weights[i] = sites_[i].weight;
    if (!moves(i)) continue;
    if (!(cells[i].volume > 0) || !(cells[i].volume_by_own_weight > 0)) {
      // Emptied by its own last move: half of that back. Otherwise its neighbours did it.
      const double back = -0.5 * state.previous_move[i];
      weights[i] = back > 0 ? weight_of_cube(cube_of_radius(sites_[i].weight) + back) : repaired_weight(i);
      state.previous_move[i] = 0;
      continue;
    }
    const double part = targets_.part(i);
    const double cube = cube_of_radius(sites_[i].weight), stretch = 1.5 * std::sqrt(sites_[i].weight);
    const double step = options_.damping * kStep * stretch * response_step(cells[i], missing(cells, i));
    const double volume = cells[i].volume, per_volume = stretch / cells[i].volume_by_own_weight;
    const double least = std::max((kMostLoss - 1) * cube, (kMostLoss - 1) * volume * per_volume);
    const double most = std::min((kMostGrowth - 1) * cube, (kMostGrowth - 1) * std::max(volume, 0.1 * part) * per_volume);
    const double move = std::clamp(step + share * state.previous_move[i], least, most);
    state.previous_move[i] = move;
    weights[i] = std::max(weight_of_cube(cube + move), kLeastShare * weight_of_volume(part));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) sites_[i].weight = weights[i];
}

// The constant gain of 2007.
void WeightFit::move_by_gain(std::span<const CellMeasure> cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!moves(i)) continue;
    const double weight = sites_[i].weight + options_.gain * missing(cells, i);
    sites_[i].weight = std::max(weight, kLeastShare * weight_of_volume(targets_.part(i)));
  }
}

}  // namespace bl::geometry
