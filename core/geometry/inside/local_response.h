// How all volumes answer to changes of weights, kept up to date row by row, and solved for some of the sites.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/inside/conjugate_gradients.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// The matrix dV_i/dw_j as in ResponseSystem, for sites whose cells are made anew at different times. A bond of two sites has one
/// value, that of the cell made last; so the matrix stays symmetric.
class LocalResponse {
 public:
  void reset(std::size_t count);
  void resize(std::size_t count);
  /// Takes over what a cell that has just been made says of its site's row; appends to `lost` the sites that it no longer
  /// borders.
  void set_row(std::uint32_t site, std::span<const PowerSite> sites, const CellMeasure& cell, std::vector<std::uint32_t>& lost);
  double diagonal(std::uint32_t site) const { return rows_[site].free + rows_[site].bound; }

  /// The sites that miss their demand by more than a share `enough` of it, and those so many bonds around them, in ascending
  /// order; all sites that count where that comes to many.
  std::span<const std::uint32_t> active_around(std::span<const double> demand, std::span<const double> volume,
                                               std::span<const std::uint8_t> absent, double enough, int rings);

  /// Changes of weight [m²] of the active sites, the others held, that bring their volumes to their demands within a share
  /// `enough` of each: conjugate gradients, preconditioned by the diagonal.
  const std::vector<double>& solve(std::span<const std::uint32_t> active, std::span<const double> demand,
                                   std::span<const double> volume, double enough);

  /// The largest share of its own volume that a cell's borders would sweep with the whole of the last solution.
  double largest_sweep(std::span<const std::uint32_t> active, std::span<const double> volume);

  /// What a share of the last solution does to the volumes, to first order; `shift` grows by how far the farthest of a cell's
  /// borders moves [m].
  void apply(std::span<const std::uint32_t> active, double share, std::vector<double>& volume, std::vector<double>& shift);
  /// The sites whose volumes the last apply() has changed.
  std::span<const std::uint32_t> touched() const { return touched_; }

 private:
  struct Bond {
    std::uint32_t other;
    double value;  ///< A_ij / (2 d_ij) [m]
    double lever;  ///< 1 / (2 d_ij) [1/m]: how far the bisector moves with the difference of the weights
  };
  struct Row {
    double lever = 0;            ///< 1 / (2 r) [1/m]: how far the ball grows with the weight
    double free = 0, bound = 0;  ///< part of the diagonal from the spherical surface, and from the bonds [m]
    std::vector<Bond> bonds;
  };

  void multiply(std::span<const std::uint32_t> active, const std::vector<double>& x, std::vector<double>& result) const;

  std::vector<Row> rows_;
  std::vector<std::uint8_t> is_active_;
  std::vector<std::uint32_t> active_, touched_;
  GradientVectors vectors_;  // solution: the last change of weights [m²]
  std::vector<double> shift_;
};

}  // namespace bl::geometry
