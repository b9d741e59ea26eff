// Sparse symmetric system, one row per site.
#include "core/geometry/inside/response_system.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include "core/geometry/inside/conjugate_gradients.h"

namespace bl::geometry {

namespace {

constexpr int kMostIterations = 2000;
// With no free surface at all the system has the constant vector in its kernel; this share of the diagonal takes it out.
constexpr double kPin = 1e-9;

}  // namespace

ResponseSystem::ResponseSystem(std::span<const PowerSite> sites, std::span<const CellMeasure> cells,
                               std::span<const std::uint8_t> is_free)
    : diagonal_(sites.size(), 0), first_(1, 0) {
  const auto is_unknown = [&](std::size_t i) { return is_free[i] && cells[i].volume > 0 && cells[i].volume_by_own_weight > 0; };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (is_unknown(i)) {
      diagonal_[i] = cells[i].volume_by_own_weight * (1 + kPin);
      for (const FacetArea& facet : cells[i].facets) {
        if (facet.kind != FacetArea::Kind::site || !is_unknown(facet.index)) continue;
        column_.push_back(facet.index);
        value_.push_back(-facet.area / (2 * distance(sites[i].position, sites[facet.index].position)));
      }
    }
    first_.push_back(static_cast<std::uint32_t>(column_.size()));
  }
}

void ResponseSystem::multiply(const std::vector<double>& x, std::vector<double>& result) {
  std::fill(result.begin(), result.end(), 0);
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    if (!(diagonal_[i] > 0)) continue;
    double sum = diagonal_[i] * x[unknown_of_[i]];
    for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) sum += value_[k] * x[unknown_of_[column_[k]]];
    result[unknown_of_[i]] += sum;
  }
}

std::vector<double> ResponseSystem::solve(std::span<const double> wanted, std::span<const std::uint32_t> unknown_of,
                                          double tolerance) {
  unknown_of_.assign(unknown_of.begin(), unknown_of.end());
  const std::size_t count = wanted.size();
  // The diagonal of the summed system; bonds within one unknown count into it.
  std::vector<double> scale(count, 0);
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    if (!(diagonal_[i] > 0)) continue;
    scale[unknown_of_[i]] += diagonal_[i];
    for (std::uint32_t k = first_[i]; k < first_[i + 1]; ++k) {
      if (unknown_of_[column_[k]] == unknown_of_[i]) scale[unknown_of_[i]] += value_[k];
    }
  }
  GradientVectors vectors;
  vectors.assign(count);
  for (std::size_t u = 0; u < count; ++u) {
    vectors.residual[u] = scale[u] > 0 ? wanted[u] : 0;
    scale[u] = scale[u] > 0 ? 1 / scale[u] : 0;
  }
  conjugate_gradients(
      std::views::iota(std::size_t{0}, count), vectors, kMostIterations,
      [&](const std::vector<double>& x, std::vector<double>& image) { multiply(x, image); },
      [&](std::size_t u, double residual) { return residual * scale[u]; },
      [&](double rest, double first) { return !(rest > tolerance * tolerance * first); });
  return std::move(vectors.solution);
}

}  // namespace bl::geometry
