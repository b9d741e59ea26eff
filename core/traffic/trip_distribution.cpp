// The gravity model, singly constrained in one step and doubly constrained by balancing.
#include "core/traffic/trip_distribution.h"

#include <algorithm>
#include <cmath>

#include "core/base/mathematics.h"

namespace bl::traffic {

namespace {

constexpr int kMostRounds = 200;
// Where the error falls by a smaller share in a round, the columns cannot be met.
constexpr double kLeastProgress = 1e-6;

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

// Row by row, as they lie in memory.
std::vector<double> column_sums(const std::vector<double>& trips, std::size_t n) {
  std::vector<double> sums(n, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) sums[j] += trips[i * n + j];
  return sums;
}

// Every column gets its sum. Returns the largest share by which one was off.
double scale_columns(std::vector<double>& trips, std::span<const double> arriving, double scale) {
  const std::size_t n = arriving.size();
  double largest = 0;
  std::vector<double> factors = column_sums(trips, n);
  for (std::size_t j = 0; j < n; ++j) {
    const double sum = factors[j], wanted = arriving[j] * scale;
    factors[j] = 1;
    if (!(sum > 0) || !(wanted > 0)) continue;
    largest = std::max(largest, std::abs(sum - wanted) / wanted);
    factors[j] = wanted / sum;
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) trips[i * n + j] *= factors[j];
  return largest;
}

}  // namespace

TripDistribution distribute_trips(std::span<const double> times, std::span<const double> leaving,
                                  std::span<const double> arriving, double fade, TripConstraint constraint, double tolerance) {
  const std::size_t n = leaving.size();
  TripDistribution out{std::vector<double>(n * n, 0), std::vector<double>(n, 0), {}, 0};
  for (std::size_t i = 0; i < n; ++i) {
    // Against the nearest destination, so that a far one is not rounded to nothing.
    double nearest = HUGE_VAL;
    for (std::size_t j = 0; j < n; ++j)
      if (i != j && arriving[j] > 0) nearest = std::min(nearest, times[i * n + j]);
    for (std::size_t j = 0; j < n; ++j)
      if (const double time = times[i * n + j]; i != j && std::isfinite(time) && leaving[i] > 0 && std::isfinite(nearest))
        out.trips[i * n + j] = arriving[j] * mathematics::exponential(-(time - nearest) / fade);
  }
  scale_rows(out.trips, leaving, out.lost);
  if (constraint == TripConstraint::origins) return out;
  const double scale = sum_of(arriving) > 0 ? sum_of(leaving) / sum_of(arriving) : 0;
  for (double last = HUGE_VAL; scale > 0 && out.rounds < kMostRounds; ++out.rounds) {
    const double error = scale_columns(out.trips, arriving, scale);
    scale_rows(out.trips, leaving, out.lost);
    if (error <= tolerance || error > (1 - kLeastProgress) * last) break;
    last = error;
  }
  out.missing.assign(arriving.begin(), arriving.end());
  const std::vector<double> ending = column_sums(out.trips, n);
  for (std::size_t j = 0; j < n; ++j) out.missing[j] -= ending[j];
  return out;
}

}  // namespace bl::traffic
