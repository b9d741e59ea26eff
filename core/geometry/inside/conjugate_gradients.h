// Conjugate gradients with a diagonal, over all unknowns or some: one loop for all linear responses.
#pragma once

#include <cstddef>
#include <vector>

#include "core/base/stop_check.h"

namespace bl::geometry {

/// What the loop works on; kept between two solutions it saves the memory's making.
struct GradientVectors {
  std::vector<double> solution, residual, scaled, direction, image;

  void assign(std::size_t count) {
    for (auto* values : {&solution, &residual, &scaled, &direction, &image}) values->assign(count, 0);
  }
};

/// Fills `solution` at the given rows from `residual`, which holds what is wanted there. `multiply` writes the image of
/// `direction`, `scale` divides a row's residual by its diagonal, and `is_enough` judges the scaled residual r·s beside the
/// first one. One after the other in the order of the rows, so that the arguments alone decide every bit.
template <class Rows, class Multiply, class Scale, class IsEnough>
void conjugate_gradients(const Rows& rows, GradientVectors& v, int most_iterations, const Multiply& multiply, const Scale& scale,
                         const IsEnough& is_enough) {
  const auto precondition = [&] {
    double sum = 0;
    for (const auto u : rows) {
      v.scaled[u] = scale(u, v.residual[u]);
      sum += v.residual[u] * v.scaled[u];
    }
    return sum;
  };
  double rest = precondition();
  const double first = rest;
  for (const auto u : rows) {
    v.solution[u] = 0;
    v.direction[u] = v.scaled[u];
  }
  for (int i = 0; i < most_iterations && !is_enough(rest, first); ++i) {
    if (i % 8 == 7 && is_stop_wished()) break;
    multiply(v.direction, v.image);
    double curvature = 0;
    for (const auto u : rows) curvature += v.direction[u] * v.image[u];
    if (!(curvature > 0)) break;
    const double length = rest / curvature;
    for (const auto u : rows) {
      v.solution[u] += length * v.direction[u];
      v.residual[u] -= length * v.image[u];
    }
    const double next = precondition();
    for (const auto u : rows) v.direction[u] = v.scaled[u] + (next / rest) * v.direction[u];
    rest = next;
  }
}

}  // namespace bl::geometry
