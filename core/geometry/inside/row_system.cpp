// Solves sparse systems that are not symmetric by BiCGSTAB.
#include "core/geometry/inside/row_system.h"

#include <cmath>
#include <cstddef>

namespace bl::geometry {

namespace {

using Numbers = std::vector<double>;

// The rows divided by their diagonals.
void multiply(const RowSystem& system, const Numbers& x, Numbers& into) {
  for (std::size_t r = 0; r < system.size(); ++r) {
    double sum = 0;
    for (std::uint32_t k = system.starts[r]; k < system.starts[r + 1]; ++k) sum += system.values[k] * x[system.columns[k]];
    into[r] = x[r] + sum / system.diagonal[r];
  }
}

double product(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

}  // namespace

std::vector<double> solve(const RowSystem& system, std::span<const double> right, double share) {
  constexpr int kMostRounds = 1000;
  const std::size_t count = system.size();
  Numbers x(count, 0), rest(count), along(count, 0), image(count, 0), turned(count);
  for (std::size_t r = 0; r < count; ++r) rest[r] = right[r] / system.diagonal[r];
  const Numbers shadow = rest;
  const double goal = share * share * product(rest, rest);
  Numbers best = x;
  double least = product(rest, rest), rho = 1, alpha = 1, omega = 1;
  for (int round = 0; round < kMostRounds && least > goal; ++round) {
    const double next = product(shadow, rest);
    const double beta = next / rho * (alpha / omega);
    rho = next;
    for (std::size_t r = 0; r < count; ++r) along[r] = rest[r] + beta * (along[r] - omega * image[r]);
    multiply(system, along, image);
    alpha = rho / product(shadow, image);
    for (std::size_t r = 0; r < count; ++r) rest[r] -= alpha * image[r];
    multiply(system, rest, turned);
    const double length = product(turned, turned);
    omega = length > 0 ? product(turned, rest) / length : 0;
    for (std::size_t r = 0; r < count; ++r) {
      x[r] += alpha * along[r] + omega * rest[r];
      rest[r] -= omega * turned[r];
    }
    const double now = product(rest, rest);
    if (!std::isfinite(now)) break;
    if (now < least) {
      least = now;
      best = x;
    }
    if (omega == 0 || rho == 0) break;
  }
  return best;
}

}  // namespace bl::geometry
