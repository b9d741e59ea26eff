// The linear response of all sampled volumes to all potentials, and its solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/inside/sampled_diagram.h"

namespace bl::geometry {

/// Changes of potential per unknown for wanted changes of volume [m³]. `unknown_of` gives per site the unknown that its potential
/// moves with (several sites may share one), or 0xffffffff for sites that stay. The matrix has -response off the diagonal and, on
/// it, the sum of these and the free responses: symmetric, and positive definite while there is free surface. Conjugate gradients
/// with the diagonal, until the scaled residual has shrunk by `tolerance`; sequential, so the arguments alone decide.
std::vector<double> solve_potentials(const SampledCells& cells, std::span<const std::uint32_t> unknown_of,
                                     std::span<const double> wanted, double tolerance);

}  // namespace bl::geometry
