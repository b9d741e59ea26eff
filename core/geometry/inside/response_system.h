// The linear response of all volumes to all weights, and its solution: the heart of the Newton step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// The matrix dV_i/dw_j of the sites that are free to move: off the diagonal -A_ij / (2 d_ij), on it the sum of these plus
/// spherical area / (2 radius). Symmetric and positive definite while some shape has a free surface.
class ResponseSystem {
 public:
  static constexpr std::uint32_t kStays = 0xffffffffu;

  /// `free`: the sites whose weights are unknowns, ascending. `unknown_of` gives, per site, the unknown that its weight moves
  /// with, or kStays. Several sites may share one, and the sum of their volumes changes as wanted. Sites without volume take no
  /// part.
  ResponseSystem(std::span<const PowerSite> sites, std::span<const CellMeasure> cells, std::span<const std::uint32_t> free,
                 std::span<const std::uint32_t> unknown_of);

  /// Changes of weight [m²] per unknown for wanted changes of volume [m³]. Conjugate gradients, preconditioned by the diagonal,
  /// until the scaled residual has shrunk by `tolerance`. Sequential, so the result depends on the arguments alone.
  std::vector<double> solve(std::span<const double> wanted, double tolerance);

 private:
  void multiply(const std::vector<double>& x, std::vector<double>& result);

  std::vector<std::uint32_t> sites_;   // of the rows, ascending: those that take part
  std::vector<double> diagonal_;       // by row
  std::vector<std::uint32_t> first_;   // row r: entries first_[r] .. first_[r + 1)
  std::vector<std::uint32_t> column_;  // sites
  std::vector<double> value_;
  std::span<const std::uint32_t> unknown_of_;
  std::vector<std::uint32_t> unknowns_;  // that have a row, ascending
};

}  // namespace bl::geometry
