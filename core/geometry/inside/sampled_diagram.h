// The bounded, shrink-wrapped diagram under other metrics than the power distance, measured along lines instead of exactly.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/geometry/inside/site_metric.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// "power", "additive", "multiplicative".
std::string_view name_of(Metric metric);

/// Lines along the longest side of the domain's box, at most: some hundred megabytes of lines.
inline constexpr int kMostSamples = 1024;

struct SampleOptions {
  Metric metric = Metric::power;
  int samples = 96;                             ///< the declared resolution: lines along the longest side of the domain's box
  double storey_height = 3;                     ///< [m], for the floor area
  std::span<const double> storey_heights = {};  ///< [m], per site; overrides `storey_height` where not empty
  bool with_storeys = true;                     ///< off: floor area, footprint, height and bottom stay 0; saves half of the time
  ThreadPool* pool = nullptr;                   ///< null: on the calling thread. The result does not depend on it
};

/// How the volumes of two sites follow each other's potentials (see Metric): dV_a/dψ_b = dV_b/dψ_a = -response.
struct SampledBond {
  std::uint32_t a = 0, b = 0;  ///< a < b
  double response = 0;         ///< integral of 1 / |∇c_a - ∇c_b| over the facet
};

/// The cells, and what is known of their accuracy.
struct SampledCells {
  /// The records of power_cells(), measured by sampling, without outlines and meshes. Volumes, areas, centroids and floor areas
  /// are estimates; height and bottom are those of what the lines meet, so corners between lines are missed.
  std::vector<CellMeasure> cells;
  /// Declared error of each volume [m³]: 0.4 step² sqrt(surface + 6 step²) plus 0.75 times the range of the three estimates by
  /// the lines of one direction each (their mean is the volume). The first part is the law of systematic sampling: columns at
  /// the rim err independently, so the standard deviation is k h² sqrt(S) (Matheron 1971), and k = 0.1 was measured; the second
  /// sees what that law does not, a facet that runs along the lines of one direction. An estimate, not a proof: no error of
  /// 20 448 cells of random and lattice sites, compared with the exact ones, was beyond it, and half were below a tenth of it.
  std::vector<double> errors;
  double step = 0;                     ///< between neighbouring lines [m]
  double domain_volume = 0;            ///< of the domain as the same lines see it [m³]: what the cell volumes add up to
  std::size_t lines = 0;               ///< that meet the domain, in three directions
  std::vector<SampledBond> bonds;      ///< sorted by (a, b)
  std::vector<double> free_responses;  ///< per site: dV/dψ through its free surface, the part on the ball
};

/// The cells of all sites, in the order of the sites; every site gets a record. For any domain. Fails on what makes no sense:
/// numbers that are not finite, negative weights where a radius is needed, a resolution out of bounds.
Result<SampledCells> sampled_cells(const Domain& domain, std::span<const PowerSite> sites, const SampleOptions& options = {});

/// The same with the domain's lines kept between calls. Results depend on the arguments alone.
class SampledDiagram {
 public:
  SampledDiagram();
  ~SampledDiagram();
  SampledDiagram(SampledDiagram&&) noexcept;
  SampledDiagram& operator=(SampledDiagram&&) noexcept;

  /// Makes the lines, unless they are there from the last call.
  Result<void> set_domain(const Domain& domain, int samples, ThreadPool* pool = nullptr);
  /// `options.samples` is that of the domain.
  Result<SampledCells> measure(std::span<const PowerSite> sites, const SampleOptions& options) const;

 private:
  struct Ground;
  std::unique_ptr<Ground> ground_;
};

}  // namespace bl::geometry
