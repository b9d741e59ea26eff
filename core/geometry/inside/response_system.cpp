// Sparse symmetric system, one row per site.
#include "core/geometry/inside/response_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/geometry/inside/conjugate_gradients.h"

namespace bl::geometry {

namespace {

constexpr int kMostIterations = 2000;
// With no free surface at all the system has the constant vector in its kernel; this share of the diagonal takes it out.
constexpr double kPin = 1e-9;

}  // namespace

ResponseSystem::ResponseSystem(std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                               std::span<const std::uint32_t> free, std::span<const std::uint32_t> unknown_of)
    : first_(1, 0), unknown_of_(unknown_of) {
  const auto is_unknown = [&](std::size_t i) {
    return unknown_of[i] != kStays && cells[i].volume > 0 && cells[i].volume_by_own_weight > 0;
  };
  for (const std::uint32_t i : free) {
    if (!is_unknown(i)) continue;
    sites_.push_back(i);
    diagonal_.push_back(cells[i].volume_by_own_weight * (1 + kPin));
    for (const FacetArea& facet : cells[i].facets) {
      if (facet.kind != FacetArea::Kind::site || !is_unknown(facet.index)) continue;
      column_.push_back(facet.index);
      value_.push_back(-facet.area / (2 * distance(sites[i].position, sites[facet.index].position)));
    }
    first_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
}

void ResponseSystem::multiply(const std::vector<double>& x, std::vector<double>& result) {
  for (const std::uint32_t u : unknowns_) result[u] = 0;
  for (std::size_t r = 0; r < sites_.size(); ++r) {
    const std::uint32_t own = unknown_of_[sites_[r]];
    double sum = diagonal_[r] * x[own];
    for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k) sum += value_[k] * x[unknown_of_[column_[k]]];
    result[own] += sum;
  }
}

std::vector<double> ResponseSystem::solve(std::span<const double> wanted, double tolerance) {
  // The diagonal of the summed system; bonds within one unknown count into it.
  std::vector<double> scale(wanted.size(), 0);
  for (std::size_t r = 0; r < sites_.size(); ++r) {
    const std::uint32_t own = unknown_of_[sites_[r]];
    unknowns_.push_back(own);
    scale[own] += diagonal_[r];
    for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k)
      if (unknown_of_[column_[k]] == own) scale[own] += value_[k];
  }
  std::sort(unknowns_.begin(), unknowns_.end());
  unknowns_.erase(std::unique(unknowns_.begin(), unknowns_.end()), unknowns_.end());
  GradientVectors vectors;
  vectors.assign(wanted.size());
  for (const std::uint32_t u : unknowns_) {
    vectors.residual[u] = scale[u] > 0 ? wanted[u] : 0;
    scale[u] = scale[u] > 0 ? 1 / scale[u] : 0;
  }
  conjugate_gradients(
      unknowns_, vectors, kMostIterations, [&](const std::vector<double>& x, std::vector<double>& image) { multiply(x, image); },
      [&](std::size_t u, double residual) { return residual * scale[u]; },
      [&](double rest, double first) { return !(rest > tolerance * tolerance * first); });
  return std::move(vectors.solution);
}

}  // namespace bl::geometry
