// Conjugate gradients on the bonds between sampled cells.
#include "core/geometry/potential_system.h"

namespace bl {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;
constexpr int kMostIterations = 2000;
// Takes the constant vector out of the kernel where there is no free surface, as a share of the diagonal.
constexpr double kPin = 1e-9;

double product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Bonds between unknowns; what binds an unknown to a site that stays is on the diagonal only.
struct System {
  struct Bond {
    std::uint32_t a, b;
    double response;
  };
  std::vector<double> alone, diagonal;
  std::vector<Bond> bonds;

  System(const SampledCells& cells, std::span<const std::uint32_t> unknown_of, std::size_t count)
      : alone(count, 0), diagonal(count, 0) {
    for (std::size_t i = 0; i < unknown_of.size(); ++i) {
      if (unknown_of[i] != kNone) alone[unknown_of[i]] += cells.free_responses[i];
    }
    for (const SampledBond& bond : cells.bonds) {
      const std::uint32_t a = unknown_of[bond.a], b = unknown_of[bond.b];
      if (a == b) continue;
      if (a == kNone || b == kNone) {
        alone[a == kNone ? b : a] += bond.response;
        continue;
      }
      bonds.push_back({a, b, bond.response});
      diagonal[a] += bond.response;
      diagonal[b] += bond.response;
    }
    for (std::size_t u = 0; u < count; ++u) {
      alone[u] += kPin * (alone[u] + diagonal[u]);
      diagonal[u] += alone[u];
    }
  }

  void multiply(const std::vector<double>& x, std::vector<double>& y) const {
    for (std::size_t u = 0; u < x.size(); ++u) y[u] = alone[u] * x[u];
    for (const Bond& bond : bonds) {
      const double flow = bond.response * (x[bond.a] - x[bond.b]);
      y[bond.a] += flow;
      y[bond.b] -= flow;
    }
  }
};

}  // namespace

std::vector<double> solve_potentials(const SampledCells& cells, std::span<const std::uint32_t> unknown_of,
                                     std::span<const double> wanted, double tolerance) {
  const std::size_t count = wanted.size();
  const System system(cells, unknown_of, count);
  std::vector<double> x(count, 0), residual(count), scaled(count), direction, image(count);
  const auto precondition = [&] {
    for (std::size_t u = 0; u < count; ++u) scaled[u] = system.diagonal[u] > 0 ? residual[u] / system.diagonal[u] : 0;
  };
  for (std::size_t u = 0; u < count; ++u) residual[u] = system.diagonal[u] > 0 ? wanted[u] : 0;
  precondition();
  direction = scaled;
  double rest = product(residual, scaled);
  const double enough = tolerance * tolerance * rest;
  for (int i = 0; i < kMostIterations && rest > enough; ++i) {
    system.multiply(direction, image);
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
