// Conjugate gradients on the bonds between sampled cells.
#include "core/geometry/inside/potential_system.h"

#include <ranges>
#include <utility>

#include "core/geometry/inside/conjugate_gradients.h"
#include "core/geometry/inside/none.h"

namespace bl::geometry {

namespace {

constexpr int kMostPotentialIterations = 2000;
// Takes the constant vector out of the kernel where there is no free surface, as a share of the diagonal.
constexpr double kPotentialPin = 1e-9;

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
      alone[u] += kPotentialPin * (alone[u] + diagonal[u]);
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
  GradientVectors vectors;
  vectors.assign(count);
  for (std::size_t u = 0; u < count; ++u) vectors.residual[u] = system.diagonal[u] > 0 ? wanted[u] : 0;
  conjugate_gradients(
      std::views::iota(std::size_t{0}, count), vectors, kMostPotentialIterations,
      [&](const std::vector<double>& x, std::vector<double>& image) { system.multiply(x, image); },
      [&](std::size_t u, double residual) { return system.diagonal[u] > 0 ? residual / system.diagonal[u] : 0; },
      [&](double rest, double first) { return !(rest > tolerance * tolerance * first); });
  return std::move(vectors.solution);
}

}  // namespace bl::geometry
