// Walks the lines of a sampling grid, block by block, and adds up what the sites own of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/inside/sample_lines.h"
#include "core/geometry/inside/site_metric.h"
#include "core/geometry/power_cells.h"

namespace bl::geometry {

/// A site in the frame of the grid.
struct FrameSite {
  std::array<double, 3> at;
  double weight = 0, radius = 0;  ///< [m²], [m]; the radius is 0 where the weight is not positive
};

/// What one site owns, in lengths along lines: times step² and over three, in volumes.
struct LineSums {
  std::array<double, 3> cell{}, shape{};  ///< per direction [m]
  Vector3 moment;                         ///< of the shape, in the frame [m²]
  double sphere = 0;                      ///< sum of |cosines| where lines leave the ball; times step² its free area
};

/// A facet of a shape: sums over the lines that cross it.
struct LineFacetSum {
  std::uint32_t site = 0;
  FaceKind kind = FaceKind::site;  ///< between sites, `site` is the lower of the two indices
  std::uint32_t index = 0;
  double area = 0;      ///< sum of |cosines|; times step² the area
  double response = 0;  ///< the same over |∇c_i - ∇c_j|
};

struct DiagramSums {
  std::vector<LineSums> sites;
  std::vector<LineFacetSum> facets;  ///< sorted by (site, kind, index), each once
};

/// Sums over the lines of all three directions. `participants` are indices into `sites`; others own nothing.
DiagramSums sum_lines(Metric metric, const SampleFrame& frame, const std::array<SampleLines, 3>& lines,
                      std::span<const FrameSite> sites, std::span<const std::uint32_t> participants, ThreadPool* pool);

/// What the upright lines of a grid see of one shape.
struct UprightSums {
  double lowest = 0, highest = 0;  ///< in the frame [m]
  std::uint64_t footprint = 0;     ///< lines that meet it
  std::uint64_t sections = 0;      ///< crossings of lines and sections of whole storeys: at (k + 1/2) above the lowest point
  std::uint64_t rest = 0;          ///< the same of the section in the middle of what is left above the whole storeys
};

/// Runs over the lines along axis 2 only, each as a whole. `storeys` are heights per site [m].
std::vector<UprightSums> sum_upright(Metric metric, const SampleFrame& frame, const SampleLines& lines,
                                     std::span<const FrameSite> sites, std::span<const std::uint32_t> participants,
                                     std::span<const double> storeys, ThreadPool* pool);

}  // namespace bl::geometry
