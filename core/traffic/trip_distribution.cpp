// The gravity model, singly constrained in one step and doubly constrained by balancing.
#include "core/traffic/trip_distribution.h"

#include <algorithm>
#include <cmath>

namespace bl {

namespace {

constexpr int kMostRounds = 200;

double sum_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

// Every row gets its sum; rows without any weight lose it.
void scale_rows(std::vector<double>& trips, std::span<const double> leaving, std::vector<double>& lost) {
  const std::size_t n = leaving.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::span row = std::span(trips).subspan(i * n, n);
    const double sum = sum_of(row);
    lost[i] = sum > 0 ? 0 : leaving[i];
    for (double& value : row) value = sum > 0 ? value * (leaving[i] / sum) : 0;
  }
}

// Every column gets its sum. Returns the largest share by which one was off.
double scale_columns(std::vector<double>& trips, std::span<const double> arriving, double scale) {
  const std::size_t n = arriving.size();
  double largest = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += trips[i * n + j];
    const double wanted = arriving[j] * scale;
    if (!(sum > 0) || !(wanted > 0)) continue;
    largest = std::max(largest, std::abs(sum - wanted) / wanted);
    for (std::size_t i = 0; i < n; ++i) trips[i * n + j] *= wanted / sum;
  }
  return largest;
}

}  // namespace

TripDistribution distribute_trips(std::span<const double> times, std::span<const double> leaving,
                                  std::span<const double> arriving, double fade, TripConstraint constraint, double tolerance) {
  const std::size_t n = leaving.size();
  TripDistribution out{std::vector<double>(n * n, 0), std::vector<double>(n, 0), 0};
  for (std::size_t i = 0; i < n; ++i) {
    // Against the nearest destination, so that a far one is not rounded to nothing.
    double nearest = HUGE_VAL;
    for (std::size_t j = 0; j < n; ++j)
      if (i != j && arriving[j] > 0) nearest = std::min(nearest, times[i * n + j]);
    for (std::size_t j = 0; j < n; ++j)
      if (const double time = times[i * n + j]; i != j && std::isfinite(time) && leaving[i] > 0 && std::isfinite(nearest))
        out.trips[i * n + j] = arriving[j] * std::exp(-(time - nearest) / fade);
  }
  scale_rows(out.trips, leaving, out.lost);
  if (constraint == TripConstraint::origins || !(sum_of(arriving) > 0)) return out;
  const double scale = sum_of(leaving) / sum_of(arriving);
  for (; out.rounds < kMostRounds; ++out.rounds) {
    const double error = scale_columns(out.trips, arriving, scale);
    scale_rows(out.trips, leaving, out.lost);
    if (error <= tolerance) break;
  }
  return out;
}

}  // namespace bl
