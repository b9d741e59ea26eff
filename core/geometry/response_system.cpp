// Sparse symmetric system, one row per site.
#include "core/geometry/response_system.h"

#include <algorithm>
#include <cmath>

namespace bl {

namespace {

constexpr int kMostIterations = 2000;
// With no free surface at all the system has the constant vector in its kernel; this share of the diagonal takes it out.
constexpr double kPin = 1e-9;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

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
  std::vector<double> x(count, 0), residual(count, 0), scaled(count), direction, image(count);
  for (std::size_t u = 0; u < count; ++u) {
    residual[u] = scale[u] > 0 ? wanted[u] : 0;
    scale[u] = scale[u] > 0 ? 1 / scale[u] : 0;
  }
  const auto precondition = [&] {
    for (std::size_t u = 0; u < count; ++u) scaled[u] = residual[u] * scale[u];
  };
  precondition();
  direction = scaled;
  double rest = product(residual, scaled);
  const double enough = tolerance * tolerance * rest;
  for (int i = 0; i < kMostIterations && rest > enough; ++i) {
    multiply(direction, image);
    const double curvature = product(direction, image);
    if (!(curvature > 0)) break;
    const double length = rest / curvature;
    for (std::size_t u = 0; u < count; ++u) {
      x[u] += length * direction[u];
      residual[u] -= length * image[u];
    }
    precondition();
    const double next = product(residual, scaled);
    for (std::size_t u = 0; u < count; ++u) direction[u] = scaled[u] + (next / rest) * direction[u];
    rest = next;
  }
  return x;
}

}  // namespace bl
