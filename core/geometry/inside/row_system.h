// A sparse system of linear equations that is not symmetric, and its solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace bl::geometry {

/// Rows of a square matrix, each with a diagonal that is not zero.
struct RowSystem {
  std::vector<double> diagonal;
  std::vector<std::uint32_t> starts{0}, columns;  // the others of row r: starts[r] to starts[r + 1]
  std::vector<double> values;

  std::size_t size() const { return diagonal.size(); }
};

/// BiCGSTAB (van der Vorst 1992) with the diagonal as preconditioner, from zero, until the residual has fallen to `share` of the
/// right side. Where it stops earlier, the best solution that it has met.
std::vector<double> solve(const RowSystem& system, std::span<const double> right, double share);

}  // namespace bl::geometry
